// The steps of a round of relaxSpacing() other than evening out gaps.
#pragma once

#include <utility>
#include <vector>

#include "field/fields.hpp"
#include "geometry/closed_curves.hpp"
#include "geometry/signed_distance.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"

namespace sillon {

/// Scales the shares of a move by `factor` around the points that came to cross each other.
/// \param before,after  the same curves, each of about equal steps: a place is a share of the way round.
/// \param crossings  pairs of points of `after` at which the crossing segments begin.
/// \param reach  points of `before` on either side of a crossing, at most half of its curve.
/// \param share  share of each point of `before`.
void damp(const ClosedCurves& before, const ClosedCurves& after, const std::vector<std::pair<int, int>>& crossings,
          int reach, float factor, std::vector<float>& share);

/// Computes the moves that minimise, along each curve, the squared differences between its segments and segments as
/// long in the direction asked for, plus `pull` times the squared moves. Ends of segments that run more than 37 degrees
/// off, as in U-turns and joints, stay. \param pull  above 0; a move of one point is felt over 1/sqrt(pull) points.
/// \return a move per point, at most half a spacing [mm].
std::vector<Vec2f> movesToLines(const ClosedCurves& curves, const LineField& lines, double spacing, float pull,
                                const RunContext& run);

/// Rounds turns by more than 56 degrees within tau/4: bends the fewest points around one by the least that takes it
/// below that. If bending seven points on either side does not suffice, the point is the tip of a U-turn whose legs lie
/// too near to each other, and is pulled back by up to three spacings. Points stay where that would make the path meet
/// itself or another, or bring it nearer to the border than tau/4 (0.18 tau where that does not help) and than it was
/// nearby.
/// \param curves  points about tau/4 apart; their number stays.
void roundKinks(ClosedCurves& curves, const BorderIndex& border, double spacing, const RunContext& run);

}  // namespace sillon
