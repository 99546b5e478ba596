// Toolpath to an SVG drawing in mm, bead widths visible.
#pragma once

#include <string>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"

namespace sillon {

/// One group per cycle: its beads as strokes coloured by direction, and above them the thin, closed
/// line the nozzle follows. Points are exact to 1 µm; a stroke takes the beads whose widths differ
/// by at most 0.02 mm and whose directions differ by at most 5 degrees, so that the file stays
/// small.
/// \param page  [mm], 0.001..100000 per side.
/// \return a complete document, the same bytes for the same toolpath; InvalidArgument for a
/// toolpath that is none.
Result<std::string> toolpathSvg(const Toolpath& toolpath, Vec2 page);

}  // namespace sillon
