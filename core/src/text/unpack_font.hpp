// Unpacks web fonts: TrueType and OpenType files packed by zlib (WOFF) or by Brotli (WOFF2).
#pragma once

#include <optional>
#include <string>

namespace sillon {

/// Unpacks a font; of a collection its first font. A font that is not packed is returned as it is.
/// \return nothing for a packed font that is damaged, or has more than kMostFontBytes.
std::optional<std::string> unpackedFont(std::string bytes);

}  // namespace sillon
