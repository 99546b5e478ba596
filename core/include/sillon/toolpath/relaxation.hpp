// Evens out the spacing of the stitched path; replaces the repulsion of Sec. 5.6 (Eq. 15).
#pragma once

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/field/line_field.hpp"
#include "sillon/geometry/signed_distance.hpp"
#include "sillon/settings/toolpath_params.hpp"
#include "sillon/toolpath/bead_gaps.hpp"

namespace sillon {

struct Relaxed {
  ClosedCurves curves;  ///< points tau/4 apart
  BeadGaps gaps;        ///< of the curves as they are now, at most 1.5 tau
};

/// Each round moves every point by `relaxationStrength` times the difference of its gaps towards the wider side (more
/// beside the border and where the difference is above a quarter of tau; at most 0.15 tau), smooths the moves along the
/// path, pulls each point towards the middle of its neighbours and resamples at tau/4. Where a round would make the
/// path meet itself, its moves are halved there, to nothing in the end: a simple path stays simple (checked exactly on
/// 1 µm). The last round ends with `roundKinks`. The published repulsion pushes apart only what is nearer than tau/2.
/// \param asked  where not null, every round but the last turns the beads towards these lines, the last time less, and
/// gaps are evened out by at least a quarter of their difference: tones of a picture come nearer to what was asked for.
/// Of two rounds and more there are two more then, and points are pulled to their neighbours' middle by 0.3 at most.
Result<Relaxed> relaxSpacing(ClosedCurves curves, const BorderIndex& border, const ToolpathParams& params,
                             const RunContext& run, const LineField* asked = nullptr);

}  // namespace sillon
