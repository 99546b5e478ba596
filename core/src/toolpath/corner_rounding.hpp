// Rounds the sharp turns that evening out leaves at the tips of U-turns.
#pragma once

#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/signed_distance.hpp"

namespace sillon {

/// Where a path turns by more than 56 degrees within tau/4, bends the fewest points around it as little as takes the
/// turn below that. Where bending seven points on either side does not, the tip is a U-turn's whose legs lie too near
/// to each other, and is pulled back by up to three spacings. Points stay where that would make the path meet itself or
/// another, or bring it nearer to the border than tau/4 (0.18 tau where that does not help) and than it was nearby.
/// \param curves  points about tau/4 apart; their number stays.
void roundKinks(ClosedCurves& curves, const BorderIndex& border, double spacing, const RunContext& run);

}  // namespace sillon
