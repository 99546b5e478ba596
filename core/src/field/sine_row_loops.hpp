// The loops of sine_rows.hpp for any number of cells at a time. Each source that includes this has its own.
#pragma once

#include "base/sin_cos.hpp"
#include "field/sine_rows.hpp"

namespace sillon {
namespace {

template <class Lanes>
void fillPowersBy(const PowerRow& row, std::size_t cells) {
  using F = typename Lanes::F;
  for (std::size_t x = 0; x < cells; x += Lanes::count) {
    const SinCosOf<Lanes> first = sinCosOf<Lanes>(Lanes::load(row.angle + x));
    F c = first.cos;
    F s = first.sin;
    for (int k = 1;; ++k) {
      Lanes::store(row.cos[k] + x, c);
      Lanes::store(row.sin[k] + x, s);
      if (k == kNodeReach) break;
      const F next = c * first.cos - s * first.sin;
      s = c * first.sin + s * first.cos;
      c = next;
    }
  }
}

template <class Lanes>
void addToNodesBy(const NodeSums& sums, std::size_t cells) {
  using F = typename Lanes::F;
  const F weightY = Lanes::all(sums.weightY);
  const F sign = Lanes::all(sums.sign);
  const F weight0 = Lanes::all(sums.weightX[0]);
  float* const centre = sums.odd + 2;
  for (std::size_t x = 0; x < cells; x += Lanes::count) {
    const F qr = Lanes::load(sums.qr + x);
    const F qi = Lanes::load(sums.qi + x);
    const F c = Lanes::load(sums.cy + x);
    const F s = sign * Lanes::load(sums.sy + x);
    const F i = weightY * (qr * s + qi * c);
    Lanes::store(sums.r + x, weightY * (qr * c - qi * s));
    Lanes::store(sums.i + x, i);
    Lanes::store(centre + x, Lanes::load(centre + x) + weight0 * i);
  }
  for (int a = 1; a <= kNodeReach; ++a) {
    const float* const cx = sums.cx[a];
    const float* const sx = sums.sx[a];
    // Column 2x + 1 + a: odd row entry x + a/2, or even row entry x + (a + 1)/2; likewise to the left.
    float* const right = a % 2 == 0 ? sums.odd + 2 + a / 2 : sums.even + 2 + (a + 1) / 2;
    float* const left = a % 2 == 0 ? sums.odd + 2 - a / 2 : sums.even + 2 - (a - 1) / 2;
    const F weight = Lanes::all(sums.weightX[a]);
    // One after the other: where both are added in one go, loads wait for stores to nearly the same place.
    for (std::size_t x = 0; x < cells; x += Lanes::count) {
      const F wave = Lanes::load(sums.i + x) * Lanes::load(cx + x) + Lanes::load(sums.r + x) * Lanes::load(sx + x);
      Lanes::store(right + x, Lanes::load(right + x) + weight * wave);
    }
    for (std::size_t x = 0; x < cells; x += Lanes::count) {
      const F wave = Lanes::load(sums.i + x) * Lanes::load(cx + x) - Lanes::load(sums.r + x) * Lanes::load(sx + x);
      Lanes::store(left + x, Lanes::load(left + x) + weight * wave);
    }
  }
}

}  // namespace
}  // namespace sillon
