#include "gcode_reader/machine.hpp"

#include <string_view>

#include "gcode_reader/macros.hpp"

namespace sillon {
namespace {

// Sets a target without waiting: a lower one lets the heater cool to it.
void ask(Heater& heater, double degrees) { heater = {degrees, std::min(heater.ready, degrees)}; }

// Waits until a heater has reached its target.
void await(Heater& heater) { heater.ready = heater.target; }

std::size_t toolIndex(double tool) { return toSize(std::clamp(tool, 0.0, 99.0)); }

}  // namespace

// The nozzle of a tool: its own if its temperature was ever set, else the one that was set last.
std::size_t Heaters::indexOf(int tool) const {
  const std::size_t index = std::max(tool, 0);
  return index < kTools && known_[index] ? index : told_;
}

// The nozzle with this index, which is now the one that was set last.
Heater& Heaters::tell(std::size_t index) {
  told_ = std::min(index, kTools - 1);
  known_[told_] = true;
  return nozzles_[told_];
}

std::vector<int> Heaters::otherHotTools(int tool) const {
  std::vector<int> hot;
  for (std::size_t index = 0; index < kTools; ++index) {
    if (index != indexOf(tool) && nozzles_[index].target > 0) hot.push_back(static_cast<int>(index));
  }
  return hot;
}

void Heaters::run(const GcodeCommand& command, const GcodeWords& words, int tool, bool klipper) {
  if (command.letter == 0) return runNamed(command);
  if (command.is('M', 116) || command.is('G', 1009)) {  // M116 and TriLAB's purge, G1009, wait for all heaters
    std::for_each(nozzles_.begin(), nozzles_.end(), await);
    await(chamber_);
    return await(bed_);
  }
  const bool ofTool = setsTool(command, words) || command.is('M', 568);
  const bool nozzle = command.is('M', 104) || command.is('M', 109);
  const bool bed = command.is('M', 140) || command.is('M', 190);
  const bool chamber = command.is('M', 141) || command.is('M', 191);
  if ((!nozzle && !bed && !chamber && !ofTool) || !words.readable()) return;
  const char letter = ofTool ? 'P' : 'T';
  const auto heater = [&]() -> Heater& {
    if (bed) return bed_;
    if (chamber) return chamber_;
    const std::size_t own = toolIndex(tool);
    if (!words.has(letter)) return tell(separate_ ? own : indexOf(tool));
    separate_ = separate_ || toolIndex(words.at(letter)) != own;
    return tell(toolIndex(words.at(letter)));
  };
  if (command.is('M', 568) && words.has('A') && words.at('A') < 1) return ask(heater(), 0);
  const bool off = klipper && (nozzle || bed);  // Klipper reads no R; without S it switches the heater off
  const char degrees = words.has('S') || ofTool || off ? 'S' : 'R';
  if (!words.has(degrees) && !off) return;
  Heater& told = heater();
  ask(told, words.has(degrees) ? std::max(0.0, words.at(degrees)) : 0.0);
  if (command.code == 109 || command.code == 190 || command.code == 191) await(told);
}

// Runs Klipper's TURN_OFF_HEATERS, SET_HEATER_TEMPERATURE and TEMPERATURE_WAIT.
void Heaters::runNamed(const GcodeCommand& command) {
  const std::string name = upperCase(command.name);
  if (name == "TURN_OFF_HEATERS") {
    nozzles_.fill({});
    bed_ = chamber_ = {};
    return;
  }
  const bool waits = name == "TEMPERATURE_WAIT";
  if (!waits && name != "SET_HEATER_TEMPERATURE") return;
  std::string whose;
  double degrees = 0;
  bool told = false;
  forEachParameter(command.rest, [&](const std::string& key, std::string_view value) {
    if (key == (waits ? "SENSOR" : "HEATER")) whose = upperCase(value);
    if (key == (waits ? "MINIMUM" : "TARGET")) told = readNumber(value, degrees) > 0;
  });
  const bool bed = whose == "HEATER_BED";
  if (!bed && !whose.starts_with("EXTRUDER")) return;
  double tool = 0;  // number in EXTRUDER, EXTRUDER1, ...; the first has none
  if (!bed) readNumber(std::string_view(whose).substr(8), tool);
  Heater& heater = bed ? bed_ : tell(toolIndex(tool));
  if (!waits) return ask(heater, degrees);
  if (told) heater.ready = std::min(heater.target, degrees);
}

}  // namespace sillon
