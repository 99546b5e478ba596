#include "sillon/bead_width.hpp"

#include <algorithm>
#include <cmath>

#include "curves.hpp"
#include "parallel_for.hpp"
#include "point_grid.hpp"
#include "simd.hpp"

namespace sillon {
namespace {

constexpr float kThread =
    0.02f;  ///< what a joint across a gap or a neck keeps, or the cycle would not print as one [tau]

constexpr int kOwnChain = 7;  ///< points tau/4 apart: a hairpin's legs do not count as neighbours of each other

// The share of its width that a bead at p may keep so that no bead beside it is overlapped: both give way alike.
float shareBeside(const PointGrid& grid, const std::vector<float>& sortedWidth, Vec2f p, float width, float reach,
                  float allowed, int point, int first, int size) {
  const F4 px = splat(p.x);
  const F4 py = splat(p.y);
  const F4 half = splat(0.5f);
  const F4 own = splat(0.5f * width - allowed);
  const OwnChain chain(point, first, size, kOwnChain);
  F4 least = splat(1);
  grid.around(p, reach, [&](int from, int to) {
    for (int k = from; k < to; k += 4) {
      const std::size_t s = static_cast<std::size_t>(k);
      const F4 dx = load4(&grid.x[s]) - px;
      const F4 dy = load4(&grid.y[s]) - py;
      const F4 room = max4(own + half * load4(&sortedWidth[s]), splat(1e-6f));
      const F4 share2 = (dx * dx + dy * dy) / (room * room);
      least = min4(least, select4(chain.holds(load4(&grid.id[s])), splat(1), share2));
    }
  });
  return std::sqrt(std::min(std::min(least[0], least[1]), std::min(least[2], least[3])));
}

// Narrows beads where two would overlap by more than `allowed` [mm].
void narrowOverlaps(const ClosedCurves& curves, const std::vector<std::int32_t>& curveOf, float spacing, float low,
                    float allowed, std::vector<float>& width, const RunContext& run) {
  const PointGrid grid(curves.points, 0.75f * spacing, run);
  std::vector<float> sorted(grid.id.size(), 0.0f);  // as the grid has them, and no width for its padding
  for (std::size_t s = 0; s < static_cast<std::size_t>(grid.count()); ++s) {
    sorted[s] = width[static_cast<std::size_t>(grid.id[s])];
  }
  const float widest = width.empty() ? 0 : *std::max_element(width.begin(), width.end());
  parallelFor(run, grid.count(), 2048, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      const std::size_t i = static_cast<std::size_t>(k);
      const int c = curveOf[i];
      const float reach = std::max(0.5f * (width[i] + widest) - allowed, 0.0f);
      const float share = shareBeside(grid, sorted, curves.points[i], width[i], reach, allowed, k,
                                      curves.begin[static_cast<std::size_t>(c)], curves.size(c));
      width[i] = std::min(width[i], std::max(low, width[i] * share));
    }
  });
}

}  // namespace

Result<BeadWidths> beadWidths(const ClosedCurves& curves, const NeighbourGaps& gaps, const BorderIndex& border,
                              const ToolpathParams& params, const RunContext& run) {
  const float spacing = static_cast<float>(params.spacing);
  const float low = static_cast<float>(params.minWidth) * spacing;
  const float balance = static_cast<float>(params.widthBalance);
  const float high = static_cast<float>(params.maxWidth) * spacing;
  BeadWidths widths{std::vector<float>(curves.points.size()), std::vector<float>(curves.points.size(), 1e9f)};
  const std::vector<std::int32_t> curveOf = curveOfPoints(curves);
  parallelFor(run, static_cast<int>(curves.points.size()), 4096, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      const std::size_t i = static_cast<std::size_t>(k);
      const float least = std::min(gaps.left[i], gaps.right[i]);
      const float both = 0.5f * (gaps.left[i] + gaps.right[i]);
      float width = std::clamp(least + balance * (both - least), low, high);
      const Vec2 p{static_cast<double>(curves.points[i].x), static_cast<double>(curves.points[i].y)};
      if (border.blockDistance(p) < spacing || border.outside(p)) {
        // Half-way to the neighbours too: round a reflex corner the bead's straight segments pass nearer than its
        // points.
        float distance = border.nearest(p).distance;
        for (const int neighbour : {previousOf(curves, curveOf[i], k), nextOf(curves, curveOf[i], k)}) {
          const Vec2f q = (curves.points[i] + curves.points[static_cast<std::size_t>(neighbour)]) * 0.5f;
          distance = std::max(distance, border.nearest({static_cast<double>(q.x), static_cast<double>(q.y)}).distance);
        }
        widths.limit[i] = std::max(-2 * distance, kThread * spacing);
        width = std::min(width, widths.limit[i]);
      }
      widths.width[i] = width;
    }
  });
  // What simplification may still move counts as overlap already.
  const float allowed = static_cast<float>(params.beadOverlap * params.spacing - params.simplifyTolerance);
  narrowOverlaps(curves, curveOf, spacing, low, allowed, widths.width, run);
  if (run.cancelled()) return Error{ErrorCode::Cancelled, "the run was cancelled"};
  return widths;
}

}  // namespace sillon
