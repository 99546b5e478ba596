// Letters of a text, and errors of fonts.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

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

}  // namespace sillon
