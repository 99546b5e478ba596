// Signed distances to the outline.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

// Regular cells that sample the plate (Sec. 5), with sides of tau/2 and a margin so that contours close.

struct Grid {
  Vec2 origin;      ///< lower left corner of cell (0, 0) [mm]
  double cell = 0;  ///< side [mm]
  int nx = 0;
  int ny = 0;

  [[nodiscard]] std::size_t size() const { return cellCount(nx, ny); }
  [[nodiscard]] std::size_t index(int x, int y) const { return indexOf(x, y, nx); }
  /// Returns the index of the cell that contains a point, or of the nearest one.
  [[nodiscard]] std::size_t cellAt(Vec2 p) const {
    const auto place = [this](double at, int count) {
      return static_cast<int>(std::clamp(at / cell, 0.0, static_cast<double>(count - 1)));
    };
    return index(place(p.x - origin.x, nx), place(p.y - origin.y, ny));
  }
  [[nodiscard]] Vec2 centre(int x, int y) const { return {origin.x + (x + 0.5) * cell, origin.y + (y + 0.5) * cell}; }
};

/// Makes a grid of tau/2 cells over the box and a margin of 1.5 tau. Without jitter, the neighbour weights are
/// constant.
Grid makeGrid(const Bounds& box, double spacing);

/// Makes the lattice of the contour: the grid's corners, edge middles and centres, (2 nx + 1) x (2 ny + 1) nodes tau/4
/// apart.
Grid nodeLattice(const Grid& grid);

// Exact signed distance to the border (Sec. 4), on the cells of a grid and at single points.

struct NearestBorder {
  float distance = 0;  ///< [mm], < 0 inside
  Vec2f normal;        ///< unit gradient of the distance, outward
};

/// Index of the border. For each block of 4 x 4 cells it keeps the segments that can be nearest to any point of the
/// block: a quadtree discards those beyond the best distance plus a block's diagonal. Exact, and linear in the number
/// of cells for drawings with few segments per block.
class BorderIndex {
 public:
  /// Returns the nearest border point, exactly. For points outside the grid its nearest block answers (approximately).
  [[nodiscard]] NearestBorder nearest(Vec2 p) const;
  /// Returns a lower bound of the unsigned distance over the block that holds p [mm], a cheap way to skip the interior.
  [[nodiscard]] float blockDistance(Vec2 p) const;

  /// Returns a lower bound of the depth inside the shape over the block that holds p [mm]; 0 if the block is not wholly
  /// inside.
  [[nodiscard]] float blockDepth(Vec2 p) const;

  /// Tells whether p lies outside the shape. Cheap away from the border.
  [[nodiscard]] bool outside(Vec2 p) const;

  friend Result<BorderIndex> buildBorderIndex(const Outline& outline, const Grid& grid, const RunContext& run);
  friend Result<std::vector<float>> bandDistance(const Shape& shape, const BorderIndex& index, const Grid& lattice,
                                                 float band, const RunContext& run);

 private:
  [[nodiscard]] std::size_t blockOf(Vec2 p) const;

  Grid blocks_;
  std::vector<BorderSegment> segments_;
  std::vector<int> begin_;  ///< offsets into candidates_, one per block and the end
  std::vector<int> candidates_;
  std::vector<float> lowest_;
  std::vector<char> outside_;  ///< 1 if the block lies outside; valid if the border does not pass the block
};

/// Builds the index of an outline.
/// \return TooLarge if the outline is too detailed for the grid, OutOfMemory if it is for RunContext::memory(),
/// EmptyShape if it has no segment, or Cancelled.
Result<BorderIndex> buildBorderIndex(const Outline& outline, const Grid& grid, const RunContext& run);

/// Signed distance [mm] and its unit gradient at the cell centres, row by row.
struct SignedDistanceField {
  Grid grid;
  std::vector<float> distance;
  std::vector<Vec2f> normal;
};

/// Computes the field, exact at every centre. The sign comes from the fill rule by scanlines, because the sign by the
/// nearest normal fails at reflex corners.
Result<SignedDistanceField> signedDistanceField(const Shape& shape, const BorderIndex& index, const Grid& grid,
                                                const RunContext& run);

/// Computes distances on any lattice: exact where |distance| <= band, elsewhere at least `band` with the right sign.
Result<std::vector<float>> bandDistance(const Shape& shape, const BorderIndex& index, const Grid& lattice, float band,
                                        const RunContext& run);

// Approximate distances in a raster.

/// Returns the distance of each cell to the nearest wall [cells], within 8 %: 0 at walls, 1e9 if there is no wall.
/// Chamfer distance of Borgefors (1986) with steps of 1 and sqrt(2).
/// \param wall  columns x rows, row by row; not 0 at a wall
std::vector<float> chamferDistance(const std::vector<char>& wall, int columns, int rows);

}  // namespace sillon
