// Zones of straight lines: what they cover, that they neither overlap nor become slivers, and how PrusaSlicer lays
// them.
#include "sillon/export/export.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "export/packing.hpp"
#include "export/zip.hpp"
#include "export/zone_parts.hpp"
#include "export/zones.hpp"
#include "geometry/outline.hpp"

using namespace sillon;
using doctest::Approx;

namespace {

std::uint16_t texel(double degrees) {
  const double turned = std::fmod(degrees + 90 + 360, 180);
  return static_cast<std::uint16_t>(std::lround(turned / 180 * 65535));
}

/// \param degrees  of a place on a page of 1 x 1, y up.
template <class Degrees>
DirectionMap mapOf(int size, Degrees degrees) {
  DirectionMap map;
  map.width = map.height = size;
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column)
      map.angle.push_back(texel(degrees(Vec2{(column + 0.5) / size, 1 - (row + 0.5) / size})));
  }
  return map;
}

DirectionMap rings() {
  return mapOf(128, [](Vec2 p) { return std::atan2(p.y - 0.5, p.x - 0.5) / std::numbers::pi * 180 + 90; });
}

double between(double a, double b) {
  const double d = std::fmod(std::abs(a - b), 180);
  return std::min(d, 180 - d);
}

bool inside(const std::vector<Ring>& rings, Vec2 p) {
  bool in = false;
  for (const Ring& ring : rings) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec2 a = ring[k];
      const Vec2 b = ring[(k + 1) % ring.size()];
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) in = !in;
    }
  }
  return in;
}

double areaOf(const std::vector<Ring>& rings) {
  double sum = 0;
  for (const Ring& ring : rings) {
    for (std::size_t k = 0; k < ring.size(); ++k) sum += cross(ring[k], ring[(k + 1) % ring.size()]) / 2;
  }
  return sum;
}

/// Every place of the page lies in one zone, and their areas are that of the page and its border.
void checkTiling(const DirectionZones& zones, Vec2 page) {
  double all = 0;
  for (const DirectionZone& zone : zones.zones) {
    CHECK(areaOf(zone.rings) > 0);  // inside on their left
    all += areaOf(zone.rings);
  }
  CHECK(all == Approx((page.x + 2) * (page.y + 2)).epsilon(0.01));
  int wrong = 0;
  for (int k = 0; k < 4000; ++k) {
    const Vec2 p{page.x * std::fmod(0.618034 * k, 1.0), page.y * std::fmod(0.754878 * k, 1.0)};
    int found = 0;
    for (const DirectionZone& zone : zones.zones) found += inside(zone.rings, p) ? 1 : 0;
    wrong += found == 1 ? 0 : 1;
  }
  CHECK(wrong == 0);
}

/// The widest disc around each place that lies in its zone, or beyond the shape: its middle may be beside the place.
/// \return the share of places that no disc of this diameter within their zone covers.
double sliverShare(const DirectionZones& zones, const Shape& shape, double diameter) {
  constexpr double kStep = 0.25;
  const int nx = static_cast<int>(shape.page.x / kStep);
  const int ny = static_cast<int>(shape.page.y / kStep);
  const auto rows = insideIntervals(shape, kStep / 2, kStep, ny);
  std::vector<int> label(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny), -1);
  const auto at = [&](int x, int y) -> int& {
    return label[static_cast<std::size_t>(y) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(x)];
  };
  for (int y = 0; y < ny; ++y) {
    for (int x = 0; x < nx; ++x) {
      const Vec2 p{(x + 0.5) * kStep, (y + 0.5) * kStep};
      const bool in = std::any_of(rows[y].begin(), rows[y].end(),
                                  [&](const Interval& span) { return p.x >= span.begin && p.x < span.end; });
      for (std::size_t k = 0; in && k < zones.zones.size(); ++k) {
        if (inside(zones.zones[k].rings, p)) at(x, y) = static_cast<int>(k);
      }
    }
  }
  const int reach = static_cast<int>(diameter / 2 / kStep);
  const auto around = [&](int x, int y, auto&& each) {
    for (int v = -reach; v <= reach; ++v) {
      for (int u = -reach; u <= reach; ++u) {
        if (u * u + v * v > reach * reach || x + u < 0 || y + v < 0 || x + u >= nx || y + v >= ny) continue;
        each(x + u, y + v);
      }
    }
  };
  std::vector<char> covered(label.size(), 0);
  for (int y = 0; y < ny; ++y) {
    for (int x = 0; x < nx; ++x) {
      if (at(x, y) < 0) continue;
      bool fits = true;
      around(x, y, [&](int u, int v) { fits = fits && (at(u, v) < 0 || at(u, v) == at(x, y)); });
      if (!fits) continue;
      around(x, y, [&](int u, int v) {
        covered[static_cast<std::size_t>(v) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(u)] = 1;
      });
    }
  }
  double all = 0;
  double slivers = 0;
  for (std::size_t k = 0; k < label.size(); ++k) {
    all += label[k] >= 0 ? 1 : 0;
    slivers += label[k] >= 0 && covered[k] == 0 ? 1 : 0;
  }
  return slivers / all;
}

