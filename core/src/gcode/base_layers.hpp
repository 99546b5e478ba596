// Layers that fill an area: base, skirt, brim, rim.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "gcode/job.hpp"
#include "geometry/outline.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

// The shape as intervals along horizontal lines, fine enough to measure its area and to find points outside.

inline constexpr double kOutsideTolerance = 0.1;  ///< distance outside that still counts as inside [mm]

/// Intervals inside a shape, one row per `step`; the first row lies at y = firstY [mm].
struct ShapeScan {
  std::vector<std::vector<Interval>> rows;
  double firstY = 0;
  double step = 0;
  double area = 0;  ///< area of the shape [mm²]
};

/// Scans a shape. \param box  around the shape.
ShapeScan scanShape(const Shape& shape, const Bounds& box);

/// Tells whether a point lies in the shape or at most 0.1 mm outside.
bool holds(const ShapeScan& scan, Vec2 p);

/// Counts the points that lie more than 0.1 mm outside the shape.
std::int64_t countOutside(const Toolpath& toolpath, const ShapeScan& scan);

// Lines that fill a shape, for the layers below the toolpath.

using Polyline = std::vector<Vec2>;  ///< open unless said otherwise [mm]

/// Returns zigzags that fill the shape with lines at 45 or 135 degrees, `lineWidth` apart and half of that off the
/// border. Neighbouring lines are joined along the border where the border allows it. Zigzags shorter than `lineWidth`
/// are left out. \param lineWidth  [mm], > 0. \param falling  lines run at 135 instead of 45 degrees.
/// \param inset  extra distance from the border [mm].
std::vector<Polyline> hatchLines(const Shape& shape, double lineWidth, bool falling, double inset = 0);

// Closed loops at fixed distances from the border: brims and concentric layers.

/// Returns loops at the distances `first`, `first + step`, ... from the border [mm, below 0 inside], `count` of them or
/// until none is left. Corners are rounded outside and kept inside; within 0.01 mm. Outer loops run clockwise, loops
/// around holes the other way. \param step  not 0. \param count  0..1000. \param second  null, or the destination of
/// the loops that lie `shift` further along `step`; computed together with the others they take half the time.
/// \param shift  [mm], >= 0. \return EmptyShape, TooLarge.
Result<std::vector<Polyline>> offsetLoops(const Shape& shape, double first, double step, int count,
                                          std::vector<Polyline>* second = nullptr, double shift = 0);

// Skirt, purge line and brim, which prime the nozzle and hold the plate on the bed.

/// Returns closed rectangles around a box, the innermost 5 mm off, in printing order: from the outside in.
std::vector<Polyline> skirtLoops(const Bounds& box, double lineWidth, int loops);

/// Adds a skirt around all plates, where it fits. \param box  around all beads [mm].
void addSkirt(GcodeJob& job, const Bounds& box, const Printer& printer, int loops);

/// Adds a purge line off the plate, which extrudes purgeLength and what the end of the last print drew back. A skirt
/// that takes the last room for it is left out. \param box  around all beads [mm].
void addPurge(GcodeJob& job, const Bounds& box, const Printer& printer, const PrintParams& params);

/// Adds loops around the outside of the plate, the outermost first; holes stay free.
std::optional<Error> addBrim(GcodeJob& job, const Shape& shape, PointUm offset, const Printer& printer,
                             const PrintParams& params);

/// Adds loops that stand on the oriented layers, from the outer border and the holes inwards. All loops of one border
/// come before those of the next. \return InvalidArgument if no line fits into the shape, EmptyShape, TooLarge.
std::optional<Error> addRim(GcodeJob& job, const Shape& body, PointUm offset, const Printer& printer,
                            const PrintParams& params);

/// Finds the border loop of a rim that is nearest to a place; null without any.
const BeadPath* loopNearest(const std::vector<std::vector<BeadPath>>& rim, PointUm at);

/// Returns the way of a travel to a loop of the rim, which keeps off the finished face because strings would show
/// there. It follows the loop that the nozzle stands at, crosses where the two loops are close, and follows the other;
/// it takes a third loop, `via`, in between if that crosses less of the face. Empty: the nozzle goes straight.
/// \param at  place of the nozzle. \param start  index of the point where the loop begins.
std::vector<PointUm> wayAlong(const BeadPath& from, PointUm at, const BeadPath& via, const BeadPath& to,
                              std::size_t start);

// Base layers: the plain ones below the toolpath.

/// Adds the base layers, and warns where they leave too much of the body bare. \param body  the shape, united.
/// \return InvalidArgument if no line fits into the shape, EmptyShape, TooLarge.
std::optional<Error> addBaseLayers(GcodeJob& job, const Shape& body, PointUm offset, const Printer& printer,
                                   const PrintParams& params);

}  // namespace sillon
