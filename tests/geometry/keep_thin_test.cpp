#include "geometry/parts.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "sillon/geometry/shape.hpp"
#include "support/about.hpp"
#include "support/scenes.hpp"

using namespace sillon;
using scenes::rectangle;
using scenes::shapeOf;

namespace {

constexpr double kSpacing = 0.4;
constexpr double kBead = 1.1 * kSpacing;  // to which thin places are widened

// A bar of some width, turned, beside a square that stays as it is.
Shape barOf(double width, double length, double degrees) {
  const double a = degrees * std::numbers::pi / 180;
  const Vec2 along{std::cos(a), std::sin(a)};
  const Vec2 across{-along.y, along.x};
  const Vec2 at{12, 6};
  const Ring bar{at, at + along * length, at + along * length + across * width, at + across * width};
  return shapeOf({rectangle({1, 1}, {6, 6}), bar}, {40, 40});
}

Shape kept(const Shape& shape) {
  const RunContext run(2);
  const auto made = keepThinPlaces(shape, kSpacing, run);
  REQUIRE(made);
  return made.value();
}

double areaOf(const Shape& shape) { return resolveOutline(shape).value().area; }

}  // namespace

TEST_CASE("a bar of 0.7 beads becomes one bead wide, with round ends about where its own were") {
  for (const double degrees : {0.0, 20.0, 45.0, 73.0}) {
    CAPTURE(degrees);
    const double width = 0.7 * kSpacing;
    const double length = 15;
    const Shape shape = kept(barOf(width, length, degrees));
    // The middle ends half the bar's width before the bar does; the corners of the bar lie inside of the bead's ends.
    const double expected = 25 + (length - width) * kBead + std::numbers::pi / 4 * kBead * kBead;
    CHECK(areaOf(shape) == about(expected, 0.002));
    REQUIRE(shape.kept.size() == 1);
    CHECK(shape.kept[0].width == about(width, 1e-3));
    CHECK(shape.kept[0].areaMm2 == about(width * length, 0.1));
  }
}

TEST_CASE("a thin ring becomes one bead wide all round") {
  const double radius = 5;
  const double width = 0.6 * kSpacing;
  const Shape ring =
      shapeOf({scenes::circle({10, 10}, radius + width / 2, 200), scenes::circle({10, 10}, radius - width / 2, 200)},
              {20, 20}, FillRule::EvenOdd);
  const double expected = 2 * std::numbers::pi * radius * kBead;
  CHECK(areaOf(kept(ring)) == about(expected, 0.01));
}

TEST_CASE("a bar of 0.4 beads, wide ones and corners stay as they are") {
  for (const double width : {0.4, 1.05, 2.0}) {
    CAPTURE(width);
    const Shape shape = barOf(width * kSpacing, 15, 20);
    CHECK(kept(shape) == shape);
  }
  CHECK(kept(shapeOf({rectangle({0, 0}, {10, 10})}, {10, 10})) == shapeOf({rectangle({0, 0}, {10, 10})}, {10, 10}));
}

TEST_CASE("a spacing that no plate can have keeps nothing and is refused") {
  for (const double spacing : {0.0, -1.0, 0.049, 21.0, std::nan("")}) {
    CAPTURE(spacing);
    const auto shape = keepThinPlaces(barOf(0.4, 15, 20), spacing, RunContext(1));
    REQUIRE(!shape.ok());
    CHECK(shape.error().code == ErrorCode::InvalidArgument);
  }
}

TEST_CASE("a bar of half a bead is kept, and one a little thinner is not") {
  CHECK(kept(barOf(0.501 * kSpacing, 15, 30)).kept.size() == 1);
  CHECK(kept(barOf(0.498 * kSpacing, 15, 30)).kept.empty());
}

TEST_CASE("where a wedge grows thin it is kept down to half a bead") {
  // Its width falls from 2 beads to nothing over 40 mm: a quarter of it is between one bead and half of one.
  const Shape wedge = shapeOf({{{0, 4}, {40, 4 + kSpacing}, {0, 4 + 2 * kSpacing}}}, {40, 10});
  const Shape shape = kept(wedge);
  REQUIRE(shape.kept.size() == 1);
  CHECK(bounds(shape).max.x == about(40, 1e-9));
  CHECK(shape.kept[0].areaMm2 == about(10 * 0.75 * kSpacing, 0.1));
  // A tenth wider than a bead from where it is one bead wide to where it is half of one.
  CHECK(areaOf(shape) == about(0.5 * 40 * 2 * kSpacing + 10 * (1.1 - 0.75) * kSpacing, 0.02));
}
