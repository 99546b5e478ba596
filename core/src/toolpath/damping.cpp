#include "toolpath/relaxation_steps.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace sillon {

// Marks the points around each crossing first and scales their shares afterwards, so that a point near to two crossings
// is scaled once.
void damp(const ClosedCurves& before, const ClosedCurves& after, const std::vector<std::pair<int, int>>& crossings,
          int reach, float factor, std::vector<float>& share) {
  const std::vector<std::int32_t> curveOf = curveOfPoints(after);
  std::vector<char> marked(share.size(), 0);
  for (const auto& [a, b] : crossings) {
    for (const int point : {a, b}) {
      const int c = curveOf[point];
      const int n = before.size(c);
      const int first = before.begin[c];
      // Equal steps: the same share of the way round is the same place, as the lengths hardly differ.
      const double part = static_cast<double>(point - after.begin[c]) / after.size(c);
      const int middle = static_cast<int>(part * n);
      for (int k = -std::min(reach, n / 2); k <= std::min(reach, n / 2); ++k) {
        marked[first + wrapped(middle + k, n)] = 1;
      }
    }
  }
  // A factor of 0 leaves a point where it was.
  for (std::size_t k = 0; k < share.size(); ++k) {
    if (marked[k]) share[k] *= factor;
  }
}

}  // namespace sillon
