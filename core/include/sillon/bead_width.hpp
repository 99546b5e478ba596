// Bead widths that fill the room between the beads (Sec. 5.6, Eq. 16).
#pragma once

#include <vector>

#include "sillon/neighbour_gaps.hpp"
#include "sillon/params.hpp"
#include "sillon/result.hpp"
#include "sillon/run_context.hpp"
#include "sillon/sdf.hpp"
#include "sillon/types.hpp"

namespace sillon {

struct BeadWidths {
  std::vector<float> width;  ///< [mm]
  std::vector<float> limit;  ///< twice the distance to the border: wider beads spill [mm]; large where it is far
};

/// Width at every point: between the smaller of the two gaps at its sides (Eq. 16: 1-2 % of the area stays empty) and
/// their mean (the room that there is), by `widthBalance`; held to [minWidth, maxWidth] spacings and, so that no bead
/// spills, to twice the distance to the border. Where two beads would then overlap by more than `beadOverlap` spacings,
/// both give way in proportion.
/// \param gaps  of these curves.
Result<BeadWidths> beadWidths(const ClosedCurves& curves, const NeighbourGaps& gaps, const BorderIndex& border,
                              const ToolpathParams& params, const RunContext& run);

}  // namespace sillon
