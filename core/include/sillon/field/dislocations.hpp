// Places at which beads begin or end, and estimates of how many the directions force.
#pragma once

#include <cstdint>

namespace sillon {

/// Counts of dislocations, and estimates of the least that the directions need.
struct Dislocations {
  /// Sum of the sizes of the waves' indices; each dislocation is a U-turn or two
  std::int64_t count = 0;
  /// Singularities of the lines: places round which they turn by half a turn
  std::int64_t singularities = 0;
  /// Estimate of the least count at one constant spacing: the integral of |div t| over the infill,
  /// divided by 2 tau, where t is the bead direction smoothed over 2 tau and |div t| is at most
  /// 1/(2 tau). Beads tau apart end at a rate of div t/tau, and one dislocation ends two of them.
  /// Varying spacing can do with less.
  double bound = 0;
  /// Estimate of the U-turns at the border or at the innermost perimeter: the integral of |t . n|
  /// along it, divided by 2 tau, where n is its normal. Beads that meet it end there, and each
  /// U-turn joins two of them.
  double borderTurns = 0;
};

}  // namespace sillon
