// Lines that fill a shape, for the layers below the toolpath.
#pragma once

#include <vector>

#include "sillon/geometry/shape.hpp"

namespace sillon {

using Polyline = std::vector<Vec2>;  ///< open unless said otherwise [mm]

/// Zigzags that fill the shape with lines at 45 or 135 degrees, `lineWidth` apart and half of it off the border.
/// Neighbouring lines are joined along the border where the border allows it. Zigzags shorter than `lineWidth` are
/// left out. \param lineWidth  [mm], > 0. \param falling  135 instead of 45 degrees. \param inset  further off the
/// border [mm].
std::vector<Polyline> hatchLines(const Shape& shape, double lineWidth, bool falling, double inset = 0);

}  // namespace sillon
