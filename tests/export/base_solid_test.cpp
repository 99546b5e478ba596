#include "sillon/export/export.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "geometry/triangulate.hpp"
#include "sillon/geometry/shape.hpp"
#include "support/random_plates.hpp"
#include "support/scenes.hpp"

using namespace sillon;
using doctest::Approx;

namespace {

Ring box(double x, double y, double width, double height) {
  return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
}

Shape shapeOf(std::vector<Ring> rings, FillRule rule = FillRule::EvenOdd) {
  return {{{std::move(rings), rule}}, {60, 40}};
}

using Triple = std::array<double, 3>;

Triple minus(const Triple& a, const Triple& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Triple crossOf(const Triple& u, const Triple& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
double dotOf(const Triple& u, const Triple& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; }

// By the divergence theorem; above 0 only if the normals point outward.
double volume(const Mesh& mesh) {
  double sum = 0;
  const Triple origin = mesh.points[0];
  for (const auto& t : mesh.triangles) {
    sum += dotOf(minus(mesh.points[t[0]], origin),
                 crossOf(minus(mesh.points[t[1]], origin), minus(mesh.points[t[2]], origin))) /
           6;
  }
  return sum;
}

// Edges that are not shared by exactly two triangles in opposite directions. Bridges to holes may be walked twice.
int openEdges(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++count[{t[k], t[(k + 1) % 3]}];
  }
  int open = 0;
  for (const auto& [edge, times] : count) {
    const auto back = count.find({edge.second, edge.first});
    open += times != 1 || back == count.end() || back->second != 1 ? 1 : 0;
  }
  return open;
}

// Area of the top, all parts of which must look up: nothing is covered twice if it is the shape's.
double topArea(const Mesh& mesh, double top) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const bool flat = std::all_of(t.begin(), t.end(), [&](std::uint32_t k) { return mesh.points[k][2] == top; });
    if (!flat) continue;
    const Triple n = crossOf(minus(mesh.points[t[1]], mesh.points[t[0]]), minus(mesh.points[t[2]], mesh.points[t[0]]));
    CHECK(n[2] >= 0);
    sum += n[2] / 2;
  }
  return sum;
}

Mesh bodyOf(const Shape& shape, const PrintParams& params = {}) {
  Result<Mesh> mesh = baseBody(shape, Printer{}, params);
  REQUIRE_MESSAGE(mesh.ok(), mesh.error().message);
  return std::move(mesh).value();
}

double borderOf(const Outline& outline) {
  double sum = 0;
  for (const BorderSegment& piece : outline.segments) sum += length(piece.b - piece.a);
  return sum;
}

}  // namespace

TEST_CASE("a rectangle becomes a box of twelve triangles where the G-code puts it") {
  const Mesh mesh = bodyOf(shapeOf({box(0, 0, 60, 40)}));
  CHECK(mesh.points.size() == 8);
  CHECK(mesh.triangles.size() == 12);
  CHECK(openEdges(mesh) == 0);
  CHECK(volume(mesh) == Approx(60 * 40 * 0.4));
  for (const Triple& p : mesh.points) {
    CHECK((p[0] == 80 || p[0] == 140));
    CHECK((p[1] == 90 || p[1] == 130));
    CHECK((p[2] == 0 || p[2] == 0.4));
  }
}

