#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include "base/numbers.hpp"
#include "base/refused.hpp"
#include "gcode/blocks.hpp"
#include "gcode_reader/file_settings.hpp"
#include "gcode_reader/layers.hpp"
#include "gcode_reader/machine.hpp"
#include "gcode_reader/macros.hpp"
#include "gcode_reader/parser.hpp"
#include "gcode_reader/rules.hpp"
#include "printer_import/notes.hpp"
#include "printer_import/slicer_files.hpp"
#include "sillon/gcode_reader/check.hpp"

namespace sillon {
namespace {

constexpr double kMostAdvance = 2;  // [s]; values of linear advance 1.0, in a unit of its own, begin at 10

bool hasWord(std::string_view line, char letter) {
  return line.find(std::string{' ', letter}) != std::string_view::npos;
}

bool isMove(std::string_view line) {
  return isCommand(line, "G0") || isCommand(line, "G1") || isCommand(line, "G2") || isCommand(line, "G3");
}

// Tells whether a line is one of those that slicers and their scripts put between the last bead and the end block.
bool isOfEnding(std::string_view line) {
  if (isOfOldPrint(line) || line.starts_with("TIMELAPSE_")) return true;
  const bool retracts = (isCommand(line, "G10") || isCommand(line, "G11")) && !hasWord(line, 'P');
  return retracts || isCommand(line, "G92") || isCommand(line, "M117") || isCommand(line, "M118") ||
         isCommand(line, "M204") || isCommand(line, "M205");
}

// Drops the retraction at the end of a start block. The donor pushed the filament forward again at its first bead, but
// our print begins primed.
void dropRetraction(std::string& block) {
  while (!block.empty()) {
    const std::size_t line = block.rfind('\n', block.size() - 2) + 1;  // npos + 1 is 0
    const std::string_view last = std::string_view(block).substr(line, block.size() - line - 1);
    const bool still = !hasWord(last, 'X') && !hasWord(last, 'Y') && !hasWord(last, 'Z');
    const bool pulls = isMove(last) && still && last.find(" E-") != std::string_view::npos;
    const bool firmware =
        isCommand(last, "G10") && !hasWord(last, 'P') && !hasWord(last, 'L');  // with P or L it sets up a tool
    if (!pulls && !firmware) return;
    block.resize(line);
  }
}

/// Position of the value in a word such as X12.5; npos if the line has no such word.
std::size_t valueOf(std::string_view line, char letter) {
  const std::size_t word = line.find(std::string{' ', letter});
  return word == std::string_view::npos ? word : word + 2;
}

/// Number behind a letter; nothing if the line has none.
std::optional<double> numberOf(std::string_view line, char letter) {
  const std::size_t begin = valueOf(line, letter);
  return begin == std::string_view::npos ? std::nullopt : firstNumber(firstWord(line.substr(begin)));
}

/// The line with other values behind some letters; all else stays.
std::string withValues(std::string line, std::initializer_list<std::pair<char, std::string_view>> values) {
  for (const auto& [letter, value] : values) {
    const std::size_t begin = valueOf(line, letter);
    if (begin == std::string::npos) continue;
    line.replace(begin, std::min(line.find(' ', begin), line.size()) - begin, value);
  }
  return line;
}

/// Gives a macro's parameters other values. \param valueOf  called with a key in upper case and its value; returns the
/// new value.
template <class ValueOf>
void replaceParameters(std::string& line, ValueOf&& valueOf) {
  std::string out;
  std::size_t done = 0;
  forEachParameter(line, [&](const std::string& key, std::string_view old) {
    const std::size_t at = old.data() - line.data();
    if (at < done) return;
    out.append(line, done, at - done).append(valueOf(key, old));
    done = at + old.size();
  });
  line = out.append(line, done);
}

/// Replaces the plate's corners, which macros with adaptive meshes take as PRINT_MIN and PRINT_MAX, as AREA_START and
/// AREA_END, as X0, Y0, X1 and Y1, or as SIZE with all four. \return false: the line has no such parameters.
bool replaceArea(std::string& line) {
  std::string keys = " ";
  forEachParameter(line, [&](const std::string& key, std::string_view value) {
    if (key != "SIZE" || std::count(value.begin(), value.end(), '_') == 3) keys += key + ' ';
  });
  const auto has = [&](std::string_view key) { return keys.find(' ' + std::string(key) + ' ') != std::string::npos; };
  const bool corners = has("X0") && has("Y0") && has("X1") && has("Y1");
  if (!corners && !has("PRINT_MIN") && !has("AREA_START") && !has("SIZE")) return false;
  constexpr const char* kMin[] = {"{first_layer_print_min[0]}", "{first_layer_print_min[1]}"};
  constexpr const char* kMax[] = {"{first_layer_print_max[0]}", "{first_layer_print_max[1]}"};
  const auto joined = [](const char* const(&pair)[2], const char* by) { return std::string(pair[0]) + by + pair[1]; };
  replaceParameters(line, [&](std::string_view key, std::string_view value) {
    if (key == "PRINT_MIN" || key == "AREA_START") return joined(kMin, ",");
    if (key == "PRINT_MAX" || key == "AREA_END") return joined(kMax, ",");
    if (key == "SIZE" && has(key)) return joined(kMin, "_") + "_" + joined(kMax, "_");
    if (corners && key.size() == 2 && (key[0] == 'X' || key[0] == 'Y') && (key[1] == '0' || key[1] == '1')) {
      return std::string((key[1] == '0' ? kMin : kMax)[key[0] == 'X' ? 0 : 1]);
    }
    return std::string(value);
  });
  return true;
}

/// Counts a file's filament. Its firmware is not known yet, so that G90 and G91 are taken not to change the mode of E.
struct Filament {
  bool absolute = false;  ///< E is absolute: set by M82, cleared by M83
  double at = 0;          ///< last E as written [mm]

