#include "gcode/motion.hpp"

#include <algorithm>
#include <cmath>

#include "base/fast_math.hpp"
#include "base/numbers.hpp"

namespace sillon {
namespace {

constexpr double kWidthStep = 0.02;           // [mm], step of width between the moves of a bead that changes it
constexpr double kShortest = 0.033;           // [mm]; three fit into a quarter of a spacing, the distance of points
constexpr double kSlopeShare = 0.75;          // share of the slope of widths at which pressure advance would retract
constexpr double kAnyGrowth = 1e6;            // growth of widths where they may jump: no limit
constexpr double kRounding = 1e-6;            // makes 14.9999999 count as 15
constexpr double kLeastCurveSpeed = 5;        // [mm/s]; a slower nozzle drips more than it lays
constexpr double kFeedrateHysteresis = 2;     // [mm/s]; smaller gains are not worth a visible step
constexpr double kKlipperExtruderCorner = 1;  // [mm/s of filament], instantaneous_corner_velocity
constexpr double kMarlinExtruderJerk = 5;     // [mm/s of filament], DEFAULT_EJERK

Vec2 direction(const Motion& motion, std::size_t i) {  // unit vector along a segment; needs the lengths
  const PointUm d = motion.points[i + 1] - motion.points[i];
  const double scale = 0.001 / motion.lengths[i];
  return {static_cast<double>(d.x) * scale, static_cast<double>(d.y) * scale};
}

// Fills in the lengths of all segments.
void measure(Motion& motion) {
  motion.lengths.resize(motion.points.size() - 1);
  for (std::size_t i = 0; i < motion.lengths.size(); ++i) {
    motion.lengths[i] = lengthMm(motion.points[i + 1] - motion.points[i]);
  }
}

// Copies the points in printing order, from vertex `start` on.
void order(const BeadPath& path, std::size_t start, Motion& motion) {
  const std::size_t count = path.points.size();
  const std::size_t total = path.closed ? count + 1 : count;
  motion.points.resize(total);
  motion.widths.resize(total);
  for (std::size_t i = 0; i < total; ++i) {
    std::size_t k = start + i;
    if (k >= count) k -= count;
    motion.points[i] = path.points[k];
    motion.widths[i] = path.widths[k];
  }
  measure(motion);
}

// Cuts the path where it begins to coast, on the grid of the file.
void cutForCoast(Motion& motion, double coast, bool closed) {
  motion.beads = motion.lengths.size();
  if (!closed || coast <= 0) return;
  double rest = coast;
  while (motion.beads > 1 && rest > 0) {
    const std::size_t i = motion.beads - 1;
    const double piece = motion.lengths[i];
    if (piece <= rest) {
      rest -= piece;
      --motion.beads;
      continue;
    }
    const PointUm from = motion.points[i];
    const PointUm d = motion.points[i + 1] - from;
    const double share = 1 - rest / piece;
    const PointUm cut =
        from + PointUm{std::llround(share * static_cast<double>(d.x)), std::llround(share * static_cast<double>(d.y))};
    if (cut != from && cut != motion.points[i + 1]) {
      const auto at = static_cast<std::ptrdiff_t>(i + 1);
      motion.points.insert(motion.points.begin() + at, cut);
      motion.widths.insert(motion.widths.begin() + at,
                           motion.widths[i] + share * (motion.widths[i + 1] - motion.widths[i]));
      motion.lengths[i] = lengthMm(cut - from);
      motion.lengths.insert(motion.lengths.begin() + at, lengthMm(motion.points[i + 2] - cut));
    }
    return;
  }
}

// Splits segments along which the width changes much, because a written move has one width from end to end. The lengths
// of the pieces are scaled to that of the segment, so that their rounded ends add no plastic.
void splitWidths(Motion& motion) {
  Motion split;
  split.beads = motion.beads;
  const std::size_t most = motion.points.size() + motion.points.size() / 8;
  for (std::vector<double>* values : {&split.widths, &split.lengths}) values->reserve(most);
  split.points.reserve(most);
  for (std::size_t i = 0; i < motion.lengths.size(); ++i) {
    const PointUm d = motion.points[i + 1] - motion.points[i];
    const double change = motion.widths[i + 1] - motion.widths[i];
    int pieces = 1;
    if (std::abs(change) > kWidthStep) {  // rarely true
      const double wanted =
          std::min(std::ceil(std::abs(change) / kWidthStep - kRounding), std::floor(motion.lengths[i] / kShortest));
      pieces = std::max(1, static_cast<int>(wanted));
    }
    if (pieces == 1) {
      split.points.push_back(motion.points[i]);
      split.widths.push_back(motion.widths[i]);
      split.lengths.push_back(motion.lengths[i]);
      continue;
    }
    const auto cut = [&](int k) {
      const double share = static_cast<double>(k) / pieces;
      return PointUm{toWhole(share * static_cast<double>(d.x)), toWhole(share * static_cast<double>(d.y))};
    };
    double sum = 0;
    for (int k = 0; k < pieces; ++k) sum += lengthMm(cut(k + 1) - cut(k));
    double along = 0;
    for (int k = 0; k < pieces; ++k) {
      const double length = lengthMm(cut(k + 1) - cut(k));
      split.points.push_back(motion.points[i] + cut(k));
      split.widths.push_back(motion.widths[i] + along / sum * change);
      split.lengths.push_back(length * (motion.lengths[i] / sum));
      along += length;
    }
    if (i < motion.beads) split.beads += pieces - 1;
  }
  split.points.push_back(motion.points.back());
  split.widths.push_back(motion.widths.back());
  motion = std::move(split);
}

// Fills in the area that each segment covers, from its length and the mean of its widths.
void setAreas(Motion& motion) {
  motion.areas.resize(motion.lengths.size());
  for (std::size_t i = 0; i < motion.lengths.size(); ++i) {
    motion.areas[i] = motion.lengths[i] * (motion.widths[i] + motion.widths[i + 1]) / 2;
  }
}

// Replaces the widths where the two envelopes differ: each stretch gets one blend of both, chosen to keep its volume.
void blend(Motion& motion, const std::vector<double>& low, const std::vector<double>& high, bool closed) {
  const std::size_t segments = motion.lengths.size();
  const std::size_t count = closed ? segments : segments + 1;
  std::vector<double>& widths = motion.widths;
  // The walk along a closed path begins at a smooth vertex, so that the seam cuts no stretch.
  std::size_t first = 0;
  while (closed && first < count && low[first] < high[first]) ++first;
  const auto at = [&](std::size_t k) { return first + k < count ? first + k : (first + k) % count; };
  for (std::size_t begin = 0; begin < count; ++begin) {
    double wanted = 0;
    double room = 0;
    std::size_t end = begin;
    for (; end < count && low[at(end)] < high[at(end)]; ++end) {
      const std::size_t i = at(end);
      const double before = i > 0 ? motion.lengths[i - 1] : closed ? motion.lengths[segments - 1] : 0;
      const double share = before + (i < segments ? motion.lengths[i] : 0);
      wanted += share * (widths[i] - low[i]);
      room += share * (high[i] - low[i]);
    }
    if (end == begin) continue;
    const double t = std::clamp(wanted / room, 0.0, 1.0);
    for (; begin < end; ++begin) widths[at(begin)] = low[at(begin)] + t * (high[at(begin)] - low[at(begin)]);
  }
  if (closed) widths.back() = widths.front();
}

// Limits the slope of the widths to |dw/dL| <= 0.75 w / (K v). Two envelopes keep that slope: the largest function
// below the widths and the smallest above. They meet wherever the widths are smooth enough already, so those stay bit
// for bit. Elsewhere any convex combination of the two keeps the slope as well; each rough stretch takes the one of
// equal volume.
void limitSlope(Motion& motion, const std::vector<double>& speeds, const MotionLimits& limits, bool closed) {
  if (limits.pressureAdvance <= 0) return;
  const std::size_t segments = motion.lengths.size();
  std::vector<double>& widths = motion.widths;
  std::vector<double> growth(segments);  // largest ratio of the widths at the two ends
  std::vector<double> shrink(segments);  // inverse of growth; dividing instead takes a quarter of the time of writing
  bool smooth = true;
  for (std::size_t i = 0; i < segments; ++i) {
    const bool thread = std::min(widths[i], widths[i + 1]) < limits.leastBead - kRounding;
    growth[i] = thread ? kAnyGrowth : 1 + kSlopeShare * motion.lengths[i] / (limits.pressureAdvance * speeds[i]);
    shrink[i] = 1 / growth[i];
    smooth = smooth && widths[i + 1] <= widths[i] * growth[i] && widths[i] <= widths[i + 1] * growth[i];
  }
  if (smooth) return;

  std::vector<double> low = widths;
  std::vector<double> high = widths;
  const int rounds = closed ? 2 : 1;  // the second round carries the envelopes past the seam
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < segments; ++i) {
      low[i + 1] = std::min(low[i + 1], low[i] * growth[i]);
      high[i + 1] = std::max(high[i + 1], high[i] * shrink[i]);
    }
    for (std::size_t i = segments; i-- > 0;) {
      low[i] = std::min(low[i], low[i + 1] * growth[i]);
      high[i] = std::max(high[i], high[i + 1] * shrink[i]);
    }
    if (closed) {
      low.front() = low.back() = std::min(low.front(), low.back());
      high.front() = high.back() = std::max(high.front(), high.back());
    }
  }

