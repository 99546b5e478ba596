// The exponential of highlights, the same on every platform.
#pragma once

#include <algorithm>

#include "base/simd.hpp"

namespace sillon {

/// e^-x for x >= 0, relative error below 5e-5 up to 60; beyond 80 as at 80. A Taylor polynomial at x/256, squared eight
/// times.
inline float decay(float x) {
  const float y = std::min(x, 80.0f) * (1.0f / 256);
  float v = 1 - y * (1 - y * (1.0f / 2) * (1 - y * (1.0f / 3) * (1 - y * (1.0f / 4) * (1 - y * (1.0f / 5)))));
  for (int k = 0; k < 8; ++k) v *= v;
  return v;
}

/// Of four at once, each the same to the last bit.
inline F4 decay(F4 x) {
  const F4 one = splat(1);
  const F4 y = min4(splat(80.0f), x) * splat(1.0f / 256);
  const F4 fourth = one - y * splat(1.0f / 4) * (one - y * splat(1.0f / 5));
  F4 v = one - y * (one - y * splat(1.0f / 2) * (one - y * splat(1.0f / 3) * fourth));
  for (int k = 0; k < 8; ++k) v = v * v;
  return v;
}

}  // namespace sillon
