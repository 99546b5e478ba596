// Room on either side of every point of a path (Eq. 16, taken separately to the left and to the right).
#pragma once

#include <vector>

#include "sillon/run_context.hpp"
#include "sillon/sdf.hpp"
#include "sillon/types.hpp"

namespace sillon {

/// Diameters of the smallest circles that touch the path at a point from the left or right and pass through a point of
/// another piece of path: for parallel neighbours their distance. The border counts as a neighbour at twice its distance.
struct NeighbourGaps {
  std::vector<float> left;   ///< [mm], at most the cap
  std::vector<float> right;
};

/// Pieces of the same curve nearer than 2.5 spacings along it are not neighbours: else every hairpin looks too thin.
/// \param curves  points about tau/4 apart. \param cap  largest gap looked for [mm].
NeighbourGaps neighbourGaps(const ClosedCurves& curves, const BorderIndex& border, double spacing, float cap,
                            const RunContext& run);

/// Unit tangent at a point: the chord between its neighbours on the curve; zero if they coincide.
Vec2f tangentAt(const ClosedCurves& curves, int curve, int point);

}  // namespace sillon
