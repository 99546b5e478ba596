// Base64 and CRC-32.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace sillon {

// Encoding of bytes as text.

/// Encodes bytes in base64 (RFC 4648) with padding.
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

// The checksum of zips, PNGs and binary G-code.

/// CRC-32 of ISO 3309, the same as in zlib.
class Crc32 {
 public:
  void add(std::string_view bytes) {
    static constexpr auto kTable = [] {
      std::array<std::uint32_t, 256> table{};
      for (std::uint32_t k = 0; k < 256; ++k) {
        std::uint32_t rest = k;
        for (int bit = 0; bit < 8; ++bit) rest = (rest >> 1) ^ ((rest & 1) != 0 ? 0xEDB88320U : 0);
        table[k] = rest;
      }
      return table;
    }();
    std::uint32_t crc = rest_;
    for (const char c : bytes) crc = (crc >> 8) ^ kTable[(crc ^ static_cast<std::uint8_t>(c)) & 0xFFU];
    rest_ = crc;
  }
  [[nodiscard]] std::uint32_t value() const { return ~rest_; }

 private:
  std::uint32_t rest_ = 0xFFFFFFFFU;
};

inline std::uint32_t crc32(std::string_view bytes) {
  Crc32 crc;
  crc.add(bytes);
  return crc.value();
}

}  // namespace sillon