  const std::vector<double> before = widths;
  blend(motion, low, high, closed);
  for (std::size_t i = 0; i < segments; ++i) {
    motion.areas[i] += motion.lengths[i] * (widths[i] + widths[i + 1] - before[i] - before[i + 1]) / 2;
  }
}

// Heading of a path, as an angle along its length. It is constant in the middle of a segment and turns evenly around a
// corner, within half a bead's width on either side: the bead shows no finer detail.
class Heading {
 public:
  Heading(const Motion& motion, double width) {
    knots_.reserve(2 * motion.lengths.size());
    double at = 0;
    double angle = 0;
    for (std::size_t i = 0; i < motion.lengths.size(); ++i) {
      if (i > 0) angle += turnAt(motion, i);
      const double length = motion.lengths[i];
      const double inset = std::min(length, width) / 2;
      knots_.push_back({at + inset, angle});
      if (length > width) knots_.push_back({at + length - inset, angle});
      at += length;
    }
  }

  /// \param knot  index where the last search ended; s must not decrease from call to call.
  [[nodiscard]] double at(double s, std::size_t& knot) const {
    while (knot + 1 < knots_.size() && knots_[knot + 1].x <= s) ++knot;
    const Vec2 from = knots_[knot];
    if (knot + 1 == knots_.size() || s <= from.x) return from.y;
    const Vec2 d = knots_[knot + 1] - from;
    return from.y + d.y * (s - from.x) / d.x;
  }

