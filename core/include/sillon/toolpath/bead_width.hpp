// Bead widths that fill the room between the beads (Sec. 5.6, Eq. 16).
#pragma once

#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/signed_distance.hpp"
#include "sillon/settings/toolpath_params.hpp"
#include "sillon/toolpath/bead_gaps.hpp"

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
Result<BeadWidths> beadWidths(const ClosedCurves& curves, const BeadGaps& gaps, const BorderIndex& border,
                              const ToolpathParams& params, const RunContext& run);

}  // namespace sillon
