// Parts of a shape: connected cells, thin features that are kept, and lost cells.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/signed_distance.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

// Connected parts of the plate, each of which must become one cycle.

/// Labels cells by part, -1 outside. Two cells belong to one part if a way between them stays within bridge/2 of the
/// shape: solids nearer to each other than `bridge` form one part, and so do solids connected by a neck.
struct Parts {
  Grid grid;
  std::vector<std::int32_t> label;
  int count = 0;  ///< number of parts in which a bead has room; these come first
};

/// Labels the connected parts of a shape.
/// \param bridge  [mm], >= 0. Gaps are measured to tau/64; necks narrower than a cell are found only if bridge >=
/// tau/2.
Parts labelParts(const SignedDistanceField& sdf, const BorderIndex& border, double spacing, double bridge);

// Places narrower than a bead, which are widened to one.

/// Adds a path that widens the thin places of a shape to one bead: where the shape is at least half a spacing wide and
/// narrower than one spacing, it adds discs of one spacing along the middle (the medial axis). Places smaller than
/// tau²/4, such as corners that no round bead fills, stay as they are. `Shape::kept` lists the places.
/// \param spacing  tau [mm], 0.05..20.
/// \return the same shape if nothing is thin; InvalidArgument for another spacing; the errors of resolveOutline() and
/// buildBorderIndex(); Cancelled.
Result<Shape> keepThinPlaces(Shape shape, double spacing, const RunContext& run);

// Samples of places where a shape is narrower than a bead.

/// The shape minus its opening by a disc of one spacing, as connected places larger than tau²/4.
struct LostCells {
  Grid grid;                                     ///< samples at the cells' centres, tau/8 apart
  std::vector<float> distance;                   ///< signed distances, exact down to -tau/2 [mm]
  std::vector<std::vector<std::size_t>> places;  ///< indices of the samples of each place

  [[nodiscard]] Vec2 at(std::size_t sample) const {
    const std::size_t nx = grid.nx;
    return grid.centre(static_cast<int>(sample % nx), static_cast<int>(sample / nx));
  }
};

/// Finds the lost cells of a shape.
/// \param box  box of the outline.
/// \return Cancelled, or TooLarge if the outline is too detailed for the samples.
Result<LostCells> lostCells(const Shape& shape, const BorderIndex& border, const Bounds& box, double spacing,
                            const RunContext& run);

}  // namespace sillon
