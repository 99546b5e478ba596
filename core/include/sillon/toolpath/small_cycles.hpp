// Cycles too short to turn once round without a kink.
#pragma once

#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/signed_distance.hpp"

namespace sillon {

/// Leaves out cycles that come no deeper than a twentieth of a spacing, along spurs and cracks whose sides fall
/// together: their beads would be next to nothing. Leaves out cycles shorter than a spacing beside a longer one, half a
/// spacing away at most: they would add two hairpins and cover next to nothing. Other cycles of less than 1.75 spacings
/// become circles of that length at the deepest place nearby, as the nozzle can go round those; they stay as they are
/// where a circle would meet another curve or come nearer to the border than 0.2 spacings. \param curves  closed curves
/// that do not meet, their points at most about a quarter of a spacing apart.
ClosedCurves regularizeSmallCycles(const ClosedCurves& curves, const BorderIndex& border, double spacing,
                                   const RunContext& run);

}  // namespace sillon
