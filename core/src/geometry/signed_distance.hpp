// Distances to the outline.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/outline.hpp"

namespace sillon {

// The regular cells that sample the plate (Sec. 5): side tau/2, with a margin so that contours close.

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

// Exact signed distance to the border (Sec. 4), on the cells of a grid and at single points.

struct NearestBorder {
  float distance = 0;  ///< [mm], < 0 inside
  Vec2f normal;        ///< unit gradient of the distance, outward
};

/// For each block of 4 x 4 cells the border segments that can be nearest to any point in it: a quadtree keeps those
/// within the best distance plus a block's diagonal. Exact, and linear in the cells for drawings made of few segments a
/// block.
class BorderIndex {
 public:
  /// Exact nearest border point. Points outside the grid are answered from its nearest block (approximate).
  [[nodiscard]] NearestBorder nearest(Vec2 p) const;
  /// Lower bound of the unsigned distance [mm] over the block that holds p: a cheap way to skip the interior.
  [[nodiscard]] float blockDistance(Vec2 p) const;

  /// Lower bound of the depth inside the shape [mm] over the block that holds p; 0 where the block is not wholly
  /// inside.
  [[nodiscard]] float blockDepth(Vec2 p) const;

  /// Tells whether p lies outside the shape; cheap away from the border.
  [[nodiscard]] bool outside(Vec2 p) const;

  friend Result<BorderIndex> buildBorderIndex(const Outline& outline, const Grid& grid, const RunContext& run);
  friend Result<std::vector<float>> bandDistance(const Shape& shape, const BorderIndex& index, const Grid& lattice,
                                                 float band, const RunContext& run);

 private:
  [[nodiscard]] std::size_t blockOf(Vec2 p) const;

  Grid blocks_;
  std::vector<BorderSegment> segments_;
  std::vector<int> begin_;  ///< blocks + 1 offsets into candidates_
  std::vector<int> candidates_;
  std::vector<float> lowest_;
  std::vector<char> outside_;  ///< side of the whole block, where the border does not pass it
};

/// \return TooLarge when the outline is too detailed for the grid, OutOfMemory when it is for RunContext::memory(),
///   EmptyShape when it has no segment, or Cancelled.
Result<BorderIndex> buildBorderIndex(const Outline& outline, const Grid& grid, const RunContext& run);

/// Signed distance [mm] and its unit gradient at the cell centres, row-major.
struct SignedDistanceField {
  Grid grid;
  std::vector<float> distance;
  std::vector<Vec2f> normal;
};

/// Exact at every centre. The sign comes from the fill rule by scanline: the nearest normal fails at reflex corners.
Result<SignedDistanceField> signedDistanceField(const Shape& shape, const BorderIndex& index, const Grid& grid,
                                                const RunContext& run);

/// Distances on any lattice, exact where |distance| <= band and at least `band` in size (right sign) elsewhere.
Result<std::vector<float>> bandDistance(const Shape& shape, const BorderIndex& index, const Grid& lattice, float band,
                                        const RunContext& run);

// Distances in a raster, for rules of thumb.

/// Distance of each cell to the nearest wall, in cells; within 8 %. Walls are 0; 1e9 where there is no wall. The
/// chamfer distance of Borgefors (1986) with steps of 1 and sqrt(2). \param wall  columns x rows, row by row; not 0: a
/// wall
std::vector<float> chamferDistance(const std::vector<char>& wall, int columns, int rows);

}  // namespace sillon
