#include "toolpath/joining.hpp"

#include <algorithm>

namespace sillon {

// The frame is left out, so that all nine neighbours exist.
std::size_t cellInPart(const Parts& parts, Vec2f p) {
  const Grid& grid = parts.grid;
  const int x = std::clamp(static_cast<int>((static_cast<double>(p.x) - grid.origin.x) / grid.cell), 1, grid.nx - 2);
  const int y = std::clamp(static_cast<int>((static_cast<double>(p.y) - grid.origin.y) / grid.cell), 1, grid.ny - 2);
  const std::size_t own = grid.index(x, y);
  if (parts.label[own] >= 0) return own;
  for (int k = 0; k < 9; ++k) {
    const std::size_t beside = grid.index(x + k % 3 - 1, y + k / 3 - 1);
    if (parts.label[beside] >= 0) return beside;
  }
  return own;
}

// A breadth-first search from all points at once: each cell belongs to the point that reaches it first.
std::vector<std::pair<int, int>> facingPoints(const Parts& parts, const std::vector<Vec2f>& points,
                                              const std::vector<int>& setOfPoint) {
  const Grid& grid = parts.grid;
  std::vector<std::int32_t> owner(grid.size(), -1);
  std::vector<std::pair<int, int>> pairs;
  // A pair counts only if the two points are of different sets.
  const auto meet = [&](std::int32_t a, std::int32_t b) {
    if (setOfPoint[a] != setOfPoint[b]) pairs.emplace_back(std::min(a, b), std::max(a, b));
  };
  std::vector<std::int32_t>
      front;  // cells in the order in which they were reached, so that each lies on a shortest way
  // Every point starts in its own cell; two points in one cell meet at once.
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (setOfPoint[k] < 0) continue;
    const std::size_t cell = cellInPart(parts, points[k]);
    if (parts.label[cell] < 0) continue;
    if (owner[cell] >= 0) {
      meet(owner[cell], static_cast<std::int32_t>(k));
      continue;
    }
    owner[cell] = static_cast<std::int32_t>(k);
    front.push_back(static_cast<std::int32_t>(cell));
  }
  // Spread to the four neighbours within the same part. At a cell that has an owner, the two owners face each other.
  for (std::size_t k = 0; k < front.size(); ++k) {
    const std::size_t cell = front[k];
    const int x = static_cast<int>(cell % grid.nx);
    const int y = static_cast<int>(cell / grid.nx);
    const auto spread = [&](int toX, int toY) {
      if (toX < 0 || toY < 0 || toX >= grid.nx || toY >= grid.ny) return;
      const std::size_t to = grid.index(toX, toY);
      // Points spread within their part only, as no joint leads from one part to another.
      if (parts.label[to] != parts.label[cell]) return;
      if (owner[to] >= 0) {
        meet(owner[cell], owner[to]);
        return;
      }
      owner[to] = owner[cell];
      front.push_back(static_cast<std::int32_t>(to));
    };
    spread(x + 1, y);
    spread(x, y + 1);
    spread(x - 1, y);
    spread(x, y - 1);
  }
  // A border of two regions has many cells: keep each pair once.
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace sillon
