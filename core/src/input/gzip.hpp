// Files packed by gzip, and helpers for all packed files: numbers and limits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/refused.hpp"
#include "sillon/base/result.hpp"

namespace sillon {

// Numbers in files, lowest byte first.

/// Appends the `bytes` lowest bytes of a number, lowest first; beyond 8 bytes it appends zeros.
inline void append(std::string& out, std::uint64_t value, int bytes) {
  for (int k = 0; k < bytes; ++k) {
    out += static_cast<char>(value & 0xFF);
    value >>= 8;
  }
}

/// Reads the number of `count` bytes from `at`; the caller makes sure that they are there.
inline std::uint64_t number(std::string_view bytes, std::size_t at, int count) {
  std::uint64_t value = 0;
  for (int k = count - 1; k >= 0; --k) {
    value = value << 8 | static_cast<std::uint8_t>(bytes[at + k]);
  }
  return value;
}

// Files packed by gzip, RFC 1952.

inline bool isGzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

/// Unpacks a gzip file.
/// \param most  largest number of bytes that may come out.
/// \return InvalidFile for a file that is damaged or has several members; TooLarge for more bytes.
Result<std::string> gunzipped(std::string_view file, std::size_t most);

/// Packs the text behind the header of `file`, which keeps its name and date.
/// \return the errors of gunzipped() for the header; TooLarge above 1 GiB.
Result<std::string> gzippedLike(std::string_view file, std::string_view text);

/// Packs the text behind a header without name and date. \return TooLarge above 1 GiB.
Result<std::string> gzipped(std::string_view text);

// Limits on packed files of any kind.

/// Largest factor by which deflate can shrink data.
inline constexpr std::size_t kBestDeflate = 1032;

/// Refuses to pack G-code that is too long.
/// \param size  size of the G-code [bytes]
/// \return TooLarge, or nothing
inline std::optional<Error> tooLargeToPack(std::size_t size) {
  constexpr std::size_t kMost = std::size_t{1} << 30;
  if (size <= kMost) return std::nullopt;
  return fileTooLarge(size, kMost);
}

}  // namespace sillon
