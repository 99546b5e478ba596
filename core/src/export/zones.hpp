// Cuts directions into zones of one direction each, and writes a body with them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/export/export.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/input/plate_input.hpp"

namespace sillon {

/// Cuts directions into zones of one direction each, nearest to the map in the mean square. Their
/// borders are then evened, and parts narrower than `least` go to their neighbours. The same
/// arguments give the same bytes.
/// \return InvalidArgument, EmptyShape or Cancelled.
Result<DirectionZones> directionZones(const Shape& shape, const DirectionMap& directions, const ZoneParams& params,
                                      const RunContext& run);

/// Writes a 3MF of the body with one modifier per zone, in PrusaSlicer's form, which PrusaSlicer,
/// Bambu Studio and OrcaSlicer open. Each modifier sets the angle of its zone: fill_angle
/// (PrusaSlicer), infill_direction (Bambu Studio, OrcaSlicer), solid_infill_direction and
/// top_layer_direction (OrcaSlicer). For tops it sets the pattern "aligned rectilinear", whose
/// lines all three slicers lay in that direction on every layer. Zones reach 2 mm or 8 layers below
/// each level top and each gentle slope; where that takes more than 400,000 triangles, they reach
/// through the whole body.
/// \param corner  corner of the zones' page on the bed [mm].
/// \param layerHeight  layer height that the slicer is told [mm], 0.01..2.
/// \param face  height of the only top that gets zones [mm]; unset: all tops get them.
/// \return InvalidArgument or TooLarge.
Result<std::string> zones3mf(const Mesh& body, const DirectionZones& zones, Vec2 corner, double layerHeight,
                             std::optional<double> face = {});

/// Makes a prism of the shape, its holes cut out, from the bed up.
/// \param height  height of the prism [mm], 0.05..5000.
/// \return EmptyShape, InvalidFile or TooLarge.
Result<Mesh> prismOf(const Shape& shape, double height);

/// Reads an STL, binary or as text.
/// \return InvalidFile; TooLarge for more than 10 million triangles.
Result<Mesh> readStl(std::string_view bytes);

/// Counts the edges that an odd number of triangles share: 0 for closed bodies.
std::size_t openEdges(const Mesh& mesh);

/// Returns the shape of a body as seen from above, on a page as large as its box.
/// \param corner  receives the page's place on the bed.
/// \return EmptyShape or TooLarge.
Result<Shape> silhouetteOf(const Mesh& body, Vec2& corner);

}  // namespace sillon
