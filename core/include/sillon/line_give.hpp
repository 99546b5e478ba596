// Lines give way by a few degrees, and the spacing with them, where the waves ask for it.
#pragma once

#include <vector>

#include "sillon/constraints.hpp"
#include "sillon/line_field.hpp"
#include "sillon/params.hpp"
#include "sillon/phase_field.hpp"
#include "sillon/result.hpp"
#include "sillon/run_context.hpp"

namespace sillon {

/// Lines and frequencies as one round of alignment would have them.
struct GivenLines {
  LineField lines;
  std::vector<float> frequency;  ///< as spacingField
};

/// The gradient of the aligned phases over neighbouring cells says how the beads really run and how far apart they lie.
/// Each line is turned towards it from where it was asked to be, by at most `lineGive`, and the frequency follows it
/// within e^`spacingBend`; both are averaged twice over neighbours that run alike. Cells where the phase jumps by more
/// than 1.2 rad, and rings whose beads follow the border whatever the picture says, stay as they are.
/// \param asked  the lines as lineField made them. \param frequency  that the waves were aligned with.
Result<GivenLines> giveLines(const LineField& asked, const std::vector<float>& frequency, const SineField& waves,
                             const CellConstraints& cells, const ToolpathParams& params, const RunContext& run);

}  // namespace sillon
