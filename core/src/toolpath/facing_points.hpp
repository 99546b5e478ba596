// Points of different sets of curves that face each other across room without curves, however far.
#pragma once

#include <utility>
#include <vector>

#include "sillon/geometry/connected_parts.hpp"

namespace sillon {

/// The cell that holds p, or the first beside it that is of a part where that one lies outside.
std::size_t cellInPart(const Parts& parts, Vec2f p);

/// Pairs of points of different sets and one part between whose regions a border runs: every point spreads over the
/// cells of its part until it meets what another spread over, so that of two sets those that are nearest to each other
/// on a way within the part are among the pairs. Linear in the cells.
/// \param setOfPoint  -1: the point does not spread. \return each pair once, the lower index first, in ascending order.
std::vector<std::pair<int, int>> facingPoints(const Parts& parts, const std::vector<Vec2f>& points,
                                              const std::vector<int>& setOfPoint);

}  // namespace sillon