 private:
  static double turnAt(const Motion& motion, std::size_t i) {
    const Vec2 before = direction(motion, i - 1);
    const Vec2 after = direction(motion, i);
    return atan2Approx(static_cast<float>(cross(before, after)), static_cast<float>(dot(before, after)));
  }

  std::vector<Vec2> knots_;  // x: length along the path [mm], y: angle [radians]
};

// Lowers the speeds in curves to v² <= a r, where r is the path's mean radius over one bead's width. Then evens out the
// speeds.
void slowCurves(Motion& motion, const MotionLimits& limits, std::vector<double>& speeds) {
  const double acceleration = std::min(limits.curveAcceleration, limits.acceleration);
  if (acceleration <= 0) return;
  const std::size_t segments = motion.lengths.size();
  double area = 0;
  double total = 0;
  for (std::size_t i = 0; i < segments; ++i) {
    area += motion.lengths[i] * (motion.widths[i] + motion.widths[i + 1]) / 2;
    total += motion.lengths[i];
  }
  const double width = area / total;
  const Heading heading(motion, width);
  std::vector<double> squared(segments);
  for (std::size_t i = 0; i < segments; ++i) squared[i] = speeds[i] * speeds[i];
  // The heading is unknown beyond the ends, so the window stays inside.
  const double first = (std::min(motion.lengths.front(), width) + width) / 2;
  const double last = total - (std::min(motion.lengths.back(), width) + width) / 2;
  double begin = 0;
  std::size_t behind = 0;
  std::size_t ahead = 0;
  for (std::size_t i = 0; i < segments; ++i) {
    const double length = motion.lengths[i];
    const double middle = std::max(first, std::min(begin + length / 2, last));
    const double turn = std::abs(heading.at(middle + width / 2, ahead) - heading.at(middle - width / 2, behind));
    if (turn * squared[i] > acceleration * width) squared[i] = acceleration * width / turn;
    begin += length;
  }
  // Slow segments slow down a bead's width before and after them; shorter changes of speed would show as flicker.
  for (const bool back : {false, true}) {
    double held = 0;
    double rest = 0;
    for (std::size_t k = 0; k < segments; ++k) {
      const std::size_t i = back ? segments - 1 - k : k;
      rest -= motion.lengths[i];
      if (rest < 0 || squared[i] <= held) {
        held = squared[i];
        rest = width;
      }
      squared[i] = held;
    }
  }
  for (std::size_t i = 0; i < segments; ++i) {
    const double speed = std::max(kLeastCurveSpeed, std::sqrt(squared[i]));
    if (speed >= speeds[i]) continue;
    motion.curveSlowedMm += motion.lengths[i];
    speeds[i] = speed;
  }
}

