// The part of G-code export that can fail: it checks everything, and lays out what will be written.
#pragma once

#include "gcode/job.hpp"
#include "sillon/base/result.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/settings/printer.hpp"

namespace sillon {

/// \param across  null where needsAcross does not ask for it. \return InvalidArgument, DoesNotFit or EmptyShape, as
/// writeGcode.
Result<GcodeJob> prepareGcodeJob(const Toolpath& toolpath, const Toolpath* across, const Shape& shape,
                                 const Printer& printer, const PrintParams& params);

/// \return InvalidArgument, DoesNotFit or EmptyShape, as writePatches.
Result<GcodeJob> preparePatchJob(const PatchPlate& plate, const Printer& printer, const PrintParams& params);

}  // namespace sillon
