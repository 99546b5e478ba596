// The side of a plate that is seen, as its finished G-code lays it.
#pragma once

#include <string_view>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// Follows a file of writeGcode as a printer would and takes the oriented layer of the first copy that is seen: the
/// lowest for ShowSide::Bed, else the highest. Its beads come back on the page, unturned and unmirrored, each move with
/// the width that its filament fills, so that they can be judged like the toolpath that was written.
/// \param shape, printer, params  as they were written with. \param spacing  tau [mm], of the toolpath.
/// \return InvalidFile if there is no oriented layer in it.
Result<Toolpath> readBack(std::string_view gcode, const Shape& shape, const Printer& printer, const PrintParams& params,
                          double spacing);

}  // namespace sillon
