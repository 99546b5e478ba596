#include <algorithm>

#include "sillon/text/text.hpp"
#include "text/font_data.hpp"
#include "text/fonts.hpp"

namespace sillon {

std::optional<std::string_view> builtinFont(std::string_view name) {
  const auto names = builtinFonts();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  const FontData& data = kFontData[found - names.begin()];
  return std::string_view(reinterpret_cast<const char*>(data.bytes), data.size);
}

}  // namespace sillon