Mesh boxMesh(std::array<double, 3> low, std::array<double, 3> high) {
  Mesh mesh;
  for (int k = 0; k < 8; ++k) {
    mesh.points.push_back(
        {(k & 1) != 0 ? high[0] : low[0], (k & 2) != 0 ? high[1] : low[1], (k & 4) != 0 ? high[2] : low[2]});
  }
  const std::array<std::array<std::uint32_t, 4>, 6> faces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}}};
  for (const auto& f : faces) {
    mesh.triangles.push_back({f[0], f[1], f[2]});
    mesh.triangles.push_back({f[0], f[2], f[3]});
  }
  return mesh;
}

std::string partOf(const std::string& package, const char* name) {
  const ZipDirectory directory = readZip(package).value();
  for (const ZipEntry& entry : directory.entries) {
    if (entry.name == name) return unpackEntry(package, entry, std::size_t{1} << 26).value();
  }
  return {};
}

/// The values of an attribute, in order.
std::vector<std::string> valuesOf(const std::string& xml, const std::string& before) {
  std::vector<std::string> all;
  for (std::size_t at = xml.find(before); at != std::string::npos; at = xml.find(before, at)) {
    at += before.size();
    all.push_back(xml.substr(at, xml.find('"', at) - at));
  }
  return all;
}

DirectionZones zonesOf(const Shape& shape, const DirectionMap& map, int most = 6, double least = 3) {
  const RunContext run(1);
  const auto zones = directionZones(shape, map, {most, least}, run);
  REQUIRE(zones);
  return zones.value();
}

}  // namespace

TEST_CASE("one direction is one zone, two are two with their border where they meet") {
  const Shape shape = makeRectangle({40, 20}).value();
  const DirectionZones one = zonesOf(shape, uniformDirection(33).value());
  REQUIRE(one.zones.size() == 1);
  CHECK(one.zones[0].degrees == Approx(33));
  CHECK(one.zones[0].areaMm2 == Approx(800).epsilon(0.02));
  CHECK(one.error < 0.05);
  checkTiling(one, shape.page);

  const DirectionZones two = zonesOf(shape, mapOf(64, [](Vec2 p) { return p.x < 0.25 ? 10 : 100; }));
  REQUIRE(two.zones.size() == 2);
  CHECK(two.zones[0].degrees == Approx(10));
  CHECK(two.zones[1].degrees == Approx(100));
  CHECK(two.zones[0].areaMm2 == Approx(200).epsilon(0.03));
  CHECK(two.error < 0.05);
  checkTiling(two, shape.page);
  for (const Vec2 p : two.zones[0].rings[0]) CHECK(p.x <= 10.2);
}

