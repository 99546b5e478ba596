// Writing as single strokes.
#pragma once

#include <string_view>
#include <vector>

#include "sillon/base/types.hpp"

namespace sillon {

inline constexpr double kLetterHeight = 6;     ///< [units]
inline constexpr double kLetterWidth = 4;      ///< [units]
inline constexpr double kLetterAdvance = 5.5;  ///< [units], from one letter to the next

/// Length of a line of writing [units].
double textWidth(std::string_view text);

/// Strokes of a line of writing, each of at least two points. Letters are shown as capitals, what has no strokes as
/// "-". \param corner  lower left [mm]. \param unit  a sixth of a capital's height [mm].
std::vector<std::vector<Vec2>> textStrokes(std::string_view text, Vec2 corner, double unit);

}  // namespace sillon
