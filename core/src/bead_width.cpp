#include "sillon/bead_width.hpp"

#include <algorithm>
#include <cmath>

#include "curves.hpp"
#include "parallel_for.hpp"

namespace sillon {
namespace {

constexpr float kThread =
    0.02f;  ///< what a joint across a gap or a neck keeps, or the cycle would not print as one [tau]

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
  if (run.cancelled()) return Error{ErrorCode::Cancelled, "the run was cancelled"};
  return widths;
}

}  // namespace sillon
