#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/decimal_text.hpp"
#include "export/mesh_xml.hpp"
#include "export/prism.hpp"
#include "export/zip.hpp"
#include "sillon/export/zones.hpp"

namespace sillon {
namespace {

constexpr double kBeyond = 1;           // [mm] below and above the body
constexpr double kLevelArea = 1;        // [mm²] of level tops that count
constexpr std::size_t kMostSlabs = 64;  // else the highest top decides for all

using Corner3 = std::array<double, 3>;

/// Between two heights all tops have angles of one kind.
struct Slab {
  double bottom = 0;
  double top = 0;
  bool turned = false;  ///< the slicer adds 90 degrees there
};

// \param z  of a top \param last  it is the highest: PrusaSlicer lays no layer whose middle it would be, others it does
bool isTurned(double z, const ZoneLayers& layers, bool last) {
  constexpr double kTie = 1e-4;
  const double index = (z - layers.firstHeight) / layers.height;  // of the layer, from 0
  return std::llround(last ? index - kTie : index + kTie) % 2 != 0;
}

// Below 0 where the triangles of a body face inwards.
double volumeOf(const Mesh& body) {
  double six = 0;
  for (const auto& t : body.triangles) {
    const Corner3& a = body.points[t[0]];
    const Corner3& b = body.points[t[1]];
    const Corner3& c = body.points[t[2]];
    six += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return six / 6;
}

// Upward faces by their height.
std::vector<double> levelTops(const Mesh& body) {
  const double outwards = volumeOf(body) < 0 ? -1 : 1;
  std::vector<std::pair<std::int64_t, double>> faces;  // [µm], [mm²]
  for (const auto& t : body.triangles) {
    const Corner3& a = body.points[t[0]];
    const Corner3& b = body.points[t[1]];
    const Corner3& c = body.points[t[2]];
    if (std::abs(a[2] - b[2]) > 1e-3 || std::abs(a[2] - c[2]) > 1e-3) continue;
    const double area = outwards * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
    if (area > 0) faces.emplace_back(std::llround(1000 * a[2]), area);
  }
  std::sort(faces.begin(), faces.end());
  std::vector<double> tops;
  double area = 0;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    area += faces[k].second;
    if (k + 1 < faces.size() && faces[k + 1].first <= faces[k].first + 1) continue;
    if (area >= kLevelArea) tops.push_back(static_cast<double>(faces[k].first) / 1000);
    area = 0;
  }
  return tops;
}

std::vector<Slab> slabsOf(const Mesh& body, const ZoneLayers& layers) {
  double low = body.points.front()[2];
  double high = low;
  for (const Corner3& p : body.points) {
    low = std::min(low, p[2]);
    high = std::max(high, p[2]);
  }
  std::vector<double> tops = levelTops(body);
  if (tops.empty() || tops.back() < high) tops.push_back(high);
  std::vector<Slab> slabs;
  for (const double z : tops) {
    const bool turned = isTurned(z - low, layers, z >= high);
    if (!slabs.empty() && slabs.back().turned == turned) {
      slabs.back().top = z;
    } else {
      slabs.push_back({slabs.empty() ? low - kBeyond : slabs.back().top, z, turned});
    }
  }
  if (slabs.size() > kMostSlabs) slabs = {{low - kBeyond, high, isTurned(high - low, layers, true)}};
  slabs.back().top = high + kBeyond;
  return slabs;
}

std::string metadata(const char* type, const char* key, const std::string& value) {
  return "   <metadata type=\"" + std::string(type) + "\" key=\"" + key + "\" value=\"" + value + "\"/>\n";
}

constexpr double kLeastHeight = 0.05;  // [mm]
constexpr double kMostHeight = 5000;   // [mm]

struct Volume {
  std::string name;
  std::size_t first = 0;  ///< triangle
  std::size_t last = 0;
  std::string settings;
  bool modifier = false;
};

}  // namespace

Result<Mesh> prismOf(const Shape& shape, double height) {
  if (!(height >= kLeastHeight && height <= kMostHeight))
    return Error{ErrorCode::InvalidArgument, outOfRange("height", height, " mm", "0.05 to 5000 mm")};
  const Result<FlatBody> flat = flatBody(shape, {});
  if (!flat) return flat.error();
  Mesh mesh;
  addPrism(flat.value().triangulation, flat.value().points, {}, 0, height, mesh);
  return mesh;
}

Result<Shape> silhouetteOf(const Mesh& body, Vec2& corner) {
  constexpr double kCells = 4e6;
  Bounds box;
  for (const Corner3& p : body.points) box.add({p[0], p[1]});
  const Vec2 size = box.size();
  if (!(size.x > 0 && size.y > 0)) return Error{ErrorCode::EmptyShape, "the body is flat; there is nothing to see"};
  const double cell = std::max(0.05, std::sqrt(size.x * size.y / kCells));
  Image mask;
  mask.width = static_cast<int>(std::ceil(size.x / cell));
  mask.height = static_cast<int>(std::ceil(size.y / cell));
  mask.channels = 1;
  // How many triangles more than at the pixel to the left lie at each: one that is large takes no longer for it.
  const auto stride = static_cast<std::size_t>(mask.width) + 1;
  std::vector<std::int32_t> more(stride * static_cast<std::size_t>(mask.height), 0);
  const double pitch = size.x / mask.width;
  for (const auto& t : body.triangles) {
    std::array<Vec2, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = Vec2{body.points[t[k]][0], body.points[t[k]][1]} - box.min;
    const auto [low, high] = std::minmax({p[0].y, p[1].y, p[2].y});
    const int first = std::max(0, static_cast<int>(std::ceil(low / pitch - 0.5)));
    const int last = std::min(mask.height - 1, static_cast<int>(std::floor(high / pitch - 0.5)));
    for (int row = first; row <= last; ++row) {
      const double y = (row + 0.5) * pitch;
      double from = 1e30;
      double to = -1e30;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 a = p[k];
        const Vec2 b = p[(k + 1) % 3];
        if ((a.y > y) == (b.y > y)) continue;
        const double x = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
        from = std::min(from, x);
        to = std::max(to, x);
      }
      if (from > to) continue;  // a corner at most
      const int left = std::max(0, static_cast<int>(std::ceil(from / pitch - 0.5)));
      const int right = std::min(mask.width - 1, static_cast<int>(std::floor(to / pitch - 0.5)));
      if (left > right) continue;
      std::int32_t* const at = more.data() + static_cast<std::size_t>(mask.height - 1 - row) * stride;
      ++at[left];
      --at[right + 1];
    }
  }
  mask.samples.reserve(static_cast<std::size_t>(mask.width) * static_cast<std::size_t>(mask.height));
  for (std::size_t row = 0; row < more.size(); row += stride) {
    std::int32_t here = 0;
    for (std::size_t x = 0; x + 1 < stride; ++x) {
      here += more[row + x];
      mask.samples.push_back(here > 0 ? 65535 : 0);
    }
  }
  corner = box.min;
  return shapeFromMask(mask, size.x);
}

