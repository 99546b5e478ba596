#include "geometry/signed_distance.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "geometry/parts.hpp"
#include "support/scenes.hpp"

using namespace sillon;
using scenes::circle;
using scenes::rectangle;
using scenes::shapeOf;

namespace {

SignedDistanceField fieldOf(const Shape& shape, double spacing, const RunContext& run = RunContext(1)) {
  const auto outline = resolveOutline(shape);
  REQUIRE(outline.ok());
  const Grid grid = makeGrid(outline.value().bounds, spacing);
  const auto index = buildBorderIndex(outline.value(), grid, run);
  REQUIRE(index.ok());
  auto field = signedDistanceField(shape, index.value(), grid, run);
  REQUIRE(field.ok());
  return std::move(field).value();
}

double bruteForce(const std::vector<BorderSegment>& segments, Vec2 p) {
  double best = 1e300;
  for (const BorderSegment& s : segments) {
    const Vec2 u = s.b - s.a;
    const double t = std::clamp(dot(p - s.a, u) / dot(u, u), 0.0, 1.0);
    best = std::min(best, length(p - (s.a + u * t)));
  }
  return best;
}

int partsOf(const Shape& shape, double bridge) {
  const RunContext run(1);
  const auto outline = resolveOutline(shape);
  const Grid grid = makeGrid(outline.value().bounds, 0.4);
  const auto index = buildBorderIndex(outline.value(), grid, run);
  const auto field = signedDistanceField(shape, index.value(), grid, run);
  return labelParts(field.value(), index.value(), 0.4, bridge).count;
}

}  // namespace

TEST_CASE("the grid holds the box and a margin of one and a half spacings, in cells of half a spacing") {
  Bounds box;
  box.add({0, 0});
  box.add({64.9984, 52.4986});
  const Grid grid = makeGrid(box, 0.4);
  CHECK(grid.nx == 331);
  CHECK(grid.ny == 269);
  CHECK(grid.centre(0, 0).x == doctest::Approx(-0.6 + 0.1));
  const Grid nodes = nodeLattice(grid);
  CHECK(nodes.centre(1, 1).x == doctest::Approx(grid.centre(0, 0).x));
  CHECK(nodes.centre(0, 0).x == doctest::Approx(grid.origin.x));
}

TEST_CASE("there is no distance to an outline without a border") {
  const auto index = buildBorderIndex({}, makeGrid({{0, 0}, {10, 10}}, 0.4), RunContext(1));
  REQUIRE(!index.ok());
  CHECK(index.error().code == ErrorCode::EmptyShape);
}

TEST_CASE("the distance to a rectangle is that of its closed form, inside and out") {
  const SignedDistanceField field = fieldOf(shapeOf({rectangle({0, 0}, {9, 5})}, {9, 5}), 0.4);
  for (int y = 0; y < field.grid.ny; ++y) {
    for (int x = 0; x < field.grid.nx; ++x) {
      const Vec2 p = field.grid.centre(x, y);
      const double dx = std::abs(p.x - 4.5) - 4.5;
      const double dy = std::abs(p.y - 2.5) - 2.5;
      const double expected = dx > 0 && dy > 0 ? std::hypot(dx, dy) : std::max(dx, dy);
      REQUIRE(static_cast<double>(field.distance[field.grid.index(x, y)]) == doctest::Approx(expected).epsilon(1e-6));
    }
  }
}

TEST_CASE("the error against a true circle falls with the square of the polygon's edge, not with the cell") {
  double before = 1e9;
  for (const int corners : {20, 40, 80, 160}) {
    const SignedDistanceField field = fieldOf(shapeOf({circle({5, 5}, 5, corners)}, {10, 10}), 0.5);
    double worst = 0;
    for (int y = 0; y < field.grid.ny; ++y) {
      for (int x = 0; x < field.grid.nx; ++x) {
        const double expected = length(field.grid.centre(x, y) - Vec2{5, 5}) - 5;
        worst = std::max(worst, std::abs(static_cast<double>(field.distance[field.grid.index(x, y)]) - expected));
      }
    }
    CHECK(worst < before / 3);
    before = worst;
  }
  CHECK(before < 2e-3);
}

TEST_CASE("every distance is exact, every normal unit and outward, also at reflex corners") {
  for (const auto& scene : scenes::all()) {
    CAPTURE(scene.name);
    const auto outline = resolveOutline(scene.input.shape);
    const SignedDistanceField field = fieldOf(scene.input.shape, 0.6, RunContext(3));
    const float step = 0.02f;
    for (int y = 0; y < field.grid.ny; y += 2) {
      for (int x = 0; x < field.grid.nx; x += 3) {
        const std::size_t i = field.grid.index(x, y);
        const Vec2 p = field.grid.centre(x, y);
        REQUIRE(static_cast<double>(std::abs(field.distance[i])) ==
                doctest::Approx(bruteForce(outline.value().segments, p)).epsilon(1e-5));
        REQUIRE(length(field.normal[i]) == doctest::Approx(1).epsilon(1e-5));
        // Along the outward normal an inside point comes nearer to the border.
        if (field.distance[i] < -2 * step) {
          const Vec2 q{p.x + static_cast<double>(step * field.normal[i].x),
                       p.y + static_cast<double>(step * field.normal[i].y)};
          REQUIRE(bruteForce(outline.value().segments, q) < static_cast<double>(-field.distance[i]));
        }
      }
    }
  }
}

