#include "base/capsule_rows.hpp"

#include "base/simd.hpp"

namespace sillon {

void pixelsOf(const Capsule& capsule, int y, int count, int columns, PixelRuns& runs) {
  constexpr float kFar = 1e9f;
  const F4 none = splat(0);
  const F4 nowhere = splat(std::nanf(""));
  const F4 width = splat(static_cast<float>(columns));
  F4 row = splat(static_cast<float>(y)) + F4{0, 1, 2, 3};
  for (int k = 0; k < count; k += 4) {
    F4 left = splat(kFar);
    F4 right = splat(-kFar);
    // In a row that a disc does not meet, x is NaN, which min4 and max4 ignore.
    for (const Capsule::Disc& disc : capsule.discs) {
      const F4 x = splat(disc.centre.x);
      const F4 dy = row - splat(disc.centre.y);
      const F4 half = sqrt4(splat(disc.radius * disc.radius) - dy * dy);
      left = min4(x - half, left);
      right = max4(x + half, right);
    }
    for (const Capsule::Edge& edge : capsule.edges) {
      const F4 rise = row - splat(edge.low);
      const F4 x = select4((rise > none) & (row < splat(edge.high)), splat(edge.x) + splat(edge.slope) * rise, nowhere);
      left = min4(x, left);
      right = max4(x, right);
    }
    const I4 fromEnd = toInt(width - min4(max4(left, none), width));
    store4(runs.begin + k, splatInt(columns) - fromEnd);
    store4(runs.end + k, toInt(min4(max4(right + splat(1), none), width)));
    row = row + splat(4);
  }
}

}  // namespace sillon
