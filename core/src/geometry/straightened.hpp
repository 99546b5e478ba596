// Removes points that a line does not need.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "sillon/base/types.hpp"

namespace sillon {

inline double distanceToLine(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 d = b - a;
  const double size = length(d);
  return size > 0 ? std::abs(cross(d, p - a)) / size : length(p - a);
}

/// Leaves out points near the straight line between their neighbours. The first and the last point stay.
/// \param tolerance  largest distance from that line [mm].
/// \param longest  longest straight piece that results [mm].
inline std::vector<Vec2> straightened(const std::vector<Vec2>& line, double tolerance, double longest) {
  constexpr std::size_t kWindow = 40;  // largest number of points left out in one go
  std::vector<Vec2> out;
  std::size_t from = 0;
  while (from < line.size()) {
    out.push_back(line[from]);
    std::size_t to = from + 1;
    while (to + 1 < line.size() && to - from < kWindow && length(line[to + 1] - line[from]) <= longest) {
      bool straight = true;
      for (std::size_t k = from + 1; k <= to && straight; ++k) {
        straight = distanceToLine(line[k], line[from], line[to + 1]) <= tolerance;
      }
      if (!straight) break;
      ++to;
    }
    from = to;
  }
  return out;
}

}  // namespace sillon
