// Web fonts: TrueType and OpenType files, packed by zlib (WOFF) or by Brotli (WOFF2).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace sillon {

/// The file inside a packed one, of a collection its first font; a font that is not packed as it is.
/// \return nothing for a packed font that is damaged, or has more than kMostFontBytes.
std::optional<std::string> unpackedFont(std::string bytes);

}  // namespace sillon
