#include "toolpath/joining.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>

#include "support/scenes.hpp"

using namespace sillon;

namespace {

Parts emptyParts(int nx, int ny) {
  Parts parts;
  parts.grid = {{-1, 2}, 0.2, nx, ny};
  parts.label.assign(parts.grid.size(), -1);
  return parts;
}

Vec2f inCell(const Grid& grid, int x, int y, double offX = 0, double offY = 0) {
  const Vec2 p = grid.centre(x, y);
  return {static_cast<float>(p.x + offX * grid.cell), static_cast<float>(p.y + offY * grid.cell)};
}

// Steps from one cell to all others of its part; -1: no way.
std::vector<int> stepsFrom(const Parts& parts, std::size_t cell) {
  const Grid& grid = parts.grid;
  std::vector<int> steps(grid.size(), -1);
  steps[cell] = 0;
  for (bool more = true; more;) {  // until nothing gets nearer
    more = false;
    for (int y = 0; y < grid.ny; ++y) {
      for (int x = 0; x < grid.nx; ++x) {
        const std::size_t at = grid.index(x, y);
        if (steps[at] < 0) continue;
        const auto reach = [&](int toX, int toY) {
          if (toX < 0 || toY < 0 || toX >= grid.nx || toY >= grid.ny) return;
          const std::size_t to = grid.index(toX, toY);
          if (parts.label[to] != parts.label[at] || (steps[to] >= 0 && steps[to] <= steps[at] + 1)) return;
          steps[to] = steps[at] + 1;
          more = true;
        };
        reach(x - 1, y);
        reach(x + 1, y);
        reach(x, y - 1);
        reach(x, y + 1);
      }
    }
  }
  return steps;
}

}  // namespace

TEST_CASE("a point is in its own cell, or in the first cell of a part beside it") {
  Parts parts = emptyParts(8, 6);
  const Grid& grid = parts.grid;
  parts.label[grid.index(3, 2)] = 0;
  for (const double x : {-0.49, 0.0, 0.49}) {
    for (const double y : {-0.49, 0.0, 0.49}) CHECK(cellInPart(parts, inCell(grid, 3, 2, x, y)) == grid.index(3, 2));
  }
  for (int y = 1; y <= 4; ++y) {
    for (int x = 1; x <= 6; ++x) {
      const bool beside = std::abs(x - 3) <= 1 && std::abs(y - 2) <= 1;
      CHECK(cellInPart(parts, inCell(grid, x, y)) == (beside ? grid.index(3, 2) : grid.index(x, y)));
    }
  }
  parts.label[grid.index(5, 4)] = 1;
  CHECK(cellInPart(parts, inCell(grid, 4, 3)) == grid.index(3, 2));  // the lower of the two
  CHECK(cellInPart(parts, inCell(grid, 5, 3)) == grid.index(5, 4));
  // Beyond the grid counts as its outermost cells but one: the rest is margin.
  for (const auto& [x, y, cellX, cellY] : {std::array{-5, 2, 1, 2}, {40, 2, 6, 2}, {4, -5, 4, 1}, {4, 40, 4, 4}}) {
    parts.label.assign(grid.size(), 0);
    CHECK(cellInPart(parts, inCell(grid, x, y)) == grid.index(cellX, cellY));
  }
}

TEST_CASE("points face each other where the regions that are nearest to them touch") {
  scenes::Random random(3);
  int found = 0;
  for (int round = 0; round < 40; ++round) {
    CAPTURE(round);
    // Two parts side by side, with holes; cells up to the grid's edge.
    Parts parts = emptyParts(14 + round % 5, 11 + round % 3);
    const Grid& grid = parts.grid;
    for (int y = 0; y < grid.ny; ++y) {
      for (int x = 0; x < grid.nx; ++x) {
        if (random.in(0, 1) > 0.15) parts.label[grid.index(x, y)] = x < grid.nx / 2 ? 0 : 1;
      }
    }
    std::vector<Vec2f> points;
    std::vector<int> sets;
    for (int k = 0; k < 3 + round; ++k) {
      points.push_back(
          inCell(grid, 1 + random.index(grid.nx - 2), 1 + random.index(grid.ny - 2), random.in(-0.4, 0.4), 0.1));
      sets.push_back(random.index(5) - 1);
    }
    const auto pairs = facingPoints(parts, points, sets);

    // The first point of a cell spreads from there; the others face it.
    std::map<std::size_t, int> sourceAt;
    std::set<std::pair<int, int>> possible, certain;
    const auto differ = [&](int a, int b) { return sets[a] != sets[b]; };
    for (int k = 0; k < static_cast<int>(points.size()); ++k) {
      const std::size_t cell = cellInPart(parts, points[k]);
      if (sets[k] < 0 || parts.label[cell] < 0) continue;
      const auto [at, first] = sourceAt.try_emplace(cell, k);
      if (!first && differ(at->second, k)) {
        possible.insert({at->second, k});
        certain.insert({at->second, k});
      }
    }
    std::vector<std::vector<int>> nearest(grid.size());
    std::vector<int> least(grid.size(), 1 << 20);
    for (const auto& [cell, k] : sourceAt) {
      const std::vector<int> steps = stepsFrom(parts, cell);
      for (std::size_t at = 0; at < steps.size(); ++at) {
        if (steps[at] < 0 || steps[at] > least[at]) continue;
        if (steps[at] < least[at]) nearest[at].clear();
        least[at] = steps[at];
        nearest[at].push_back(k);
      }
    }
    const auto touch = [&](std::size_t u, std::size_t v) {
      if (parts.label[u] != parts.label[v]) return;
      for (const int a : nearest[u]) {
        for (const int b : nearest[v]) {
          if (!differ(a, b)) continue;
          const std::pair<int, int> pair{std::min(a, b), std::max(a, b)};
          possible.insert(pair);
          if (nearest[u].size() == 1 && nearest[v].size() == 1) certain.insert(pair);
        }
      }
    };
    for (int y = 0; y < grid.ny; ++y) {
      for (int x = 0; x < grid.nx; ++x) {
        if (x + 1 < grid.nx) touch(grid.index(x, y), grid.index(x + 1, y));
        if (y + 1 < grid.ny) touch(grid.index(x, y), grid.index(x, y + 1));
      }
    }
    CHECK(std::is_sorted(pairs.begin(), pairs.end()));
    CHECK(std::adjacent_find(pairs.begin(), pairs.end()) == pairs.end());
    CHECK(std::includes(possible.begin(), possible.end(), pairs.begin(), pairs.end()));
    CHECK(std::includes(pairs.begin(), pairs.end(), certain.begin(), certain.end()));
    found += static_cast<int>(certain.size());
  }
  CHECK(found > 300);
}
