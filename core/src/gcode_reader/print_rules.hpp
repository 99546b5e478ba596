// The rules of a whole print, beyond those of each line: settings that change on the way, the nozzle's rests on what is
// laid, and layers that do not lie on each other. For files that somebody is about to print; blocks and plates
// that are just being written go without.
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

class PrintRules final : public Rules {
 public:
  /// \param machine  that the file says it is for; its limits count where neither the caller nor the file tells any.
  PrintRules(FileSettings settings, bool ours, const std::optional<Printer>& machine);

  /// After the last line: names of the limits that were not judged, as neither the caller nor the file told them.
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

  // By setting; below 0: never told.
  std::array<double, kSettings> now_{};
  std::array<double, kSettings> atFirst_{};  // at the layers' first bead
  std::array<double, kSettings> before_{};   // the most before that
  std::vector<Change> pending_;              // since the last bead
  std::vector<Change> changes_;
  bool laying_ = false;  // a bead of a layer was laid
  bool homed_ = false;   // by the end block

  // Facts that the file tells of itself, perhaps only at its end.
  std::vector<double> temperatures_;
  std::size_t filaments_ = 0;
  bool pla_ = false;
  double mostSpeed_ = 0;  // [mm/s]
  double mostPush_ = 0;   // [mm/s], of filament alone
  double fastest_ = 0;    // of the layers' beads
  std::int64_t fastestLine_ = 0;
  double fastestPush_ = 0;
  std::int64_t fastestPushLine_ = 0;

  double fan_ = 0;  // [%]
  double cooledMm_ = 0;
  double uncooledMm_ = 0;  // of beads above the second layer
  double firstMm_ = 0;
  double firstCooledMm_ = 0;  // with half a fan or more
  std::int64_t firstCooledLine_ = 0;
  double firstFan_ = 0;

  bool retractionKnown_ = false;
  double dragged_ = 0;  // [mm] over what is laid, since the last bead

  // Ways since the last bead in files of others, who tell a speed before each and before the bead behind it.
  bool toldF_ = false;
  bool wayToldF_ = false;  // before its end
  bool quiet_ = false;     // nothing but ways
  double way_ = 0;         // [mm]
  Vec2 wayStart_;
  std::int64_t gaps_ = 0;  // without either
  std::int64_t gapLine_ = 0;
  std::int64_t ways_ = 0;  // with both

  // Plastic by layers, beside what their marks tell.
  struct LayerFlow {
    std::int64_t line = 0;
    double laid = 0;  // [mm³]
    double told = 0;
  };
  std::vector<LayerFlow> flows_;
  bool plain_ = false;     // a role whose marks tell how much plastic it gets
  double width_ = 0;       // [mm], by the last mark; 0: none
  double pathHeight_ = 0;  // [mm]

  double told_ = -1;        // [mm], Z that a mark tells of this layer
  double toldBefore_ = -1;  // of the layer before
  double toldFirst_ = -1;   // of the lowest
  double height_ = 0;
  bool heightTold_ = false;
  double offset_ = 0;  // of all heights of another program's file
  bool offsetKnown_ = false;
  double usualStep_ = 0;  // [mm], by a header that tells the layers' height once
  double lastZ_ = -1;     // of the last layer without a mark of its own
  bool stepJudged_ = false;
  bool climbs_ = false;  // the layer has a bead that rises
  // The last level bead that lies off its layer, until the next one tells whether it climbs.
  std::int64_t offLine_ = 0;
  double offZ_ = 0;
  double offTop_ = 0;

  bool aside_ = false;  // skirts and brims
  Bounds box_;          // of this layer's beads
  Bounds below_;
  double boxZ_ = 0;
  double belowZ_ = 0;
  std::int64_t boxLine_ = 0;
};

}  // namespace sillon
