// Prisms over shapes.
#pragma once

#include <vector>

#include "geometry/triangulate.hpp"
#include "sillon/base/result.hpp"
#include "sillon/export/base_solid.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

using PrismPoint = Vec2T<std::int64_t>;  ///< [µm]
using PrismRings = std::vector<std::vector<std::uint32_t>>;

struct FlatBody {
  std::vector<PrismPoint> points;
  Triangulation triangulation;  ///< of the points
};

/// A shape on the grid of 1 µm, cut into triangles that cover it once. \param offset  added to all points.
/// \return EmptyShape, or TooLarge where that is too much work.
Result<FlatBody> flatBody(const Shape& shape, PrismPoint offset);

/// Appends the prism between two heights [mm]. \param flat  of `points`.
void addPrism(const Triangulation& flat, const std::vector<PrismPoint>& points, PrismPoint offset, double bottom,
              double top, Mesh& mesh);

}  // namespace sillon
