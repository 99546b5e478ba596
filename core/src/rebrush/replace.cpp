#include "rebrush/replace.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/lines.hpp"
#include "base/numbers.hpp"
#include "gcode_reader/machine.hpp"
#include "gcode_reader/parser.hpp"

namespace sillon {
namespace {

constexpr double kChord = 0.005;      // [mm] largest distance of a merged move from its points
constexpr double kWidthError = 0.03;  // [mm] largest error of a merged move's width
constexpr double kLongestMove = 5;    // [mm] longest merged move
constexpr double kLeastFlow = 0.85;   // least ratio of the slicer's plastic to that of the new beads at flow 1
constexpr double kMostFlow = 1.18;    // largest ratio of the slicer's plastic to that of the new beads at flow 1
constexpr double kSpeedStep = 2;      // [mm/s] least gain of speed: smaller ones are not worth a visible step
constexpr double kFarEntry = 2;     // [mm] longest way from the slicer's entry to the cycle that may leave the surface
constexpr double kShortTravel = 2;  // [mm] longest travel without retraction, as slicers allow

// A straight move that lays plastic.
struct LayingMove {
  Vec2 to;
  double length = 0;  // [mm]
  double volume = 0;  // [mm³] at flow 1
};

// Point of a cycle on the bed; indices wrap around.
Vec2 pointAt(const Cycle& cycle, std::size_t k, Vec2 offset) {
  const Vec2f p = cycle.points[k % cycle.points.size()];
  return Vec2{p.x, p.y} + offset;
}

// Rounds a place to the three decimals of written coordinates.
Vec2 rounded(Vec2 p) { return {std::round(p.x * 1000) / 1000 + 0.0, std::round(p.y * 1000) / 1000 + 0.0}; }

double distanceTo(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 d = b - a;
  const double along = dot(d, d);
  const double t = along > 0 ? std::clamp(dot(p - a, d) / along, 0.0, 1.0) : 0;
  return length(p - a - t * d);
}

// Merges the cycle, from its vertex `first` back to it, into few moves within the tolerances. Volumes add up exactly.
std::vector<LayingMove> mergedBeads(const Cycle& cycle, std::size_t first, Vec2 offset, double height) {
  const std::size_t count = cycle.points.size();
  const auto width = [&](std::size_t k) { return static_cast<double>(cycle.widths[(first + k) % count]); };
  const auto point = [&](std::size_t k) { return pointAt(cycle, first + k, offset); };
  std::vector<LayingMove> beads;
  for (std::size_t from = 0; from < count;) {
    std::size_t to = from + 1;
    double low = std::min(width(from), width(to));
    double high = std::max(width(from), width(to));
    while (to < count) {
      const std::size_t next = to + 1;
      low = std::min(low, width(next));
      high = std::max(high, width(next));
      bool fits = high - low <= 2 * kWidthError && length(point(next) - point(from)) <= kLongestMove;
      for (std::size_t k = from + 1; k < next && fits; ++k)
        fits = distanceTo(point(k), point(from), point(next)) <= kChord;
      if (!fits) break;
      to = next;
    }
    double volume = 0;
    for (std::size_t k = from; k < to; ++k)
      volume += length(point(k + 1) - point(k)) * (width(k) + width(k + 1)) / 2 * height;
    beads.push_back({rounded(point(to)), length(point(to) - point(from)), volume});
    from = to;
  }
  return beads;
}

// Index of the cycle's point that is nearest to a place on the bed.
std::size_t nearestTo(const Cycle& cycle, Vec2 place, Vec2 offset) {
  std::size_t nearest = 0;
  for (std::size_t k = 1; k < cycle.points.size(); ++k) {
    if (length(pointAt(cycle, k, offset) - place) < length(pointAt(cycle, nearest, offset) - place)) nearest = k;
  }
  return nearest;
}

// Tells whether a point lies in a shape, by the even-odd rule.
bool isInside(const Shape& shape, Vec2 p) {
  bool inside = false;
  for (const FilledPath& path : shape.paths) {
    for (const Ring& ring : path.rings) {
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Vec2 a = ring[k];
        const Vec2 b = ring[(k + 1) % ring.size()];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
      }
    }
  }
  return inside;
}

// Tells whether a straight way stays within the surface.
bool staysInside(const SlicedSurface& surface, Vec2 from, Vec2 to) {
  constexpr double kStep = 0.2;  // [mm]
  const int steps = std::clamp(static_cast<int>(length(to - from) / kStep) + 1, 1, 5000);
  for (int k = 1; k < steps; ++k) {  // the ends lie on beads, so they need no check
    const Vec2 p = from + (static_cast<double>(k) / steps) * (to - from);
    if (!isInside(surface.region, p - surface.corner)) return false;
  }
  return true;
}

// Chooses speeds in whole mm/s, and writes them where they change. If the slicer's is unknown, none is written, and the
// printer keeps its own.
class Feedrate {
 public:
  /// \param speed  speed of the slicer's beads [mm/s]; 0: unknown. \param mostFlow  largest flow [mm³/s]; 0: unknown.
  Feedrate(double speed, double mostFlow) : speed_(speed), mostFlow_(mostFlow), current_(speed) {}

