// Polygons with holes cut into triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sillon/base/types.hpp"

namespace sillon {

using Triangle = std::array<std::uint32_t, 3>;  ///< of points, counter-clockwise

struct Triangulation {
  std::vector<std::vector<std::uint32_t>> rings;  ///< those that were kept: all but holes that lie in nothing
  std::vector<Triangle> triangles;
  bool complete = true;  ///< false: it would have taken too long, and nothing is told
};

/// Cuts what lies to the left of closed rings into triangles between their points. However bad the rings are, each
/// triangle's edge that is no ring's edge belongs to one other triangle, in the opposite direction, and each edge of a
/// kept ring to one triangle, in its own direction: walls along the rings close the surface. Where the rings neither
/// cross nor overlap, the triangles do not either.
/// \param points  within 2^29 of the origin. \param rings  of at least 3 points; each point belongs to one ring, once.
Triangulation triangulate(const std::vector<Vec2T<std::int64_t>>& points,
                          const std::vector<std::vector<std::uint32_t>>& rings);

}  // namespace sillon
