// The region that beads cover, as a picture of distances.
#pragma once

#include <cstdint>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

/// A straight bead of one width [mm].
struct RegionBead {
  Vec2 from;
  Vec2 to;
  double width = 0;
};

/// Signed distance to the edge of the region at the middle of each cell, cut off two cells or more from it; row 0
/// below.
struct RegionField {
  Vec2 corner;      ///< lower left of cell (0, 0) on the bed
  double cell = 0;  ///< [mm]
  int columns = 0;
  int rows = 0;
  std::vector<float> distance;     ///< [mm], < 0 inside
  std::vector<std::int32_t> part;  ///< connected part of each cell, -1 outside
  int parts = 0;

  [[nodiscard]] int at(Vec2 p) const;  ///< index of the cell of a place; -1 beside the field
};

/// Dilates each bead by half its width, and fills what no disc of radius `notch` [mm] gets into: the notches between
/// the round ends of beads, narrower than any wall. Cells are 0.05 mm, larger where the field would have more than 4
/// million: on faces of more than 100 x 100 mm. \return TooLarge for coordinates that no bed has.
Result<RegionField> fieldOfBeads(const std::vector<RegionBead>& beads, double notch = 0);

/// The outline of one part, between cells; holes smaller than `hole` [mm²] are filled.
/// \param corner  receives the lower left corner of the region's page on the bed.
/// \return EmptyShape if nothing of it is inside.
Result<Shape> regionOf(const RegionField& field, int part, double hole, Vec2& corner);

/// How deep each cell lies in its part, in cells from its border; 0 outside. Within 8 % of the true distance.
std::vector<float> depths(const RegionField& field);

/// The widest disc in each part, its diameter [mm]. \param depth  as depths gives it.
std::vector<double> breadths(const RegionField& field, const std::vector<float>& depth);

}  // namespace sillon
