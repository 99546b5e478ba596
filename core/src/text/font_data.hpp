// Files of the built-in fonts, which core/embed_fonts.cmake makes part of the library.
#pragma once

#include <cstddef>

namespace sillon {

struct FontData {
  const unsigned char* bytes;
  std::size_t size;
};

/// Font files in the order of builtinFonts().
extern const FontData kFontData[];

}  // namespace sillon
