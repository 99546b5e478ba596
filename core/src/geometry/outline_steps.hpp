// The steps of resolveOutline: from paths in any order to edges with the inside on their left.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "geometry/winding.hpp"
#include "sillon/geometry/outline.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

enum class Points { AsGiven, OnGrid };  ///< mm as they are, or whole steps of the grid

/// The pieces with inside on exactly one side, on their left. No pieces if nothing is inside.
/// \param rule  null: inside is where any path is filled. \return TooLarge as resolveOutline.
Result<Outline> borderOf(const std::vector<FilledPath>& paths, const InsideRule* rule, Points points);

/// For each path 1 if it lies within one of the largest convex paths, so that all of them together are the same without
/// it; of equal paths one stays. \return as many as there are paths.
std::vector<char> coveredPaths(const std::vector<FilledPath>& paths);

inline constexpr double kTouch = 1e-7;  ///< points nearer than this coincide [mm]

/// The nearest point of the grid, of a point in its steps.
inline Vec2 onGrid(Vec2 p) { return {std::round(p.x) + 0.0, std::round(p.y) + 0.0}; }

/// The edges in pieces that meet at their ends only. Every ring stays closed.
/// \param box     that holds them
/// \param points  on the grid, edges and pieces are in whole steps of it
/// \return none if there are more than 4 million pieces, or that would take too long.
std::optional<std::vector<PathEdge>> splitEdges(const std::vector<PathEdge>& edges, const Bounds& box, Points points);

/// Tells for both sides of a piece, seen from a to b, whether the inside lies there.
struct Sides {
  bool left = false;
  bool right = false;
};

/// \param pieces  of the edges of paths, meeting at their ends only; box holds them
/// \param rule    null: inside is where any path is filled
/// \return of each piece; of those with the same ends, the first one's are told and the others have no inside on
///         either. None if that would take too long.
std::optional<std::vector<Sides>> sidesOf(const std::vector<PathEdge>& pieces, const Bounds& box,
                                          const std::vector<FilledPath>& paths, const InsideRule* rule);

}  // namespace sillon
