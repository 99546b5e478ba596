// The checksum of zips, PNGs and binary G-code.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace sillon {

/// CRC-32 of ISO 3309, as zlib has it.
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
