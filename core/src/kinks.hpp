// Rounds the sharp turns that evening out leaves at the tips of hairpins.
#pragma once

#include "sillon/run_context.hpp"
#include "sillon/sdf.hpp"
#include "sillon/types.hpp"

namespace sillon {

/// Where a path turns by more than 58 degrees within tau/4, bends the fewest points around it as little as takes the
/// turn below that. Points stay where that would make the path meet itself or another, or bring it nearer to the border
/// than tau/4 and than it was.
/// \param curves  points about tau/4 apart; their number stays.
void roundKinks(ClosedCurves& curves, const BorderIndex& border, double spacing, const RunContext& run);

}  // namespace sillon
