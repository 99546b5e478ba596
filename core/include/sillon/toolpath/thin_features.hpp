// Thin features that the waves passed over: arms and parts hardly wider than a bead.
#pragma once

#include <vector>

#include "sillon/geometry/connected_parts.hpp"
#include "sillon/geometry/grid.hpp"
#include "sillon/geometry/signed_distance.hpp"

namespace sillon {

/// Gives places near the border that no contour comes to a contour of their own: where a wave is positive all over an
/// arm hardly wider than a bead, its contours end at the arm's mouth. Such nodes of the lattice become negative, and so
/// do those along the middle of lines up to 1.35 beads wide, which the lattice may have no node in that is deep enough.
/// \param nodes     lattice of the contour, cells of tau/4.
/// \param distance  at the nodes, exact within `spacing` of the border [mm].
/// \param spacing   tau [mm].
/// \param values    sine field at the nodes; negative inside of a contour.
void fillThinFeatures(const Grid& nodes, const std::vector<float>& distance, const BorderIndex& border, double spacing,
                      std::vector<float>& values);

/// Gives every part that can hold a bead a contour: where none of the others found it, the values at the cells in which
/// a bead has room become negative.
/// \param values  on the node lattice of the parts' grid.
void keepThinParts(const Parts& parts, const SignedDistanceField& sdf, const BorderIndex& border, double spacing,
                   std::vector<float>& values);

}  // namespace sillon
