// The finished toolpath: rounded to what is written, without points that say nothing.
#pragma once

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/settings/toolpath_params.hpp"
#include "sillon/toolpath/bead_width.hpp"

namespace sillon {

/// Rounds to 1 µm and leaves out points whose position and width follow from those kept within
/// `simplifyTolerance` (segments stay below 2 mm, so that widths and speeds can follow; no bead grows over the border
/// by it). Where that would make the path meet itself, the points stay.
Result<Toolpath> finishToolpath(const ClosedCurves& curves, const BeadWidths& widths, const ToolpathParams& params,
                                const RunContext& run);

}  // namespace sillon
