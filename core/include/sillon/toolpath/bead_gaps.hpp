// Room on either side of every point of a path (Eq. 16, taken separately to the left and to the right).
#pragma once

#include <vector>

#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/signed_distance.hpp"

namespace sillon {

/// Diameters of the smallest circles that touch the path at a point from the left or right and pass through a point of
/// another piece of path: for parallel neighbours their distance. The border counts as a neighbour at twice its
/// distance.
struct BeadGaps {
  std::vector<float> left;  ///< [mm], at most the cap
  std::vector<float> right;
  std::vector<char> tight;  ///< not 0 where the path may meet itself: another piece within 0.3 spacings, a sharp turn
};

/// Points of the same curve nearer than one spacing along it are not neighbours. Further ones are, so that a U-turn's
/// legs keep their distance from each other; round its tip the touching circle is the tip itself, as it should be.
/// (Leaving out 2.5 spacings lets the legs be pressed together: ten times the kinks.)
/// \param curves  points tau/4 apart.
/// \param cap     largest gap looked for [mm].
BeadGaps beadGaps(const ClosedCurves& curves, const BorderIndex& border, double spacing, float cap,
                  const RunContext& run);

}  // namespace sillon
