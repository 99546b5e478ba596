// Files packed by gzip, RFC 1952.
#pragma once

#include <string>
#include <string_view>

#include "sillon/base/result.hpp"

namespace sillon {

inline bool isGzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

/// What the file holds. \return InvalidFile for one that is damaged or made of several; TooLarge above 256 MiB.
Result<std::string> unzipped(std::string_view file);

/// The text behind the header of `file`, with its name and date.
/// \return as unzipped, of the header; TooLarge above 1 GiB.
Result<std::string> zippedLike(std::string_view file, std::string_view text);

/// The text behind a header without name and date. \return TooLarge above 1 GiB.
Result<std::string> zipped(std::string_view text);

}  // namespace sillon
