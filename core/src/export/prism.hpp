// Prisms over triangulated outlines.
#pragma once

#include <vector>

#include "geometry/triangulate.hpp"
#include "sillon/export/base_solid.hpp"
#include "sillon/geometry/outline.hpp"

namespace sillon {

using PrismPoint = Vec2T<std::int64_t>;  ///< [µm]
using PrismRings = std::vector<std::vector<std::uint32_t>>;

/// Rings of an outline on the grid of 1 µm, inside on their left. What lies on each other in opposite directions there
/// bounds nothing; what does not close is left out. \param points  receives the rings' points.
PrismRings ringsOn(const Outline& outline, PrismPoint offset, std::vector<PrismPoint>& points);

/// Appends the prism between two heights [mm]. \param flat  of `points`.
void addPrism(const Triangulation& flat, const std::vector<PrismPoint>& points, PrismPoint offset, double bottom,
              double top, Mesh& mesh);

}  // namespace sillon
