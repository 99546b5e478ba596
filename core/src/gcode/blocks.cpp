#include "gcode/blocks.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/lines.hpp"
#include "base/numbers.hpp"
#include "base/refused.hpp"
#include "gcode/layout.hpp"
#include "gcode_reader/machine.hpp"
#include "gcode_reader/macros.hpp"
#include "gcode_reader/parser.hpp"
#include "gcode_reader/rules.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "sillon/settings/presets.hpp"

namespace sillon {
namespace {

constexpr double kHotEnough = 20;  // [degrees Celsius], shortfall at which a nozzle still counts as hot
constexpr double kNozzleBody = 2;  // [mm], half width of the nozzle's tip; more than any bead's half width

// Warns of a block that moves below what stands on the bed. \param height  height of that [mm].
void warnLow(GcodeJob& job, const std::string& block, const GcodeCheck& check, double height) {
  if (check.lowest >= height) return;
  job.warn(WarningCode::BlockMovesLow, {{"block", block}, {"z", check.lowest}, {"height", height}});
}

// Tells whether a finding is worth a warning, although the block may be used all the same.
bool isWorthALook(const GcodeFinding& finding) {
  return finding.rule == "bounds" || finding.rule == "settings" || finding.rule == "modes" ||
         finding.code == "bead-in-bed" || finding.code == "too-high";
}

// Tells whether a finding harms the machine, or has an effect beyond the print. Such blocks are refused in every
// dialect.
bool isDangerous(const GcodeFinding& finding) {
  return finding.error && (finding.rule == "commands" || finding.code == "too-hot" || finding.code == "below-bed" ||
                           finding.rule == "grammar" || finding.code == "volumetric");
}

Warning lineWarning(WarningCode code, std::int64_t line, const GcodeFinding& finding) {
  return {code, {{"line", static_cast<double>(line)}, {"what", finding.message}, {"rule", finding.rule}}};
}

// Refuses line breaks written as "\n", as in a block copied out of a slicer's settings file: the printer would read one
// long line and run its first command only.
std::optional<Error> checkBreaks(const std::string& block, const char* name) {
  for (std::size_t at = block.find("\\n"); at != std::string::npos; at = block.find("\\n", at + 2)) {
    const std::string_view next = std::string_view(block).substr(at + 2, 2);
    if (next.size() == 2 && std::string_view("GMT").find(next[0]) != std::string_view::npos && next[1] >= '0' &&
        next[1] <= '9') {
      return refusedArgument("BreaksWritten", {{"block", name}});
    }
  }
  return std::nullopt;
}

// Checks the start block. One that leaves out homing or heating prints cold or beside the bed, with nobody there to
// stop it.
std::optional<Error> checkStart(const std::string& block, const Printer& printer, const PrintParams& params,
                                GcodeJob& job) {
  // The maker's blocks for Bambu machines wipe far off the bed.
  const bool trusted = printer.flavor == GcodeFlavor::Bambu;
  const GcodeCheck check = checkGcode(block, printer);
  // Above another print Z may be known from that print, and homing Z could drive the nozzle into it.
  const bool homes = params.startHeight > 0 ? check.homesPlane : check.homes;
  if (!homes) return refusedArgument("NotHomed");
  job.startRetracted = check.retracted;
  job.otherHotTools = check.otherHotTools;
  job.hotChamber = check.chamberTarget > 0;
  if (check.firmwareRetracted) return refusedArgument("DrawnBack");
  // Many blocks level the bed with a nozzle too cold to drip; firmwares refuse to move filament then.
  job.hotStart = check.nozzleReady >= std::max(kColdest, printer.firstLayerNozzleTemperature - kHotEnough);
  // The block extrudes at its own temperature; the job's is written only behind it.
  if (check.filamentMm > 0 && std::abs(check.nozzleTarget - printer.firstLayerNozzleTemperature) > kHotEnough) {
    job.warn(WarningCode::StartTemperature,
             {{"hot", check.nozzleTarget}, {"meant", printer.firstLayerNozzleTemperature}});
  }
  warnLow(job, "printer.startGcode", check, params.startHeight > 0 ? params.startHeight + printer.zOffset : 0);
  for (const GcodeFinding& finding : check.findings) {
    if (finding.line == 0) continue;  // findings about whole files
    const Warning warning = lineWarning(WarningCode::StartLine, finding.line, finding);
    const bool elsewhere = finding.code == "origin-shift";  // the plate would move with the origin
    if (isDangerous(finding) || elsewhere || (finding.error && !trusted)) return refusalOf(warning);
    if (isWorthALook(finding)) job.warnings.push_back(warning);
  }
  return std::nullopt;
}

// The print that stands on the bed when the end block begins [mm].
struct Standing {
  Bounds box;
  double height;
};

// Runs a block. \param take  called with each line that has code, its command, and its move, if any; the machine's
// homed axes are those that this line homes.
template <class Take>
void runBlock(const std::string& block, MachineState& machine, Take&& take) {
  forEachLine(block, [&](const GcodeLine& line) {
    const GcodeParts parts = partsOf(line.text);
    if (parts.code.empty()) return;
    const GcodeCommand command = commandOf(parts.code);
    machine.homedAxes = 0;
    take(line, command, runCommand(machine, command, readsWords(command) ? wordsOf(command.rest) : GcodeWords{}));
  });
}

// Checks that a printer which runs the block from `from` [mm], above the print, does not come down on it.
std::optional<Error> checkLow(const std::string& block, Vec2 from, double z, const Standing& plate,
                              const Printer& printer, GcodeJob& job) {
  MachineState machine(printer.flavor);
  machine.at = from;
  machine.z = z;
  machine.toldAxes = kAllAxes;
  const Vec2 body{kNozzleBody, kNozzleBody};
  const Bounds near{plate.box.min - body, plate.box.max + body};
  std::optional<Error> refused;
  runBlock(block, machine, [&](const GcodeLine& line, const GcodeCommand& command, const auto& move) {
    if (refused) return;
    const auto warn = [&](const char* what) {
      job.warn(
          WarningCode::EndLine,
          {{"line", static_cast<double>(line.number)}, {"what", std::string(what)}, {"rule", std::string("height")}});
    };
    // A delta printer, whose bed is round, homes at its top.
    if (command.is('G', 28) && machine.homed(kAxisZ) && !printer.roundBed) {
      warn("homes Z, for which most printers come down on the plate");
    }
    if (probesBed(command)) warn("probes the bed, for which printers come down on the plate");
    if (!move || !machine.told(kAxisZ) || !(move->z < plate.height)) return;
    constexpr int kPieces = 32;
    for (int k = 0; k <= kPieces; ++k) {
      const double share = static_cast<double>(k) / kPieces;
      const double height = move->zFrom + share * (move->z - move->zFrom);
      if (height >= plate.height - 1e-9 || !near.holds(move->from + share * (move->to - move->from))) continue;
      refused = refusalOf({WarningCode::EndLine,
                           {{"line", static_cast<double>(line.number)},
                            {"what", "goes down to Z " + decimal(move->z, 3) + " over the plate, which is " +
                                         decimal(plate.height, 3) + " mm high; it must rise or go aside"},
                            {"rule", std::string("height")}}});
      return;
    }
  });
  return refused;
}

// Warns of a block that extrudes where the plate will lie, such as a purge line made for another place.
void warnUnder(const std::string& block, const Standing& plate, const Printer& printer, GcodeJob& job) {
  MachineState machine(printer.flavor);
  bool warned = false;
  runBlock(block, machine, [&](const GcodeLine& line, const GcodeCommand&, const auto& move) {
    if (warned || !move || !(move->e > 0) || !(move->length > 0) || !(move->z < plate.height)) return;
    constexpr int kPieces = 64;
    for (int k = 0; k <= kPieces && !warned; ++k) {
      warned = plate.box.holds(move->from + (static_cast<double>(k) / kPieces) * (move->to - move->from));
    }
    if (!warned) return;
    job.warn(WarningCode::StartLine, {{"line", static_cast<double>(line.number)},
                                      {"what", std::string("lays a bead where the plate will lie")},
                                      {"rule", std::string("bounds")}});
  });
}

// Checks the end block, which begins near the middle of the last plate; its moves from there must stay on the bed.
std::optional<Error> checkEnd(const std::string& block, Vec2 from, double height, const Printer& printer,
                              GcodeJob& job) {
  std::string stillHot = job.hotChamber ? "M141 S60\n" : "";
  for (const int tool : job.otherHotTools) stillHot += "M104 T" + std::to_string(tool) + " S200\n";
  const std::string before = "G28\nM190 S60\nM109 S200\nG1 X" + fixed(from.x, 3) + " Y" + fixed(from.y, 3) + " Z" +
                             fixed(height, 3) + " F300\nG91\nG1 X0.1 E0.0002\nG90\nG92 E0\n" + stillHot +
                             (printer.absoluteE ? "M82\n" : "M83\n");
  const auto lines = std::count(before.begin(), before.end(), '\n');
  bool hot = false;
  for (const GcodeFinding& finding : checkGcode(before + block, printer).findings) {
    hot = hot || finding.rule == "end";
    if (finding.line <= lines) continue;
    const Warning warning = lineWarning(WarningCode::EndLine, finding.line - lines, finding);
    const bool fault = finding.error && (finding.rule == "bounds" || finding.rule == "grammar");
    if (isDangerous(finding) || (fault && printer.flavor != GcodeFlavor::Bambu)) {
      return refusalOf(warning);
    }
    if (finding.error || isWorthALook(finding)) job.warnings.push_back(warning);
  }
  if (hot) job.warn(WarningCode::EndHot);
  return std::nullopt;
}

// Sillon's own start block, which homes while the printer warms up. Lifting, going aside and waiting for heat follow
// every start block.
std::string ownStart(const Printer& printer) {
  return std::string(printer.flavor == GcodeFlavor::RepRap ? "T0\n" : "") + "M140 S" +
         fixed(printer.bedTemperature, 0) + "\nM104 S150\nG28\n";
}

// Removes empty lines, which remain of branches that were left out.
std::string withoutBlankLines(std::string_view block) {
  std::string out;
  while (!block.empty()) {
    const std::string_view line = nextLine(block);
    if (!line.empty()) out.append(line).append("\n");
  }
  return out;
}

// Percentage that a block leaves set: by M221 for all flow, by M220 for all speeds.
double percentAfter(std::string_view block, int code) {
  double percent = 100;
  while (!block.empty()) {
    const GcodeCommand command = commandOf(codeOf(nextLine(block)));
    if (command.is('M', code)) percent = wordsOf(command.rest).at('S', percent);
  }
  return percent;
}

// Tells whether a block is that of a printer profile; a maker's own block sets what is usual for its machine.
bool isOfProfile(const std::string& block) {
  static const std::vector<PrinterProfile> all = profiles(ProfileKind::Printer);
  return std::any_of(all.begin(), all.end(),
                     [&](const PrinterProfile& profile) { return profile.printer.startGcode == block; });
}

}  // namespace

Error refusalOf(const Warning& warning) {
  return {ErrorCode::InvalidArgument, warning.message, warningName(warning.code), warning.values};
}

bool setsPressureAdvance(std::string_view block) {
  bool sets = false;
  while (!block.empty()) {
    const std::string_view line = codeOf(nextLine(block));
    for (const auto& [command, key] : {std::pair<std::string_view, std::string_view>{"M900", " K"},
                                       {"M572", " S"},
                                       {"SET_PRESSURE_ADVANCE", " ADVANCE="}}) {
      const std::size_t at = line.find(key);
      if (!line.starts_with(command) || at == std::string_view::npos) continue;
      const std::string_view value = line.substr(at + key.size(), line.find(' ', at + 1) - at - key.size());
      sets = value.find_first_of("123456789") != std::string_view::npos;
    }
  }
  return sets;
}

bool runsStartMacro(std::string_view block) {
  while (!block.empty()) {
    if (isStartMacro(commandOf(codeOf(nextLine(block))))) return true;
  }
  return false;
}

bool primesItself(const Printer& printer, const PrintParams& params, const Bounds& beads) {
  if (printer.startGcode.empty()) return false;
  if (printer.flavor == GcodeFlavor::Bambu) return true;
  const Result<std::string> start =
      expandTemplate(printer.startGcode, templateValues(printer, params, beads), "printer.startGcode");
  return start && checkGcode(start.value(), printer).filamentMm > 0;
}

std::optional<Error> addBlocks(GcodeJob& job, Bounds beads, Vec2 last, const Printer& printer,
                               const PrintParams& params) {
  if (printer.flavor == GcodeFlavor::Bambu && printer.startGcode.empty()) return refusedArgument("BambuStart");
  // Its height includes zOffset, because blocks are written in the printer's own Z.
  const Standing plate{beads, layerTop(params, layerCount(params) - 1) + printer.zOffset};
  for (const BeadPath& path : job.skirt) addBeads(beads, path);
  if (auto error = checkBreaks(printer.startGcode, "printer.startGcode")) return error;
  if (auto error = checkBreaks(printer.endGcode, "printer.endGcode")) return error;
  const std::vector<TemplateValue> values = templateValues(printer, params, beads);
  Result<std::string> start = expandTemplate(printer.startGcode, values, "printer.startGcode");
  if (!start) return start.error();
  Result<std::string> end = expandTemplate(printer.endGcode, values, "printer.endGcode");
  if (!end) return end.error();
  if (!printer.startGcode.empty()) {
    if (auto error = checkStart(start.value(), printer, params, job)) return error;
    warnUnder(start.value(), plate, printer, job);
  }
  if (!printer.endGcode.empty()) {
    const double z = std::min(plate.height + printer.lift + kParkLift, printer.maxZ);
    if (auto error = checkLow(end.value(), last, z, plate, printer, job)) return error;
    warnLow(job, "printer.endGcode", checkGcode(end.value(), printer), plate.height);
    if (auto error = checkEnd(end.value(), last, z, printer, job)) return error;
  }
  job.startFlow = percentAfter(start.value(), 221);
  if (job.startFlow != 100 && !isOfProfile(printer.startGcode)) {
    job.warn(WarningCode::StartFlow, {{"percent", job.startFlow}});
  }
  if (const double speed = percentAfter(start.value(), 220); speed != 100) {
    job.warn(WarningCode::StartScales, {{"percent", speed}});
  }
  job.ownStart = printer.startGcode.empty();
  job.startBlock = job.ownStart ? ownStart(printer) : withoutBlankLines(start.value());
  job.endBlock = withoutBlankLines(end.value());
  return std::nullopt;
}

}  // namespace sillon
