// The bytes of the fonts that come with the library.
#pragma once

#include <optional>
#include <string_view>

namespace sillon {

/// \return nothing for a name that is not one of builtinFonts().
std::optional<std::string_view> builtinFont(std::string_view name);

}  // namespace sillon
