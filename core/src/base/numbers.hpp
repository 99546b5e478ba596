// Converts numbers to text, and rounds to whole numbers.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>

namespace sillon {

// Decimal numbers as text, made from scaled integers: the same bytes everywhere, no locale, no exponent, no "-0".

/// Prints scaled / 10^digits with exactly `digits` decimals, e.g. (-12345, 3) as "-12.345".
/// \param out  buffer of at least 24 characters.
/// \param digits  0..9.
/// \return one past the last character.
inline char* printScaled(char* out, std::int64_t scaled, int digits) {
  std::uint64_t magnitude = static_cast<std::uint64_t>(scaled);
  if (scaled < 0) {
    *out++ = '-';
    magnitude = 0 - magnitude;
  }
  std::uint64_t unit = 1;
  for (int k = 0; k < digits; ++k) unit *= 10;
  out = std::to_chars(out, out + 21, magnitude / unit).ptr;
  if (digits == 0) return out;
  *out++ = '.';
  std::uint64_t fraction = magnitude % unit;
  for (int k = digits - 1; k >= 0; --k, fraction /= 10) out[k] = static_cast<char>('0' + fraction % 10);
  return out + digits;
}

/// Rounds to `digits` decimals, e.g. fixed(0.4, 2) is "0.40". It accepts any double, including NaN and infinity,
/// because error messages print such values. \param digits  0..6.
inline std::string fixed(double value, int digits) {
  if (std::isnan(value)) return "not a number";
  // 1e12 with 6 decimals still fits in 64 bits.
  if (value > 1e12) return std::isinf(value) ? "infinite" : "above 1e12";
  if (value < -1e12) return std::isinf(value) ? "-infinite" : "below -1e12";
  double unit = 1;
  for (int k = 0; k < digits; ++k) unit *= 10;
  char text[32];
  return std::string(text, printScaled(text, std::llround(value * unit), digits));
}

/// Rounds like fixed(), but without trailing zeros: decimal(0.4, 3) is "0.4", decimal(60, 3) is "60".
inline std::string decimal(double value, int digits) {
  std::string text = fixed(value, digits);
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

/// Formats a value for a message like decimal(value, 6), except that tiny values are not shown as 0.
inline std::string shownNumber(double value) {
  std::string text = decimal(value, 6);
  if (value == 0 || text != "0") return text;
  return value > 0 ? "above 0, below 0.000001" : "below 0, above -0.000001";
}

// Rounding to whole numbers without a library call.

/// Rounds to the nearest whole number, exactly as llround(). \param value  |value| < 2^62.
inline std::int64_t toWhole(double value) {
#if defined(__wasm__)
  return std::llround(value);  // in WebAssembly a conversion takes more code than a call
#else
  const auto whole = static_cast<std::int64_t>(value);  // rounds towards zero; the rest is exact
  const double rest = value - static_cast<double>(whole);
  return whole + (rest >= 0.5 ? 1 : 0) - (rest <= -0.5 ? 1 : 0);
#endif
}

}  // namespace sillon
