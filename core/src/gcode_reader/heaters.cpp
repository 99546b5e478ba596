#include "gcode_reader/heaters.hpp"

#include <algorithm>
#include <string>
#include <string_view>

namespace sillon {
namespace {

void ask(Heater& heater, double degrees) { heater = {degrees, std::min(heater.ready, degrees)}; }

void await(Heater& heater) { heater.ready = heater.target; }

// What Klipper's commands name a heater or a sensor.
bool isBed(std::string_view name) { return name.starts_with("HEATER_BED"); }
bool isNozzle(std::string_view name) { return name.starts_with("EXTRUDER"); }

}  // namespace

std::size_t Heaters::indexOf(int tool) const {
  const auto index = static_cast<std::size_t>(std::max(tool, 0));
  return index < kTools && named_[index] ? index : told_;
}

std::size_t Heaters::nameTool(double tool) {
  const auto index = static_cast<std::size_t>(std::clamp(tool, 0.0, static_cast<double>(kTools - 1)));
  named_[index] = true;
  return index;
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
  if (!bed) {
    const char letter = ofTool ? 'P' : 'T';
    told_ = words.has(letter) ? nameTool(words.at(letter)) : indexOf(tool);
  }
  Heater& heater = bed ? bed_ : nozzles_[told_];
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
  const bool numbered = isNozzle(name) && readNumber(name.substr(8), tool) > 0;
  if (isNozzle(name)) told_ = numbered ? nameTool(tool) : 0;
  Heater& heater = isBed(name) ? bed_ : nozzles_[told_];
  double degrees = 0;
  const bool told = readNumber(valueOf(waits ? " MINIMUM=" : " TARGET="), degrees) > 0;
  if (!waits) return ask(heater, degrees);
  if (told) heater.ready = std::min(heater.target, degrees);
}

}  // namespace sillon
