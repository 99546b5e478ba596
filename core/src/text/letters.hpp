// Letters of a text, and errors of fonts.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "input/shaped_line.hpp"
#include "sillon/base/result.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/text/text.hpp"

namespace sillon {

/// Limit on the path data of all letters of a text, which may repeat a few outlines [bytes].
inline constexpr std::size_t kMostDrawnBytes = std::size_t{16} << 20;

/// Makes the error for a font that is neither built in nor among the given files.
Error unknownFont(const std::string& font);
/// Returns the name under which engines in browsers ask for a shaped line.
std::string nameOfLine(const std::string& font, int weight, const std::string& line);
Error noFont(const std::string& font);
/// \param most  limit on path data [bytes]
Error tooDetailed(const std::string& font, std::size_t most = kMostPathBytes);
/// Makes the error for a letter that no font has.
Error missingLetter(const std::string& font, const LackedLetter& lacked);
/// Adds a letter to those that are reported; ShapedLine limits their number.
void addLacked(std::vector<LackedLetter>& all, const LackedLetter& one);

/// Shapes one line: kerning, ligatures and joined scripts as the font has them, and scripts of both
/// senses in one line by the Unicode bidirectional algorithm. Tabs are spaces. Letters that the
/// font lacks come, one by one, from the first built-in font that has them, at the same height of
/// capitals; letters that none has are left out.
/// \param font  one of builtinFonts(), or a file that `read` hands over.
/// \param weight  weight of a variable font, 1..1000; 0: the font's own.
/// \return InvalidFile for a file that is no font; InvalidArgument for a name that is neither.
Result<ShapedLine> shapeLine(const ReadInput& read, const std::string& font, const std::string& line, int weight = 0);

/// Returns the built-in font that families name first, or else one that looks alike.
/// \param families  names between commas, as in CSS's `font-family`.
DrawingFont fontOfDrawing(std::string_view families);

/// Shapes one line of a drawing.
Result<ShapedLine> shapeLineOfDrawing(const ReadInput& read, const DrawingFont& font, const std::string& line);

}  // namespace sillon
