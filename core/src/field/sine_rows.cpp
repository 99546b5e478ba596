#include "field/sine_rows.hpp"

#include "base/fast_math.hpp"
#include "base/simd.hpp"

namespace sillon {

void fillPowers(const PowerRow& row, std::size_t cells) {
  for (std::size_t x = 0; x < cells; x += 4) {
    const SinCos4 first = sinCos(load4(row.angle + x));
    F4 c = first.cos;
    F4 s = first.sin;
    for (int k = 1;; ++k) {
      store4(row.cos[k] + x, c);
      store4(row.sin[k] + x, s);
      if (k == kNodeReach) break;
      const F4 next = c * first.cos - s * first.sin;
      s = c * first.sin + s * first.cos;
      c = next;
    }
  }
}

void addToNodes(const NodeSums& sums, std::size_t cells) {
  const F4 weightY = splat(sums.weightY);
  const F4 sign = splat(sums.sign);
  const F4 weight0 = splat(sums.weightX[0]);
  float* const centre = sums.odd + 2;
  for (std::size_t x = 0; x < cells; x += 4) {
    const F4 qr = load4(sums.qr + x);
    const F4 qi = load4(sums.qi + x);
    const F4 c = load4(sums.cy + x);
    const F4 s = sign * load4(sums.sy + x);
    const F4 i = weightY * (qr * s + qi * c);
    store4(sums.r + x, weightY * (qr * c - qi * s));
    store4(sums.i + x, i);
    store4(centre + x, load4(centre + x) + weight0 * i);
  }
  for (int a = 1; a <= kNodeReach; ++a) {
    const float* const cx = sums.cx[a];
    const float* const sx = sums.sx[a];
    // Column 2x + 1 + a: odd row entry x + a/2, or even row entry x + (a + 1)/2; likewise to the left.
    float* const right = a % 2 == 0 ? sums.odd + 2 + a / 2 : sums.even + 2 + (a + 1) / 2;
    float* const left = a % 2 == 0 ? sums.odd + 2 - a / 2 : sums.even + 2 - (a - 1) / 2;
    const F4 weight = splat(sums.weightX[a]);
    // One after the other: where both are added in one go, loads wait for stores to nearly the same place.
    for (std::size_t x = 0; x < cells; x += 4) {
      const F4 wave = load4(sums.i + x) * load4(cx + x) + load4(sums.r + x) * load4(sx + x);
      store4(right + x, load4(right + x) + weight * wave);
    }
    for (std::size_t x = 0; x < cells; x += 4) {
      const F4 wave = load4(sums.i + x) * load4(cx + x) - load4(sums.r + x) * load4(sx + x);
      store4(left + x, load4(left + x) + weight * wave);
    }
  }
}

}  // namespace sillon