  /// Runs a line. \return filament that it pushes [mm]; below 0: pulls back.
  double take(std::string_view line) {
    if (isCommand(line, "M82")) absolute = true;
    if (isCommand(line, "M83")) absolute = false;
    const bool sets = isCommand(line, "G92");
    const auto value = sets || isMove(line) ? numberOf(line, 'E') : std::nullopt;
    if (!value) return 0;
    const double pushed = sets ? 0 : absolute ? *value - at : *value;
    at = sets || absolute ? *value : at + *value;
    return pushed;
  }
};

// Indentation of a line, by which RepRapFirmware knows the lines that belong to an "if".
std::string_view indentationOf(std::string_view line) {
  return line.substr(0, std::min(line.find_first_not_of(" \t"), line.size()));
}

// Replaces the temperatures and the filament of a start macro with placeholders, for those of the next job.
void insertMacroTargets(std::string& line, double nozzle, double bed, std::string_view filament) {
  replaceParameters(line, [&](std::string_view key, std::string_view value) -> std::string_view {
    if (value == filament && !filament.empty()) return "{filament_type}";
    const double degrees = firstNumber(value).value_or(0);
    switch (macroHeat(key)) {
      case MacroHeat::Bed:
        return degrees > 0 && degrees == bed ? "{first_layer_bed_temperature}" : value;
      case MacroHeat::Nozzle:
        return degrees >= kColdest && degrees == nozzle ? "{first_layer_temperature}" : value;
      case MacroHeat::NozzleLater:
        return degrees >= kColdest ? "{temperature}" : value;
      case MacroHeat::None:
        break;
    }
    return value;
  });
}

/// Temperature to which a line heats the chamber [degrees Celsius]; 0: it does not.
double chamberOf(std::string_view line) {
  const bool heats = isCommand(line, "M141") || isCommand(line, "M191");
  double degrees = heats ? numberOf(line, 'S').value_or(0) : 0;
  forEachParameter(line, [&](const std::string& key, std::string_view value) {
    if (key.find("CHAMBER") != std::string::npos) degrees = std::max(degrees, firstNumber(value).value_or(0));
  });
  return degrees;
}

// Runs a line of code. \return the move, if it is one.
std::optional<MachineMove> run(MachineState& machine, std::string_view code) {
  const GcodeCommand command = commandOf(code);
  return runCommand(machine, command, readsWords(command) ? wordsOf(command.rest) : GcodeWords{});
}

/// Reads a printer from G-code that was made for it, the donor.
class Donor {
 public:
  explicit Donor(ImportedPrinter& out) : out_(out) {}