  /// Sets a speed as it is, without rounding to whole mm/s. \return an F word, or nothing if the speed does not change.
  std::string set(double speed) {
    if (!(speed > 0) || speed == told_) return {};
    told_ = speed;
    return " F" + decimal(60 * speed, 3);
  }

  /// Sets the speed for a bead of this section [mm²], lowered where its flow would be too large. \return as set.
  std::string follow(double section) {
    if (!(speed_ > 0)) return {};
    const double allowed = mostFlow_ > 0 ? mostFlow_ / section : speed_;
    const double step = allowed < speed_ ? std::max(std::floor(allowed), 1.0) : speed_;
    if (step < current_ || step >= current_ + kSpeedStep || step == speed_) current_ = step;
    return set(current_);
  }

 private:
  double speed_;
  double mostFlow_;
  double current_;
  double told_ = 0;
};

// Replaces X and Y in a line of G-code; comments stay.
std::string withPlace(std::string_view line, Vec2 place) {
  std::string out;
  const std::size_t comment = std::min(line.find(';'), line.size());
  for (std::size_t k = 0; k < line.size();) {
    const char c = line[k];
    if (k < comment && (c == 'X' || c == 'Y')) {
      out += c;
      out += fixed(c == 'X' ? place.x : place.y, 3);
      ++k;
      while (k < comment && (line[k] == '-' || line[k] == '+' || line[k] == '.' || (line[k] >= '0' && line[k] <= '9')))
        ++k;
      continue;
    }
    out += c;
    ++k;
  }
  return out;
}

}  // namespace

