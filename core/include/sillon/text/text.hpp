// Letters as shapes: from a font file and a text to outlines in millimetres, the same on every
// machine.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/input/read_input.hpp"
#include "sillon/input/shaped_line.hpp"
#include "sillon/settings/layers.hpp"

namespace sillon {

/// Names of the fonts that come with Sillon, all under open licences, in the order in which they
/// are offered. Built from core/data/fonts.
std::span<const std::string_view> builtinFonts();

/// Share of the em that capitals take in fonts without H.
inline constexpr double kUsualCapHeight = 0.7;
/// The most path data of one line's outlines [bytes]: a hostile font could make any letter a
/// million curves.
inline constexpr std::size_t kMostPathBytes = std::size_t{4} << 20;
/// The most letters of a kind that ShapedLine::lacked tells.
inline constexpr int kMostLackedTold = 8;

/// Shapes one line: kerning, ligatures and joined scripts as the font has them, and scripts of both
/// senses in one line by the Unicode bidirectional algorithm. Tabs are spaces. What the font lacks
/// comes, letter by letter, from the first built-in font that has it, at the same height of
/// capitals; what none has is left out. \param font  one of builtinFonts(), or a file that `read`
/// hands over. \param weight  as Layer::weight. \return InvalidFile for what is no font;
/// InvalidArgument for a name that is neither.
Result<ShapedLine> shapeLine(const ReadInput& read, const std::string& font,
                             const std::string& line, int weight = 0);

/// The built-in font that families name first, or else one that looks alike.
/// \param families  as in CSS's `font-family`.
DrawingFont fontOfDrawing(std::string_view families);

/// Shapes one line of a drawing.
Result<ShapedLine> shapeLineOfDrawing(const ReadInput& read, const DrawingFont& font,
                                      const std::string& line);

/// Names under which engines in browsers ask `read` for the lines of a drawing's text: shapeLine
/// has them from JavaScript. Empty for what is no drawing, or has more letters than readSvg takes.
std::vector<std::string> linesOfDrawing(std::string_view svg);

/// Letters to draw.
struct Lettering {
  std::string text;  ///< lines between line feeds, UTF-8
  std::string font;
  double capHeight = 10;  ///< [mm]
  double circle = 0;      ///< as Layer::circle
  TextAlign align = TextAlign::Middle;
  int weight = 0;  ///< as Layer::weight
};

/// The outlines of a text. Straight lines lie on a page as large as their ink; on a circle, the
/// circle's middle is the page's. Its `drawing` tells letters of other fonts. \return the errors of
/// shapeLine; MissingLetter or PictureLetter, as a reason, for letters that no font has; EmptyShape
/// for spaces alone; InvalidArgument for a line that is longer than its circle.
Result<Shape> textShape(const Lettering& lettering, const ReadInput& read);

}  // namespace sillon