TEST_CASE("volume is area times height, with holes, islands in them, touching corners and overlaps") {
  struct Case {
    const char* name;
    Shape shape;
    double area;
  };
  const Case cases[] = {
      {"hole", shapeOf({box(0, 0, 20, 20), box(5, 5, 10, 10)}), 300},
      {"island in a hole", shapeOf({box(0, 0, 20, 20), box(2, 2, 16, 16), box(8, 8, 4, 4)}), 400 - 256 + 16},
      {"four holes in a row",
       shapeOf({box(0, 0, 21, 5), box(1, 1, 4, 3), box(6, 1, 4, 3), box(11, 1, 4, 3), box(16, 1, 4, 3)}), 105 - 48},
      {"holes above each other",
       shapeOf({box(0, 0, 5, 21), box(1, 1, 3, 4), box(1, 6, 3, 4), box(1, 11, 3, 4), box(1, 16, 3, 4)}), 105 - 48},
      {"two squares that touch", shapeOf({box(0, 0, 5, 5), box(5, 5, 5, 5)}), 50},
      {"two holes that touch", shapeOf({box(0, 0, 20, 20), box(5, 5, 5, 5), box(10, 10, 5, 5)}), 350},
      {"a hole level with two that touch",
       shapeOf({box(0, 0, 20, 20),
                {{8, 10}, {10, 12}, {8, 14}, {6, 12}},
                {{8, 10}, {6, 8}, {8, 6}, {10, 8}},
                {{14, 10}, {16, 8}, {18, 10}, {16, 12}}}),
       400 - 24},
      {"a hole that touches the border", shapeOf({box(0, 0, 20, 20), {{0, 10}, {5, 5}, {5, 15}}}), 375},
      {"a bow tie", shapeOf({{{0, 0}, {10, 10}, {10, 0}, {0, 10}}}), 50},
      {"overlaps", shapeOf({box(0, 0, 10, 10), box(5, 5, 10, 10)}, FillRule::NonZero), 175},
      {"a comb",
       shapeOf({{{0, 0},
                 {10, 0},
                 {10, 9},
                 {9, 9},
                 {9, 1},
                 {7, 1},
                 {7, 9},
                 {6, 9},
                 {6, 1},
                 {4, 1},
                 {4, 9},
                 {3, 9},
                 {3, 1},
                 {1, 1},
                 {1, 9},
                 {0, 9}}}),
       10 + 4 * 8},
      {"points along straight sides",
       shapeOf({{{0, 0}, {3, 0}, {6, 0}, {10, 0}, {10, 5}, {10, 10}, {5, 10}, {0, 10}, {0, 1}}}), 100},
  };
  for (const Case& each : cases) {
    CAPTURE(each.name);
    const Mesh mesh = bodyOf(each.shape);
    CHECK(openEdges(mesh) == 0);
    CHECK(volume(mesh) == Approx(each.area * 0.4));
    CHECK(topArea(mesh, 0.4) == Approx(each.area));
  }
}

TEST_CASE("random shapes become closed bodies of their volume") {
  scenes::Random random(77);
  int bodies = 0;
  for (int k = 0; k < 400; ++k) {
    std::string name;
    const Shape shape = scenes::randomShape(random, name);
    CAPTURE(k);
    CAPTURE(name);
    const Result<Outline> outline = resolveOutline(shape);
    const Result<Mesh> mesh = baseBody(shape, Printer{}, {});
    CHECK((mesh.ok() || !outline.ok() || outline.value().area < 0.01));
    if (!mesh) continue;
    ++bodies;
    CHECK(openEdges(mesh.value()) == 0);
    const double slack = 0.001 * borderOf(outline.value());
    CHECK(std::abs(volume(mesh.value()) / 0.4 - outline.value().area) <= slack);
    double lookingUp = 0;
    for (const auto& t : mesh.value().triangles) {
      const Triple& a = mesh.value().points[t[0]];
      const Triple n = crossOf(minus(mesh.value().points[t[1]], a), minus(mesh.value().points[t[2]], a));
      if (a[2] == 0.4 && n[2] > 0) lookingUp += n[2] / 2;
    }
    CHECK(lookingUp <= outline.value().area + 2 * slack);  // next to nothing is covered twice
  }
  CHECK(bodies > 390);
}

TEST_CASE("discs that lie nearly on each other become one closed body without folds") {
  const auto disc = [](Vec2 centre, double turn) {
    Ring ring;
    for (int k = 0; k < 300; ++k) {
      const double angle = (k + turn) * 2 * 3.14159265358979 / 300;
      ring.push_back(centre + 15.0 * Vec2{std::cos(angle), std::sin(angle)});
    }
    return ring;
  };
  scenes::Random random(11);
  for (int round = 0; round < 60; ++round) {
    CAPTURE(round);
    Shape shape{{}, {60, 40}};
    for (int k = 0; k < 3; ++k) {
      const Vec2 centre{20 + 1e-6 * random.index(2000), 20 + 1e-6 * random.index(2000)};
      shape.paths.push_back({{disc(centre, random.index(100) / 100.0)}, FillRule::NonZero});
    }
    const Result<Outline> outline = resolveOutline(shape);
    REQUIRE(outline.ok());
    const Mesh mesh = bodyOf(shape);
    CHECK(openEdges(mesh) == 0);
    const double slack = 0.001 * borderOf(outline.value());
    CHECK(std::abs(topArea(mesh, 0.4) - outline.value().area) <= slack);
    CHECK(std::abs(volume(mesh) / 0.4 - outline.value().area) <= slack);
  }
}

