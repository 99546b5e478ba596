// Letters of a line, as whoever knows fonts hands them over.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

/// One line of letters in the order in which they are drawn, in font units, y up.
struct ShapedLine {
  struct Letter {
    std::size_t outline = 0;  ///< index in `outlines`
    Vec2 offset;              ///< from the pen
    double advance = 0;       ///< of the pen
  };
  double em = 1000;      ///< font units per em
  double capHeight = 0;  ///< of the font
  double xHeight = 0;    ///< of the font, as it says itself
  double ascent = 0;     ///< of the font above the base line
  double descent = 0;    ///< of the font below the base line, > 0
  bool instead = false;  ///< its font stands in for one that is not at hand
  std::vector<Letter> letters;
  std::vector<std::string> outlines;  ///< path data of SVG
  /// Each once; at most kMostLackedTold that are drawn in other fonts, and as many that are left
  /// out.
  std::vector<LackedLetter> lacked;
};

/// The font in which letters of a drawing are set.
struct DrawingFont {
  std::string name;
  bool instead = false;  ///< it stands in for one that is not at hand
};

/// Sets the letters of a drawing.
struct ShapeLetters {
  /// \param families  as in CSS's `font-family`: names between commas, the first one preferred.
  std::function<DrawingFont(std::string_view families)> choose;
  std::function<Result<ShapedLine>(const DrawingFont& font, const std::string& line)> shape;
};

}  // namespace sillon
