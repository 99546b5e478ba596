// The border of a shape: the line between inside and outside once paths that overlap, touch or
// cross themselves are resolved.
#pragma once

#include <functional>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

/// One straight piece of the border; the inside lies on its left.
struct BorderSegment {
  Vec2 a;
  Vec2 b;
};

/// The border as a soup of segments: no interior edges, no duplicates, in a fixed order.
struct Outline {
  std::vector<BorderSegment> segments;
  Bounds bounds;
  double area = 0;  ///< area |Omega| of the inside [mm²]
};

/// Splits all rings where they meet and keeps the pieces with inside on exactly one side.
/// \return EmptyShape if no area remains; TooLarge beyond 4 million pieces; InvalidArgument for a
/// point beyond kMaxCoordinate.
Result<Outline> resolveOutline(const Shape& shape);

/// Resolves the outline with all points on the grid of 0.001 mm that files hold. Each point moves
/// by at most 0.71 µm for each of the pieces that cross there, and narrower features vanish. Pieces
/// meet only at their ends, and from each point as many go as come.
/// \return the errors of resolveOutline.
Result<Outline> outlineOnGrid(const Shape& shape);

/// Tells whether a place counts as inside. Its argument has one entry per path, in order: 1 where
/// that path is filled at the place.
using InsideRule = std::function<bool(const std::vector<char>& filled)>;

/// Combines several paths by a rule, for example into the area that two have in common.
/// \return rings with the inside on their left, points on a grid of 1 nm; no rings if nothing is
/// inside; TooLarge beyond 4 million pieces.
Result<FilledPath> combined(const std::vector<FilledPath>& paths, const InsideRule& rule);

/// Unites the shape into one path on the same page, with all points on the grid of 0.001 mm. Paths
/// that overlap, share an edge or lie less than the grid apart become one body.
/// \return the errors of outlineOnGrid.
Result<Shape> unitedOnGrid(const Shape& shape);

/// Moves the outline of the shape outwards, or inwards by an offset below 0. Corners that move
/// outwards become round, holes become smaller, and bodies that meet become one. The page grows
/// with the outline, and keeps its size where the outline shrinks.
/// \param offset  distance [mm], -20..50. The new outline is exact to 0.005 mm, and to a tenth of a
/// mm in corners that move inwards.
/// \return InvalidArgument for another offset; EmptyShape if nothing is left; the errors of
/// resolveOutline; TooLarge, OutOfMemory or Cancelled.
Result<Shape> offsetShape(Shape shape, double offset, const RunContext& run);

/// A stretch of a horizontal line: x from begin to end [mm], begin < end.
struct Interval {
  double begin = 0;
  double end = 0;
};

/// Finds the inside of the shape along horizontal lines y = firstY + row * step [mm]: for each row,
/// disjoint intervals of x [mm] in ascending order. They are exact for any winding and overlap.
/// \param rows  number of lines, >= 0.
std::vector<std::vector<Interval>> insideIntervals(const Shape& shape, double firstY, double step,
                                                   int rows);

/// Cells of a row, from `begin` up to, but not including, `end`.
struct CellRange {
  int begin = 0;
  int end = 0;
};

/// Returns the cells whose middles lie in an interval.
/// \param step  width of a cell [mm].
/// \param count  number of cells in the row, which begins at 0.
CellRange cellsWithin(const Interval& interval, double step, int count);

/// Tells for each cell of a raster of the page whether its middle lies inside; row 0 on top.
std::vector<char> insideCells(const Shape& shape, int width, int height);

}  // namespace sillon
