// Letters of a line, handed over by an engine that knows fonts.
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
    Vec2 offset;              ///< place of the letter relative to the pen
    double advance = 0;       ///< distance by which the pen moves on
  };
  double em = 1000;      ///< font units per em
  double capHeight = 0;  ///< height of the font's capitals
  double xHeight = 0;    ///< height of the font's small letters, as the font itself says
  double ascent = 0;     ///< reach of the font above the base line
  double descent = 0;    ///< reach of the font below the base line, > 0
  bool instead = false;  ///< the font stands in for one that is not at hand
  std::vector<Letter> letters;
  std::vector<std::string> outlines;  ///< path data of SVG
  /// Letters that the font lacks, each once: at most kMostLackedTold that are drawn in other fonts,
  /// and as many that are left out
  std::vector<LackedLetter> lacked;
};

/// The font in which letters of a drawing are set.
struct DrawingFont {
  std::string name;
  bool instead = false;  ///< the font stands in for one that is not at hand
};

/// Functions that choose a font and set the letters of a drawing.
struct ShapeLetters {
  /// Chooses a font.
  /// \param families  names between commas as in CSS's `font-family`, the first one preferred.
  std::function<DrawingFont(std::string_view families)> choose;
  std::function<Result<ShapedLine>(const DrawingFont& font, const std::string& line)> shape;
};

}  // namespace sillon