TEST_CASE("a turning field is cut into as many zones as allowed, as near as they can be") {
  const Shape disc = makeDisc(60).value();
  for (const int most : {2, 6, 12}) {
    const DirectionZones zones = zonesOf(disc, rings(), most, 2);
    CAPTURE(most);
    CHECK(zones.zones.size() == static_cast<std::size_t>(most));
    // Evenly cut, the mean error is a quarter of a zone's share of half a turn.
    CHECK(zones.error >= 45.0 / most - 0.1);
    CHECK(zones.error <= 1.25 * 45.0 / most);
    checkTiling(zones, disc.page);
    CHECK(sliverShare(zones, disc, 0.7 * 2) < 0.01);
    double all = 0;
    for (const DirectionZone& zone : zones.zones) all += zone.areaMm2;
    CHECK(all == Approx(std::numbers::pi * 900).epsilon(0.01));
  }
}

TEST_CASE("noise makes no slivers") {
  const Shape shape = makeRectangle({50, 40}).value();
  std::uint32_t seed = 7;
  const DirectionMap noise = mapOf(100, [&](Vec2 p) {
    seed = seed * 1664525 + 1013904223;
    return 60 * p.x + (seed >> 16) % 140;
  });
  const DirectionZones zones = zonesOf(shape, noise, 8, 3);
  checkTiling(zones, shape.page);
  CHECK(sliverShare(zones, shape, 0.7 * 3) < 0.01);
  for (const DirectionZone& zone : zones.zones) CHECK(zone.areaMm2 >= 8);
}

TEST_CASE("what makes no zones is refused") {
  const RunContext run(1);
  const Shape shape = makeRectangle({10, 10}).value();
  const DirectionMap map = uniformDirection(0).value();
  CHECK(directionZones(shape, map, {1, 3}, run).error().message == "zones is 1; it must be 2 to 12");
  CHECK_FALSE(directionZones(shape, map, {13, 3}, run));
  CHECK_FALSE(directionZones(shape, map, {6, 0}, run));
  CHECK_FALSE(directionZones(shape, {}, {}, run));
  CHECK(
      directionZones(shape, {300, 300, {}}, {}, run).error().message ==
      "the map of directions is 300 x 300 pixels with 0 values; it must have a pixel at least, and one value for each");
  CHECK(directionZones(Shape{{}, {10, 10}}, map, {}, run).error().code == ErrorCode::EmptyShape);
  for (const double height : {0.0, 0.04, 5001.0, HUGE_VAL, std::nan("")}) CHECK_FALSE(prismOf(shape, height));
  const DirectionZones zones = zonesOf(shape, map);
  CHECK_FALSE(zones3mf({}, zones, {}, 0.2));
  CHECK_FALSE(zones3mf(prismOf(shape, 1).value(), zones, {HUGE_VAL, 0}, 0.2));
  Mesh torn = prismOf(shape, 1).value();
  torn.triangles[3][1] = 99;
  CHECK(zones3mf(torn, zones, {}, 0.2).error().message ==
        "the mesh has a point that is not finite, or a triangle without three points of it");
  CHECK_FALSE(writeStl(torn));
  CHECK_FALSE(write3mf(torn));
  torn.triangles[3][1] = 0;
  torn.points[0][2] = std::nan("");
  CHECK(writeStl(torn).error().message ==
        "the mesh has a point that is not finite, or a triangle without three points of it");
  CHECK(zones3mf(prismOf(shape, 1).value(), zones, {}, 0).error().message ==
        "layerHeight is 0 mm; it must be 0.01 to 2 mm");
}

TEST_CASE("zones can be cancelled at any time, and tell their progress") {
  const Shape disc = makeDisc(60).value();
  const DirectionMap map = rings();
  std::vector<double> told;
  RunContext whole(1);
  whole.onProgress([&](std::string_view, double share) { told.push_back(share); });
  REQUIRE(directionZones(disc, map, {}, whole));
  REQUIRE(told.size() > 20);
  CHECK(std::is_sorted(told.begin(), told.end()));
  for (const double share : {0.0, 0.2, 0.6, 0.9}) {
    RunContext run(1);
    run.onProgress([&](std::string_view, double now) {
      if (now >= share) run.requestCancel();
    });
    const auto zones = directionZones(disc, map, {}, run);
    CAPTURE(share);
    REQUIRE_FALSE(zones);
    CHECK(zones.error().code == ErrorCode::Cancelled);
  }
}

