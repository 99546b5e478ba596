// Edges cut where they meet.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "geometry/border_of.hpp"
#include "geometry/winding.hpp"

namespace sillon {

inline constexpr double kTouch = 1e-7;  ///< points nearer than this coincide [mm]

/// The nearest point of the grid, of a point in its steps.
inline Vec2 onGrid(Vec2 p) { return {std::round(p.x) + 0.0, std::round(p.y) + 0.0}; }

/// The edges in pieces that meet at their ends only. Every ring stays closed.
/// \param box     that holds them
/// \param points  on the grid, edges and pieces are in whole steps of it
/// \return none if there are more than 4 million pieces, or that would take too long.
std::optional<std::vector<PathEdge>> splitEdges(const std::vector<PathEdge>& edges, const Bounds& box, Points points);

}  // namespace sillon
