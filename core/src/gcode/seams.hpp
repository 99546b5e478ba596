// Where cycles begin: at places where a seam does not show.
#pragma once

#include <vector>

#include "gcode/motion.hpp"
#include "gcode/shape_scan.hpp"

namespace sillon {

/// Marks where each cycle may begin unseen: within a bead of the border, seen along x or y; near a concave corner if it
/// passes one. \param offset  from the shape to the cycles. \param spacing  of the toolpath [mm].
void markSeams(std::vector<BeadPath>& cycles, PointUm offset, const Shape& shape, const ShapeScan& scan,
               double spacing);

}  // namespace sillon