// Sets the feedrate of each segment in whole mm/s, never above the limits of flow and segment rate.
void setFeedrates(Motion& motion, const std::vector<double>& speeds, const MotionLimits& limits) {
  motion.feedrates.resize(motion.lengths.size());
  double current = 0;
  for (std::size_t i = 0; i < motion.lengths.size(); ++i) {
    const double mean = motion.areas[i] / motion.lengths[i];
    const double area = limits.flow * limits.layerHeight * std::max({motion.widths[i], motion.widths[i + 1], mean});
    const double byFlow = limits.maxFlow / area;
    if (byFlow < limits.speed) motion.flowSlowedMm += motion.lengths[i];
    double allowed = std::min(speeds[i], byFlow);
    if (limits.evenFlow > 0) {
      allowed = std::min(allowed, limits.evenFlow / std::max(motion.widths[i], motion.widths[i + 1]));
    }
    const double step = allowed < limits.speed ? std::floor(allowed + kRounding) : limits.speed;
    if (step < current || step >= current + kFeedrateHysteresis) current = step;
    // Below 1 mm/s, which only dense micrometre segments need, the steps are whole mm/min.
    const double feedrate =
        current >= 1 ? std::floor(current * 60) : std::max(1.0, std::floor(allowed * 60 + kRounding));
    motion.feedrates[i] = static_cast<std::int32_t>(feedrate);
  }
}

constexpr double kUnlimited = 1e12;  // [mm²/s²], squared speed of a corner without a limit

// Squared speed at which no axis changes by more than Marlin's jerk. An axis that reverses counts with its faster side,
// as in Marlin, and not with the sum of both.
double jerkSpeedSquared(Vec2 before, Vec2 after, const MotionLimits& limits) {
  const auto change = [](double a, double b) {
    return a * b >= 0 ? std::abs(b - a) : std::max(std::abs(a), std::abs(b));
  };
  const double most = std::max(change(before.x, after.x), change(before.y, after.y));
  const double jerk = 2 * limits.cornerSpeed;
  return most * most * kUnlimited <= jerk * jerk ? kUnlimited : jerk * jerk / (most * most);
}

// Squared highest speed through the corner between two unit directions: Klipper's junction deviation, or jerk.
double cornerSpeedSquared(Vec2 before, Vec2 after, double shorter, const MotionLimits& limits) {
  if (limits.flavor != GcodeFlavor::Klipper) return jerkSpeedSquared(before, after, limits);
  const double cosine = dot(before, after);
  if (cosine >= 1 - 1e-9) return kUnlimited;
  if (cosine <= -1 + 1e-9) return 0;
  const double half = std::sqrt((1 + cosine) / 2);                // cos(turn / 2)
  const double tangent = std::sqrt((1 - cosine) / (1 + cosine));  // tan(turn / 2)
  const double deviation = (std::sqrt(2.0) - 1) * limits.cornerSpeed * limits.cornerSpeed * half / (1 - half);
  return std::min(deviation, 0.5 * shorter * limits.acceleration / tangent);
}

