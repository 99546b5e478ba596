// Lines give way by a few degrees, and the spacing with them, where the waves ask for it.
#pragma once

#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/field/constraints.hpp"
#include "sillon/field/line_field.hpp"
#include "sillon/field/phase_field.hpp"
#include "sillon/settings/toolpath_params.hpp"

namespace sillon {

/// Lines and frequencies as one round of alignment would have them.
struct RelaxedDirections {
  LineField lines;
  std::vector<float> frequency;  ///< as spacingField
};

/// The gradient of the aligned phases over neighbouring cells says how the beads really run and how far apart they lie.
/// Each line is turned towards it from where it was asked to be, by at most `directionTolerance`, and the frequency
/// follows it within e^`spacingVariation`; both are averaged twice over neighbours that run alike. Cells where the
/// phase jumps by more than 1.2 rad, and rings whose beads follow the border whatever the picture says, stay as they
/// are. \param asked  the lines as lineField made them. \param frequency  that the waves were aligned with.
Result<RelaxedDirections> relaxDirections(const LineField& asked, const std::vector<float>& frequency,
                                          const SineField& waves, const CellConstraints& cells,
                                          const ToolpathParams& params, const RunContext& run);

}  // namespace sillon
