#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/numbers.hpp"
#include "base/refused.hpp"
#include "export/mesh.hpp"
#include "export/zip.hpp"
#include "export/zone_parts.hpp"
#include "export/zones.hpp"
#include "sillon/export/export.hpp"

namespace sillon {
namespace {

constexpr double kFurthest = 10000;              // [mm], largest coordinate
constexpr std::size_t kMostTriangles = 400'000;  // triangles of all zones

std::string metadata(const char* type, const char* key, const std::string& value) {
  return "   <metadata type=\"" + std::string(type) + "\" key=\"" + key + "\" value=\"" + value + "\"/>\n";
}

// A volume of the package: a range of triangles, with its settings.
struct Volume {
  std::string name;
  std::size_t first = 0;  ///< index of its first triangle
  std::size_t last = 0;
  std::string settings;
  bool modifier = false;
};

// Cuts a zone into triangles.
FlatBody flatZone(const DirectionZone& zone) {
  FlatBody flat;
  PrismRings rings;
  for (const Ring& ring : zone.rings) {
    std::vector<std::uint32_t>& indices = rings.emplace_back();
    for (const Vec2 p : ring) {
      indices.push_back(static_cast<std::uint32_t>(flat.points.size()));
      flat.points.push_back({std::llround(1000 * p.x), std::llround(1000 * p.y)});
    }
  }
  flat.triangulation = triangulate(flat.points, rings);
  return flat;
}

}  // namespace

Result<std::string> zones3mf(const Mesh& body, const DirectionZones& zones, Vec2 corner, double layerHeight,
                             std::optional<double> face) {
  if (!(layerHeight >= 0.01 && layerHeight <= 2)) return outOfRange("layerHeight", layerHeight, 0.01, 2, "mm");
  if (body.triangles.empty()) return refusedArgument("NoTriangles");
  if (auto defect = meshDefect(body)) return *std::move(defect);
  for (const double place : {corner.x, corner.y, face.value_or(0)}) {
    if (!(std::abs(place) <= kFurthest)) return outOfRange("face", place, -kFurthest, kFurthest, "mm");
  }
  Mesh mesh = body;
  std::vector<Volume> volumes{{"body", 0, body.triangles.size() - 1, {}, false}};
  const PrismPoint offset{std::llround(1000 * corner.x), std::llround(1000 * corner.y)};
  std::vector<FlatBody> flats;
  std::size_t triangles = 0;
  for (const DirectionZone& zone : zones.zones) {
    const FlatBody& flat = flats.emplace_back(flatZone(zone));
    if (!flat.triangulation.complete || flat.triangulation.triangles.empty()) {
      return refused(ErrorCode::TooLarge, "ZoneEntangled");
    }
    triangles += 2 * (flat.triangulation.triangles.size() + flat.points.size());
  }
  const std::vector<Slab> slabs =
      face ? std::vector{slabUnder(*face, layerHeight)}
           : slabsOf(body, layerHeight, std::max<std::size_t>(1, kMostTriangles / std::max<std::size_t>(1, triangles)));
  for (std::size_t k = 0; k < flats.size(); ++k) {
    const std::string degrees = decimal(zones.zones[k].degrees, 1);
    Volume volume{"zone " + degrees, mesh.triangles.size(), 0, {}, true};
    for (const Slab& slab : slabs) {
      addPrism(flats[k].triangulation, flats[k].points, offset, slab.bottom, slab.top, mesh);
    }
    volume.last = mesh.triangles.size() - 1;
    for (const char* key : {"fill_angle", "infill_direction", "solid_infill_direction", "top_layer_direction"}) {
      volume.settings += metadata("volume", key, degrees);
    }
    // Other patterns turn by 90 degrees on every other layer, and only the slicer knows on which layer a top lies.
    for (const char* key : {"top_fill_pattern", "top_surface_pattern"}) {
      volume.settings += metadata("volume", key, "alignedrectilinear");
    }
    volumes.push_back(std::move(volume));
  }

  const std::string model = std::string(kXml) +
                            "<model unit=\"millimeter\" xml:lang=\"en-US\" "
                            "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
                            "xmlns:slic3rpe=\"http://schemas.slic3r.org/3mf/2017/06\">\n"
                            " <metadata name=\"slic3rpe:Version3mf\">1</metadata>\n"
                            " <metadata name=\"Application\">Sillon, in the form of PrusaSlicer</metadata>\n" +
                            resourcesOf(mesh) +
                            " <build>\n  <item objectid=\"1\" printable=\"1\"/>\n </build>\n</model>\n";

  std::string config = std::string(kXml) + "<config>\n <object id=\"1\" instances_count=\"1\">\n";
  config += metadata("object", "name", "zones") + metadata("object", "layer_height", decimal(layerHeight, 3));
  for (const Volume& volume : volumes) {
    config += "  <volume firstid=\"" + std::to_string(volume.first) + "\" lastid=\"" + std::to_string(volume.last) +
              "\">\n" + metadata("volume", "name", volume.name);
    if (volume.modifier) config += metadata("volume", "modifier", "1");
    config += metadata("volume", "volume_type", volume.modifier ? "ParameterModifier" : "ModelPart");
    config += volume.settings + "  </volume>\n";
  }
  config += " </object>\n</config>\n";
  Zip zip;
  addPackageParts(zip);
  zip.add("3D/3dmodel.model", model);
  zip.add("Metadata/Slic3r_PE_model.config", config);
  return zip.finish();
}

}  // namespace sillon
