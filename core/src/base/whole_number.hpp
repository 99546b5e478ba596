// The nearest whole number without a call.
#pragma once

#include <cmath>
#include <cstdint>

namespace sillon {

/// As llround, to the last bit. \param value  |value| < 2^62.
inline std::int64_t toWhole(double value) {
#if defined(__wasm__)
  return std::llround(value);  // a conversion takes more code than a call there
#else
  const auto whole = static_cast<std::int64_t>(value);  // towards zero: what is left is exact
  const double rest = value - static_cast<double>(whole);
  return whole + (rest >= 0.5 ? 1 : 0) - (rest <= -0.5 ? 1 : 0);
#endif
}

}  // namespace sillon
