#include "sillon/bead_width.hpp"

#include <algorithm>
#include <cmath>

#include "parallel_for.hpp"

namespace sillon {
Result<std::vector<float>> beadWidths(const ClosedCurves& curves, const NeighbourGaps& gaps, const BorderIndex& border,
                                      const ToolpathParams& params, const RunContext& run) {
  const float spacing = static_cast<float>(params.spacing);
  const float low = static_cast<float>(params.minWidth) * spacing;
  const float balance = static_cast<float>(params.widthBalance);
  const float high = static_cast<float>(params.maxWidth) * spacing;
  std::vector<float> widths(curves.points.size());
  parallelFor(run, static_cast<int>(widths.size()), 4096, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      const std::size_t i = static_cast<std::size_t>(k);
      const float least = std::min(gaps.left[i], gaps.right[i]);
      const float both = 0.5f * (gaps.left[i] + gaps.right[i]);
      float width = std::clamp(least + balance * (both - least), low, high);
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
