// Outlines moved outwards and inwards.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "sillon/geometry/shape.hpp"
#include "support/about.hpp"
#include "support/random_plates.hpp"
#include "support/scenes.hpp"

using namespace sillon;
using std::numbers::pi;

namespace {

const RunContext kRun(2);

Shape moved(const Shape& shape, double offset) {
  Result<Shape> made = offsetShape(shape, offset, kRun);
  if (!made) FAIL(made.error().message);
  return std::move(made).value();
}

double areaOf(const Shape& shape) { return resolveOutline(shape).value().area; }

}  // namespace

TEST_CASE("a rectangle grows by strips and quarter discs, and becomes smaller with sharp corners") {
  const Shape plain = makeRectangle({40, 25}).value();
  for (const double offset : {0.3, 2.0, 11.0}) {
    CAPTURE(offset);
    const Shape grown = moved(plain, offset);
    CHECK(areaOf(grown) == about(1000 + 130 * offset + pi * offset * offset, 1e-4));
    CHECK(grown.page.x == about(40 + 2 * offset, 1e-9));
    CHECK(grown.page.y == about(25 + 2 * offset, 1e-9));
    const Bounds box = bounds(grown);
    CHECK(std::abs(box.min.x) < 1e-3);
    CHECK(std::abs(box.max.y - grown.page.y) < 1e-3);
  }
  for (const double offset : {-0.3, -2.0, -11.0}) {
    CAPTURE(offset);
    const Shape less = moved(plain, offset);
    CHECK(areaOf(less) == about((40 + 2 * offset) * (25 + 2 * offset), 2e-3));
    CHECK(less.page == plain.page);
    CHECK(bounds(less).min.x == about(-offset, 1e-3));
  }
  CHECK(moved(plain, 0) == plain);
}

TEST_CASE("a disc stays a disc, a hole becomes smaller until it closes") {
  CHECK(areaOf(moved(makeDisc(30).value(), 3)) == about(pi * 18 * 18, 1e-4));
  CHECK(areaOf(moved(makeDisc(30).value(), -3)) == about(pi * 12 * 12, 3e-4));
  const Shape ring = makeRing(40, 10).value();
  CHECK(areaOf(moved(ring, 2)) == about(pi * (22 * 22 - 3 * 3), 1e-4));
  CHECK(areaOf(moved(ring, 5.5)) == about(pi * 25.5 * 25.5, 1e-4));
}

TEST_CASE("solids that meet become one") {
  const Shape pair =
      scenes::shapeOf({scenes::rectangle({0, 0}, {10, 10}), scenes::rectangle({12, 0}, {22, 10})}, {22, 10});
  const Shape grown = moved(pair, 2);
  REQUIRE(grown.paths.size() == 1);
  CHECK(grown.paths[0].rings.size() == 1);
}

TEST_CASE("offsets of random shapes grow with the offset and stay in the box around the shape") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    scenes::Random random(seed);
    std::string name;
    const Shape shape = scenes::randomShape(random, name);
    CAPTURE(name);
    const Result<Outline> outline = resolveOutline(shape);
    if (!outline) continue;
    const Bounds box = outline.value().bounds;
    double before = 0;
    for (const double offset : {-0.4, -0.1, 0.0, 0.15, 0.8, 3.0}) {
      CAPTURE(offset);
      const Result<Shape> made = offsetShape(shape, offset, kRun);
      if (!made) {
        CHECK(offset < 0);
        CHECK(made.error().code == ErrorCode::EmptyShape);
        continue;
      }
      const double area = areaOf(made.value());
      CHECK(area > before);
      before = area;
      const double shift = std::max(0.0, offset);
      const Bounds now = bounds(made.value());
      constexpr double kSlack = 1e-3;
      CHECK(now.min.x >= box.min.x + shift - offset - kSlack);
      CHECK(now.min.y >= box.min.y + shift - offset - kSlack);
      CHECK(now.max.x <= box.max.x + shift + offset + kSlack);
      CHECK(now.max.y <= box.max.y + shift + offset + kSlack);
      // Every inner outline lies inside of the page that grew with it.
      CHECK(made.value().page.x == about(shape.page.x + 2 * shift, 1e-6));
    }
  }
}

TEST_CASE("what an offset leaves is not nothing, and offsets have a range") {
  const auto problem = [](double offset) {
    const Result<Shape> made = offsetShape(makeRectangle({30, 8}).value(), offset, kRun);
    REQUIRE_FALSE(made.ok());
    return made.error();
  };
  CHECK(problem(-4.5).code == ErrorCode::EmptyShape);
  CHECK(problem(-4.5).message.find("-4.5 mm") != std::string::npos);
  CHECK(problem(-4.5).message.find("place is 4 mm from") != std::string::npos);
  for (const double offset : {-20.5, 50.5, std::numeric_limits<double>::quiet_NaN()}) {
    CHECK(problem(offset).code == ErrorCode::InvalidArgument);
    CHECK(problem(offset).message.find("-20 to 50 mm") != std::string::npos);
  }
  CHECK(offsetShape(Shape{}, 2, kRun).error().code == ErrorCode::EmptyShape);
}
