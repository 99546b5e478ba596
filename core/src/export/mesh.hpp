// Solids as meshes.
#pragma once

#include <string>
#include <vector>

#include "geometry/triangulate.hpp"
#include "sillon/base/result.hpp"
#include "sillon/export/base_solid.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

// A mesh as the resources of a 3MF model.

/// The <resources> element: the mesh as object 1, on a grid of 0.001 mm, heights 0.000001 mm.
std::string resourcesOf(const Mesh& mesh);

// Prisms over shapes.

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
