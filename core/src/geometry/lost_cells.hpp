// Where a shape is narrower than a bead, as samples.
#pragma once

#include <cstddef>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/geometry/grid.hpp"
#include "sillon/geometry/signed_distance.hpp"

namespace sillon {

/// The shape minus its opening by a disc of one spacing, in connected places larger than tau²/4.
struct LostCells {
  Grid grid;                                     ///< samples tau/8 apart, at the cells' centres
  std::vector<float> distance;                   ///< exact down to -tau/2 [mm]
  std::vector<std::vector<std::size_t>> places;  ///< indices of the samples of each place

  [[nodiscard]] Vec2 at(std::size_t sample) const {
    const auto nx = static_cast<std::size_t>(grid.nx);
    return grid.centre(static_cast<int>(sample % nx), static_cast<int>(sample / nx));
  }
};

/// \param box  of the outline. \return Cancelled, or TooLarge where the outline is too detailed for the samples.
Result<LostCells> lostCells(const Shape& shape, const BorderIndex& border, const Bounds& box, double spacing,
                            const RunContext& run);

}  // namespace sillon
