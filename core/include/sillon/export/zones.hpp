// The field of directions cut into a few zones of one direction each, for slicers that lay straight
// lines only.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/export/base_solid.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/input/plate_input.hpp"

namespace sillon {

struct ZoneParams {
  int most = 6;      ///< zones of different directions, 2..12; parts of one direction count once
  double least = 3;  ///< narrowest place of a zone within the shape [mm], 0.5..100
};

/// Where the lines run one way; may be of several parts.
struct DirectionZone {
  double degrees = 0;  ///< 0 <= degrees < 180, counter-clockwise from +x, whole tenths
  double areaMm2 = 0;  ///< within the shape
  /// On the page, inside on their left; beyond the shape they go on to 1 mm off the page
  std::vector<Ring> rings;
};

/// Together they cover the page and a border of 1 mm; no two overlap.
struct DirectionZones {
  std::vector<DirectionZone> zones;  ///< by angle
  int found = 0;  ///< directions that differ, of which the zones are those with wide enough places
  double error = 0;  ///< mean angle between the map and the zones, over the shape [degrees]
};

/// Cuts directions into zones of one direction each, nearest to the map's in the mean square. Then
/// borders are evened; what is narrower than `least` goes to its neighbours. The same bytes for the
/// same arguments.
/// \return InvalidArgument, EmptyShape or Cancelled.
Result<DirectionZones> directionZones(const Shape& shape, const DirectionMap& directions,
                                      const ZoneParams& params, const RunContext& run);

/// Makes a 3MF of the body and one modifier per zone. Each modifier has the angle of its zone:
/// fill_angle (PrusaSlicer), infill_direction (Bambu Studio, OrcaSlicer), solid_infill_direction
/// and top_layer_direction (OrcaSlicer), and for tops the pattern "aligned rectilinear", whose
/// lines all three slicers lay in that direction on every layer. In PrusaSlicer's form, which all
/// three open. Zones reach 2 mm or 8 layers below each level top and each gentle slope; where that
/// takes more than 400,000 triangles, through the whole body. \param corner  of the zones' page on
/// the bed [mm]. \param layerHeight  that the slicer is told [mm], 0.01..2. \param face  height of
/// the top that they are for alone [mm]; unset: they are for all. \return InvalidArgument or
/// TooLarge.
Result<std::string> zones3mf(const Mesh& body, const DirectionZones& zones, Vec2 corner,
                             double layerHeight, std::optional<double> face = {});

/// The shape less its holes in height: a prism from the bed up.
/// \param height  [mm], 0.05..5000.
/// \return EmptyShape, InvalidFile or TooLarge.
Result<Mesh> prismOf(const Shape& shape, double height);

/// STL, as bytes or as text.
/// \return InvalidFile; TooLarge for more than 10 million triangles.
Result<Mesh> readStl(std::string_view bytes);

/// Edges that an odd number of triangles share: 0 for closed bodies.
std::size_t openEdges(const Mesh& mesh);

/// The body as seen from above, on a page as large as its box.
/// \param corner  receives the page's place on the bed.
/// \return EmptyShape or TooLarge.
Result<Shape> silhouetteOf(const Mesh& body, Vec2& corner);

}  // namespace sillon
