// Computes the inside of a shape row by row.
#include <algorithm>
#include <cmath>

#include "geometry/outline.hpp"
#include "geometry/outline_steps.hpp"

namespace sillon {

std::vector<std::vector<Interval>> insideIntervals(const Shape& shape, double firstY, double step, int rows) {
  struct RowCrossing {
    double x;
    int path;
    int direction;
  };
  std::vector<std::vector<RowCrossing>> crossings(std::max(rows, 0));
  for (const PathEdge& edge : edgesOf(shape.paths)) {
    const double low = std::ceil((std::min(edge.a.y, edge.b.y) - firstY) / step) - 1;
    const double high = std::floor((std::max(edge.a.y, edge.b.y) - firstY) / step) + 1;
    const int first = static_cast<int>(std::clamp(low, 0.0, static_cast<double>(rows)));
    const int last = static_cast<int>(std::clamp(high, -1.0, static_cast<double>(rows - 1)));
    for (int row = first; row <= last; ++row) {
      const double y = firstY + row * step;
      const int direction = crossesRow(edge, y);
      if (direction != 0) crossings[row].push_back({crossingX(edge, y), edge.path, direction});
    }
  }
  std::vector<std::vector<Interval>> intervals(crossings.size());
  WindingState winding(shape.paths);
  for (std::size_t row = 0; row < crossings.size(); ++row) {
    std::vector<RowCrossing>& line = crossings[row];
    std::sort(line.begin(), line.end(), [](const RowCrossing& a, const RowCrossing& b) {
      return a.x != b.x ? a.x < b.x : (a.path != b.path ? a.path < b.path : a.direction < b.direction);
    });
    winding.reset();
    double begin = 0;
    for (const RowCrossing& crossing : line) {
      const bool before = winding.inside();
      winding.cross(crossing.path, crossing.direction);
      if (!before && winding.inside()) begin = crossing.x;
      if (before && !winding.inside() && crossing.x > begin) intervals[row].push_back({begin, crossing.x});
    }
  }
  return intervals;
}

CellRange cellsWithin(const Interval& interval, double step, int count) {
  const auto cellAt = [&](double x) {
    return static_cast<int>(std::clamp(std::ceil(x / step - 0.5), 0.0, static_cast<double>(count)));
  };
  return {cellAt(interval.begin), cellAt(interval.end)};
}

std::vector<char> insideCells(const Shape& shape, int width, int height) {
  const double stepX = shape.page.x / width, stepY = shape.page.y / height;
  std::vector<char> inside(cellCount(width, height), 0);
  const auto rows = insideIntervals(shape, 0.5 * stepY, stepY, height);
  for (int y = 0; y < height; ++y) {
    char* const row = &inside[indexOf(0, height - 1 - y, width)];
    for (const Interval& span : rows[y]) {
      const CellRange cells = cellsWithin(span, stepX, width);
      std::fill(row + cells.begin, row + cells.end, char{1});
    }
  }
  return inside;
}

}  // namespace sillon