TEST_CASE("the 3MF holds closed volumes, one behind the other, with the angles that slicers need") {
  const Shape shape = makeDisc(30).value();
  const DirectionZones zones = zonesOf(shape, rings(), 4);
  for (const double height : {1.0, 1.2}) {  // five layers, and six: slicers turn most patterns on every other one
    const std::string package = zones3mf(prismOf(shape, height).value(), zones, {20, 30}, 0.2).value();
    CHECK(package == zones3mf(prismOf(shape, height).value(), zones, {20, 30}, 0.2).value());
    const std::string config = partOf(package, "Metadata/Slic3r_PE_model.config");
    const std::string model = partOf(package, "3D/3dmodel.model");
    const auto first = valuesOf(config, "firstid=\"");
    const auto last = valuesOf(config, "lastid=\"");
    REQUIRE(first.size() == 5);
    const auto v1 = valuesOf(model, "v1=\"");
    const auto v2 = valuesOf(model, "v2=\"");
    const auto v3 = valuesOf(model, "v3=\"");
    CHECK(std::stoul(last.back()) + 1 == v1.size());
    for (std::size_t k = 0; k < 5; ++k) {
      if (k > 0) CHECK(std::stoul(first[k]) == std::stoul(last[k - 1]) + 1);
      std::map<std::pair<std::string, std::string>, int> edges;
      for (std::size_t t = std::stoul(first[k]); t <= std::stoul(last[k]); ++t) {
        for (const auto& [a, b] : {std::pair{v1[t], v2[t]}, {v2[t], v3[t]}, {v3[t], v1[t]}}) {
          ++edges[{a, b}];
          --edges[{b, a}];
        }
      }
      int open = 0;
      for (const auto& [edge, sum] : edges) open += sum == 0 ? 0 : 1;
      CHECK(open == 0);
    }
    const auto fill = valuesOf(config, "key=\"fill_angle\" value=\"");
    REQUIRE(fill.size() == 4);
    for (std::size_t k = 0; k < 4; ++k) CHECK(std::stod(fill[k]) == Approx(zones.zones[k].degrees));
    for (const char* key : {"infill_direction", "solid_infill_direction", "top_layer_direction"}) {
      CHECK(valuesOf(config, "key=\"" + std::string(key) + "\" value=\"") == fill);
    }
    for (const char* key : {"top_fill_pattern", "top_surface_pattern"}) {
      CHECK(valuesOf(config, "key=\"" + std::string(key) + "\" value=\"") ==
            std::vector<std::string>(4, "alignedrectilinear"));
    }
  }
}

