// Rules for a file, line by line: each line is run as a printer would run it, and judged.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/sentence.hpp"
#include "gcode_reader/coverage.hpp"
#include "gcode_reader/file_settings.hpp"
#include "gcode_reader/layers.hpp"
#include "gcode_reader/machine.hpp"
#include "gcode_reader/parser.hpp"
#include "sillon/gcode_reader/check.hpp"

namespace sillon {

// Makes findings from codes, whose rules and sentences are in findings.cpp.

using FindingValues = std::vector<std::pair<std::string, std::string>>;

/// The sentence of a finding, and the rule it belongs to.
struct FindingRow {
  const char* rule;
  Sentence sentence;
};

/// The sentences without their rules.
template <std::size_t Count>
constexpr std::array<Sentence, Count> sentencesOf(const FindingRow (&rows)[Count]) {
  std::array<Sentence, Count> sentences{};
  for (std::size_t k = 0; k < Count; ++k) sentences[k] = rows[k].sentence;
  return sentences;
}

/// Makes a finding from the row of its code; its line is left to the caller.
GcodeFinding makeFinding(std::span<const FindingRow> rows, std::string_view code, bool error, FindingValues values);
/// Makes a finding; its line is left to the caller.
/// \param code  one of the list in findings.cpp. \param values  values of the sentence's {names}.
GcodeFinding makeFinding(std::string_view code, bool error, FindingValues values = {});

/// Text of a file as a sentence shows it: at most 60 characters, printable ASCII, quoted.
std::string shownText(std::string_view text);

/// Code of the finding about a command's words, or null.
const char* wordFault(const GcodeWords& words);

/// Values of the finding about offsets that were added up; empty if they are within their limits.
FindingValues offsetFault(const Offsets::Axes& sum);

inline constexpr double kBeyondBed = 10;  ///< [mm], reach of makers' blocks beyond the bed's edge, to wipe and purge

/// Tells whether a move goes deeper than any nozzle may: 0.5 mm below the bed, or 2 mm beside it, where makers' blocks
/// wipe.
bool tooDeep(const MachineMove& move, const FileSettings& settings);

/// Runs and judges a file.
class Rules {
 public:
  /// \param ours  the file says that Sillon wrote it, which adds rules: closed cycles, plain lines, totals.
  Rules(FileSettings settings, bool ours);

  void line(const GcodeLine& line);
  /// Ends the file and returns the verdict. To be called after the last line.
  GcodeCheck finish();

 protected:
  // Hooks for the rules about whole prints (print_rules.hpp), called after each command, for each move before the rules
  // here judge it, and so on.
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
  void run(const GcodeCommand& command, const GcodeWords& words);  ///< any but a start or end macro
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
  // A print on top of another may know Z from that one, since homing could drive the nozzle into it.
  [[nodiscard]] unsigned heightAxis() const { return startHeight_ > 0 ? 0 : kAxisZ; }
  [[nodiscard]] bool klipper() const { return settings_.flavor == GcodeFlavor::Klipper; }

  static constexpr std::size_t kWindow = 8;  // [moves], half of a small firmware's buffer

  FileSettings settings_;
  bool ours_;
  GcodeCheck check_;
  MachineState machine_;
  Heaters heaters_;
  Offsets offsets_;
  LaidHeights laid_;        // heights that the layers have reached
  double area_ = 0;         // cross-section of the filament [mm²]
  double startHeight_ = 0;  // height of the print below, in files of ours [mm]
  bool endMacro_ = false;
  bool retractsBetween_ = false;  // the layers have a retraction
  bool moved_ = false;            // a bead was laid
  bool lastZTold_ = false;        // Z was known before the last move
  unsigned shifted_ = 0;          // axes whose known places G92 has shifted
  std::int64_t shiftLine_ = 0;    // line of the last G92 of X, Y or Z

  int layers_ = 0;
  LayerMark layerMark_ = LayerMark::None;
  bool custom_ = false;
  bool tower_ = false;        // the role is what is purged between filaments
  bool changesTool_ = false;  // inside a tool change, in another program's file
  bool oriented_ = false;
  bool base_ = false;

  bool inPath_ = false;
  bool pathOriented_ = false;
  Vec2 pathStart_;
  Vec2 pathEnd_;
  std::vector<Vec2> pathHead_;   // ends of the path's first moves
  std::ptrdiff_t overlap_ = -1;  // moves that repeat the first ones since the path came back to its start; -1: none
  double coasted_ = 0;
  std::array<double, kWindow> window_{};  // durations of the path's last moves [s]
  std::size_t windowed_ = 0;
  std::vector<LaidBead> beads_;
  double clock_ = 0;         // duration of all moves in the plane, at their speeds [s]
  double layerFastest_ = 0;  // greatest speed of the layer's oriented beads [mm/s]
  double layerSlowedMm_ = 0;
  double layerAtFastestMm_ = 0;
  double layerHeight_ = 0;
  double layerTop_ = -1;    // top of the layer, stated by files of ours [mm]; below 0: unknown
  double pushed_ = 0;       // filament pushed since the last move [mm]
  bool lastMoves_ = false;  // the last command is a move
  double flow_ = 1;         // flow of oriented layers
  double baseFlow_ = 1;     // flow of base layers, which files do not state: the usual one
  double fileTotal_ = -1;
  int fileLayers_ = -1;
  double counted_ = 0;  // filament outside start and end blocks [mm]
};

}  // namespace sillon
