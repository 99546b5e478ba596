// Ranges of everything G-code export is given.
#pragma once

#include <optional>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/gcode/patches.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/settings/print_params.hpp"
#include "sillon/settings/printer.hpp"

namespace sillon {

/// What can be judged number by number, before anything is placed: text, ranges, finite coordinates and widths.
/// \return the first fault: InvalidArgument, DoesNotFit (in height) or EmptyShape (no cycles).
/// \param across  read where needsAcross, and missing there if null.
std::optional<Error> checkGcodeInput(const Toolpath& toolpath, const Toolpath* across, const Shape& shape,
                                     const Printer& printer, const PrintParams& params);

/// The same for patches. \return InvalidArgument, DoesNotFit or EmptyShape (no lines).
std::optional<Error> checkPatchInput(const PatchPlate& plate, const Printer& printer, const PrintParams& params);

/// The part of it that needs no toolpath.
std::optional<Error> checkPlateInput(const Shape& shape, const Printer& printer, const PrintParams& params);

}  // namespace sillon
