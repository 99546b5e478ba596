// Numbers in files, lowest byte first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace sillon {

/// Appends a number's `bytes` lowest bytes; more than 8 bytes end in zeros.
inline void append(std::string& out, std::uint64_t value, int bytes) {
  for (int k = 0; k < bytes; ++k) {
    out += static_cast<char>(value & 0xFF);
    value >>= 8;
  }
}

/// The number of `count` bytes from `at`, which the caller knows to be there.
inline std::uint64_t number(std::string_view bytes, std::size_t at, int count) {
  std::uint64_t value = 0;
  for (int k = count - 1; k >= 0; --k) {
    value = value << 8 | static_cast<std::uint8_t>(bytes[at + static_cast<std::size_t>(k)]);
  }
  return value;
}

}  // namespace sillon
