// Strokes as areas: https://www.w3.org/TR/SVG2/painting.html, chapters 13.4 and 13.5.
#pragma once

#include <cstdint>
#include <vector>

#include "input/svg/svg_path.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon::svg {

enum class StrokeCap { Butt, Round, Square };
enum class StrokeJoin { Miter, Round, Bevel };

/// Lengths in user units of the element.
struct Stroke {
  double width = 1;
  StrokeCap cap = StrokeCap::Butt;
  StrokeJoin join = StrokeJoin::Miter;
  double miterLimit = 4;       ///< >= 1
  std::vector<double> dashes;  ///< dash, gap, dash, ...; each >= 0, an even number; empty: solid
  double dashOffset = 0;       ///< where in the pattern a line begins
};

/// What a stroke covers, to be filled by nonzero winding: no part of a ring runs against the others, so that overlaps
/// never cancel.
/// \param toWorld  from the element's units to mm; of a singular one nothing is left.
/// \param tolerance  of round caps and joins [mm]. \param pointsLeft  of the whole drawing.
/// Throws Refused: too many points.
std::vector<Ring> strokeRings(const std::vector<Line>& lines, const Stroke& stroke, const Matrix& toWorld,
                              double tolerance, std::int64_t& pointsLeft);

}  // namespace sillon::svg