// Squared speed at which a path starts or stops: 0 for Klipper, the jerk for the others.
double endSpeedSquared(Vec2 heading, double speed, const MotionLimits& limits) {
  if (limits.flavor == GcodeFlavor::Klipper) return 0;
  return std::min(speed * speed, jerkSpeedSquared({}, heading, limits));
}

// Times all segments by trapezoidal speed profiles with look-ahead, from rest to rest.
void setSeconds(Motion& motion, const MotionLimits& limits) {
  const std::size_t segments = motion.lengths.size();
  const double bead = limits.filamentArea > 0 ? limits.flow * limits.layerHeight / limits.filamentArea : 0;
  const double extruderStep = limits.flavor == GcodeFlavor::Klipper ? kKlipperExtruderCorner : kMarlinExtruderJerk;
  std::vector<double> squared(segments + 1, 0.0);  // squared speed at each point
  Vec2 before;
  double speedBefore = 0;
  double feedBefore = 0;
  for (std::size_t i = 0; i < segments; ++i) {
    const Vec2 heading = direction(motion, i);
    const double speed = motion.feedrates[i] / 60.0;
    const double feed = bead * motion.areas[i] / motion.lengths[i];  // mm of filament per mm
    if (i > 0) {
      const double slower = std::min(speed, speedBefore);
      const double shorter = std::min(motion.lengths[i], motion.lengths[i - 1]);
      squared[i] = std::min(slower * slower, cornerSpeedSquared(before, heading, shorter, limits));
      const double jump = (feed - feedBefore) * (feed - feedBefore);
      if (jump * squared[i] > extruderStep * extruderStep) squared[i] = extruderStep * extruderStep / jump;
    } else {
      squared[0] = endSpeedSquared(heading, speed, limits);
    }
    before = heading;
    speedBefore = speed;
    feedBefore = feed;
  }
  squared[segments] = endSpeedSquared(before, speedBefore, limits);

  const double twice = 2 * limits.acceleration;
  for (std::size_t i = segments; i-- > 0;) {
    squared[i] = std::min(squared[i], squared[i + 1] + twice * motion.lengths[i]);
  }
  motion.seconds.resize(segments);
  double entry = std::sqrt(squared[0]);
  for (std::size_t i = 0; i < segments; ++i) {
    squared[i + 1] = std::min(squared[i + 1], squared[i] + twice * motion.lengths[i]);
    const double exit = std::sqrt(squared[i + 1]);
    double top = motion.feedrates[i] / 60.0;
    const double reachable = (squared[i] + squared[i + 1]) / 2 + limits.acceleration * motion.lengths[i];
    if (reachable < top * top) top = std::sqrt(reachable);
    const double ramps = (2 * top * top - squared[i] - squared[i + 1]) / twice;
    const double cruise = std::max(0.0, motion.lengths[i] - ramps);
    motion.seconds[i] = (2 * top - entry - exit) / limits.acceleration + cruise / top;
    motion.totalSeconds += motion.seconds[i];
    entry = exit;
  }
}

}  // namespace

double travelSeconds(const std::vector<PointUm>& points, double speed, const MotionLimits& limits) {
  Motion motion;
  motion.points = points;
  motion.widths.assign(points.size(), 0.0);
  measure(motion);
  motion.areas.assign(motion.lengths.size(), 0.0);
  motion.feedrates.assign(motion.lengths.size(), static_cast<std::int32_t>(std::llround(speed * 60)));
  setSeconds(motion, limits);
  return motion.totalSeconds;
}

Motion planMotion(const BeadPath& path, std::size_t start, const MotionLimits& limits) {
  Motion motion;
  order(path, start, motion);
  cutForCoast(motion, limits.coast, path.closed);
  splitWidths(motion);
  setAreas(motion);
  joinMoves(motion, limits);
  std::vector<double> speeds = boardSpeeds(motion, limits);
  slowCurves(motion, limits, speeds);
  limitSlope(motion, speeds, limits, path.closed);
  if (path.closed && limits.scarf > 0) addScarf(motion, speeds, limits.scarf);
  setFeedrates(motion, speeds, limits);
  setSeconds(motion, limits);
  return motion;
}

}  // namespace sillon
