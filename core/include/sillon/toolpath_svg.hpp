// Toolpath to an SVG drawing in mm, bead widths visible.
#pragma once

#include <string>

#include "sillon/shape.hpp"
#include "sillon/types.hpp"

namespace sillon {

/// One group per cycle, beads coloured by direction. Widths are exact at the points and vary linearly between them.
/// \return a complete document; the same toolpath gives the same bytes.
std::string toolpathSvg(const Toolpath& toolpath, Vec2 page);

}  // namespace sillon