Result<std::string> zones3mf(const Mesh& body, const DirectionZones& zones, Vec2 corner, const ZoneLayers& layers) {
  for (const double height : {layers.height, layers.firstHeight}) {
    if (!(height >= 0.01 && height <= 2)) {
      return Error{ErrorCode::InvalidArgument, outOfRange("layer height", height, " mm", "0.01 to 2 mm")};
    }
  }
  if (body.triangles.empty()) return Error{ErrorCode::InvalidArgument, "the body has no triangles"};
  Mesh mesh = body;
  std::vector<Volume> volumes{{"body", 0, body.triangles.size() - 1, {}, false}};
  const PrismPoint offset{std::llround(1000 * corner.x), std::llround(1000 * corner.y)};
  for (const Slab& slab : slabsOf(body, layers)) {
    for (const DirectionZone& zone : zones.zones) {
      std::vector<PrismPoint> points;
      PrismRings rings;
      for (const Ring& ring : zone.rings) {
        std::vector<std::uint32_t>& indices = rings.emplace_back();
        for (const Vec2 p : ring) {
          indices.push_back(static_cast<std::uint32_t>(points.size()));
          points.push_back({std::llround(1000 * p.x), std::llround(1000 * p.y)});
        }
      }
      const Triangulation flat = triangulate(points, rings);
      if (!flat.complete || flat.triangles.empty()) {
        return Error{ErrorCode::TooLarge,
                     "a zone is too entangled to cut into triangles; fewer or wider zones are not"};
      }
      Volume volume{"zone " + decimal(zone.degrees, 1), mesh.triangles.size(), 0, {}, true};
      addPrism(flat, points, offset, slab.bottom, slab.top, mesh);
      volume.last = mesh.triangles.size() - 1;
      const double given = std::fmod(zone.degrees + (slab.turned ? 90 : 0), 180);
      for (const char* key : {"fill_angle", "infill_direction", "solid_infill_direction"}) {
        volume.settings += metadata("volume", key, decimal(given, 1));
      }
      volume.settings += metadata("volume", "top_layer_direction", decimal(zone.degrees, 1));
      for (const char* key : {"top_fill_pattern", "top_surface_pattern"}) {
        volume.settings += metadata("volume", key, "monotonic");
      }
      volumes.push_back(std::move(volume));
    }
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
  config += metadata("object", "name", "zones") + metadata("object", "layer_height", decimal(layers.height, 3));
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
