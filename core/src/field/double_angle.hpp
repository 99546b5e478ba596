// Between a direction and its line: d and -d are the same z = e^{2i angle}.
#pragma once

#include <algorithm>
#include <cmath>

#include "sillon/base/types.hpp"

namespace sillon {

/// z of a unit direction: (cos 2a, sin 2a).
inline Vec2f lineOf(Vec2f d) { return {d.x * d.x - d.y * d.y, 2 * d.x * d.y}; }

/// One of the two unit directions of a unit z, by the half-angle formulas.
inline Vec2f directionOf(Vec2f z) {
  const float c = std::sqrt(std::max(0.0f, 0.5f * (1 + z.x)));
  const float s = std::sqrt(std::max(0.0f, 0.5f * (1 - z.x)));
  const Vec2f d{c, z.y < 0 ? -s : s};
  return d * (1 / length(d));
}

}  // namespace sillon
