#include "gcode_reader/heaters.hpp"

#include <algorithm>
#include <string>
#include <string_view>

namespace sillon {
namespace {

void ask(Heater& heater, double degrees) { heater = {degrees, std::min(heater.ready, degrees)}; }

void await(Heater& heater) { heater.ready = heater.target; }

std::size_t toIndex(double tool) { return static_cast<std::size_t>(std::clamp(tool, 0.0, 99.0)); }

// What Klipper's commands name a heater or a sensor.
bool isBed(std::string_view name) { return name.starts_with("HEATER_BED"); }
bool isNozzle(std::string_view name) { return name.starts_with("EXTRUDER"); }

}  // namespace

std::size_t Heaters::indexOf(int tool) const {
  const auto index = static_cast<std::size_t>(std::max(tool, 0));
  return index < kTools && known_[index] ? index : told_;
}

Heater& Heaters::tell(std::size_t index) {
  told_ = std::min(index, kTools - 1);
  known_[told_] = true;
  return nozzles_[told_];
}

void Heaters::run(const GcodeCommand& command, const GcodeWords& words, int tool) {
  if (command.letter == 0) return runNamed(command);
  if (command.is('M', 116)) {  // waits for all
    std::for_each(nozzles_.begin(), nozzles_.end(), await);
    return await(bed_);
  }
  const bool ofTool = command.is('G', 10) || command.is('M', 568);
  const bool nozzle = command.is('M', 104) || command.is('M', 109);
  const bool bed = command.is('M', 140) || command.is('M', 190);
  if ((!nozzle && !bed && !(ofTool && words.has('P'))) || !words.readable()) return;
  const double degrees = words.at('S', ofTool ? -1 : words.at('R', -1));
  if (degrees < 0) return;
  const char letter = ofTool ? 'P' : 'T';
  Heater& heater = bed ? bed_ : tell(words.has(letter) ? toIndex(words.at(letter)) : indexOf(tool));
  ask(heater, degrees);
  if (command.code == 109 || command.code == 190) await(heater);
}

void Heaters::runNamed(const GcodeCommand& command) {
  std::string line(command.name);
  line.append(" ").append(command.rest);
  std::transform(line.begin(), line.end(), line.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  const auto valueOf = [&](std::string_view key) {
    const std::size_t at = line.find(key);
    return at == std::string::npos ? std::string_view{} : std::string_view(line).substr(at + key.size());
  };
  if (line.starts_with("TURN_OFF_HEATERS")) {
    nozzles_.fill({});
    bed_ = {};
    return;
  }
  const bool waits = line.starts_with("TEMPERATURE_WAIT ");
  if (!waits && !line.starts_with("SET_HEATER_TEMPERATURE ")) return;
  const std::string_view name = valueOf(waits ? " SENSOR=" : " HEATER=");
  if (!isBed(name) && !isNozzle(name)) return;
  double tool = 0;  // EXTRUDER, EXTRUDER1, ...
  if (isNozzle(name)) readNumber(name.substr(8), tool);
  Heater& heater = isBed(name) ? bed_ : tell(toIndex(tool));
  double degrees = 0;
  const bool told = readNumber(valueOf(waits ? " MINIMUM=" : " TARGET="), degrees) > 0;
  if (!waits) return ask(heater, degrees);
  if (told) heater.ready = std::min(heater.target, degrees);
}

}  // namespace sillon
