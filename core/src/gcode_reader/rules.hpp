// The rules that a file is held to, line by line: what a printer would do, and what would go wrong.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gcode_reader/coverage.hpp"
#include "gcode_reader/file_settings.hpp"
#include "gcode_reader/layers.hpp"
#include "gcode_reader/machine.hpp"
#include "gcode_reader/parser.hpp"
#include "sillon/gcode_reader/check.hpp"

namespace sillon {

// Makes findings: the one place where their codes, rules and sentences stand.

using FindingValues = std::vector<std::pair<std::string, std::string>>;

/// \param code  one of the list in findings.cpp. \param values  for the sentence's {names}.
/// line and count are left to the caller.
GcodeFinding makeFinding(std::string_view code, bool error, FindingValues values = {});

/// Text of a file, as a sentence may show it: at most 60 characters, printable ASCII, quoted.
std::string shownText(std::string_view text);

/// The code of the finding about a command's words, or null.
const char* wordFault(const GcodeWords& words);

/// The values of the finding about offsets that were added up: empty if they are well.
FindingValues offsetFault(const Offsets::Axes& sum);

inline constexpr double kBeyondBed = 10;  ///< [mm], how far makers' blocks go over the bed's edge to wipe and purge

/// Whether a move goes deeper than any nozzle may: 0.5 mm below the bed; 2 mm where it is beside the bed, as makers'
/// blocks wipe there.
bool tooDeep(const MachineMove& move, const FileSettings& settings);

class Rules {
 public:
  /// \param ours  the file says that Sillon wrote it, and is held to more: closed cycles, plain lines, totals.
  Rules(FileSettings settings, bool ours);

  void line(const GcodeLine& line);
  /// The verdict; after the last line.
  GcodeCheck finish();

 protected:
  // For rules about whole prints, print_rules.hpp. Called behind each command, before each move that the machine has
  // made, and so on.
  virtual void onCommand(std::string_view) {}
  virtual void onComment(std::string_view) {}
  virtual void onMove(const MachineMove&) {}
  virtual void onFilament(double /*e*/, double /*retractedBefore*/) {}
  virtual void onLayer() {}
  virtual void onFinish() {}

  void found(std::string_view code, bool error, FindingValues values = {});
  void found(GcodeFinding finding);
  void comment(std::string_view text);
  void command(std::string_view text);
  void startMacro(std::string_view text);
  void run(const GcodeCommand& command, const GcodeWords& words);  ///< a command with a letter
  GcodeWords words(const GcodeCommand& command);
  void modes(const GcodeCommand& command, const GcodeWords& words);
  void noteHeat();
  void checkHot();
  void move(const MachineMove& move);
  void bead(const MachineMove& move, double e);
  void travel(double length);
  void filament(double e, double retractedBefore);
  void endPath();
  void checkPlace(Vec2 p, const char* offBed);
  void checkHeight(const MachineMove& move);
  void checkBeadHeight(double z);
  void checkRate(double seconds);
  void followOverlap(Vec2 to);
  void lay(Vec2 from, Vec2 to, double section, double seconds);
  void judgeLayers();
  void judgeOrigin();
  void judgeTotals();
  void endLayer();

  [[nodiscard]] bool block() const { return layers_ == 0 || custom_ || changesTool_; }
  // Above another print Z may be known from that one: to home it could drive into it.
  [[nodiscard]] unsigned heightAxis() const { return startHeight_ > 0 ? 0 : kAxisZ; }
  [[nodiscard]] bool klipper() const { return settings_.flavor == GcodeFlavor::Klipper; }

  static constexpr std::size_t kWindow = 8;  // [moves], half of a small firmware's buffer

  FileSettings settings_;
  bool ours_;
  GcodeCheck check_;
  MachineState machine_;
  Heaters heaters_;
  Offsets offsets_;
  LaidHeights laid_;        // by the layers
  double area_ = 0;         // of the filament [mm²]
  double startHeight_ = 0;  // of a print on the bed, in files of ours
  bool endMacro_ = false;
  bool retractsBetween_ = false;  // somewhere in the layers
  bool moved_ = false;            // a bead was laid
  bool lastZTold_ = false;        // before the last move
  unsigned shifted_ = 0;          // axes that G92 moved from a place that was known
  std::int64_t shiftLine_ = 0;    // of the last G92 that moved any

  int layers_ = 0;
  LayerMark layerMark_ = LayerMark::None;
  bool custom_ = false;
  bool tower_ = false;        // of what is purged between filaments
  bool changesTool_ = false;  // in a file of another program
  bool oriented_ = false;
  bool base_ = false;

  bool inPath_ = false;
  bool pathOriented_ = false;
  Vec2 pathStart_;
  Vec2 pathEnd_;
  std::vector<Vec2> pathHead_;   // ends of its first moves
  std::ptrdiff_t overlap_ = -1;  // moves since it came back to its start, all over its first ones; -1: it has not
  double coasted_ = 0;
  std::array<double, kWindow> window_{};  // [s] of the last moves of a path
  std::size_t windowed_ = 0;
  std::vector<LaidBead> beads_;
  double clock_ = 0;         // [s] of all moves in the plane, at their speeds
  double layerFastest_ = 0;  // of its oriented beads
  double layerSlowedMm_ = 0;
  double layerAtFastestMm_ = 0;
  double layerHeight_ = 0;
  double layerTop_ = -1;    // as a file of ours tells it; below 0: not told
  double pushed_ = 0;       // [mm of filament] since the last move
  bool lastMoves_ = false;  // the last command is a move
  double flow_ = 1;         // of oriented layers
  double baseFlow_ = 1;     // not told by files: as it mostly is
  double fileTotal_ = -1;
  int fileLayers_ = -1;
  double counted_ = 0;  // [mm of filament] outside start and end blocks
};

}  // namespace sillon
