#include "gcode/base_layers.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "geometry/outline.hpp"

namespace sillon {
namespace {

// Tells whether a row holds x, or ends at most kOutsideTolerance before it.
bool rowHolds(const std::vector<Interval>& row, double x) {
  const auto after = std::upper_bound(row.begin(), row.end(), x + kOutsideTolerance,
                                      [](double value, const Interval& piece) { return value < piece.begin; });
  return after != row.begin() && std::prev(after)->end >= x - kOutsideTolerance;
}

}  // namespace

ShapeScan scanShape(const Shape& shape, const Bounds& box) {
  ShapeScan result;
  const int count = std::clamp(static_cast<int>(box.size().y / 0.05), 1, 4000);
  result.step = box.size().y / count;
  result.firstY = box.min.y + result.step / 2;
  if (!(result.step > 0)) return result;
  result.rows = insideIntervals(shape, result.firstY, result.step, count);
  for (const std::vector<Interval>& row : result.rows) {
    for (const Interval& piece : row) result.area += (piece.end - piece.begin) * result.step;
  }
  return result;
}

bool holds(const ShapeScan& scan, Vec2 p) {
  const double row = (p.y - scan.firstY) / scan.step + 0.5;  // row number, counted from the lower edge of the first one
  return row >= 0 && row < static_cast<double>(scan.rows.size()) && rowHolds(scan.rows[toSize(row)], p.x);
}

std::int64_t countOutside(const Toolpath& toolpath, const ShapeScan& scan) {
  const auto last = static_cast<double>(scan.rows.size()) - 1;
  const auto holds = [&](double row, double x) {
    return row >= 0 && row <= last && rowHolds(scan.rows[toSize(row)], x);
  };
  std::int64_t outside = 0;
  for (const Cycle& cycle : toolpath.cycles) {
    for (const Vec2f p : cycle.points) {
      const double at = (static_cast<double>(p.y) - scan.firstY) / scan.step;
      const double reach = kOutsideTolerance / scan.step;
      bool found = holds(std::floor(at), p.x);  // nearly always true
      for (double row = std::floor(at - reach); !found && row <= std::ceil(at + reach); ++row) found = holds(row, p.x);
      if (!found) ++outside;
    }
  }
  return outside;
}

}  // namespace sillon
