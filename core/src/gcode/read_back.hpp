// The visible side of a plate, read back from its finished G-code.
#pragma once

#include <string_view>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// Follows a file of writeGcode as a printer would and returns the visible oriented layer of the first copy: the lowest
/// one for ShowSide::Bed, else the highest. Its beads lie on the page again, unturned and unmirrored, and each move has
/// the width that its filament fills, so that they can be judged like the toolpath that was written.
/// \param shape, printer, params  as given to writeGcode. \param spacing  spacing tau of the toolpath [mm].
/// \return InvalidFile if there is no oriented layer in it.
Result<Toolpath> readBack(std::string_view gcode, const Shape& shape, const Printer& printer, const PrintParams& params,
                          double spacing);

}  // namespace sillon
