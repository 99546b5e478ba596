#include "gcode_reader/macros.hpp"

#include "gcode_reader/machine.hpp"

namespace sillon {
namespace {

constexpr double kHottestTold = 500;  // [degrees Celsius]; a greater number is no temperature

bool holds(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

// Name of a macro in upper case; empty if the command cannot be one.
std::string macroName(const GcodeCommand& command) {
  std::string name = command.letter == 0 ? upperCase(command.name) : std::string();
  const bool plain = name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789") == std::string::npos;
  return plain ? name : std::string();
}

// Tells whether a command is M98 with a file that has this part in its name.
bool runsFile(const GcodeCommand& command, std::string_view part) {
  return command.is('M', 98) && holds(upperCase(command.rest), part);
}

}  // namespace

std::string upperCase(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return out;
}

bool isStartMacro(const GcodeCommand& command) {
  if (command.is('G', 9111) || runsFile(command, "START")) return true;
  const std::string name = macroName(command);
  return holds(name, "PRINT") && (holds(name, "START") || holds(name, "BEGIN"));
}

bool isEndMacro(const GcodeCommand& command) {
  std::string name("_");
  name.append(macroName(command)).append("_");
  // A name such as SUSPEND_PRINT must not count: hence the underscores.
  return holds(name, "PRINTEND") || holds(name, "ENDPRINT") || (holds(name, "PRINT") && holds(name, "_END_"));
}

unsigned homedByMacro(const GcodeCommand& command) {
  const std::string name = macroName(command);
  if (holds(name, "CG28") || runsFile(command, "HOME")) return kAllAxes;
  const std::size_t home = name.find("HOME");
  if (home == std::string::npos || name.starts_with("MMU")) return 0;  // a filament changer homes only its own selector
  const std::string_view of = std::string_view(name).substr(home + 4);
  if (of.size() < 2 || of[0] != '_' || of.find_first_not_of("XYZ", 1) != std::string_view::npos) return kAllAxes;
  return (holds(of, "X") ? kAxisX : 0) | (holds(of, "Y") ? kAxisY : 0) | (holds(of, "Z") ? kAxisZ : 0);
}

MacroHeat macroHeat(std::string_view key) {
  if (holds(key, "CHAMBER") || holds(key, "STANDBY")) return MacroHeat::None;
  if (holds(key, "BED")) return holds(key, "OTHER") ? MacroHeat::None : MacroHeat::Bed;
  for (const std::string_view part : {"EXTRUDER", "HOTEND", "NOZZLE", "TEMP", "TOOL0"}) {
    if (holds(key, part)) return holds(key, "OTHER") ? MacroHeat::NozzleLater : MacroHeat::Nozzle;
  }
  if (key == "B") return MacroHeat::Bed;
  return key == "TOOL" || key == "T" || key == "T0" || key == "E" || key == "S" ? MacroHeat::Nozzle : MacroHeat::None;
}

MacroTargets macroTargets(std::string_view parameters) {
  MacroTargets targets;
  bool nozzleFirst = false;
  bool bedFirst = false;
  forEachParameter(parameters, [&](std::string_view key, std::string_view value) {
    double degrees = 0;
    if (readNumber(value, degrees) == 0) return;
    const bool first = holds(key, "FIRST") || holds(key, "INITIAL");
    // Numbers below a nozzle's coolest temperature are its diameter, or a tool.
    const auto take = [first, degrees](double& target, bool& told) {
      if (target == 0 || (first && !told)) target = degrees;
      told = told || first;
    };
    switch (macroHeat(key)) {
      case MacroHeat::Nozzle:
        if (degrees >= kColdest && degrees <= kHottestTold) take(targets.nozzle, nozzleFirst);
        return;
      case MacroHeat::Bed:
        if (degrees > 0 && degrees < kColdest) take(targets.bed, bedFirst);
        return;
      case MacroHeat::NozzleLater:
      case MacroHeat::None:
        return;
    }
  });
  return targets;
}

}  // namespace sillon
