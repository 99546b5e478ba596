// Bytes as text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace sillon {

/// RFC 4648 with padding.
inline std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const auto at = [&](std::size_t i) { return i < bytes.size() ? std::uint32_t{bytes[i]} : 0u; };
    const std::uint32_t group = at(k) << 16 | at(k + 1) << 8 | at(k + 2);
    for (int digit = 0; digit < 4; ++digit) text += kDigits[(group >> (18 - 6 * digit)) & 63];
  }
  for (std::size_t k = 0; k < (3 - bytes.size() % 3) % 3; ++k) text[text.size() - 1 - k] = '=';
  return text;
}

}  // namespace sillon
