// The border of a shape: what separates inside from outside once paths overlap, touch or cross
// themselves.
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
  double area = 0;  ///< |Omega| [mm²]
};

/// Splits all rings where they meet and keeps the pieces with inside on exactly one side.
/// \return EmptyShape if no area remains; TooLarge beyond 4 million pieces; InvalidArgument for a
/// point beyond
///   kMaxCoordinate.
Result<Outline> resolveOutline(const Shape& shape);

/// The same with all points on the grid of 0.001 mm that files hold: each moves by at most 0.71 µm
/// for each of the pieces that cross there, and what is narrower vanishes. Pieces meet at their
/// ends only, and from each point as many go as come.
Result<Outline> outlineOnGrid(const Shape& shape);

/// Tells whether a place counts as inside. Given are the paths in order, 1 where they are filled
/// there.
using InsideRule = std::function<bool(const std::vector<char>& filled)>;

/// The area that a rule makes of several paths, such as what two have in common.
/// \return rings that run with the inside on their left, points on a grid of 1 nm; no rings if
/// nothing is inside;
///   TooLarge beyond 4 million pieces.
Result<FilledPath> combined(const std::vector<FilledPath>& paths, const InsideRule& rule);

/// The shape as one path on the same page, with all points on the grid of 0.001 mm: paths that
/// overlap, share an edge or lie less than the grid apart are one body. As outlineOnGrid, with its
/// errors.
Result<Shape> unitedOnGrid(const Shape& shape);

/// The shape with its outline moved outwards, or inwards by an offset below 0. Corners that move
/// outwards become round, holes become smaller, and what meets is one. The page grows with the
/// outline, and stays where it becomes smaller.
/// \param offset  [mm], -20..50. The new outline is exact to 0.005 mm, and to a
///   tenth of a mm in corners that move inwards.
/// \return InvalidArgument for another offset; EmptyShape if nothing is left; as resolveOutline,
///   and TooLarge, OutOfMemory or Cancelled.
Result<Shape> offsetShape(Shape shape, double offset, const RunContext& run);

/// A stretch of a horizontal line: x from begin to end [mm], begin < end.
struct Interval {
  double begin = 0;
  double end = 0;
};

/// The inside of the shape along horizontal lines y = firstY + row * step [mm]: for each row
/// ascending, disjoint intervals of x [mm]. Exact for any winding and overlap.
/// \param rows  >= 0.
std::vector<std::vector<Interval>> insideIntervals(const Shape& shape, double firstY, double step,
                                                   int rows);

/// Cells of a row, from `begin` to before `end`.
struct CellRange {
  int begin = 0;
  int end = 0;
};

/// The cells whose middles lie in an interval. \param step  width of a cell [mm]. \param count  of
/// the row, which begins at 0.
CellRange cellsWithin(const Interval& interval, double step, int count);

/// Tells of each cell of a raster of the page whether its middle lies inside, row 0 on top.
std::vector<char> insideCells(const Shape& shape, int width, int height);

}  // namespace sillon
