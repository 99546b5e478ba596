// Cycles too short to turn once round without a kink.
#pragma once

#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/signed_distance.hpp"

namespace sillon {

/// Leaves out cycles that lie at the border all round, along spurs and cracks whose sides fall together: their beads
/// would be next to nothing. Leaves out the shortest ones, dots of less than a bead, close beside a longer one: they
/// would add two U-turns and cover next to nothing. Other short cycles become circles of about their length, or of
/// less where there is no room for that, at the deepest place nearby, as the nozzle can go round those. They stay as
/// they are beside another cycle, which they will be joined to, and where even the smallest circle would come too near
/// to the border. The limits, in spacings, are the constants in small_cycles.cpp. \param curves  closed curves that do
/// not meet, their points at most about a quarter of a spacing apart.
ClosedCurves regularizeSmallCycles(const ClosedCurves& curves, const BorderIndex& border, double spacing,
                                   const RunContext& run);

}  // namespace sillon