TEST_CASE("holes that meet in one point, and one level with it, leave a closed body however they are turned") {
  const std::vector<std::vector<Ring>> drawings{
      {{{8, 10}, {11, 13}, {8, 13}}, {{8, 10}, {5, 13}, {5, 7}}, {{8, 10}, {8, 7}, {11, 7}}, box(14, 10, 3, 3)},
      {{{8, 10}, {11, 13}, {8, 13}}, {{8, 10}, {5, 13}, {5, 7}}, {{14, 10}, {16, 8}, {18, 10}, {16, 12}}},
      {{{8, 10}, {12, 12}, {12, 11}}, {{8, 10}, {12, 9}, {12, 8}}, box(14, 10, 3, 3), box(2, 10, 3, 3)},
      {{{8, 10}, {12, 13}, {12, 12}}, {{8, 10}, {12, 11}, {12, 9}}, {{8, 10}, {12, 8}, {12, 7}}, box(2, 8, 3, 2)},
  };
  for (std::size_t k = 0; k < drawings.size(); ++k) {
    for (int turn = 0; turn < 8; ++turn) {
      CAPTURE(k);
      CAPTURE(turn);
      std::vector<Ring> rings{box(0, 0, 20, 20)};
      double area = 400;
      for (const Ring& hole : drawings[k]) {
        Ring& ring = rings.emplace_back();
        double twice = 0;
        for (std::size_t i = 0; i < hole.size(); ++i) {
          twice += cross(hole[i], hole[(i + 1) % hole.size()]);
          Vec2 p = hole[i];
          if (turn & 1) p.x = 20 - p.x;
          if (turn & 2) p.y = 20 - p.y;
          if (turn & 4) std::swap(p.x, p.y);
          ring.push_back(p);
        }
        area -= std::abs(twice) / 2;
      }
      const Mesh mesh = bodyOf(shapeOf(rings));
      CHECK(openEdges(mesh) == 0);
      CHECK(topArea(mesh, 0.4) == Approx(area));
    }
  }
}

TEST_CASE("cells and halves of cells that touch in corners everywhere become one closed body of their area") {
  scenes::Random random(23);
  for (int round = 0; round < 200; ++round) {
    CAPTURE(round);
    Shape shape{{}, {60, 40}};
    double area = 0;
    for (int y = 0; y < 9; ++y) {
      for (int x = 0; x < 9; ++x) {
        Ring ring = box(3 * x, 3 * y, 3, 3);
        const int cut = random.index(8);  // 0 to 3: one corner is missing; 4, 5: empty; 6, 7: full
        if (cut == 4 || cut == 5) continue;
        if (cut < 4) ring.erase(ring.begin() + cut);
        area += cut < 4 ? 4.5 : 9;
        shape.paths.push_back({{ring}, FillRule::NonZero});
      }
    }
    const Mesh mesh = bodyOf(shape);
    CHECK(openEdges(mesh) == 0);
    CHECK(volume(mesh) == Approx(area * 0.4));
    CHECK(topArea(mesh, 0.4) == Approx(area));
  }
}

TEST_CASE("however bad the rings are, the triangles and walls close") {
  scenes::Random random(5);
  for (int round = 0; round < 300; ++round) {
    std::vector<Vec2T<std::int64_t>> points;
    std::vector<std::vector<std::uint32_t>> rings;
    for (int r = 1 + random.index(5); r > 0; --r) {
      rings.emplace_back();
      for (int k = 3 + random.index(20); k > 0; --k) {
        rings.back().push_back(static_cast<std::uint32_t>(points.size()));
        points.push_back({random.index(12), random.index(12)});
      }
    }
    const Triangulation flat = triangulate(points, rings);
    REQUIRE(flat.complete);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sum;  // of an edge forth, less back
    const auto walk = [&](std::uint32_t a, std::uint32_t b, int times) {
      sum[std::minmax(a, b)] += a < b ? times : -times;
    };
    for (const Triangle& t : flat.triangles) {
      for (std::size_t k = 0; k < 3; ++k) walk(t[k], t[(k + 1) % 3], 1);
    }
    for (const auto& ring : flat.rings) {
      for (std::size_t k = 0; k < ring.size(); ++k) walk(ring[k], ring[(k + 1) % ring.size()], -1);
    }
    CHECK(std::all_of(sum.begin(), sum.end(), [](const auto& edge) { return edge.second == 0; }));
  }
}

