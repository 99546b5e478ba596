// Sine and cosine of some floats at a time: see fast_math.hpp.
#pragma once

namespace sillon {

template <class Lanes>
struct SinCosOf {
  typename Lanes::F sin;
  typename Lanes::F cos;
};

/// sin and cos of |x| <= 8192, error below 3e-7 for |x| <= 10 and below 2e-6 + 1e-7 |x| beyond. Quadrants are removed
/// in three steps (Cody-Waite), then minimax polynomials on [-pi/4, pi/4].
/// \tparam Lanes  Four or Eight.
template <class Lanes>
inline SinCosOf<Lanes> sinCosOf(typename Lanes::F x) {
  using F = typename Lanes::F;
  using I = typename Lanes::I;
  const auto all = [](float v) { return Lanes::all(v); };
  const F half = Lanes::select(x < all(0), all(-0.5f), all(0.5f));
  const I quadrant = Lanes::toInt(x * all(0.636619772f) + half);
  const F q = Lanes::toFloat(quadrant);
  const F r = ((x - q * all(1.5703125f)) - q * all(4.837512969970703125e-4f)) - q * all(7.54978995489188216e-8f);
  const F r2 = r * r;
  const F s = r + r * r2 * (all(-1.6666654611e-1f) + r2 * (all(8.3321608736e-3f) + r2 * all(-1.9515295891e-4f)));
  const F c =
      all(1) - all(0.5f) * r2 +
      r2 * r2 * (all(4.166664568298827e-2f) + r2 * (all(-1.388731625493765e-3f) + r2 * all(2.443315711809948e-5f)));
  const I one = Lanes::all(1);
  const I two = Lanes::all(2);
  const I odd = (quadrant & one) == one;
  const I sinNegative = (quadrant & two) == two;
  const I cosNegative = ((quadrant + one) & two) == two;
  const F sine = Lanes::select(odd, c, s);
  const F cosine = Lanes::select(odd, s, c);
  return {Lanes::select(sinNegative, -sine, sine), Lanes::select(cosNegative, -cosine, cosine)};
}

}  // namespace sillon