TEST_CASE("single points agree with the field in size and sign") {
  const Shape shape = shapeOf({scenes::star({8, 8}, 8, 3, 7)}, {16, 16});
  const auto outline = resolveOutline(shape);
  const Grid grid = makeGrid(outline.value().bounds, 0.4);
  const RunContext run(1);
  const auto index = buildBorderIndex(outline.value(), grid, run);
  const auto field = signedDistanceField(shape, index.value(), grid, run);
  for (int y = 0; y < grid.ny; ++y) {
    for (int x = 0; x < grid.nx; ++x) {
      REQUIRE(index.value().nearest(grid.centre(x, y)).distance == field.value().distance[grid.index(x, y)]);
    }
  }
}

TEST_CASE("the band is exact where it must be and has the right sign and size elsewhere") {
  const Shape shape = shapeOf({circle({6, 6}, 6), circle({6, 6}, 2)}, {12, 12});
  const auto outline = resolveOutline(shape);
  const Grid grid = makeGrid(outline.value().bounds, 0.4);
  const Grid nodes = nodeLattice(grid);
  const RunContext run(2);
  const auto index = buildBorderIndex(outline.value(), grid, run);
  const auto band = bandDistance(shape, index.value(), nodes, 0.4f, run);
  REQUIRE(band.ok());
  for (int y = 0; y < nodes.ny; ++y) {
    for (int x = 0; x < nodes.nx; ++x) {
      const float value = band.value()[nodes.index(x, y)];
      const double exact = bruteForce(outline.value().segments, nodes.centre(x, y));
      const double radius = length(nodes.centre(x, y) - Vec2{6, 6});
      if (exact > 0.01) REQUIRE((value < 0) == (radius < 6 && radius > 2));
      if (exact <= 0.4) {
        REQUIRE(static_cast<double>(std::abs(value)) == doctest::Approx(exact).epsilon(1e-5));
      } else {
        REQUIRE(std::abs(value) >= 0.4f);
      }
    }
  }
}

TEST_CASE("the band is that of single points to the last bit, wherever the lattice lies") {
  const Shape shape = shapeOf({scenes::star({8, 8}, 8, 3, 7), circle({8, 8}, 2)}, {16, 16});
  const auto outline = resolveOutline(shape);
  const Grid grid = makeGrid(outline.value().bounds, 0.4);
  const RunContext run(1);
  const auto index = buildBorderIndex(outline.value(), grid, run);
  for (const double cell : {0.05, 0.0731, 0.3, 2.1}) {
    const Vec2 size = outline.value().bounds.size();
    const Grid lattice{outline.value().bounds.min - Vec2{0.33, 0.41}, cell, static_cast<int>((size.x + 0.7) / cell) + 1,
                       static_cast<int>((size.y + 0.7) / cell) + 1};
    const auto band = bandDistance(shape, index.value(), lattice, 0.6f, run);
    REQUIRE(band.ok());
    for (int y = 0; y < lattice.ny; ++y) {
      for (int x = 0; x < lattice.nx; ++x) {
        const float exact = std::abs(index.value().nearest(lattice.centre(x, y)).distance);
        if (exact <= 0.6f) REQUIRE(std::abs(band.value()[lattice.index(x, y)]) == exact);
      }
    }
  }
}

TEST_CASE("islands are parts of their own unless the gap is narrower than the bridge") {
  for (const double gap : {0.1, 0.35, 0.45, 1.0}) {
    for (const double angle : {0.0, 0.3, 0.785, std::numbers::pi / 2}) {
      CAPTURE(gap);
      CAPTURE(angle);
      // Two rectangles with a straight gap between them, turned.
      std::vector<Ring> rings = {rectangle({-6, -3}, {-gap / 2, 3}), rectangle({gap / 2, -3}, {6, 3})};
      for (Ring& ring : rings) {
        for (Vec2& p : ring) {
          p = {10 + p.x * std::cos(angle) - p.y * std::sin(angle), 10 + p.x * std::sin(angle) + p.y * std::cos(angle)};
        }
      }
      const Shape shape = shapeOf(rings, {20, 20});
      CHECK(partsOf(shape, 0.4) == (gap < 0.4 ? 1 : 2));
      CHECK(partsOf(shape, 0) == 2);
    }
  }
}

TEST_CASE("places too thin for a bead make no part") {
  CHECK(partsOf(shapeOf({circle({5, 5}, 4), rectangle({12, 1}, {12.2, 9})}, {14, 10}), 0.4) == 1);
}
