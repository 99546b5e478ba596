// Layers that fill an area: base, skirt, brim, rim.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "gcode/job.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/outline.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

// The shape along horizontal lines, fine enough to measure its area and to tell what lies outside.

inline constexpr double kOutsideTolerance = 0.1;  ///< [mm]

struct ShapeScan {
  std::vector<std::vector<Interval>> rows;
  double firstY = 0;
  double step = 0;
  double area = 0;  ///< [mm²]
};

/// \param box  around the shape.
ShapeScan scanShape(const Shape& shape, const Bounds& box);

/// Tells whether a point lies in the shape or at most 0.1 mm outside.
bool holds(const ShapeScan& scan, Vec2 p);

/// Points that lie more than 0.1 mm outside the shape.
std::int64_t countOutside(const Toolpath& toolpath, const ShapeScan& scan);

// Lines that fill a shape, for the layers below the toolpath.

using Polyline = std::vector<Vec2>;  ///< open unless said otherwise [mm]

/// Zigzags that fill the shape with lines at 45 or 135 degrees, `lineWidth` apart and half of it off the border.
/// Neighbouring lines are joined along the border where the border allows it. Zigzags shorter than `lineWidth` are
/// left out. \param lineWidth  [mm], > 0. \param falling  135 instead of 45 degrees. \param inset  further off the
/// border [mm].
std::vector<Polyline> hatchLines(const Shape& shape, double lineWidth, bool falling, double inset = 0);

// Closed loops at fixed distances from the border: brims and concentric layers.

/// Loops at the distances `first`, `first + step`, ... [mm, below 0 inside], `count` of them or until none is left.
/// Corners are rounded outside and kept inside; within 0.01 mm. Outer loops run clockwise, loops around holes the other
/// way. \param step  not 0. \param count  0..1000. \param second  not null: where the loops `shift` further along
/// `step` go, which take half as long beside the others as by themselves. \param shift  [mm], >= 0. \return EmptyShape,
/// TooLarge.
Result<std::vector<Polyline>> offsetLoops(const Shape& shape, double first, double step, int count,
                                          std::vector<Polyline>* second = nullptr, double shift = 0);

// Skirt, purge line and brim, which prime the nozzle and hold the plate on the bed.

/// Closed rectangles around a box, the innermost 5 mm off, printed from the outside in.
std::vector<Polyline> skirtLoops(const Bounds& box, double lineWidth, int loops);

/// A skirt around all plates, where it fits. \param box  around all beads [mm].
void addSkirt(GcodeJob& job, const Bounds& box, const Printer& printer, int loops);

/// Fills the nozzle off the plate: 10 mm of filament, and what the last print's end drew back. A skirt that takes the
/// last room for it goes. \param box  around all beads [mm].
void addPurge(GcodeJob& job, const Bounds& box, const Printer& printer, const PrintParams& params);

/// Loops around the outside of the plate, the outermost first; holes stay free.
std::optional<Error> addBrim(GcodeJob& job, const Shape& shape, PointUm offset, const Printer& printer,
                             const PrintParams& params);

/// Loops along the border and its holes, from there inwards, which stand on the oriented layers. All of one border come
/// before those of the next. \return InvalidArgument if no line fits into the shape, EmptyShape, TooLarge.
std::optional<Error> addRim(GcodeJob& job, const Shape& body, PointUm offset, const Printer& printer,
                            const PrintParams& params);

/// The loop of a rim's borders that is nearest to a place; null without any.
const BeadPath* loopNearest(const std::vector<std::vector<BeadPath>>& rim, PointUm at);

/// Places on the way to a loop of the rim, as strings would be seen to cross the finished face: along the loop that the
/// nozzle stands at, over to the other where the two are close, and along that; by way of a third loop where less of
/// the face is crossed so. Empty: straight on. \param at  place of the nozzle. \param start  where the loop begins.
std::vector<PointUm> wayAlong(const BeadPath& from, PointUm at, const BeadPath& via, const BeadPath& to,
                              std::size_t start);

// The plain layers below the toolpath.

/// \param body  the shape, united. \return InvalidArgument if no line fits into the shape, EmptyShape, TooLarge.
std::optional<Error> addBaseLayers(GcodeJob& job, const Shape& body, PointUm offset, const Printer& printer,
                                   const PrintParams& params);

}  // namespace sillon
