// Where beads must begin or end, and how many such places the directions force.
#pragma once

#include <cstdint>

#include "sillon/base/run_context.hpp"
#include "sillon/field/constraints.hpp"
#include "sillon/field/line_field.hpp"
#include "sillon/field/phase_field.hpp"
#include "sillon/geometry/signed_distance.hpp"
#include "sillon/settings/toolpath_params.hpp"

namespace sillon {

struct Dislocations {
  std::int64_t count = 0;          ///< of the waves: sum of the sizes of their indices; each is a U-turn or two
  std::int64_t singularities = 0;  ///< of the lines: places round which they turn by half a turn
  /// Estimate of the least count at one constant spacing: the integral of |div t| over the infill divided by 2 tau, t
  /// the bead direction smoothed over 2 tau and |div t| at most 1/(2 tau). Beads tau apart end at a rate of div t/tau,
  /// and one dislocation ends two of them. Spacing that bends can do with less.
  double bound = 0;
  /// Estimate of the U-turns at the border or at the innermost perimeter: the integral of |t . n| along it divided by
  /// 2 tau, n its normal. Beads that meet it end there, and each U-turn joins two.
  double borderTurns = 0;
};

/// Goes round every 2 x 2 block of unmasked cells: what the phase gains there is a whole number of turns, the index.
Dislocations findDislocations(const LineField& lines, const SineField& waves, const CellConstraints& cells,
                              const SignedDistanceField& sdf, const ToolpathParams& params, const RunContext& run);

}  // namespace sillon
