// Narrow places that the waves passed over: arms hardly wider than a bead.
#pragma once

#include <vector>

#include "sillon/grid.hpp"

namespace sillon {

/// Gives places near the border that no contour comes to a contour of their own: where a wave is positive all over an
/// arm hardly wider than a bead, its contours end at the arm's mouth. Such nodes of the lattice become negative.
/// \param nodes     lattice of the contour, cells of tau/4.
/// \param distance  at the nodes, exact within `spacing` of the border [mm].
/// \param spacing   tau [mm].
/// \param values    sine field at the nodes; negative inside of a contour.
void fillNarrowPlaces(const Grid& nodes, const std::vector<float>& distance, double spacing,
                      std::vector<float>& values);

}  // namespace sillon
