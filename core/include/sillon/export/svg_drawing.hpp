// Draws a toolpath as an SVG in mm, with the widths of its beads.
#pragma once

#include <string>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"

namespace sillon {

/// Draws one group per cycle: its beads as strokes coloured by direction, and above them the thin,
/// closed line that the nozzle follows. Points are exact to 1 µm. To keep the file small, a stroke
/// joins beads whose widths differ by at most 0.02 mm and whose directions differ by at most 5
/// degrees.
/// \param page  size [mm], 0.001..100000 per side.
/// \return a complete document, the same bytes for the same toolpath; InvalidArgument for a
/// malformed toolpath.
Result<std::string> toolpathSvg(const Toolpath& toolpath, Vec2 page);

}  // namespace sillon
