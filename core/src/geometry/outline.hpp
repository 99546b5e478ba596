// Paths combined, and the inside of shapes along lines and in cells.
#pragma once

#include <functional>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

/// Greatest distance of a shape's points from 0 [mm]; its 1e12 nm are exact in a double.
inline constexpr double kMaxCoordinate = 1e6;

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

/// A stretch of a horizontal line: x from begin to end [mm], begin < end.
struct Interval {
  double begin = 0;
  double end = 0;
};

/// Finds the inside of the shape along horizontal lines y = firstY + row * step [mm]: for each row,
/// disjoint intervals of x [mm] in ascending order. They are exact for any winding and overlap.
/// \param rows  number of lines, >= 0.
std::vector<std::vector<Interval>> insideIntervals(const Shape& shape, double firstY, double step, int rows);

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
