// Connected parts of the plate: what must become one cycle each.
#pragma once

#include <cstdint>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/geometry/signed_distance.hpp"

namespace sillon {

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

}  // namespace sillon
