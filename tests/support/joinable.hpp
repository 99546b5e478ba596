// Which of a plate's paths could have been one, told by the shape alone and not as the core joins them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

#include "geometry/signed_distance.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/pipeline/pipeline.hpp"

namespace scenes {

/// Paths that lie where another path does: on places with room for a bead that hang together by such places, or lie
/// no further from each other than what is bridged. Sampled tau/4 apart, so that straits just as wide as a bead and
/// gaps just as wide as a bridge may count as too much. \return how many there are beside the first of each solid.
inline int joinablePaths(const sillon::Shape& shape, const sillon::ToolpathParams& params,
                         const sillon::Toolpath& toolpath, const sillon::RunContext& run) {
  const sillon::Outline outline = sillon::resolveOutline(shape).value();
  const sillon::Grid grid = sillon::makeGrid(outline.bounds, params.spacing / 2);
  const sillon::BorderIndex border = sillon::buildBorderIndex(outline, grid, run).value();
  const std::vector<float> distance = sillon::signedDistanceField(shape, border, grid, run).value().distance;

  // Where a bead's middle fits, and round that what the bead and half a bridge reach.
  const double reach = 0.5 * (params.spacing + params.bridge.value_or(params.spacing)) - 0.5 * grid.cell;
  const int cells = static_cast<int>(reach / grid.cell);
  std::vector<int> solid(grid.size(), 0);  // -1: in a solid that has no number yet
  for (int y = 0; y < grid.ny; ++y) {
    for (int x = 0; x < grid.nx; ++x) {
      if (static_cast<double>(distance[grid.index(x, y)]) > -0.5 * params.spacing) continue;
      for (int dy = -cells; dy <= cells; ++dy) {
        for (int dx = -cells; dx <= cells; ++dx) {
          const bool within = x + dx >= 0 && y + dy >= 0 && x + dx < grid.nx && y + dy < grid.ny;
          if (within && std::hypot(dx, dy) * grid.cell <= reach) solid[grid.index(x + dx, y + dy)] = -1;
        }
      }
    }
  }
  int solids = 0;
  std::vector<std::size_t> front;
  for (std::size_t first = 0; first < solid.size(); ++first) {
    if (solid[first] != -1) continue;
    ++solids;
    front.assign(1, first);
    solid[first] = solids;
    while (!front.empty()) {
      const int x = static_cast<int>(front.back() % static_cast<std::size_t>(grid.nx));
      const int y = static_cast<int>(front.back() / static_cast<std::size_t>(grid.nx));
      front.pop_back();
      for (const auto& [nextX, nextY] : {std::pair{x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}}) {
        if (nextX < 0 || nextY < 0 || nextX >= grid.nx || nextY >= grid.ny) continue;
        int& next = solid[grid.index(nextX, nextY)];
        if (next != -1) continue;
        next = solids;
        front.push_back(grid.index(nextX, nextY));
      }
    }
  }

  int joinable = 0;
  std::set<int> taken;
  for (const auto& cycle : toolpath.cycles) {
    std::set<int> touched;
    for (const auto& point : cycle.points) {
      const int at = solid[grid.cellAt({static_cast<double>(point.x), static_cast<double>(point.y)})];
      if (at > 0) touched.insert(at);
    }
    bool shared = false;
    for (const int at : touched) shared = !taken.insert(at).second || shared;
    joinable += shared ? 1 : 0;
  }
  return joinable;
}

/// How far the path's middle leaves the shape at most [mm]: threads across gaps and beside necks do.
inline double farthestOutside(const sillon::Shape& shape, const sillon::Toolpath& toolpath,
                              const sillon::RunContext& run) {
  const sillon::Outline outline = sillon::resolveOutline(shape).value();
  const sillon::Grid grid = sillon::makeGrid(outline.bounds, toolpath.spacing);
  const sillon::BorderIndex border = sillon::buildBorderIndex(outline, grid, run).value();
  double farthest = 0;
  for (const auto& cycle : toolpath.cycles) {
    for (std::size_t k = 0; k < cycle.points.size(); ++k) {
      const sillon::Vec2f a = cycle.points[k];
      const sillon::Vec2f step = cycle.points[(k + 1) % cycle.points.size()] - a;
      const int samples = static_cast<int>(16 * static_cast<double>(length(step)) / toolpath.spacing) + 1;
      for (int n = 0; n < samples; ++n) {
        const sillon::Vec2f q = a + step * (static_cast<float>(n) / static_cast<float>(samples));
        const sillon::Vec2 p{static_cast<double>(q.x), static_cast<double>(q.y)};
        if (border.outside(p)) farthest = std::max(farthest, std::abs(static_cast<double>(border.nearest(p).distance)));
      }
    }
  }
  return farthest;
}

}  // namespace scenes
