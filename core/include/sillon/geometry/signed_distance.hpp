// Exact signed distance to the border (Sec. 4), on the cells of a grid and at single points.
#pragma once

#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/geometry/grid.hpp"
#include "sillon/geometry/outline.hpp"

namespace sillon {

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

  /// Whether p lies outside the shape; cheap away from the border.
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

}  // namespace sillon