Replacement replaceBeads(std::string_view gcode, const SurfaceBlock& block, const Cycle& cycle, Vec2 offset,
                         double filamentArea, double mostFlow) {
  Replacement out;
  const SlicedSurface& surface = block.surface;
  const auto leave = [](LeftBecause why) {
    Replacement left;
    left.left = why;
    return left;
  };
  // A travel without retraction behind the block must not become longer: the nozzle would ooze.
  const auto leadsOn = [&](Vec2 place) {
    if (!block.next || block.tightBefore) return true;
    const double before = length(*block.next - surface.exit);
    return length(*block.next - place) <= std::max(before + surface.spacing, kShortTravel);
  };
  std::size_t first = nearestTo(cycle, surface.entry, offset);
  // Else the cycle begins where the slicer ends; on the way there the nozzle crosses only places that it will cover.
  if (!leadsOn(rounded(pointAt(cycle, first, offset)))) first = nearestTo(cycle, surface.exit, offset);
  const Vec2 start = rounded(pointAt(cycle, first, offset));
  if (!leadsOn(start)) return leave(LeftBecause::Travel);
  if (length(start - surface.entry) > kFarEntry && !staysInside(surface, surface.entry, start)) {
    return leave(LeftBecause::Travel);
  }
  const std::vector<LayingMove> beads = mergedBeads(cycle, first, offset, surface.height);
  double volume = 0;
  for (const LayingMove& bead : beads) volume += bead.volume;
  const double flow = volume > 0 ? surface.volumeMm3 / volume : 0;
  if (!(flow >= kLeastFlow && flow <= kMostFlow)) return leave(LeftBecause::Flow);

  out.flow = flow;

  const std::string& end = block.lineEnd;
  Edit edit{surface.begin, surface.end, {}};
  std::string& text = edit.text;
  text.reserve(beads.size() * 32);
  Feedrate feedrate(surface.speed, mostFlow);
  Vec2 at = surface.entry;
  if (const double way = length(start - at); way > 0.0005) {
    // On a long way at the speed of beads, the nozzle would ooze.
    const double speed =
        way > kShortTravel && surface.speed > 0 ? std::max(block.travelSpeed, surface.speed) : surface.speed;
    text += "G1 X" + fixed(start.x, 3) + " Y" + fixed(start.y, 3) + feedrate.set(speed) + end;
    at = start;
  }
  if (const std::string word = feedrate.set(surface.speed); !word.empty()) text += "G1" + word + end;
  // E has five decimals; the rest that rounding leaves goes into the next move.
  double told = block.before.e;
  double exact = told;
  for (const LayingMove& bead : beads) {
    exact += bead.volume * flow / filamentArea;
    if (bead.to == at) continue;
    const double target = std::round(exact * 1e5) / 1e5;
    text += "G1 X" + fixed(bead.to.x, 3) + " Y" + fixed(bead.to.y, 3) + " E" +
            fixed(block.before.absoluteE ? target : target - told, 5) +
            feedrate.follow(bead.volume * flow / bead.length) + end;
    told = target;
    at = bead.to;
    ++out.moves;
  }
  out.volumeMm3 = (told - block.before.e) * filamentArea;
  if (block.before.absoluteE && std::abs(told - block.after.e) > 1e-9) text += "G92 E" + fixed(block.after.e, 5) + end;
  for (const std::string& line : block.kept) {
    if (!line.empty()) text += line + end;
  }
  if (const std::string word = feedrate.set(block.after.speed); !word.empty()) text += "G1" + word + end;
  // The last line of a file may have no line end; then the new text gets none.
  if (!gcode.substr(0, surface.end).ends_with('\n')) text.erase(text.size() - end.size());
  out.edits.push_back(std::move(edit));

  // The old beads under the wipes are gone. The wipes go on along the new cycle instead, over the same length.
  std::size_t vertex = first;
  Vec2 place = at;
  for (const WipeMove& wipe : block.wipes) {
    double rest = wipe.length;
    for (std::size_t guard = 0; rest > 0 && guard <= cycle.points.size(); ++guard) {
      const Vec2 next = pointAt(cycle, vertex + 1, offset);
      const double step = length(next - place);
      if (step > rest) {
        place = place + (rest / step) * (next - place);
        rest = 0;
      } else {
        place = next;
        rest -= step;
        ++vertex;
      }
    }
    const std::string_view line = gcode.substr(wipe.begin, wipe.end - wipe.begin);
    out.edits.push_back({wipe.begin, wipe.end, withPlace(line, rounded(place))});
  }
  return out;
}

std::string stateDifference(std::string_view before, std::string_view after, const SurfaceBlock& block) {
  const auto run = [&](std::string_view text) {
    MachineState machine = block.before;
    Heaters heaters;
    double pushed = 0;
    while (!text.empty()) {
      const GcodeParts parts = partsOf(trimmed(nextLine(text)));
      if (parts.code.empty()) continue;
      const GcodeCommand command = commandOf(parts.code);
      const GcodeWords words = readsWords(command) ? wordsOf(command.rest) : GcodeWords{};
      heaters.run(command, words, machine.tool, false);
      const auto move = runCommand(machine, command, words);
      if (move && move->e > 0 && move->length > 0) pushed += move->e;
    }
    return std::tuple{machine, heaters, pushed};
  };
  const auto [a, heatA, pushedA] = run(before);
  const auto [b, heatB, pushedB] = run(after);
  if (block.next && !(a.at == b.at)) return "the place";
  if (a.z != b.z) return "the height";
  if (a.absolute != b.absolute || a.absoluteE != b.absoluteE || a.inches != b.inches) return "the modes";
  if (a.absoluteE && std::abs(a.e - b.e) > 1.5e-5) return "E";
  if (std::abs(a.retracted - b.retracted) > 1e-4 || a.firmwareRetracted != b.firmwareRetracted) return "the retraction";
  if (std::abs(a.speed - b.speed) > 1e-6) return "the speed";
  if (a.tool != b.tool) return "the tool";
  if (!(heatA == heatB)) return "the heat";
  if (std::abs(pushedA - pushedB) > 0.01 * pushedA) return "the filament";
  return {};
}

}  // namespace sillon
