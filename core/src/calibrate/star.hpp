// The star of directions, which has all of them.
#pragma once

#include "calibrate/plate.hpp"
#include "sillon/base/types.hpp"

namespace sillon {

/// Of length 1, towards 15 k degrees.
Vec2 spoke(int k);

/// Sector k of 24 lies where the dial says 15 k degrees, and its beads run that way.
/// \param tell  whether the degrees are the values of the plate.
void layStar(PlateBuilder& plate, Vec2 centre, double inner, double outer, bool tell);

}  // namespace sillon
