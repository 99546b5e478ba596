// Rules about a whole print, beyond those about each line: settings that change in mid-print, stops with the nozzle on
// the print, and layers that do not lie on each other. They are for files that are about to be printed; blocks, and
// plates that are just being written, go without.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gcode_reader/rules.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// Judges a file as Rules does, and as a whole print.
class PrintRules final : public Rules {
 public:
  /// \param machine  profile of the machine that the file names; its limits count if neither the caller nor the file
  /// states any.
  PrintRules(FileSettings settings, bool ours, const std::optional<Printer>& machine);

  /// Names of the limits that were not judged, since neither the caller nor the file states them. To be called after
  /// the last line.
  [[nodiscard]] std::vector<std::string> unchecked() const;

 private:
  enum Setting : std::size_t { Nozzle, Bed, Flow, Speed, Advance, Acceleration, Corner, Tool, kSettings };

  /// A setting that changed between beads of the layers.
  struct Change {
    Setting setting;
    std::int64_t line;
    double value;
  };

  void onCommand(std::string_view code) override;
  void onComment(std::string_view text) override;
  void onMove(const MachineMove& move) override;
  void onFilament(double e, double retractedBefore) override;
  void onLayer() override;
  void onFinish() override;

  void note(Setting setting, double value);
  void noteMotion(const GcodeCommand& command, const GcodeWords& words, const std::string& name);
  void noteFan(const GcodeCommand& command, const GcodeWords& words, const std::string& name);
  void judgeWait(const GcodeCommand& command, const GcodeWords& words, const std::string& name);
  void judgeEnd();
  void noteGap(const MachineMove& move);
  void noteFlow(const MachineMove& move);
  void judgeHeight(const MachineMove& move);
  void tellOff();
  void judgeSpeed(const MachineMove& move);
  void judge(const Change& change);
  void judgeHeat(const Change& change);
  void judgeFan();
  void judgeGaps();
  void judgeFlow();
  void readSettings(std::string_view text);
  void tell(std::string_view code, bool error, FindingValues values = {}, std::int64_t line = 0);
  [[nodiscard]] bool standsOnPrint() const;

  std::optional<Printer> profile_;

  // Values by Setting; below 0: never set.
  std::array<double, kSettings> now_{};
  std::array<double, kSettings> atFirst_{};  // values at the layers' first bead
  std::array<double, kSettings> before_{};   // greatest values before that bead
  std::vector<Change> pending_;              // changes since the last bead
  std::vector<Change> changes_;              // changes that a bead has followed
  bool laying_ = false;                      // a bead of a layer was laid
  bool homed_ = false;                       // the end block homes Z

  // Facts that the file states about itself, perhaps only at its end.
  std::vector<double> temperatures_;
  std::size_t filaments_ = 0;
  bool pla_ = false;
  double mostSpeed_ = 0;  // limit of X [mm/s]
  double mostPush_ = 0;   // limit of filament alone [mm/s]
  double fastest_ = 0;    // speed of the layers' fastest bead [mm/s]
  std::int64_t fastestLine_ = 0;
  double fastestPush_ = 0;
  std::int64_t fastestPushLine_ = 0;

  double fan_ = 0;         // [%]
  double cooledMm_ = 0;    // length of beads above the second layer with a fan
  double uncooledMm_ = 0;  // length of such beads without a fan
  double firstMm_ = 0;
  double firstCooledMm_ = 0;  // length of beads in the first layer with half the fan or more
  std::int64_t firstCooledLine_ = 0;
  double firstFan_ = 0;

  bool retractionKnown_ = false;
  double dragged_ = 0;  // travel over what is laid, since the last bead [mm]

  // Ways since the last bead, in files of other programs, which state a speed for each way and again for the bead
  // behind it.
  bool toldF_ = false;     // a speed was stated since the last way
  bool wayToldF_ = false;  // a speed was stated on the way
  bool quiet_ = false;     // there was nothing but ways
  double way_ = 0;         // length of the ways [mm]
  Vec2 wayStart_;
  std::int64_t gaps_ = 0;  // ways that lack one of the speeds
  std::int64_t gapLine_ = 0;
  std::int64_t ways_ = 0;  // ways with both speeds

  // Plastic of a layer, and the plastic that its marks ask for.
  struct LayerFlow {
    std::int64_t line = 0;
    double laid = 0;  // [mm³]
    double told = 0;  // [mm³]
  };
  std::vector<LayerFlow> flows_;
  bool plain_ = false;     // the role gets as much plastic as its marks ask for
  double width_ = 0;       // width by the last mark [mm]; 0: none
  double pathHeight_ = 0;  // height by the last mark [mm]

  double told_ = -1;        // Z of this layer by its mark [mm]; below 0: none
  double toldBefore_ = -1;  // Z of the layer before
  double toldFirst_ = -1;   // Z of the lowest layer
  double height_ = 0;
  bool heightTold_ = false;
  double offset_ = 0;  // shift of all heights of another program's file [mm]
  bool offsetKnown_ = false;
  double usualStep_ = 0;  // height of all layers by the header [mm]
  double lastZ_ = -1;     // Z of the last layer without a mark
  bool stepJudged_ = false;
  bool climbs_ = false;  // the layer has a bead that rises
  // The last level bead that lies off its layer, until the next one shows whether the layer climbs.
  std::int64_t offLine_ = 0;
  double offZ_ = 0;
  double offTop_ = 0;

  bool aside_ = false;  // the role is a skirt, a brim or a support
  Bounds box_;          // box of this layer's beads
  Bounds below_;        // box of the layer below
  double boxZ_ = 0;
  double belowZ_ = 0;
  std::int64_t boxLine_ = 0;
};

}  // namespace sillon
