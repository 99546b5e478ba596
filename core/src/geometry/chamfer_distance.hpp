// Distances in a raster, for rules of thumb.
#pragma once

#include <vector>

namespace sillon {

/// Distance of each cell to the nearest wall, in cells; within 8 %. Walls are 0; 1e9 where there is no wall. The
/// chamfer distance of Borgefors (1986) with steps of 1 and sqrt(2). \param wall  columns x rows, row by row; not 0: a
/// wall
std::vector<float> chamferDistance(const std::vector<char>& wall, int columns, int rows);

}  // namespace sillon
