// The plain layers below the toolpath.
#pragma once

#include <optional>

#include "gcode/job.hpp"
#include "sillon/base/result.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

/// \param body  the shape, united. \return InvalidArgument if no line fits into the shape, EmptyShape, TooLarge.
std::optional<Error> addBaseLayers(GcodeJob& job, const Shape& body, PointUm offset, const Printer& printer,
                                   const PrintParams& params);

}  // namespace sillon
