// How far the spacing must bend so that the lines can be the gradient of one wave.
#pragma once

#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/field/constraints.hpp"
#include "sillon/field/line_field.hpp"
#include "sillon/settings/toolpath_params.hpp"

namespace sillon {

/// Frequency of the wave per cell, in units of pi/tau: beads lie tau / frequency apart. Where lines fan out, a constant
/// spacing asks for new beads, which begin at U-turns; beads that widen a little need none. With u = log frequency and
/// t the bead's direction, e^u d is a gradient where the derivative of u along t is the lines' divergence, -curl d; u
/// solves that by least squares, held to 0 over a length of 8 spacings and to |u| <= spacingVariation. A ring whose
/// beads follow the border whatever the picture says (mode Count) has no part in it. \return one value per cell, 1
/// where masked and everywhere if spacingVariation is 0; Cancelled.
Result<std::vector<float>> spacingField(const LineField& lines, const CellConstraints& cells,
                                        const ToolpathParams& params, const RunContext& run);

}  // namespace sillon
