// Bytes of the fonts that come with the library.
#pragma once

#include <optional>
#include <string_view>

namespace sillon {

/// Returns the file of a built-in font. \return nothing if the name is not one of builtinFonts().
std::optional<std::string_view> builtinFont(std::string_view name);

}  // namespace sillon