  std::optional<Error> read(std::string_view text);

  /// Tells whether the file marks no layers, as Slic3r's do not, but holds its start and end block as settings.
  [[nodiscard]] bool tellsBlocks() const { return tellsBlocks_; }
  [[nodiscard]] const SlicerSettings& settings() const { return settings_; }

 private:
  void scan(std::string_view text);
  void comment(std::string_view line);
  void takeOwnSettings();
  std::optional<Error> guessBed();
  std::optional<Error> weighFilament(std::string_view text);
  std::optional<Error> endBlock(std::string_view rest);
  void startBlock(std::string_view block);
  void startLine(std::string_view whole);
  void lookAt(std::string_view code);
  void templateFilament(const GcodeCheck& check);
  void endLine(std::string_view code, bool shown);
  void note(std::string_view code, std::initializer_list<std::pair<const char*, std::string>> values = {}) {
    addNote(out_.notRead, importNote(code, values));
  }

  ImportedPrinter& out_;
  SlicerSettings settings_;
  std::string cura_;                                 // Cura's settings, escaped, joined from many comments
  std::size_t firstLayer_ = std::string_view::npos;  // offset of the first layer's mark
  std::size_t lastBead_ = 0;                         // offset behind the line of the last bead
  bool numbered_ = false;                            // lines have numbers, such as N1 G28*18
  Filament end_;                                     // filament at the last bead
  MachineState donor_;                               // the donor's machine, from the last bead on
  MachineState ours_;                                // the machine in our end block
  bool tellsBlocks_ = false;
  std::string template_;  // template of the start block in the slicer
  int tool_ = 0;          // tool of the first bead
  int chosen_ = 0;        // tool at the end of the start block
  Bounds beads_;          // box of the layers' beads
  Bounds purged_;         // box of the start block's beads
  double advance_ = 0;    // pressure advance that the start block sets [s]
  std::string flowLine_;  // line of the start block that leaves another flow than 100 %
};

// Reads a setting from a comment.
void Donor::comment(std::string_view line) {
  constexpr std::string_view kCura = ";SETTING_3 ";
  if (line.starts_with(kCura) && cura_.size() < kMaxSettingsBytes) cura_ += line.substr(kCura.size());
  constexpr std::string_view kMachine = ";TARGET_MACHINE.NAME:";
  if (line.starts_with(kMachine)) settings_.insert_or_assign("printer_model", line.substr(kMachine.size()));
  constexpr std::string_view kNozzle = ";EXTRUDER_TRAIN.0.NOZZLE.DIAMETER:";  // Cura's, for the Ultimaker 3 and later
  if (line.starts_with(kNozzle)) settings_.insert_or_assign("nozzle_diameter", line.substr(kNozzle.size()));
  if (line.starts_with(";FLAVOR:")) settings_.insert_or_assign("gcode_flavor", std::string(line.substr(8)));
  std::string_view key;
  std::string_view value;
  if (splitSetting(line.substr(1), key, value) && value.size() <= kMaxBlockBytes) {
    settings_.insert_or_assign(std::string(key), std::string(value));
  }
}

// Takes the start block over. Slicers keep its template among the settings. If the template, filled in with this file's
// values, says the same as some lines of the block, it takes their place: what it computes from the plate, such as
// purge lines beside it and the mesh below it, then follows the next plate.
void Donor::startBlock(std::string_view block) {
  const std::string folded = withSettings(template_, settings_, templateValues(out_.printer, {}, {}));
  const bool asks = folded.size() <= kMaxBlockBytes && folded.find_first_of("{[") != std::string::npos;
  const auto expanded = expandTemplate(asks ? folded : "", templateValues(out_.printer, {}, beads_), "");
  const TextRange said = expanded ? whereSaid(block, expanded.value()) : TextRange{};
  const auto lines = [this](std::string_view rest) {
    while (!rest.empty() && out_.printer.startGcode.size() <= kMaxBlockBytes) startLine(nextLine(rest));
  };
  lines(block.substr(0, said.begin));
  for (std::string_view rest = block.substr(said.begin, said.end - said.begin); !rest.empty();) {
    lookAt(codeOf(nextLine(rest)));
  }
  for (std::string_view rest = said.end > 0 ? folded : std::string_view(); !rest.empty();) {
    const std::string_view line = nextLine(rest);
    // Comments are left out, since one may read as a layer's mark; but one with a branch holds code, too.
    const bool comment = trimmed(line).starts_with(';') && line.find("if") == std::string_view::npos;
    if (!comment && !isOfOldPrint(codeOf(line))) out_.printer.startGcode.append(line).append("\n");
  }
  lines(block.substr(said.end));
  if (tool_ != chosen_) startLine("T" + std::to_string(tool_));  // the donor chooses it behind the first mark
}

// Takes over a line of the start block. Areas of the old plate become those of the new one; all other words of such a
// line are the printer's and stay.
void Donor::startLine(std::string_view whole) {
  const std::string plain = spelled(codeOf(whole));
  const std::string_view code = plain;
  const std::string_view indentation = indentationOf(whole);
  if (code.empty() || isOfOldPrint(code)) return;
  std::string line(code);
  if (isCommand(code, "M555")) {
    line = withValues(std::move(line), {{'X', "{first_layer_print_min[0]}"},
                                        {'Y', "{first_layer_print_min[1]}"},
                                        {'W', "{first_layer_print_size[0]}"},
                                        {'H', "{first_layer_print_size[1]}"}});
  } else if (code.starts_with("G29 A") && hasWord(code, 'X') && hasWord(code, 'I')) {  // Bambu's A, A1, A2
    line = withValues(std::move(line), {{'X', "{first_layer_print_min[0]}"},
                                        {'Y', "{first_layer_print_min[1]}"},
                                        {'I', "{first_layer_print_size[0]}"},
                                        {'J', "{first_layer_print_size[1]}"}});
  } else if (isCommand(code, "G29") && hasWord(code, 'L') && hasWord(code, 'R') && hasWord(code, 'F')) {  // Marlin's
    line = withValues(std::move(line), {{'L', "{first_layer_print_min[0]}"},
                                        {'F', "{first_layer_print_min[1]}"},
                                        {'R', "{first_layer_print_max[0]}"},
                                        {'B', "{first_layer_print_max[1]}"}});
  } else if (const bool macro = commandOf(code).letter == 0; !macro || !replaceArea(line)) {
    const bool area =
        isCommand(code, "G29") && hasWord(code, 'X') && !hasWord(code, 'C') && !code.starts_with("G29 P9");
    if (area || (macro && upperCase(code).find("MESH_MIN") != std::string::npos)) {
      note("FixedArea", {{"line", std::string(code.substr(0, 60))}});
    }
  }
  lookAt(code);
  out_.printer.startGcode.append(indentation).append(line).append("\n");
}

// Notes the pressure advance that a line sets for the donor's filament, and the scales of flow and speed that it
// leaves.
void Donor::lookAt(std::string_view code) {
  for (const auto& [command, key] : {std::pair<std::string_view, std::string_view>{"M900", " K"},
                                     {"M572", " S"},
                                     {"SET_PRESSURE_ADVANCE", " ADVANCE="}}) {
    const std::size_t at = code.find(key);
    if (!isCommand(code, command) || at == std::string_view::npos) continue;
    const auto value = firstNumber(firstWord(code.substr(at + key.size())));
    if (value && *value >= 0 && *value <= kMostAdvance) advance_ = *value;
  }
  const auto share = numberOf(code, 'S');  // Bambu's "M221 S" has no number: it keeps limits of the axes
  if (!share) return;
  const bool whole = *share == 100;
  if (isCommand(code, "M221")) flowLine_ = whole ? "" : std::string(code.substr(0, 60));
  if (isCommand(code, "M220") && !whole) note("Factor", {{"line", std::string(code.substr(0, 60))}});
}

// Replaces the filament's own temperatures and type, which the slicer put into the start block, with placeholders for
// those of the next job. Other temperatures, as for probing or cleaning, are the printer's and stay.
void Donor::templateFilament(const GcodeCheck& check) {
  Printer& p = out_.printer;
  const bool bears = check.nozzleTarget >= kColdest && check.nozzleTarget <= p.maxNozzleTemperature;
  const double nozzle = bears ? check.nozzleTarget : 0;
  double bed = check.bedTarget > 0 && check.bedTarget <= p.maxBedTemperature ? check.bedTarget : 0;
  std::string kept;
  std::string block;
  const auto keep = [&kept](const std::string& line) {
    if (kept.find(line) == std::string::npos) kept += (kept.empty() ? "" : ", ") + line;
  };
  const auto insertTarget = [&](std::string& line, std::size_t begin, bool ofBed) {
    const std::string word(firstWord(std::string_view(line).substr(begin)));
    const auto value = firstNumber(word);
    if (!value || !(*value > 0)) return;
    if (*value == (ofBed ? bed : nozzle)) {
      line.replace(begin, word.size(), ofBed ? "{first_layer_bed_temperature}" : "{first_layer_temperature}");
    } else if (!ofBed && *value > kColdest) {
      keep(line);
    }
  };
  std::string_view rest = p.startGcode;
  while (!rest.empty()) {
    const std::string_view whole = nextLine(rest);
    std::string line(trimmed(whole));
    const bool ofBed = isCommand(line, "M140") || isCommand(line, "M190");
    if (ofBed || isCommand(line, "M104") || isCommand(line, "M109")) {
      const std::size_t begin = std::min(valueOf(line, 'S'), valueOf(line, 'R'));
      if (begin != std::string::npos) insertTarget(line, begin, ofBed);
    }
    if (chamberOf(line) > 0) keep(line);
    if (isStartMacro(commandOf(codeOf(line)))) {  // PRINT_START BED=60 EXTRUDER=215
      const MacroTargets targets = macroTargets(line);
      if (targets.bed > 0 && targets.bed <= p.maxBedTemperature) bed = targets.bed;
      if (targets.nozzle > 0 && targets.nozzle != nozzle) keep(line);
      insertMacroTargets(line, nozzle, bed, p.filamentType);
    }
    constexpr std::string_view kType = "M1002 set_filament_type:";
    if (line == std::string(kType) + p.filamentType) line = std::string(kType) + "{filament_type}";
    block.append(indentationOf(whole)).append(line).append("\n");
  }
  p.startGcode = std::move(block);
  if (nozzle > 0) p.firstLayerNozzleTemperature = nozzle;
  if (bed > 0) p.bedTemperature = bed;
  if (!kept.empty()) note("FixedTemperatures", {{"lines", kept.substr(0, 200)}});
}

// Takes over a line behind the last bead. \param shown  false: the line is not of the end block, and is only run.
void Donor::endLine(std::string_view code, bool shown) {
  const bool counted = donor_.absoluteE;
  const auto move = run(donor_, code);
  if (!shown || isOfOldPrint(code)) return;
  std::string line(code);
  run(ours_, code);
  // Our print has counted other filament and its end block begins with M83, so that E must become relative.
  if (isMove(code) && hasWord(code, 'E')) {
    if (ours_.absoluteE) out_.printer.endGcode += "M83\n";
    ours_.absoluteE = false;
    if (counted && move) line = withValues(std::move(line), {{'E', decimal(move->e, 5)}});
  }
  // A height of the old print may lie inside the new plate. Our print lifts the nozzle before the block begins.
  if (isMove(code) && donor_.absolute && hasWord(code, 'Z')) {
    const std::size_t z = line.find(" Z");
    line.erase(z, std::min(line.find(' ', z + 1), line.size()) - z);
    note("EndHeights");
    if (!hasWord(line, 'X') && !hasWord(line, 'Y') && !hasWord(line, 'E')) return;
  }
  // A place at which the print is presented may lie off the bed as it is known here, which an export would refuse.
  if (isMove(code) && donor_.absolute && out_.printer.flavor != GcodeFlavor::Bambu) {
    const Printer& p = out_.printer;
    for (const auto& [axis, low, high] : {std::tuple{'X', p.bedMin.x, p.bedMax.x}, {'Y', p.bedMin.y, p.bedMax.y}}) {
      const std::size_t begin = valueOf(line, axis);
      const auto value = numberOf(line, axis);
      if (!value || (*value >= low - kBeyondBed && *value <= high + kBeyondBed)) continue;
      line.erase(begin - 2, std::min(line.find(' ', begin), line.size()) - begin + 2);
      note("EndPlaces");
    }
    if (!hasWord(line, 'X') && !hasWord(line, 'Y') && !hasWord(line, 'E')) return;
  }
  out_.printer.endGcode += line + "\n";
}

// Scans the file for the ends of its blocks, its beads, the tool of the first one, and its settings.
void Donor::scan(std::string_view text) {
  Filament filament;
  Vec2 nozzle;
  bool placed = false;
  bool relative = false;
  int tool = 0;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t at = text.size() - rest.size();
    const std::string_view whole = trimmed(nextLine(rest));
    if (whole.empty()) continue;
    if (whole[0] == ';') {
      if (firstLayer_ == std::string_view::npos && isLayerMark(whole)) {
        firstLayer_ = at;
        chosen_ = tool;
      }
      comment(whole);
      continue;
    }
    numbered_ = numbered_ || (whole[0] == 'N' && whole.size() > 1 && whole[1] >= '0' && whole[1] <= '9');
    const std::string other = isSpelled(whole) ? std::string() : spelled(whole);
    const std::string_view line = other.empty() ? whole : std::string_view(other);
    tool = chosenFilament(line).value_or(tool);
    const double pushed = filament.take(line);
    const bool bead = pushed > 0 && isMove(line) && (hasWord(line, 'X') || hasWord(line, 'Y'));
    if (bead) {
      lastBead_ = text.size() - rest.size();
      end_ = filament;
    }
    if (isCommand(line, "G91") || isCommand(line, "G90")) relative = isCommand(line, "G91");
    if (!isMove(line) || relative) continue;
    Bounds& laid = firstLayer_ == std::string_view::npos ? purged_ : beads_;
    if (bead && laid.empty() && &laid == &beads_) tool_ = tool;
    if (bead && placed) laid.add(nozzle);
    for (double* const place : {&nozzle.x, &nozzle.y}) {
      const auto value = numberOf(line, place == &nozzle.x ? 'X' : 'Y');
      if (!value) continue;
      *place = *value;
      placed = true;
    }
    if (bead) laid.add(nozzle);
  }
}

// Takes the settings that the file states. The blocks among them are templates only; those in the file were printed.
void Donor::takeOwnSettings() {
  chooseTool(settings_, tool_);
  for (const char* key : {"machine_start_gcode", "start_gcode"}) {
    if (const auto told = settings_.find(key); told != settings_.end() && template_.empty())
      template_ = unescaped(told->second);
  }
  for (const char* key : {"start_gcode", "machine_start_gcode", "end_gcode", "machine_end_gcode"}) settings_.erase(key);
  const std::string opened = unescaped(unescaped(cura_));
  for (std::string_view lines = opened; !lines.empty();) {
    std::string_view key;
    std::string_view value;
    if (!splitSetting(trimmed(nextLine(lines)), key, value) || key == "name") continue;  // a quality's name
    settings_.emplace(std::string(key), std::string(value));
  }
  takeSettings(settings_, out_);
  out_.printer.startGcode.clear();  // the file's blocks take the place of the profile's
  out_.printer.endGcode.clear();
}

// Estimates the bed if the file does not state it: it reaches as far as the beads do. A bed around the origin is a
// delta's, whose beds are round.
std::optional<Error> Donor::guessBed() {
  const bool told = settings_.contains("bed_shape") || settings_.contains("printable_area");
  if (told || !out_.profile.empty()) return std::nullopt;
  constexpr double kPurged = 5;  // [mm], purge beside the bed
  Printer& p = out_.printer;
  const auto [least, most] = beads_;
  if (std::min(least.x, least.y) >= -kPurged) {
    // Purge lines of the start block lie on the bed, too.
    const Vec2 purged = purged_.empty() ? most : purged_.max;
    p.bedMax = {std::ceil(std::max({p.bedMax.x, most.x, purged.x})),
                std::ceil(std::max({p.bedMax.y, most.y, purged.y}))};
    for (ImportNote& note : out_.notRead) {
      if (note.code == "BedUnknown") note = bedUnknown(p);
    }
    return std::nullopt;
  }
  if (!(least.x < 0 && least.y < 0 && most.x > 0 && most.y > 0)) {
    return refusedFile("BedUntold", {{"left", least.x}, {"front", least.y}, {"right", most.x}, {"back", most.y}});
  }
  const double reach = std::max({-least.x, -least.y, most.x, most.y});
  const double half = std::max(0.5 * std::max(p.bedMax.x - p.bedMin.x, p.bedMax.y - p.bedMin.y), std::ceil(reach));
  p.bedMin = {-half, -half};
  p.bedMax = {half, half};
  p.roundBed = true;
  return std::nullopt;
}

// Estimates the filament's diameter from the beads if the file does not state it, as Cura's do not. If the beads leave
// it open, the user is asked, unless the machine is known.
std::optional<Error> Donor::weighFilament(std::string_view text) {
  Printer& p = out_.printer;
  const bool told = settings_.contains("filament_diameter") || settings_.contains("material_diameter");
  if (told || p.filamentDiameter != kThinFilament) return std::nullopt;
  const bool nozzle = settings_.contains("nozzle_diameter") || settings_.contains("machine_nozzle_size");
  const bool known = nozzle || !out_.profile.empty();
  const WeighedFilament weighed =
      sillon::weighFilament(text, p.flavor, known ? std::optional<double>(p.nozzle) : std::nullopt);
  if (weighed.evidence == FilamentEvidence::Open && out_.profile.empty()) return askForFilament(weighed);
  p.filamentDiameter = weighed.diameter;
  if (weighed.evidence == FilamentEvidence::Odd || weighed.evidence == FilamentEvidence::Open) {
    note("FilamentUnclear", {{"diameter", decimal(weighed.diameter, 2)},
                             {"width", decimal(weighed.widthWith(weighed.diameter), 2)},
                             {"nozzle", decimal(p.nozzle, 2)}});
  } else if (weighed.evidence == FilamentEvidence::Fits && weighed.diameter != kThinFilament) {
    note("FilamentGuessed", {{"diameter", decimal(weighed.diameter, 2)}});
  }
  return std::nullopt;
}

Error tooLong(const char* block) { return refusedFile("BlockTooLong", {{"block", block}, {"most", kMaxBlockBytes}}); }

// Takes the end block over. \param rest  text behind the last bead.
std::optional<Error> Donor::endBlock(std::string_view rest) {
  bool begun =
      rest.find(";TYPE:Custom") == std::string_view::npos && rest.find("; FEATURE: Custom") == std::string_view::npos;
  bool wiping = begun;  // without a mark, moves that end the last bead come first
  donor_ = ours_ = MachineState(out_.printer.flavor);
  donor_.absoluteE = end_.absolute;
  donor_.e = end_.at;
  ours_.absoluteE = false;
  while (!rest.empty()) {
    const std::string_view line = trimmed(nextLine(rest));
    if (line == ";TYPE:Custom" || line == "; FEATURE: Custom") begun = true;
    const std::string code = spelled(codeOf(line));
    if (code.empty()) continue;
    wiping = wiping && (isMove(code) || isOfEnding(code));
    endLine(code, begun && !wiping);
    if (out_.printer.endGcode.size() > kMaxBlockBytes) return tooLong("printer.endGcode");
  }
  return std::nullopt;
}

// Reads the whole file into the printer; returns an error if the file is no donor.
std::optional<Error> Donor::read(std::string_view text) {
  scan(text);
  if (numbered_ && lastBead_ == 0) {
    return refusedFile("LinesNumbered");
  }
  if (firstLayer_ == std::string_view::npos) {
    tellsBlocks_ = settings_.contains("start_gcode") && settings_.contains("end_gcode") && lastBead_ > 0;
    if (tellsBlocks_) {
      for (const char* key : {"start_gcode", "end_gcode"}) settings_[key] = unescaped(settings_[key]);
      return std::nullopt;
    }
    return refusedFile("NoLayers");
  }
  if (lastBead_ <= firstLayer_) return refusedFile("NoBeads");

  takeOwnSettings();
  // Bambu's machines cut, draw back and flush between two filaments, in code that stands behind the start block.
  if (tool_ != chosen_ && out_.printer.flavor == GcodeFlavor::Bambu) {
    return refusedFile("TwoFilaments", {{"loaded", chosen_ + 1}, {"used", tool_ + 1}});
  }
  if (auto error = guessBed()) return error;
  if (auto error = weighFilament(text)) return error;
  startBlock(text.substr(0, firstLayer_));
  if (!flowLine_.empty()) note("FlowFactor", {{"line", flowLine_}});
  Printer& p = out_.printer;
  if (p.startGcode.size() > kMaxBlockBytes) return tooLong("printer.startGcode");
  recogniseKlipper(out_);
  if (setsPressureAdvance(p.startGcode)) {  // the block sets it for the donor's filament, and nothing need set it again
    p.setPressureAdvance = false;
    if (advance_ > 0) p.pressureAdvance = advance_;
  }
  dropRetraction(p.startGcode);
  if (auto error = endBlock(text.substr(lastBead_))) return error;

  const auto expanded = expandTemplate(p.startGcode, templateValues(p, {}, beads_), "");
  const GcodeCheck check = checkGcode(expanded ? expanded.value() : p.startGcode, p);
  if (!check.homes) note("NoHoming");
  if (!check.heatsNozzle) note("NoNozzleWait");
  if (!check.heatsBed) note("NoBedWait");
  for (const GcodeFinding& finding : check.findings) {
    if (finding.rule == "bounds") note("BeyondBed", {{"detail", finding.message}});
  }
  templateFilament(check);
  return std::nullopt;
}

}  // namespace

bool isLayerMark(std::string_view line) {
  return line.starts_with(';') && layerMark(trimmed(line.substr(1))) != LayerMark::None;
}

Result<ImportedPrinter> importDonor(std::string_view text) {
  ImportedPrinter out;
  out.source = "donor G-code";
  Donor donor(out);
  if (auto error = donor.read(text)) return *error;
  if (donor.tellsBlocks()) return printerOfSettings(donor.settings(), std::move(out));
  judgeBlocks(out);
  std::sort(out.read.begin(), out.read.end());
  return out;
}

}  // namespace sillon
