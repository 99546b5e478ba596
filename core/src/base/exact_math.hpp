// Elementary functions of doubles with equal bytes on every platform: they only use IEEE +, -, *, / and sqrt, in one
// fixed order. Those of the C library differ in their last bits between systems and processors.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numbers>

namespace sillon::exact {

/// ln 2 and pi/2, each split into parts: products of a small whole number with the first parts are exact.
inline constexpr double kLn2[2] = {0x1.62e42feep-1, 0x1.a39ef35793c76p-33};
inline constexpr double kHalfPi[3] = {0x1.921fb544p+0, 0x1.0b4611a4p-34, 0x1.3198a2e037073p-69};

/// Coefficients 1/n! of Taylor's series.
inline constexpr std::array<double, 20> kOverFactorial = [] {
  std::array<double, 20> all{1};
  double product = 1;  // exact, because 19! has few odd factors
  for (std::size_t n = 1; n < all.size(); ++n) all[n] = 1 / (product *= static_cast<double>(n));
  return all;
}();

/// Returns 2^k for -1022 <= k <= 1023.
inline double powerOfTwo(int k) {
  const std::uint64_t bits = static_cast<std::uint64_t>(k + 1023) << 52;
  double power = 0;
  std::memcpy(&power, &bits, sizeof power);  // Emscripten 3.1.6 has no std::bit_cast
  return power;
}

/// Returns the nearest whole number, for |x| < 2^51.
inline double nearest(double x) { return (x + 0x1.8p+52) - 0x1.8p+52; }

inline double square(double x) { return x * x; }

/// Returns e^x; error below 2 units in the last place.
inline double exp(double x) {
  if (std::isnan(x)) return x;
  if (x > 709.7) return std::numeric_limits<double>::infinity();
  if (x < -708) return 0;
  const double k = nearest(x * (1 / std::numbers::ln2));
  const double r = (x - k * kLn2[0]) - k * kLn2[1];
  // Taylor's series for |r| <= 0.35.
  double sum = kOverFactorial[13];
  for (std::size_t n = 13; n-- > 0;) sum = sum * r + kOverFactorial[n];
  const int whole = static_cast<int>(k);
  return whole > 1023 ? sum * 2 * powerOfTwo(whole - 1) : sum * powerOfTwo(whole);
}

/// Returns ln x; error below 2 units in the last place, near x = 1 below 1e-16. \returns minus infinity for 0, NaN for
/// x < 0.
inline double log(double x) {
  if (!(x > 0)) return x == 0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
  if (std::isinf(x)) return x;
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < std::numbers::sqrt2 / 2) {
    m *= 2;
    --exponent;
  }
  // log m = 2 artanh s, with |s| <= 0.172.
  const double s = (m - 1) / (m + 1), s2 = s * s;
  double sum = 0;
  for (int n = 23; n > 1; n -= 2) sum = (sum + 1.0 / n) * s2;
  return exponent * kLn2[0] + (2 * (s + s * sum) + exponent * kLn2[1]);
}

struct SinCos {
  double sin;
  double cos;
};

/// Returns sin x and cos x; both errors are below 3e-16 for |x| <= 1e6.
inline SinCos sinCos(double x) {
  const double q = nearest(x * (2 / std::numbers::pi));
  const double r = ((x - q * kHalfPi[0]) - q * kHalfPi[1]) - q * kHalfPi[2], r2 = r * r;
  // Taylor's series for |r| <= 0.79.
  double s = kOverFactorial[19], c = kOverFactorial[18];
  for (std::size_t n = 18; n > 0; n -= 2) {
    s = kOverFactorial[n - 1] - s * r2;
    c = kOverFactorial[n - 2] - c * r2;
  }
  s *= r;
  switch (static_cast<long long>(q) & 3) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

inline double sin(double x) { return sinCos(x).sin; }
inline double cos(double x) { return sinCos(x).cos; }
inline double tan(double x) {
  const SinCos at = sinCos(x);
  return at.sin / at.cos;
}

/// Returns atan x; error below 4 units in the last place.
inline double atan(double x) {
  const double a = std::abs(x);
  double y = a > 1 ? 1 / a : a;
  for (int k = 0; k < 2; ++k) y /= 1 + std::sqrt(1 + y * y);  // halves the angle
  const double y2 = y * y;
  double sum = 0;
  for (int n = 23; n > 1; n -= 2) sum = (1.0 / n - sum) * y2;
  const double angle = 4 * (y - y * sum);
  return std::copysign(a > 1 ? std::numbers::pi / 2 - angle : angle, x);
}

/// Returns the angle of (x, y) in (-pi, pi]; 0 for the zero vector.
inline double atan2(double y, double x) {
  if (x == 0 && y == 0) return 0;
  const bool steep = std::abs(y) > std::abs(x);
  const double angle = steep ? std::copysign(std::numbers::pi / 2, y) - atan(x / y) : atan(y / x);
  return steep || x > 0 ? angle : y < 0 ? angle - std::numbers::pi : angle + std::numbers::pi;
}

/// Arcsine and arccosine, for |x| <= 1.
inline double asin(double x) { return atan2(x, std::sqrt((1 - x) * (1 + x))); }
inline double acos(double x) { return atan2(std::sqrt((1 - x) * (1 + x)), x); }

/// Returns sqrt(x² + y²); the squares must neither overflow nor underflow.
inline double hypot(double x, double y) { return std::sqrt(x * x + y * y); }

}  // namespace sillon::exact
