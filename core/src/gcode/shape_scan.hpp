// The shape along horizontal lines, fine enough to measure its area and to tell what lies outside.
#pragma once

#include <cstdint>
#include <vector>

#include "sillon/base/types.hpp"
#include "sillon/geometry/outline.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

inline constexpr double kOutsideTolerance = 0.1;  ///< [mm]

struct ShapeScan {
  std::vector<std::vector<Interval>> rows;
  double firstY = 0;
  double step = 0;
  double area = 0;  ///< [mm²]
};

/// \param box  around the shape.
ShapeScan scanShape(const Shape& shape, const Bounds& box);

/// Whether a point lies in the shape or at most 0.1 mm outside.
bool holds(const ShapeScan& scan, Vec2 p);

/// Points that lie more than 0.1 mm outside the shape.
std::int64_t countOutside(const Toolpath& toolpath, const ShapeScan& scan);

}  // namespace sillon
