#include "rebrush/blocks.hpp"

#include <algorithm>
#include <cmath>

#include "gcode_reader/parser.hpp"

namespace sillon {
namespace {

constexpr double kCornerSpeed = 8;  // [mm/s] square corner velocity: Marlin's usual jerk

// One straight piece of motion.
struct StraightMove {
  Vec2 direction;
  double length = 0;
  double speed = 0;
  double acceleration = 0;
};

// Largest speed at the corner between two pieces [mm/s], by Klipper's junction deviation.
double cornerSpeed(const StraightMove& a, const StraightMove& b) {
  if (a.direction == Vec2{} || b.direction == Vec2{}) return 0;
  // Cosine of half the turn; 1 is straight on.
  const double half = std::sqrt(std::max(0.0, (1 + dot(a.direction, b.direction)) / 2));
  if (half > 0.999999) return std::min(a.speed, b.speed);
  const double deviation = kCornerSpeed * kCornerSpeed * (std::sqrt(2.0) - 1);
  return std::min({a.speed, b.speed, std::sqrt(deviation * half / (1 - half))});
}

// Time of a path that begins and ends at rest [s]. A pass backward and one forward find the speeds at its corners;
// each piece is then a trapezoid of speed.
double secondsOf(const std::vector<StraightMove>& path) {
  const std::size_t count = path.size();
  std::vector<double> entry(count + 1, 0);
  for (std::size_t k = 1; k < count; ++k) entry[k] = cornerSpeed(path[k - 1], path[k]);
  const auto reach = [](double from, const StraightMove& s) {
    return std::sqrt(from * from + 2 * s.acceleration * s.length);
  };
  for (std::size_t k = count; k-- > 0;) entry[k] = std::min(entry[k], reach(entry[k + 1], path[k]));
  for (std::size_t k = 0; k < count; ++k) entry[k + 1] = std::min(entry[k + 1], reach(entry[k], path[k]));
  double seconds = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const StraightMove& s = path[k];
    const double in = entry[k];
    const double out = entry[k + 1];
    const double top = std::min(s.speed, std::sqrt(s.acceleration * s.length + (in * in + out * out) / 2));
    const double ramps = (2 * top * top - in * in - out * out) / (2 * s.acceleration);
    seconds += (2 * top - in - out) / s.acceleration + std::max(0.0, s.length - ramps) / top;
  }
  return seconds;
}

}  // namespace

double accelerationOf(std::string_view code) {
  if (!code.starts_with('M') && !code.starts_with('S')) return 0;  // most lines are moves, and end here
  double value = 0;
  if (code.starts_with("SET_VELOCITY_LIMIT")) {
    const std::size_t at = code.find("ACCEL=");
    if (at == std::string_view::npos || (at > 0 && code[at - 1] != ' ')) return 0;
    return readNumber(code.substr(at + 6), value) > 0 && value > 0 ? value : 0;
  }
  const GcodeCommand command = commandOf(code);
  if (!command.is('M', 204)) return 0;
  const GcodeWords words = wordsOf(command.rest);
  if (!words.readable()) return 0;
  value = words.has('S') ? words.at('S') : words.at('P');
  return value > 0 ? value : 0;
}

double secondsOfMoves(std::string_view text, const MachineState& before, double acceleration) {
  MachineState machine = before;
  double seconds = 0;
  std::vector<StraightMove> path;
  const auto stop = [&] {
    seconds += secondsOf(path);
    path.clear();
  };
  forEachLine(text, [&](const GcodeLine& line) {
    const GcodeParts parts = partsOf(line.text);
    if (parts.code.empty()) return;
    const GcodeCommand command = commandOf(parts.code);
    if (const double other = accelerationOf(parts.code); other > 0) acceleration = other;
    const auto move = runCommand(machine, command, readsWords(command) ? wordsOf(command.rest) : GcodeWords{});
    if (!move || !(machine.speed > 0)) return;
    const double rise = std::abs(move->z - move->zFrom);
    const double size = move->length > 0 ? move->length : std::max(rise, std::abs(move->e));
    if (!(size > 0)) return;
    StraightMove straight;
    straight.length = size;
    straight.speed = machine.speed;
    straight.acceleration = acceleration;
    if (move->length > 0 && rise == 0 && length(move->to - move->from) > 0) {
      straight.direction = 1 / length(move->to - move->from) * (move->to - move->from);
    } else {
      stop();
    }
    path.push_back(straight);
    if (straight.direction == Vec2{}) stop();
  });
  stop();
  return seconds;
}

}  // namespace sillon
