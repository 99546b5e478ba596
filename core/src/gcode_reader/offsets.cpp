#include "gcode_reader/machine.hpp"

#include <cmath>

#include "gcode_reader/macros.hpp"

namespace sillon {
namespace {

void add(Offsets::Axes& axes, const Offsets::Axes& more) { axes = {axes.x + more.x, axes.y + more.y, axes.z + more.z}; }

// Sets the axes that are given; the others keep their offset.
void set(Offsets::Axes& axes, const GcodeWords& words) {
  axes = {words.at('X', axes.x), words.at('Y', axes.y), words.at('Z', axes.z)};
}

// Sets or adjusts axes by the parameters of SET_GCODE_OFFSET, such as Z or Z_ADJUST.
void setByName(Offsets::Axes& axes, std::string_view rest) {
  forEachNumber(rest, [&](const std::string& key, double value) {
    for (const auto& [name, axis] : {std::pair{'X', &axes.x}, {'Y', &axes.y}, {'Z', &axes.z}}) {
      if (key.empty() || key[0] != name) continue;
      if (key.size() == 1) *axis = value;
      if (key.substr(1) == "_ADJUST") *axis += value;
    }
  });
}

}  // namespace

std::optional<Offsets::Axes> Offsets::run(const GcodeCommand& command, GcodeFlavor flavor) {
  const bool duet = flavor == GcodeFlavor::RepRap;
  if (command.letter == 0 && upperCase(command.name) == "SET_GCODE_OFFSET") {
    setByName(code_, command.rest);
  } else if (command.is('M', 290)) {
    const GcodeWords words = wordsOf(command.rest);
    if (words.at('X') >= 39 && words.at('Y') >= 39 && words.at('Z') > 0) return std::nullopt;  // no babystep: Bambu's
    if (duet && words.has('R') && words.at('R') == 0) baby_ = {};
    add(baby_, {words.at('X'), words.at('Y'), words.has('Z') ? words.at('Z') : words.at('S')});
  } else if (command.is('M', 206)) {
    set(home_, wordsOf(command.rest));
    home_.z = -std::abs(home_.z);  // Marlin subtracts the offset, others add it: the worse counts
  } else if (command.is('G', 10)) {
    const GcodeWords words = wordsOf(command.rest);
    const double list = words.at('L', words.has('P') ? 2 : 0);
    if (list != 1 && list != 2) return std::nullopt;
    set(place_, words);
    place_.z = -std::abs(place_.z);
  } else {
    return std::nullopt;
  }
  Axes sum = code_;
  add(sum, baby_);
  add(sum, home_);
  add(sum, place_);
  return sum;
}

}  // namespace sillon
