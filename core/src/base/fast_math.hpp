// Fast elementary functions with equal bytes on every platform, because they only use IEEE +, -, *, / and sqrt.
#pragma once

#include <cmath>
#include <cstdint>

#include "base/simd.hpp"

namespace sillon {

inline constexpr float kPi = 3.14159265358979f;

struct SinCos4 {
  F4 sin;
  F4 cos;
};

/// Returns sin and cos for |x| <= 8192; error below 3e-7 for |x| <= 10 and below 2e-6 + 1e-7 |x| beyond. Quadrants are
/// removed in three steps (Cody-Waite), then minimax polynomials apply on [-pi/4, pi/4].
inline SinCos4 sinCos(F4 x) {
  const F4 half = select4(x < splat(0), splat(-0.5f), splat(0.5f));
  const I4 quadrant = toInt(x * splat(0.636619772f) + half);
  const F4 q = toFloat(quadrant);
  const F4 r = ((x - q * splat(1.5703125f)) - q * splat(4.837512969970703125e-4f)) - q * splat(7.54978995489188216e-8f);
  const F4 r2 = r * r;
  const F4 s = r + r * r2 * (splat(-1.6666654611e-1f) + r2 * (splat(8.3321608736e-3f) + r2 * splat(-1.9515295891e-4f)));
  const F4 c =
      splat(1) - splat(0.5f) * r2 +
      r2 * r2 *
          (splat(4.166664568298827e-2f) + r2 * (splat(-1.388731625493765e-3f) + r2 * splat(2.443315711809948e-5f)));
  const I4 one = splatInt(1);
  const I4 two = splatInt(2);
  const I4 odd = (quadrant & one) == one;
  const I4 sinNegative = (quadrant & two) == two;
  const I4 cosNegative = ((quadrant + one) & two) == two;
  const F4 sine = select4(odd, c, s);
  const F4 cosine = select4(odd, s, c);
  return {select4(sinNegative, -sine, sine), select4(cosNegative, -cosine, cosine)};
}

struct SinCos {
  float sin;
  float cos;
};

inline SinCos sinCos(float x) {
  const SinCos4 v = sinCos(splat(x));
  return {v.sin[0], v.cos[0]};
}

/// Returns asin x for x in [-1, 1]; error below 1e-4, enough to place a vertex within a thousandth of a cell.
inline float asinApprox(float x) {
  const float a = std::abs(x);
  // Abramowitz and Stegun, formula 4.4.45.
  const float p = 1.5707288f + a * (-0.2121144f + a * (0.0742610f + a * -0.0187293f));
  const float v = 0.5f * kPi - std::sqrt(a < 1 ? 1 - a : 0.0f) * p;
  return x < 0 ? -v : v;
}

/// Returns the angle of (x, y) in (-pi, pi], error below 1e-5; 0 for the zero vector.
inline float atan2Approx(float y, float x) {
  const float ax = std::abs(x);
  const float ay = std::abs(y);
  const float big = ax > ay ? ax : ay;
  if (!(big > 0)) return 0;
  const float t = (ax > ay ? ay : ax) / big;
  const float t2 = t * t;
  float a =
      t * (0.99997726f +
           t2 * (-0.33262347f + t2 * (0.19354346f + t2 * (-0.11643287f + t2 * (0.05265332f + t2 * -0.01172120f)))));
  if (ay > ax) a = 0.5f * kPi - a;
  if (x < 0) a = kPi - a;
  return y < 0 ? -a : a;
}

/// Returns a well-mixed 64-bit hash (the finaliser of splitmix64), for randomness that no thread order can change.
inline std::uint64_t hash64(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

}  // namespace sillon
