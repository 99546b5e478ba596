// Letters as shapes: from a font file and a text to outlines in millimetres, the same on every
// machine.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/input/read_input.hpp"
#include "sillon/settings/layers.hpp"

namespace sillon {

/// The fonts that come with Sillon, all under open licences.
inline constexpr std::array<const char*, 5> kBuiltinFonts{"Nunito", "Bebas Neue", "Roboto Slab",
                                                          "Fredoka", "Caveat"};

/// One line of letters in the order in which they are drawn, in font units, y up.
struct ShapedLine {
  struct Letter {
    std::size_t outline = 0;  ///< index in `outlines`
    Vec2 offset;              ///< from the pen
    double advance = 0;       ///< of the pen
  };
  double capHeight = 0;  ///< of the font
  std::vector<Letter> letters;
  std::vector<std::string> outlines;  ///< path data of SVG
};

/// Shapes one line: kerning, ligatures and joined scripts as the font has them.
/// \param font  one of kBuiltinFonts, or a file that `read` hands over.
/// \return InvalidFile for what is no font; InvalidArgument for letters that the font lacks.
Result<ShapedLine> shapeLine(const ReadInput& read, const std::string& font,
                             const std::string& line);

/// Letters to draw.
struct Lettering {
  std::string text;  ///< lines between line feeds, UTF-8
  std::string font;
  double capHeight = 10;  ///< [mm]
  double circle = 0;      ///< as Layer::circle
  TextAlign align = TextAlign::Middle;
};

/// The outlines of a text. Straight lines lie on a page as large as their ink; on a circle, the
/// circle's middle is the page's. \return the errors of shapeLine; EmptyShape for spaces alone;
/// InvalidArgument for a line that is longer than its circle, or that mixes scripts of both senses.
Result<Shape> textShape(const Lettering& lettering, const ReadInput& read);

}  // namespace sillon
