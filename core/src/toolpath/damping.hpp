// Smaller moves where they would make a path meet itself.
#pragma once

#include <utility>
#include <vector>

#include "geometry/closed_curves.hpp"

namespace sillon {

/// Scales the shares of a move by `factor` around the points that came to cross each other.
/// \param before,after  the same curves, each of about equal steps: a place is a share of the way round.
/// \param crossings  pairs of points of `after`, where a crossing segment begins.
/// \param reach  how many points of `before` on either side of a crossing, at most half of its curve.
/// \param share  of each point of `before`.
void damp(const ClosedCurves& before, const ClosedCurves& after, const std::vector<std::pair<int, int>>& crossings,
          int reach, float factor, std::vector<float>& share);

}  // namespace sillon
