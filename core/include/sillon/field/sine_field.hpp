// The scalar field whose zeros are the beads (Sec. 5.4, Eq. 13).
#pragma once

#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/field/phase_field.hpp"

namespace sillon {

/// Values of the field on the node lattice of its grid (nodeLattice), row-major: the Gaussian mean of the waves
/// (sigma is a third of `kernelRadius`), in [-1, 1]. Within tau/2 of the border the ramp 2 sd/tau + 1, outside 1,
/// so that all contours close inside the shape. \param nodeDistance  signed distance on the same lattice [mm], exact
/// where >= -tau/2.
Result<std::vector<float>> evaluateSineField(const SineField& field, const std::vector<float>& nodeDistance,
                                             const ToolpathParams& params, const RunContext& run);

}  // namespace sillon
