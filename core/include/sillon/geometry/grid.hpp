// The regular cells that sample the plate (Sec. 5): side tau/2, with a margin so that contours close.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "sillon/base/types.hpp"

namespace sillon {

struct Grid {
  Vec2 origin;      ///< lower left corner of cell (0, 0) [mm]
  double cell = 0;  ///< side [mm]
  int nx = 0;
  int ny = 0;

  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny); }
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(x);
  }
  /// Index of the cell that a point lies in; of a point outside, of the nearest one.
  [[nodiscard]] std::size_t cellAt(Vec2 p) const {
    const auto place = [this](double at, int count) {
      return static_cast<int>(std::clamp(at / cell, 0.0, static_cast<double>(count - 1)));
    };
    return index(place(p.x - origin.x, nx), place(p.y - origin.y, ny));
  }
  [[nodiscard]] Vec2 centre(int x, int y) const { return {origin.x + (x + 0.5) * cell, origin.y + (y + 0.5) * cell}; }
};

/// Cells of tau/2 over the box and a margin of 1.5 tau around it; without jitter the neighbour weights are constants.
Grid makeGrid(const Bounds& box, double spacing);

/// The lattice of the contour: the grid's corners, edge middles and centres, (2 nx + 1) x (2 ny + 1) nodes at tau/4.
Grid nodeLattice(const Grid& grid);

}  // namespace sillon
