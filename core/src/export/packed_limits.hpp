// What packed files may hold, of whatever kind they are.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "sillon/base/result.hpp"

namespace sillon {

/// Nothing that is deflated becomes smaller than this share.
inline constexpr std::size_t kBestDeflate = 1032;

/// \param size  of the G-code [bytes] \param kind  ".gz", ".bgcode", ... \return TooLarge, or nothing
inline std::optional<Error> tooLargeToPack(std::size_t size, const char* kind) {
  constexpr std::size_t kMostMiB = 1024;
  if (size <= kMostMiB << 20) return std::nullopt;
  std::string message = "the G-code is ";
  message.append(std::to_string(size >> 20)).append(" MiB; in a ").append(kind);
  message.append(" it must be at most ").append(std::to_string(kMostMiB));
  return Error{ErrorCode::TooLarge, std::move(message)};
}

/// \param kind  as above. \param what  "is cut off", ...
inline Error damagedFile(const char* kind, const char* what) {
  std::string message = "the ";
  message.append(kind).append(" ").append(what);
  return {ErrorCode::InvalidFile, std::move(message)};
}

}  // namespace sillon
