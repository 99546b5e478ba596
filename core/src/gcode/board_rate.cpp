#include "gcode/motion.hpp"

#include <algorithm>

namespace sillon {
namespace {

// Window over which moves per second are averaged: half of a small firmware's buffer of 16 moves. A short move between
// long ones does no harm.
constexpr std::size_t kWindow = 8;
constexpr std::size_t kMostJoined = 64;  // [moves], most that one joined move replaces
constexpr double kLongest = 3;           // [mm], longest joined move, so that speeds can follow curves
constexpr double kFewSlowed = 0.02;      // [length]; if at most this share is slowed, no coarser tolerance is tried
constexpr double kManySlowed = 0.25;     // [length], share of a path that may be slower than its common speed
constexpr double kStep = 0.9;            // ratio between neighbouring speeds of one path
constexpr double kCrawl = 12;            // [mm/s]; below this, speeds are not lowered to the next step
constexpr double kHold = 1;              // [mm] before and after a slow stretch that are slowed with it

// Tolerance of points and widths that joined moves leave out.
struct Tolerance {
  double position;  // [um]
  double width;     // [mm]
};
// Tolerances of joined moves, tried from the finest on.
constexpr Tolerance kTolerances[] = {{1, 0.01}, {2, 0.02}, {4, 0.04}, {6, 0.06}, {8, 0.07}, {10, 0.08}};

Vec2 fromTo(PointUm a, PointUm b) { return {static_cast<double>(b.x - a.x), static_cast<double>(b.y - a.y)}; }

// Tells whether all points between the first and the last one lie within `most` [um] of the line that joins these two.
bool nearLine(const PointUm* first, const PointUm* last, double most) {
  const Vec2 line = fromTo(*first, *last);
  const double square = dot(line, line);
  const double surely = most * most * square * (1 - 1e-9);
  for (const PointUm* p = first + 1; p < last; ++p) {
    const Vec2 q = fromTo(*first, *p);
    const double along = dot(q, line);
    const double across = cross(q, line);
    // Fast path for nearly all points, without a division and a root.
    if (along > 0 && along < square && across * across < surely) continue;
    if (length(q - std::clamp(along / square, 0.0, 1.0) * line) > most) return false;
  }
  return true;
}

// Finds the highest speed of each segment such that no window of moves passes the board faster than its limit.
std::vector<double> windowSpeeds(const std::vector<double>& lengths, const MotionLimits& limits) {
  std::vector<double> speeds(lengths.size(), limits.speed);
  double window = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    // The sum is renewed now and then, so that rounding errors cannot add up over a long path.
    if (i % 1024 == 0) {
      window = 0;
      for (std::size_t k = i < kWindow ? 0 : i - kWindow; k < i; ++k) window += lengths[k];
    }
    window += lengths[i];
    if (i >= kWindow) window -= lengths[i - kWindow];
    if (i + 1 < kWindow) continue;
    const double speed = limits.maxSegmentsPerSecond * window / static_cast<double>(kWindow);
    if (speed >= limits.speed) continue;
    for (std::size_t k = i + 1 - kWindow; k <= i; ++k) speeds[k] = std::min(speeds[k], speed);
  }
  return speeds;
}

// Length of all segments that are slower than `speed` [mm].
double slowedLength(const std::vector<double>& lengths, const std::vector<double>& speeds, double speed) {
  double sum = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i) sum += speeds[i] < speed ? lengths[i] : 0;
  return sum;
}

double total(const std::vector<double>& lengths) {
  double sum = 0;
  for (const double length : lengths) sum += length;
  return sum;
}

// Joins neighbouring moves greedily, as far as the tolerance allows.
Motion joined(const Motion& motion, const Tolerance& tolerance) {
  Motion out;
  const std::size_t segments = motion.lengths.size();
  out.points.reserve(segments + 1);
  for (std::vector<double>* values : {&out.widths, &out.lengths, &out.areas}) values->reserve(segments + 1);
  std::size_t from = 0;
  while (from < segments) {
    const std::size_t last = from < motion.beads ? motion.beads : segments;  // no move crosses the start of coasting
    std::size_t to = from + 1;
    double area = motion.areas[from];
    double along = motion.lengths[from];
    double low = std::min(motion.widths[from], motion.widths[to]);
    double high = std::max(motion.widths[from], motion.widths[to]);
    while (to < last && to - from < kMostJoined) {
      const double nextArea = area + motion.areas[to];
      const double nextAlong = along + motion.lengths[to];
      const double nextLow = std::min(low, motion.widths[to + 1]);
      const double nextHigh = std::max(high, motion.widths[to + 1]);
      const double mean = nextArea / nextAlong;
      if (nextAlong > kLongest || nextHigh - mean > tolerance.width || mean - nextLow > tolerance.width) break;
      if (motion.points[to + 1] == motion.points[from]) break;
      if (!nearLine(&motion.points[from], &motion.points[to + 1], tolerance.position)) break;
      area = nextArea;
      along = nextAlong;
      low = nextLow;
      high = nextHigh;
      ++to;
    }
    out.points.push_back(motion.points[from]);
    out.widths.push_back(motion.widths[from]);
    const PointUm d = motion.points[to] - motion.points[from];
    const bool alone = to == from + 1;
    out.lengths.push_back(alone ? along : lengthMm(d));
    out.areas.push_back(area);
    if (to == motion.beads) out.beads = out.lengths.size();
    from = to;
  }
  out.points.push_back(motion.points.back());
  out.widths.push_back(motion.widths.back());
  return out;
}

}  // namespace

void joinMoves(Motion& motion, const MotionLimits& limits) {
  const double few = kFewSlowed * total(motion.lengths);
  const auto slowed = [&](const Motion& tried) {
    return slowedLength(tried.lengths, windowSpeeds(tried.lengths, limits), limits.speed);
  };
  if (slowed(motion) <= few) return;
  Motion best;
  for (const Tolerance& tolerance : kTolerances) {
    best = joined(motion, tolerance);
    if (slowed(best) <= few) break;
  }
  motion = std::move(best);
}

std::vector<double> boardSpeeds(Motion& motion, const MotionLimits& limits) {
  const std::vector<double>& lengths = motion.lengths;
  std::vector<double> speeds = windowSpeeds(lengths, limits);
  motion.segmentSlowedMm = slowedLength(lengths, speeds, limits.speed);
  if (motion.segmentSlowedMm <= 0) return speeds;

  // All of the path gets one speed, except its densest places, which get few steps below it.
  const double most = kManySlowed * total(lengths);
  double common = limits.speed;
  while (common > 1 && slowedLength(lengths, speeds, common) > most) common *= kStep;
  for (double& speed : speeds) {
    double step = common;
    while (step > speed && step > kCrawl) step *= kStep;
    speed = std::min(step, speed);
  }
  // Slow stretches slow down their surroundings, too, within kHold.
  for (const bool back : {false, true}) {
    double held = limits.speed;
    double rest = 0;
    for (std::size_t k = 0; k < lengths.size(); ++k) {
      const std::size_t i = back ? lengths.size() - 1 - k : k;
      rest -= lengths[i];
      if (rest < 0 || speeds[i] <= held) {
        held = speeds[i];
        rest = kHold;
      }
      speeds[i] = held;
    }
  }
  return speeds;
}

}  // namespace sillon
