// The pyramid of grids (Sec. 5.3), each level stored by colour.
//
// A level of nx x ny cells is kept as four planes, one per colour (x mod 2, y mod 2), of ceil(nx/2) x ceil(ny/2) cells.
// Neighbours never share a colour, so a sweep over one colour may run in place, on any number of threads and in any
// order, and gives the same result. In the planes neighbours lie at unit stride (SIMD), and the four children of a
// parent cell (X, Y) are the cells (X, Y) of the four planes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "sillon/base/types.hpp"

namespace sillon {

// Between a direction and its line: d and -d are the same z = e^{2i angle}.

/// z of a unit direction: (cos 2a, sin 2a).
inline Vec2f lineOf(Vec2f d) { return {d.x * d.x - d.y * d.y, 2 * d.x * d.y}; }

/// One of the two unit directions of a unit z, by the half-angle formulas.
inline Vec2f directionOf(Vec2f z) {
  const float c = std::sqrt(std::max(0.0f, 0.5f * (1 + z.x)));
  const float s = std::sqrt(std::max(0.0f, 0.5f * (1 - z.x)));
  const Vec2f d{c, z.y < 0 ? -s : s};
  return d * (1 / length(d));
}

inline constexpr int kColours = 4;

/// Shape of the planes of one level. Every plane has a masked frame of one cell, and rows are padded to whole vectors.
struct LevelShape {
  int nx = 0;  ///< cells of the level
  int ny = 0;
  int px = 0;  ///< cells of a plane
  int py = 0;
  int stride = 0;

  LevelShape() = default;
  LevelShape(int width, int height)
      : nx(width), ny(height), px((width + 1) / 2), py((height + 1) / 2), stride((px + 3) / 4 * 4 + 2) {}

  [[nodiscard]] std::size_t planeSize() const {
    return cellCount(stride, py + 2) + 4;  // 4: the last vector load
  }
  [[nodiscard]] std::size_t at(int x, int y) const {  ///< index of plane cell (x, y)
    return indexOf(x + 1, y + 1, stride);
  }
  [[nodiscard]] std::size_t atCell(int x, int y) const { return at(x >> 1, y >> 1); }
  [[nodiscard]] LevelShape coarser() const { return {px, py}; }
  [[nodiscard]] bool coarsest() const { return (nx < ny ? nx : ny) <= 2; }
};

inline std::size_t colourOf(int x, int y) { return (x & 1) | ((y & 1) << 1); }
inline int colourX(std::size_t colour) { return static_cast<int>(colour & 1); }
inline int colourY(std::size_t colour) { return static_cast<int>(colour >> 1); }

/// One value per cell of a level.
using Planes = std::array<std::vector<float>, kColours>;

inline Planes makePlanes(const LevelShape& shape) {
  Planes planes;
  for (std::vector<float>& plane : planes) plane.assign(shape.planeSize(), 0.0f);
  return planes;
}

/// Place of the neighbour at (dx, dy) in {-1, 0, 1}² of a cell of some colour.
struct NeighbourPlane {
  std::size_t colour;
  std::ptrdiff_t offset;  ///< added to the plane index of the cell
};

inline NeighbourPlane neighbourPlane(const LevelShape& shape, std::size_t colour, int dx, int dy) {
  const int x = colourX(colour) + dx;
  const int y = colourY(colour) + dy;
  const auto halved = [](int v) { return v < 0 ? -1 : v / 2; };
  return {colourOf(x, y), static_cast<std::ptrdiff_t>(halved(y)) * shape.stride + halved(x)};
}

/// Gaussian weights of the 8 neighbours, exp(-|dp|² / 2 sigma²), with sigma = tau/3 at the finest level and doubled per
/// level.
inline constexpr float kSideWeight = 0.32465247f;    // exp(-9/8)
inline constexpr float kCornerWeight = 0.10539922f;  // exp(-9/4)

}  // namespace sillon
