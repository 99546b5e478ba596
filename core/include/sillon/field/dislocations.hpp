// Where beads must begin or end, and how many such places the directions force.
#pragma once

#include <cstdint>

namespace sillon {

struct Dislocations {
  /// Sum of the sizes of the waves' indices; each is a U-turn or two
  std::int64_t count = 0;
  std::int64_t singularities = 0;  ///< of the lines: places round which they turn by half a turn
  /// Estimate of the least count at one constant spacing: the integral of |div t| over the infill
  /// divided by 2 tau, t the bead direction smoothed over 2 tau and |div t| at most 1/(2 tau).
  /// Beads tau apart end at a rate of div t/tau, and one dislocation ends two of them. Spacing that
  /// bends can do with less.
  double bound = 0;
  /// Estimate of the U-turns at the border or at the innermost perimeter: the integral of |t . n|
  /// along it divided by 2 tau, n its normal. Beads that meet it end there, and each U-turn joins
  /// two.
  double borderTurns = 0;
};

}  // namespace sillon
