#include "sillon/bead_width.hpp"

#include <algorithm>
#include <cmath>

#include "neighbour_gaps.hpp"
#include "parallel_for.hpp"

namespace sillon {
namespace {

constexpr float kCap = 1.5f;  ///< a gap with nothing in it is not wider than this [tau]

}  // namespace

Result<std::vector<float>> beadWidths(const ClosedCurves& curves, const BorderIndex& border, const ToolpathParams& params,
                                      const RunContext& run) {
  const float spacing = static_cast<float>(params.spacing);
  const NeighbourGaps gaps = neighbourGaps(curves, border, params.spacing, kCap * spacing, run);
  const float low = static_cast<float>(params.minWidth) * spacing;
  const float high = static_cast<float>(params.maxWidth) * spacing;
  std::vector<float> widths(curves.points.size());
  parallelFor(run, static_cast<int>(widths.size()), 4096, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      const std::size_t i = static_cast<std::size_t>(k);
      float width = std::clamp(0.5f * (gaps.left[i] + gaps.right[i]), low, high);
      const Vec2 p{static_cast<double>(curves.points[i].x), static_cast<double>(curves.points[i].y)};
      if (border.blockDistance(p) < 0.5f * width) {
        // A joint across a gap or a neck keeps a thread, or the cycle would not print as one.
        width = std::clamp(-2 * border.nearest(p).distance, 0.25f * low, width);
      }
      widths[i] = width;
    }
  });
  if (run.cancelled()) return Error{ErrorCode::Cancelled, "the run was cancelled"};
  return widths;
}

}  // namespace sillon