TEST_CASE("zones reach as deep as solid layers below each level top, and no deeper") {
  const Mesh tall = prismOf(makeDisc(20).value(), 10).value();
  const std::vector<Slab> one = slabsOf(tall, 0.2, 100);
  REQUIRE(one.size() == 1);
  CHECK(one[0].bottom == Approx(7.8));  // ten layers below the one of the top
  CHECK(one[0].top == Approx(11));
  const std::vector<Slab> thick = slabsOf(tall, 0.4, 100);
  REQUIRE(thick.size() == 1);
  CHECK(thick[0].bottom == Approx(10 - 9 * 0.4));  // eight
  const std::vector<Slab> thin = slabsOf(prismOf(makeDisc(20).value(), 1).value(), 0.2, 100);
  REQUIRE(thin.size() == 1);
  CHECK(thin[0].bottom == Approx(-1));

  // Two steps, of which the lower is in the middle of a layer wherever that begins.
  Mesh steps = boxMesh({0, 0, 0}, {10, 10, 4.1});
  const Mesh upper = boxMesh({10, 0, 0}, {20, 10, 12});
  for (auto triangle : upper.triangles) {
    for (std::uint32_t& point : triangle) point += 8;
    steps.triangles.push_back(triangle);
  }
  steps.points.insert(steps.points.end(), upper.points.begin(), upper.points.end());
  const std::vector<Slab> two = slabsOf(steps, 0.2, 100);
  REQUIRE(two.size() == 2);
  CHECK(two[0].bottom <= 4.1 - 2.2);
  CHECK(two[0].top >= 4.1);
  CHECK(two[0].top <= 4.3);
  CHECK(two[1].bottom == Approx(9.8));
  CHECK(slabsOf(steps, 0.2, 1).size() == 1);
  CHECK(slabsOf(steps, 0.2, 1)[0].bottom < 0);
  // For the lower step alone nothing is set at the height of the upper one.
  CHECK(slabUnder(4.1, 0.2).bottom == Approx(4.1 - 2.2));
  CHECK(slabUnder(4.1, 0.2).top == Approx(4.3));
  CHECK(slabUnder(12, 0.4).bottom == Approx(12 - 9 * 0.4));
  // A body whose triangles face inwards is printed all the same.
  for (auto& triangle : steps.triangles) std::swap(triangle[1], triangle[2]);
  CHECK(slabsOf(steps, 0.2, 100).size() == 2);
}

TEST_CASE("zones follow a gentle slope all the way, and no wall") {
  const auto wedge = [](double rise) {
    Mesh mesh = boxMesh({0, 0, 0}, {40, 20, 10});
    for (auto& point : mesh.points) point[2] += point[2] > 0 && point[0] > 0 ? rise : 0;
    return mesh;
  };
  const std::vector<Slab> slope = slabsOf(wedge(4), 0.2, 100);  // a layer each 2 mm
  REQUIRE(slope.size() == 1);
  CHECK(slope[0].bottom == Approx(7.8).epsilon(0.03));
  CHECK(slope[0].top == Approx(15));
  const std::vector<Slab> wall = slabsOf(wedge(30), 0.2, 100);  // its steps are 0.27 mm wide
  REQUIRE(wall.size() == 1);
  CHECK(wall[0].bottom == Approx(37.8));
}

TEST_CASE("STL is read as bytes and as text, and bodies are seen from above") {
  const Mesh box = boxMesh({1, 2, 0}, {11, 7, 3});
  const std::string bytes = writeStl(box).value();
  const Mesh read = readStl(bytes).value();
  CHECK(read.points.size() == 8);
  CHECK(read.triangles.size() == 12);
  std::ostringstream text;
  text << "solid box\n";
  for (const auto& t : box.triangles) {
    text << "facet normal 0 0 0\n outer loop\n";
    for (const std::uint32_t k : t)
      text << "  vertex " << box.points[k][0] << " " << box.points[k][1] << " " << box.points[k][2] << "e0\n";
    text << " endloop\nendfacet\n";
  }
  text << "endsolid box\n";
  const Mesh told = readStl(text.str()).value();
  CHECK(told.points == read.points);
  CHECK(told.triangles == read.triangles);
  // Programs begin with blanks, and name solids as they like.
  CHECK(readStl("\n " + text.str()).value().points == read.points);
  std::string named = text.str();
  named.replace(0, 9, "solid a vertex cover");
  CHECK(readStl(named).value().points == read.points);
  CHECK(openEdges(read) == 0);
  Mesh open = read;
  open.triangles.pop_back();
  CHECK(openEdges(open) == 3);
  Vec2 corner;
  const Shape seen = silhouetteOf(read, corner).value();
  CHECK(corner.x == Approx(1));
  CHECK(corner.y == Approx(2));
  CHECK(resolveOutline(seen).value().area == Approx(50).epsilon(0.01));
  for (std::size_t size = 0; size < bytes.size(); size += 7) CHECK_FALSE(readStl(bytes.substr(0, size)));
  const std::string whole = text.str();
  for (std::size_t size = 0; size < whole.rfind("endsolid") + 8; size += 7) CHECK_FALSE(readStl(whole.substr(0, size)));
  CHECK_FALSE(readStl("solid nothing\nendsolid\n"));
  CHECK_FALSE(readStl("solid x\nvertex 1 2\n"));
  CHECK_FALSE(readStl("solid x\nvertex 1 2 nan vertex 1 2 3 vertex 2 2 2\n"));
  CHECK_FALSE(silhouetteOf(boxMesh({0, 0, 0}, {0, 5, 5}), corner));
}

