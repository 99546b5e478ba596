// How wide the beads are.
#pragma once

#include "sillon/base/types.hpp"
#include "sillon/quality/metrics.hpp"

namespace sillon {

/// \param totalLength  of all beads [mm]
WidthMeasures widthMeasures(const Toolpath& toolpath, const ToolpathParams& params, double totalLength);

}  // namespace sillon
