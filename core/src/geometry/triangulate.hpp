// Cuts polygons with holes into triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sillon/base/types.hpp"

namespace sillon {

using Triangle = std::array<std::uint32_t, 3>;  ///< indices of points, counter-clockwise

struct Triangulation {
  std::vector<std::vector<std::uint32_t>> rings;  ///< the kept rings: all but holes outside of any ring
  std::vector<Triangle> triangles;
  bool complete = true;  ///< false if it would have taken too long; then the result is empty
};

/// Cuts the area to the left of closed rings into triangles between their points. Even for invalid rings, each edge of
/// a triangle that is no ring's edge belongs to exactly one other triangle, in the opposite direction, and each edge of
/// a kept ring to one triangle, in its own direction: walls along the rings close the surface. If the rings neither
/// cross nor overlap, the triangles do not either.
/// \param points  points within 2^29 of the origin.
/// \param rings  rings of at least 3 points; each point belongs to one ring, once.
Triangulation triangulate(const std::vector<Vec2T<std::int64_t>>& points,
                          const std::vector<std::vector<std::uint32_t>>& rings);

}  // namespace sillon