TEST_CASE("prusa-slicer lays the zones along their angles, to one degree, whatever its layers are") {
  if (std::system("command -v prusa-slicer >/dev/null 2>&1") != 0) {
    std::puts("skipped: zones that prusa-slicer slices; it is not installed");
    return;
  }
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / "sillon_zones_test";
  fs::create_directories(folder);
  const Shape shape = makeDisc(60).value();
  const DirectionZones zones = zonesOf(shape, rings(), 6);
  Mesh slope = boxMesh({0, 0, 0}, {60, 60, 3});
  for (auto& point : slope.points) point[2] += point[2] > 0 && point[0] > 0 ? 2 : 0;
  struct Case {
    const char* name;
    Mesh body;
    double layer;
    double first;
  };
  const Case cases[] = {{"five layers", prismOf(shape, 1).value(), 0.2, 0.2},
                        {"six layers", prismOf(shape, 1.2).value(), 0.2, 0.2},
                        {"a first layer of 0.35 mm", prismOf(shape, 2).value(), 0.2, 0.35},
                        {"a first layer of 0.4 mm", prismOf(shape, 2).value(), 0.16, 0.4},
                        {"a slope", slope, 0.2, 0.2},
                        {"a slope on a first layer of 0.3 mm", slope, 0.2, 0.3}};
  for (const Case& one : cases) {
    CAPTURE(one.name);
    const std::string package = zones3mf(one.body, zones, {0, 0}, one.layer).value();
    std::ofstream(folder / "zones.3mf", std::ios::binary) << package;
    const std::string command = "prusa-slicer --export-gcode --first-layer-height " + std::to_string(one.first) +
                                " --center 100,100 --output " + (folder / "zones.gcode").string() + " " +
                                (folder / "zones.3mf").string() + " >/dev/null 2>&1";
    REQUIRE(std::system(command.c_str()) == 0);
    std::ifstream in(folder / "zones.gcode");
    bool top = false;
    Vec2 at;
    double all = 0;
    double wrong = 0;
    std::vector<double> laid(zones.zones.size(), 0);
    for (std::string line; std::getline(in, line);) {
      if (line.starts_with(";TYPE:")) top = line == ";TYPE:Top solid infill";
      if (!line.starts_with("G1 X")) continue;
      Vec2 to = at;
      std::sscanf(line.c_str(), "G1 X%lf Y%lf", &to.x, &to.y);
      const Vec2 d = to - at;
      const Vec2 middle = 0.5 * (at + to) - Vec2{70, 70};  // on the page of 60 mm, centred at 100
      at = to;
      if (!top || line.find(" E") == std::string::npos || length(d) < 2) continue;
      all += length(d);
      for (std::size_t k = 0; k < zones.zones.size(); ++k) {
        if (!inside(zones.zones[k].rings, middle)) continue;
        laid[k] += length(d);
        if (between(std::atan2(d.y, d.x) / std::numbers::pi * 180, zones.zones[k].degrees) > 1) wrong += length(d);
      }
    }
    CHECK(all > 5000);
    CHECK(wrong == 0);
    for (const double mm : laid) CHECK(mm > 500);
    std::printf("prusa-slicer, %s: %.0f mm of straight top lines, %.0f mm off their zone's angle\n", one.name, all,
                wrong);
  }
  fs::remove_all(folder);
}
