#include "gcode_reader/machine.hpp"

#include <cmath>
#include <iterator>
#include <numbers>

namespace sillon {
namespace {

constexpr double kInch = 25.4;     // [mm] per inch
constexpr double kArcSlack = 0.5;  // [mm], distance that an arc's end may lie off its circle
constexpr std::pair<char, unsigned> kAxisLetters[] = {{'X', kAxisX}, {'Y', kAxisY}, {'Z', kAxisZ}};

// Centre of an arc with radius |r| between two places; r below 0 chooses the longer of the two arcs. Nothing if the
// places are too far apart.
std::optional<Vec2> centreOf(Vec2 from, Vec2 to, double r, bool clockwise) {
  const Vec2 chord = to - from;
  const double half = length(chord) / 2;
  if (!(half > 0) || half > std::abs(r) * 1.001) return std::nullopt;
  const double away = std::sqrt(std::max(0.0, r * r - half * half)) * ((r > 0) == clockwise ? -1 : 1);
  return from + 0.5 * chord + (0.5 * away / half) * Vec2{-chord.y, chord.x};
}

// Reads the centre and turn of G2 or G3, by I and J or else by R. With I and J but without a target it is a full turn.
void readArc(MachineMove& move, const GcodeWords& words, double unit) {
  if (words.has('I') || words.has('J')) {
    move.centre = move.from + unit * Vec2{words.at('I'), words.at('J')};
  } else if (const auto centre = centreOf(move.from, move.to, words.at('R') * unit, move.code == 2)) {
    move.centre = *centre;
  } else {
    move.readable = false;
    return;
  }
  const Vec2 a = move.from - move.centre;
  const Vec2 b = move.to - move.centre;
  if (std::abs(length(a) - length(b)) > kArcSlack + 0.02 * length(a)) {
    move.readable = false;
    return;
  }
  double angle = std::atan2(cross(a, b), dot(a, b));
  if (move.code == 2) angle = -angle;
  if (angle <= 1e-9) angle += 2 * std::numbers::pi;
  move.turn = move.code == 2 ? -angle : angle;
  move.length = length(a) * angle;
}

// Runs G0 to G3: reads the move, and sets place, speed and filament of the machine.
MachineMove runMove(MachineState& state, int code, const GcodeWords& words) {
  const double unit = state.inches ? kInch : 1;
  MachineMove move;
  move.code = code;
  move.from = state.at;
  move.zFrom = state.z;
  move.xy = words.has('X') || words.has('Y');
  move.toldF = words.has('F');
  move.arc = code >= 2;
  if (move.toldF) state.speed = words.at('F') * unit / 60;
  const auto target = [&](char letter, double now, double origin) {
    if (!words.has(letter)) return now;
    const double told = words.at(letter) * unit;
    return state.absolute ? told + origin : now + told;
  };
  state.at = {target('X', state.at.x, state.origin.x), target('Y', state.at.y, state.origin.y)};
  state.z = target('Z', state.z, state.originZ);
  if (words.has('E')) {
    const double told = words.at('E') * unit;
    move.e = state.absoluteE ? told - state.e : told;
    state.e = state.absoluteE ? told : state.e + told;
  }
  if (state.absolute) {
    for (const auto& [letter, axis] : kAxisLetters) state.toldAxes |= words.has(letter) ? axis : 0;
  }
  move.to = state.at;
  move.z = state.z;
  move.length = length(move.to - move.from);
  if (move.arc) readArc(move, words, unit);
  if (move.length == 0) {
    if (move.e < 0) state.retracted -= move.e;
    if (move.e > 0) state.retracted = std::max(0.0, state.retracted - move.e);
  } else if (move.e < 0) {
    state.retracted -= move.e;  // a wipe draws filament back on the way
  }
  return move;
}

// Axes that a command names, with a number or without.
unsigned axesIn(std::string_view words) {
  unsigned axes = 0;
  for (const char c : words) {
    if (c == 'X' || c == 'x') axes |= kAxisX;
    if (c == 'Y' || c == 'y') axes |= kAxisY;
    if (c == 'Z' || c == 'z') axes |= kAxisZ;
  }
  return axes;
}

// Homes axes, which sets their places and origins to 0.
void home(MachineState& state, unsigned axes) {
  state.homedAxes |= axes;
  state.toldAxes &= ~axes;
  if ((axes & kAxisX) != 0) state.at.x = state.origin.x = 0;
  if ((axes & kAxisY) != 0) state.at.y = state.origin.y = 0;
  if ((axes & kAxisZ) != 0) state.z = state.originZ = 0;
}

// Runs G92, which gives the same place other coordinates.
void setOrigin(MachineState& state, const GcodeWords& words) {
  const double unit = state.inches ? kInch : 1;
  if (words.has('E')) state.e = words.at('E') * unit;
  if (words.has('X')) state.origin.x = state.at.x - words.at('X') * unit;
  if (words.has('Y')) state.origin.y = state.at.y - words.at('Y') * unit;
  if (words.has('Z')) state.originZ = state.z - words.at('Z') * unit;
}

}  // namespace

Vec2 onArc(const MachineMove& arc, double share) {
  const Vec2 a = arc.from - arc.centre;
  const double turn = share * arc.turn;
  return arc.centre + Vec2{a.x * std::cos(turn) - a.y * std::sin(turn), a.x * std::sin(turn) + a.y * std::cos(turn)};
}

bool setsTool(const GcodeCommand& command, const GcodeWords& words, bool duet) {
  if (!command.is('G', 10)) return false;
  for (const char letter : {'P', 'L', 'R', 'X', 'Y', 'Z'}) {
    if (words.has(letter)) return true;
  }
  // Marlin's G10 S1 draws back for a change of tool.
  return words.has('S') && (duet || words.at('S') < 0 || words.at('S') > 1);
}

std::optional<bool> volumetricBy(const GcodeCommand& command, const GcodeWords& words) {
  if (!command.is('M', 200)) return std::nullopt;
  if (words.has('S')) return words.at('S') > 0;
  return words.has('D') ? std::optional<bool>(words.at('D') > 0) : std::nullopt;
}

bool readsWords(const GcodeCommand& command) {
  if (command.letter == 'G') {
    return command.sub == 0 && (command.code <= 3 || command.code == 10 || command.code == 11 || command.code == 92);
  }
  constexpr int kCodes[] = {104, 109, 140, 141, 190, 191, 200, 568};
  return command.letter == 'M' && std::find(std::begin(kCodes), std::end(kCodes), command.code) != std::end(kCodes);
}

std::optional<MachineMove> runCommand(MachineState& state, const GcodeCommand& command, const GcodeWords& words) {
  if (command.letter == 0) return runMemory(state, command);
  if (command.sub != 0) return std::nullopt;
  if (command.letter == 'T') {
    changeTool(state, command.code);
    return std::nullopt;
  }
  if (command.letter == 'M') {
    if (command.code == 82 || command.code == 83) state.absoluteE = command.code == 82;
    state.volumetric = volumetricBy(command, words).value_or(state.volumetric);
    if (state.duet && command.code == 120) pushModes(state);
    if (state.duet && command.code == 121) popModes(state);
    if (command.code == 18 || command.code == 84) {  // switches all motors off, unless it names axes or a time
      const unsigned axes = axesIn(command.rest);
      const bool others = command.rest.find_first_of("EeSs") != std::string_view::npos;
      state.homedAxes &= ~(axes != 0 ? axes : others ? 0 : kAllAxes);
    }
    return std::nullopt;
  }
  if (command.letter != 'G') return std::nullopt;
  switch (command.code) {
    case 0:
    case 1:
    case 2:
    case 3:
      if (!words.readable()) return std::nullopt;
      return runMove(state, command.code, words);
    case 10:
    case 11:
      if (!setsTool(command, words, state.duet)) state.firmwareRetracted = command.code == 10;
      break;
    case 20:
    case 21:
      state.inches = command.code == 20;
      break;
    case 161:  // G161 and G162 are MakerBot's homing
    case 162:
    case 28: {
      const unsigned axes = axesIn(command.rest);
      home(state, axes != 0 ? axes : kAllAxes);
      break;
    }
    case 90:
    case 91:
      state.absolute = command.code == 90;
      if (state.ruledByG90) state.absoluteE = state.absolute;
      break;
    case 92:
      if (words.readable()) setOrigin(state, words);
      break;
    default:
      break;
  }
  return std::nullopt;
}

}  // namespace sillon
