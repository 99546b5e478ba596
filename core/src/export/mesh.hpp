// Solids as meshes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/triangulate.hpp"
#include "sillon/base/result.hpp"
#include "sillon/export/export.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

// Meshes as resources of a 3MF model.

/// The <resources> element, with the mesh as object 1. Coordinates are rounded to 0.001 mm, heights to 0.000001 mm.
std::string resourcesOf(const Mesh& mesh);

// Prisms over shapes.

using PrismPoint = Vec2T<std::int64_t>;  ///< [µm]
using PrismRings = std::vector<std::vector<std::uint32_t>>;

/// A shape in the plane, cut into triangles.
struct FlatBody {
  std::vector<PrismPoint> points;
  Triangulation triangulation;  ///< triangles and rings, as indices of points
};

/// Rounds a shape to 1 µm and cuts it into triangles that cover it once. \param offset  added to all points.
/// \return EmptyShape, or TooLarge if the outline is too entangled.
Result<FlatBody> flatBody(const Shape& shape, PrismPoint offset);

/// Appends the prism between two heights [mm]. \param flat  triangulation of `points`.
void addPrism(const Triangulation& flat, const std::vector<PrismPoint>& points, PrismPoint offset, double bottom,
              double top, Mesh& mesh);

/// Refuses a mesh that has a corner which is not a point of it, or a point that is not finite.
std::optional<Error> meshDefect(const Mesh& mesh);

}  // namespace sillon
