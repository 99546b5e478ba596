// The borders of a picture of zones.
#pragma once

#include <cstdint>
#include <vector>

#include "sillon/geometry/grid.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

/// Rings of each zone, inside on their left. Neighbours share their border, point for point, so that they neither
/// overlap nor leave a gap; steps of cells become straight lines within 0.75 cells.
/// \param zone  of each cell, 0 to count - 1, row 0 below; zones that meet in a corner only are parted there.
std::vector<std::vector<Ring>> zoneOutlines(std::vector<std::int32_t> zone, int count, const Grid& grid);

}  // namespace sillon
