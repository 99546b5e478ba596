// Helpers for closed curves: neighbours, tangents, resampling.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"

namespace sillon {

/// Wraps an index k into a ring of n points, for k from -n to 2 n - 1.
inline int wrapped(int k, int n) { return k < 0 ? k + n : (k >= n ? k - n : k); }

/// Resamples curves at equal arc lengths of about `step`, with at least `kMinPoints` points each; the first point
/// stays.
ClosedCurves resampled(const ClosedCurves& curves, float step, const RunContext& run);
inline constexpr int kMinPoints = 6;

/// Resamples curves that do not meet so that they still do not: where two pass so closely that chords would touch, the
/// original points stay.
ClosedCurves resampledSimply(const ClosedCurves& curves, float step, const RunContext& run);

/// Returns the index of the curve that holds each point.
std::vector<std::int32_t> curveOfPoints(const ClosedCurves& curves);

/// Returns the index of the next point along its curve.
inline int nextOf(const ClosedCurves& curves, int curve, int point) {
  const std::size_t c = curve;
  return point + 1 == curves.begin[c + 1] ? curves.begin[c] : point + 1;
}

inline int previousOf(const ClosedCurves& curves, int curve, int point) {
  const std::size_t c = curve;
  return point == curves.begin[c] ? curves.begin[c + 1] - 1 : point - 1;
}

/// Returns the unit tangent at a point, along the chord between its neighbours; zero if they coincide.
inline Vec2f tangentAt(const ClosedCurves& curves, int curve, int point) {
  const Vec2f chord = curves.points[nextOf(curves, curve, point)] - curves.points[previousOf(curves, curve, point)];
  const float size = length(chord);
  return size > 0 ? chord * (1 / size) : Vec2f{};
}

// Exact crossings of closed curves.

/// Tells whether the segments ab and cd share a point. Exact on coordinates rounded to 1 µm.
bool segmentsMeet(Vec2f a, Vec2f b, Vec2f c, Vec2f d);

/// Finds all pairs of non-consecutive segments that share a point, each pair once in ascending order. Exact on
/// coordinates rounded to 1 µm. A segment is named by its first point; segments that vanish in rounding are skipped.
/// \param among  if not empty, only segments with a marked end (1 per point) are tested.
std::vector<std::pair<int, int>> findCrossings(const ClosedCurves& curves, const RunContext& run,
                                               const std::vector<char>& among = {});

}  // namespace sillon
