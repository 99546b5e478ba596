// Closed loops at fixed distances from the border: brims and concentric layers.
#pragma once

#include <vector>

#include "gcode/hatch.hpp"
#include "sillon/base/result.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

/// Loops at the distances `first`, `first + step`, ... [mm, below 0 inside], `count` of them or until none is left.
/// Corners are rounded outside and kept inside; within 0.01 mm. Outer loops run clockwise, loops around holes the other
/// way. \param step  not 0. \param count  0..1000. \param second  not null: where the loops `shift` further along
/// `step` go, which take half as long beside the others as by themselves. \param shift  [mm], >= 0. \return EmptyShape,
/// TooLarge.
Result<std::vector<Polyline>> offsetLoops(const Shape& shape, double first, double step, int count,
                                          std::vector<Polyline>* second = nullptr, double shift = 0);

}  // namespace sillon
