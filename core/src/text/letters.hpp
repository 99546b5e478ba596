// Letters of a text, and what may be wrong with a font.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/text/text.hpp"

namespace sillon {

/// The most path data of all letters of a text, which may repeat few outlines [bytes].
inline constexpr std::size_t kMostDrawnBytes = std::size_t{16} << 20;

/// \param font  neither built in nor a file that was handed over.
Error unknownFont(const std::string& font);
/// The name under which engines in browsers ask for a shaped line.
std::string nameOfLine(const std::string& font, int weight, const std::string& line);
Error noFont(const std::string& font);
/// \param most  bytes of path data.
Error tooDetailed(const std::string& font, std::size_t most = kMostPathBytes);
/// \param lacked  that no font has.
Error missingLetter(const std::string& font, const LackedLetter& lacked);
/// Adds a letter to those that are told, of which ShapedLine says how many there may be.
void addLacked(std::vector<LackedLetter>& all, const LackedLetter& one);

}  // namespace sillon
