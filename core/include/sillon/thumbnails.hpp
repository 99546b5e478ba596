// The look of a plate for the printer's screen.
#pragma once

#include <vector>

#include "sillon/gcode.hpp"
#include "sillon/result.hpp"
#include "sillon/run_context.hpp"
#include "sillon/types.hpp"

namespace sillon {

/// Pictures for PrintParams::thumbnails, in the sizes that most hosts show: 32 x 32 and 300 x 300 pixels.
/// \param page  [mm]. \return as renderLook.
Result<std::vector<Thumbnail>> lookThumbnails(const Toolpath& toolpath, Vec2 page, const RunContext& run);

}  // namespace sillon
