// Letters as shapes: outlines in millimetres from a font file and a text, the same on every
// machine.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/input/plate_input.hpp"
#include "sillon/settings/layers.hpp"

namespace sillon {

/// Returns the names of the fonts that come with Sillon, in the order in which they are offered.
/// All are under open licences; they are built from core/data/fonts.
std::span<const std::string_view> builtinFonts();

/// Share of the em that capitals take in fonts without H.
inline constexpr double kUsualCapHeight = 0.7;
/// The most path data of one line's outlines [bytes]. It is limited because a hostile font could
/// make any letter a million curves.
inline constexpr std::size_t kMostPathBytes = std::size_t{4} << 20;
/// The most letters of a kind that ShapedLine::lacked tells.
inline constexpr int kMostLackedTold = 8;

/// Lists the names under which engines in browsers ask `read` for the lines of a drawing's text,
/// which shapeLine has from JavaScript. The list is empty for a file that is no drawing, or has
/// more letters than readSvg takes.
std::vector<std::string> linesOfDrawing(std::string_view svg);

/// Letters to draw.
struct Lettering {
  std::string text;  ///< lines between line feeds, UTF-8
  std::string font;
  double capHeight = 10;  ///< height of capitals [mm]
  double circle = 0;      ///< radius of the line they stand on, see LayerLetters::circle
  TextAlign align = TextAlign::Middle;
  int weight = 0;  ///< weight of a variable font, see LayerLetters::weight
};

/// Makes the outlines of a text. Straight lines lie on a page as large as their ink; on a circle,
/// the circle's middle is the page's. The `drawing` of the shape tells letters of other fonts.
/// \return the errors of shapeLine; MissingLetter or PictureLetter, as a reason, for letters that
/// no font has; EmptyShape for spaces alone; InvalidArgument for a line that is longer than its
/// circle.
Result<Shape> textShape(const Lettering& lettering, const ReadInput& read);

}  // namespace sillon
