// Bead widths that fill the room between the beads (Sec. 5.6, Eq. 16).
#pragma once

#include <vector>

#include "sillon/params.hpp"
#include "sillon/result.hpp"
#include "sillon/run_context.hpp"
#include "sillon/sdf.hpp"
#include "sillon/types.hpp"

namespace sillon {

/// Width at every point: half the gaps on both sides together, so that the plastic laid down fills the plate (Eq. 16
/// takes twice the smaller one and leaves 2-3 % of the area empty), held to [minWidth, maxWidth] spacings and, so that
/// no bead spills, to twice the distance to the border.
/// \param curves  points about tau/4 apart.
Result<std::vector<float>> beadWidths(const ClosedCurves& curves, const BorderIndex& border, const ToolpathParams& params,
                                      const RunContext& run);

}  // namespace sillon
