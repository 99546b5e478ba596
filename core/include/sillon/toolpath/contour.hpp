// Zero contours of the field as disjoint closed curves: marching squares (Sec. 5.4).
#pragma once

#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/geometry/grid.hpp"

namespace sillon {

/// One vertex per lattice edge whose ends differ in sign, zero counting as positive: at the root of the phase (arc
/// sine) where both ends lie deeper inside than half a spacing, of the value elsewhere, and a little off both ends.
/// Larger values lie on the left of every curve, so that neighbouring curves run in opposite senses. Order and
/// orientation are fixed by the lowest edge.
/// \param values    nx x ny, positive on the frame.
/// \param distance  nx x ny signed distances [mm].
/// \return TooLarge from 2^30 vertices on, or Cancelled.
Result<ClosedCurves> contourCycles(const Grid& lattice, const std::vector<float>& values,
                                   const std::vector<float>& distance, double spacing, const RunContext& run);

}  // namespace sillon