TEST_CASE("the body stands where the base layers do: below, above or between, in all copies, turned") {
  PrintParams params;
  params.layers = 2;
  params.base = 3;
  params.firstLayerHeight = 0.3;
  const Shape shape = shapeOf({box(0, 0, 60, 40)});
  const auto heights = [](const Mesh& mesh) {
    std::pair<double, double> z{1e9, -1e9};
    for (const Triple& p : mesh.points) z = {std::min(z.first, p[2]), std::max(z.second, p[2])};
    return z;
  };
  CHECK(heights(bodyOf(shape, params)).second == Approx(0.7));
  CHECK(heights(bodyOf(shape, params)).first == 0);
  params.showSide = ShowSide::Bed;
  CHECK(heights(bodyOf(shape, params)).first == Approx(0.5));
  CHECK(heights(bodyOf(shape, params)).second == Approx(1.1));
  params.showSide = ShowSide::Up;
  params.startHeight = 5;  // the base layers lie above a print, and the first of them is as high as all
  CHECK(heights(bodyOf(shape, params)).first == 5);
  CHECK(heights(bodyOf(shape, params)).second == Approx(5.6));
  params = {};
  params.copies = {2, 2};
  params.rotate = 90;
  const Mesh copies = bodyOf(shape, params);
  CHECK(openEdges(copies) == 0);
  CHECK(copies.triangles.size() == 48);
  CHECK(volume(copies) == Approx(4 * 60 * 40 * 0.4));
  Bounds plates;
  for (const Triple& p : copies.points) plates.add({p[0], p[1]});
  CHECK(plates.size().x == Approx(40 + 10 + 40));
  CHECK(plates.size().y == Approx(60 + 10 + 60));
  params = {};
  params.place = Vec2{7, 9};
  Bounds placed;
  for (const Triple& p : bodyOf(shape, params).points) placed.add({p[0], p[1]});
  CHECK((placed.min == Vec2{7, 9}));
}

TEST_CASE("what has no body says why") {
  PrintParams params;
  params.base = 0;
  const Shape shape = shapeOf({box(0, 0, 60, 40)});
  CHECK(baseBody(shape, Printer{}, params).error().message.find("print.base is 0; it must be at least 1") == 0);
  params.base = 2000;
  CHECK(baseBody(shape, Printer{}, params).error().message.find("print.base is 2000; it must be 0 to 1000") == 0);
  CHECK(baseBody({}, Printer{}, {}).error().code == ErrorCode::EmptyShape);
  CHECK(baseBody(shapeOf({box(0, 0, 0.0001, 0.0001)}), Printer{}, {}).error().code == ErrorCode::EmptyShape);
  CHECK(baseBody(shapeOf({{{0, 0}, {1e9, 0}, {0, 1}}}), Printer{}, {}).error().code == ErrorCode::InvalidArgument);
}

TEST_CASE("an STL holds the triangles with their outward normals") {
  const Mesh mesh = bodyOf(shapeOf({box(0, 0, 20, 20), box(5, 5, 10, 10)}));
  const std::string stl = writeStl(mesh).value();
  REQUIRE(stl.size() == 84 + 50 * mesh.triangles.size());
  CHECK(!stl.starts_with("solid"));
  std::uint32_t count = 0;
  std::memcpy(&count, stl.data() + 80, 4);
  CHECK(count == mesh.triangles.size());
  for (std::size_t k = 0; k < count; ++k) {
    float values[12];
    std::memcpy(values, stl.data() + 84 + 50 * k, sizeof values);
    Triple corners[3];
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        corners[c][axis] = static_cast<double>(values[3 + 3 * c + axis]);
        CHECK(values[3 + 3 * c + axis] == static_cast<float>(mesh.points[mesh.triangles[k][c]][axis]));
      }
    }
    const Triple n = crossOf(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
    const Triple told{static_cast<double>(values[0]), static_cast<double>(values[1]), static_cast<double>(values[2])};
    CHECK(dotOf(n, told) == Approx(std::sqrt(dotOf(n, n))).epsilon(1e-5));
    CHECK(dotOf(told, told) == Approx(1).epsilon(1e-5));
  }
}

TEST_CASE("a 3MF lists the same points and triangles in a package that names its model") {
  const Mesh mesh = bodyOf(shapeOf({box(0, 0, 20, 20)}));
  const std::string zip = write3mf(mesh).value();
  CHECK(zip == write3mf(mesh).value());
  CHECK(zip.starts_with("PK\x03\x04"));
  for (const char* part : {"[Content_Types].xml", "_rels/.rels", "3D/3dmodel.model"}) {
    CHECK(zip.find(part) != std::string::npos);
  }
  CHECK(zip.find("<vertex x=\"100\" y=\"100\" z=\"0.4\"/>") != std::string::npos);
  std::size_t triangles = 0;
  for (std::size_t at = zip.find("<triangle "); at != std::string::npos; at = zip.find("<triangle ", at + 1))
    ++triangles;
  CHECK(triangles == 12);
}
