#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "compose/ink.hpp"
#include "compose/region.hpp"
#include "geometry/outline.hpp"
#include "geometry/shape_points.hpp"
#include "geometry/signed_distance.hpp"

namespace sillon {

double thinShare(const Shape& shape, double spacing) {
  constexpr double kCellsPerBead = 4;
  constexpr double kMostCells = 2048;
  const double cell = std::max(spacing / kCellsPerBead, std::max(shape.page.x, shape.page.y) / kMostCells);
  const auto radius = static_cast<float>(spacing / cell);
  const int width = static_cast<int>(std::ceil(shape.page.x / cell)) + 2;
  const int height = static_cast<int>(std::ceil(shape.page.y / cell)) + 2;
  Shape padded = shape;  // has a margin of one cell, because the edge of the raster is no wall
  padded.page = {width * cell, height * cell};
  movePoints(padded, [cell](Vec2 point) { return point + Vec2{cell, cell}; });
  const Cells inside = insideCells(padded, width, height);
  Cells walls = inside;
  for (char& wall : walls) wall = wall == 0 ? 1 : 0;
  const std::vector<float> depth = chamferDistance(walls, width, height);
  Cells core(inside.size(), 0);
  for (std::size_t k = 0; k < core.size(); ++k) core[k] = depth[k] > radius - 0.5F ? 1 : 0;
  const std::vector<float> fromCore = chamferDistance(core, width, height);
  std::size_t all = 0, lost = 0;
  for (std::size_t k = 0; k < core.size(); ++k) {
    if (inside[k] == 0) continue;
    ++all;
    if (fromCore[k] > 1.5F * radius) ++lost;  // square corners lie up to sqrt 2 radii from the core
  }
  return all == 0 ? 0 : static_cast<double>(lost) / static_cast<double>(all);
}

}  // namespace sillon
