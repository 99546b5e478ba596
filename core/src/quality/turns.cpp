#include "quality/measured_parts.hpp"

#include <atomic>
#include <cstddef>
#include <vector>

#include "base/parallel_for.hpp"

namespace sillon {
namespace {

constexpr int kGrain = 1 << 14;

// Unit vectors along the steps of a cycle.
std::vector<Vec2f> headingsOf(const Vec2f* points, int n, const RunContext& run) {
  std::vector<Vec2f> headings(n);
  parallelForEach(run, n, kGrain, [&](int k) {
    const Vec2f e = points[k + 1 < n ? k + 1 : 0] - points[k];
    const float size = length(e);
    headings[k] = size > 0 ? e * (1 / size) : Vec2f{};
  });
  return headings;
}

// Counts runs of steps around the cycle whose heading differs from that `apart` steps on by at least the given angle.
std::int64_t countRuns(const std::vector<Vec2f>& headings, std::size_t apart, float cosine, const RunContext& run) {
  const std::size_t n = headings.size();
  const auto turnsAt = [&](std::size_t k) {
    const std::size_t on = k + apart;
    return dot(headings[k], headings[on < n ? on : on % n]) <= cosine;
  };
  std::atomic<std::int64_t> begins{0};
  parallelFor(run, static_cast<int>(n), kGrain, [&](int first, int last) {
    bool before = turnsAt((first + n - 1) % n);
    std::int64_t found = 0;
    for (int k = first; k < last; ++k) {
      const bool turns = turnsAt(k);
      found += turns && !before ? 1 : 0;
      before = turns;
    }
    begins += found;
  });
  return begins == 0 && turnsAt(0) ? 1 : begins.load();  // the whole cycle turns
}

}  // namespace

Turns countTurns(const ClosedCurves& curves, double spacing, const RunContext& run) {
  const ClosedCurves fine = resampled(curves, static_cast<float>(spacing / 8), run);
  Turns turns;
  for (int c = 0; c < fine.count() && !run.cancelled(); ++c) {
    const Vec2f* points = fine.points.data() + fine.begin[c];
    const std::vector<Vec2f> headings = headingsOf(points, fine.size(c), run);
    turns.uTurns += countRuns(headings, 12, -0.5f, run);
    turns.kinks += countRuns(headings, 2, 0.5f, run);
  }
  return turns;
}

}  // namespace sillon
