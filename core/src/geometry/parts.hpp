// Parts of a shape: connected cells, thin features that are kept, cells that are lost.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/signed_distance.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

// Connected parts of the plate: what must become one cycle each.

/// Part of each cell, -1 outside. Two cells are of one part when a way between them stays within bridge/2 of the shape:
/// so solids nearer than `bridge` count as one, and solids that hang together by a neck do too.
struct Parts {
  Grid grid;
  std::vector<std::int32_t> label;
  int count = 0;  ///< parts in which a bead has room; they come first
};

/// \param bridge  [mm], >= 0. Gaps are measured to tau/64; necks narrower than a cell are seen only
///                when bridge >= tau/2.
Parts labelParts(const SignedDistanceField& sdf, const BorderIndex& border, double spacing, double bridge);

// Places narrower than a bead, widened to one.

/// Adds to a shape a path that widens its thin places to one bead: where the shape is at least half a spacing wide and
/// narrower than one spacing, discs of one spacing along its middle (its medial axis) become part of it. Places of less
/// than tau²/4, such as the corners that no round bead fills, stay as they are. `Shape::kept` tells what was kept.
/// \param spacing  tau [mm], 0.05..20. \return the same shape where nothing is thin; InvalidArgument for another
///   spacing; as resolveOutline and buildBorderIndex, and Cancelled.
Result<Shape> keepThinPlaces(Shape shape, double spacing, const RunContext& run);

// Samples of places where a shape is narrower than a bead.

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
