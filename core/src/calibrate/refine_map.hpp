// The map from the plate into a photograph, through where a fit has found the spirals.
#pragma once

#include <vector>

#include "calibrate/find_coupon.hpp"
#include "calibrate/fit_spirals.hpp"

namespace sillon {

/// Turns shine in few directions only. There a closed spiral looks nearly alike one turn farther along the lamp's
/// tilt, and may have been found there: it is put where the others say.
/// \param fit  of `spirals`, as they were seen through the map.
void refineMap(FoundCoupon& found, const std::vector<LitSpiral>& spirals, const SpiralFit& fit);

}  // namespace sillon
