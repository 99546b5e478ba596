#include "toolpath/path.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "sillon/quality/metrics.hpp"

#include "support/scenes.hpp"

using namespace sillon;

namespace {

constexpr double kSpacing = 0.4;
constexpr double kCell = kSpacing / 4;

struct Lattice {
  Grid nodes;
  BorderIndex border;
  std::vector<float> distance;
  std::vector<float> values;
};

// An upright bar as wide as `width`, from y = 1 to y = 1 + length, whose waves are positive above y = `from`.
Lattice bar(double width, double length, double from) {
  const Grid nodes{{0, 0}, kCell, 40, 80};
  const double middle = nodes.centre(20, 0).x;
  const Shape shape =
      scenes::shapeOf({scenes::rectangle({middle - width / 2, 1}, {middle + width / 2, 1 + length})}, {4, 8});
  const Outline outline = resolveOutline(shape).value();
  Lattice lattice{nodes, buildBorderIndex(outline, makeGrid(outline.bounds, kSpacing), RunContext(1)).value(), {}, {}};
  for (int y = 0; y < lattice.nodes.ny; ++y) {
    for (int x = 0; x < lattice.nodes.nx; ++x) {
      const Vec2 p = lattice.nodes.centre(x, y);
      const double across = std::abs(p.x - middle) - width / 2;
      const double along = std::max(1 - p.y, p.y - 1 - length);
      const double distance = std::max(across, along);
      lattice.distance.push_back(static_cast<float>(distance));
      lattice.values.push_back(distance < -kSpacing / 2 && p.y < from ? -0.5f : 0.5f);
    }
  }
  return lattice;
}

struct Plate {
  PlateInput input;
  ToolpathParams params;
  Toolpath toolpath;
};

// The solids on one page, under lines of one direction.
Plate plateOf(std::vector<Ring> rings, Vec2 page) {
  const DirectionMap map = scenes::mapOf(8, [](double, double) { return 1.0; });
  Plate plate{scenes::plate(scenes::shapeOf(std::move(rings), page, FillRule::NonZero), map), {}, {}};
  plate.params.spacing = kSpacing;
  auto made = generateToolpath(plate.input, plate.params, RunContext(2));
  REQUIRE(made.ok());
  plate.toolpath = std::move(made).value().toolpath;
  return plate;
}

}  // namespace

TEST_CASE("a narrow bar that no contour enters gets one, and beside contours nothing changes") {
  Lattice lattice = bar(1.4 * kSpacing, 5, 2);
  const std::vector<float> before = lattice.values;
  fillThinFeatures(lattice.nodes, lattice.distance, lattice.border, kSpacing, lattice.values);
  int filled = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double y = lattice.nodes.centre(0, static_cast<int>(i) / lattice.nodes.nx).y;
    const bool deep = lattice.distance[i] <= static_cast<float>(-kSpacing / 2);
    CAPTURE(y);
    // The contour that is there ends below y = 2; three nodes above it belong to it.
    if (deep && y > 2 + 4 * kCell) CHECK(lattice.values[i] < 0);
    if (!deep || y < 2 + 2 * kCell) CHECK(lattice.values[i] == before[i]);
    filled += lattice.values[i] != before[i] ? 1 : 0;
  }
  CHECK(filled > 20);
  const std::vector<float> once = lattice.values;
  fillThinFeatures(lattice.nodes, lattice.distance, lattice.border, kSpacing, lattice.values);
  CHECK(lattice.values == once);
}

TEST_CASE("a place of three nodes is not worth a contour") {
  Lattice lattice = bar(1.4 * kSpacing, 5, 0);
  for (std::size_t i = 0; i < lattice.values.size(); ++i) {
    const double y = lattice.nodes.centre(0, static_cast<int>(i) / lattice.nodes.nx).y;
    if (y > 3 + 0.5 * kCell || y < 3 - 2.5 * kCell) lattice.distance[i] = 0.1f;
  }
  const std::vector<float> before = lattice.values;
  fillThinFeatures(lattice.nodes, lattice.distance, lattice.border, kSpacing, lattice.values);
  CHECK(lattice.values == before);
}

TEST_CASE("arms hardly wider than a bead are all filled, wherever waves and lattice lie") {
  // A comb whose ten arms, 1.3 spacings wide, lie a little differently on the lattice; lines along and across them.
  for (const double degrees : {0.0, 37.0, 90.0}) {
    std::vector<Ring> rings{scenes::rectangle({0, 0}, {20, 6})};
    const auto left = [](int k) { return 0.7 + 1.913 * k; };
    for (int k = 0; k < 10; ++k) rings.push_back(scenes::rectangle({left(k), 5}, {left(k) + 1.3 * kSpacing, 11}));
    const DirectionMap map = scenes::mapOf(8, [&](double, double) { return degrees * std::numbers::pi / 180; });
    const PlateInput input = scenes::plate(scenes::shapeOf(std::move(rings), {20, 11}, FillRule::NonZero), map);
    ToolpathParams params;
    params.spacing = kSpacing;
    params.perimeterMode = PerimeterMode::Soft;
    const auto result = generateToolpath(input, params, RunContext(2));
    REQUIRE(result.ok());
    for (int k = 0; k < 10; ++k) {
      CAPTURE(degrees);
      CAPTURE(k);
      float highest = 0;
      for (const Cycle& cycle : result.value().toolpath.cycles) {
        for (const Vec2f p : cycle.points) {
          const double x = static_cast<double>(p.x) - left(k);
          if (x > 0 && x < 1.3 * kSpacing) highest = std::max(highest, p.y);
        }
      }
      CHECK(highest > 10.3f);
    }
  }
}

TEST_CASE("lines from one bead on are printed over their whole length, wherever they lie") {
  for (const double width : {1.0, 1.03, 1.1, 1.2, 1.33, 1.37, 1.5}) {
    std::vector<Ring> rings{scenes::rectangle({0, 0}, {3, 3})};
    for (int k = 0; k < 12; ++k) {  // each turned and shifted a little more
      const double angle = 0.131 * k;
      const Vec2 along{std::cos(angle), std::sin(angle)};
      const Vec2 half = Vec2{-along.y, along.x} * (0.5 * width * kSpacing);
      const Vec2 a = Vec2{5 + 0.013 * k, 2 + 9.0 * k + 0.037 * k}, b = a + along * 8;
      rings.push_back({a - half, b - half, b + half, a + half});
    }
    CAPTURE(width);
    const Plate plate = plateOf(std::move(rings), {20, 120});
    CHECK(plate.toolpath.cycles.size() == 13);
    const auto measures = measureToolpath(plate.toolpath, plate.input, plate.params, RunContext(2));
    REQUIRE(measures.ok());
    CHECK(measures.value().coverage > 88);
    CHECK(measures.value().spill < 0.1);
    CHECK(measures.value().lostAreaMm2 == 0);
  }
}

TEST_CASE("dots from one bead on are printed, wherever they lie") {
  for (const double width : {1.02, 1.1, 1.3, 1.6}) {
    std::vector<Ring> rings{scenes::rectangle({0, 0}, {3, 3})};
    for (int k = 0; k < 50; ++k) {
      const Vec2 centre{2 + 1.537 * (k % 10), 5 + 1.683 * (k / 10)};
      rings.push_back(scenes::circle(centre, 0.5 * width * kSpacing, 64));
    }
    CAPTURE(width);
    CHECK(plateOf(std::move(rings), {20, 20}).toolpath.cycles.size() == 51);
  }
}
