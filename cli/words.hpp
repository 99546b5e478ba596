// Parses words of the command line to numbers and pairs, or refuses them; formats counts.
#pragma once

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>

#include "sillon/base/types.hpp"

namespace sillon::cli {

/// Throws an error that CLI11 reports as a parse error: OPTION is "TEXT"; it must be WANTED.
[[noreturn]] void refuse(const std::string& option, const std::string& text, const std::string& wanted);

/// Throws a parse error with a sentence of its own.
[[noreturn]] void refuse(const std::string& sentence);

/// Formats a count: "1 line", "2 lines".
template <class Integer>
requires std::is_integral_v<Integer> std::string plural(Integer count, const std::string& word) {
  return std::to_string(count) + " " + word + (count == 1 ? "" : "s");
}

/// Parses a finite decimal number and nothing else: no nan, no inf, no hex, no trailing words.
std::optional<double> parseNumber(const std::string& text);

/// Parses two numbers with a separator between them: "120x80", "10,20".
std::optional<Vec2> parsePair(const std::string& text, char separator);

/// Parses a number; throws by refuse().
void parseInto(const std::string& option, const std::string& text, double& out);
void parseInto(const std::string& option, const std::string& text, std::optional<double>& out);

template <class Integer>
requires std::is_integral_v<Integer>
/// Parses a whole number; throws by refuse().
void parseInto(const std::string& option, const std::string& text, Integer& out) {
  constexpr auto kHigh = std::numeric_limits<Integer>::max();
  const bool negative = !text.empty() && text[0] == '-';
  const std::string digits = text.substr(negative ? 1 : 0);
  errno = 0;
  const std::uint64_t magnitude = std::strtoull(digits.c_str(), nullptr, 10);
  const bool whole = !digits.empty() && digits.find_first_not_of("0123456789") == std::string::npos && errno == 0;
  const bool fits = negative ? std::is_signed_v<Integer> && magnitude <= static_cast<std::uint64_t>(kHigh)
                             : magnitude <= static_cast<std::uint64_t>(kHigh);
  if (!whole || !fits) {
    // The range of an option is checked with the whole project; only a seed may be any value that fits.
    const bool seed = std::is_unsigned_v<Integer>;
    refuse(option, text, seed ? "a whole number from 0 to " + std::to_string(kHigh) : std::string("a whole number"));
  }
  out = static_cast<Integer>(negative ? Integer{0} - static_cast<Integer>(magnitude) : static_cast<Integer>(magnitude));
}

}  // namespace sillon::cli
