// Built-in shapes: areas in closed form, boxes, corners; holes cut out of shapes.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "sillon/geometry/shape.hpp"
#include "support/about.hpp"
#include "support/random_plates.hpp"
#include "support/scenes.hpp"

using namespace sillon;
using std::numbers::pi;
using std::numbers::sqrt3;

namespace {

Shape get(const Result<Shape>& shape) {
  if (!shape.ok()) FAIL(shape.error().message);
  return shape.value();
}

double areaOf(const Shape& shape) { return resolveOutline(shape).value().area; }

void checkRefused(const Result<Shape>& shape, ErrorCode code, const std::vector<std::string>& parts) {
  REQUIRE_FALSE(shape.ok());
  INFO(shape.error().message);
  CHECK(shape.error().code == code);
  for (const std::string& part : parts) CHECK(shape.error().message.find(part) != std::string::npos);
}

/// Area that a corner with this angle inside loses to an arc that touches both of its sides.
double roundedOff(double radius, double angle) {
  return radius * radius * (1 / std::tan(angle / 2) - (pi - angle) / 2);
}

}  // namespace

TEST_CASE("built-in shapes have the areas of their formulas") {
  const double w = 60;
  const double h = 47;
  CHECK(areaOf(get(makeHexagon({w, h}))) == about(0.75 * w * h, 1e-9));
  // Two triangles for each point, between its tip and the inner corners beside it.
  for (const int points : {5, 6}) {
    CAPTURE(points);
    const double inner = std::cos(2 * pi / points) / std::cos(pi / points);
    const double width = points == 5 ? 2 * std::sin(0.4 * pi) : sqrt3;
    const double height = points == 5 ? 1 + std::cos(0.2 * pi) : 2;
    const double area = points * inner * std::sin(pi / points);
    CHECK(areaOf(get(makeStar(points, {w, h}))) == about(area * w * h / width / height, 1e-6));
  }
  const double root = std::sqrt(0.5);
  CHECK(areaOf(get(makeHeart({w, h}))) == about((1 + pi / 4) * w * h / (root + 1) / (1.5 * root + 0.5), 1e-4));
  const double arcs = sqrt3 / 2;
  const double tall = h / (arcs + 1.0 / 3);  // height of the shield whose width and height are the formula's
  CHECK(areaOf(get(makeShield({w, h}))) == about(w * tall * (1.0 / 3 + pi / 3 - sqrt3 / 4), 1e-4));
  CHECK(areaOf(get(makeRing(w, 20))) == about(pi / 4 * (w * w - 400), 1e-4));
  CHECK(areaOf(get(makeRing(w, 0))) == about(pi / 4 * (w * w - w * w / 4), 1e-4));
  CHECK(areaOf(get(makeTag({w, 24}, 5))) == about(24 * (w - 12) + pi * 72 - pi / 4 * 25, 1e-4));
}

TEST_CASE("built-in shapes fill their page, and have heights of their own") {
  const std::vector<std::function<Result<Shape>(Vec2)>> makers{
      [](Vec2 size) { return makeHexagon(size); },  [](Vec2 size) { return makeStar(5, size); },
      [](Vec2 size) { return makeStar(8, size); },  [](Vec2 size) { return makeHeart(size); },
      [](Vec2 size) { return makeShield(size); },   [](Vec2 size) { return makeTag(size, 0); },
      [](Vec2 size) { return makeStar(24, size); },
  };
  for (std::size_t k = 0; k < makers.size(); ++k) {
    CAPTURE(k);
    for (const Vec2 size : {Vec2{60, 47}, Vec2{21.5, 80.25}, Vec2{50, 0}}) {
      const Shape shape = get(makers[k](size));
      CHECK(shape.page.x == size.x);
      if (size.y != 0) CHECK(shape.page.y == size.y);
      const Bounds box = bounds(shape);
      CHECK(box.min == Vec2{0, 0});
      CHECK(box.max == shape.page);
      for (const Ring& ring : shape.paths.at(0).rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
          CHECK(ring[i].x == std::round(ring[i].x * 1e6) / 1e6);
          CHECK_FALSE(ring[i] == ring[(i + 1) % ring.size()]);
        }
      }
      CHECK(scenes::shoelace(shape.paths[0].rings[0]) > 0);
    }
  }
  CHECK(get(makeHexagon({50, 0})).page.y == about(25 * sqrt3, 1e-6));
  CHECK(get(makeHeart({50, 0})).page.y == about(50 * 0.914214, 1e-5));
  CHECK(get(makeTag({50, 0}, 0)).page.y == 20);
}

TEST_CASE("a tag has its hole near its round end, 3 mm from it") {
  const auto centre = [](const Shape& shape) {
    Bounds box;
    for (const Vec2 p : shape.paths.at(0).rings.at(1)) box.add(p);
    CHECK(box.size().x == about(4, 1e-6));
    return 0.5 * (box.min + box.max);
  };
  CHECK(length(centre(get(makeTag({60, 24}, 4))) - Vec2{5, 12}) < 1e-6);
  CHECK(length(centre(get(makeTag({24, 60}, 4))) - Vec2{12, 55}) < 1e-6);  // above, where it is taller than wide
  CHECK(length(centre(get(makeTag({60, 6}, 4))) - Vec2{3, 3}) < 1e-6);     // in the middle of an end that is narrow
}

TEST_CASE("corners are rounded or cut off between the same points") {
  const double r = 4;
  const double w = 60;
  const double sharp = 0.75 * w * w * sqrt3 / 2;
  const double round = areaOf(get(makeHexagon({w, 0}, {r, false})));
  const double cut = areaOf(get(makeHexagon({w, 0}, {r, true})));
  const double legs = r / std::tan(pi / 3);
  CHECK(round == about(sharp - 6 * roundedOff(r, 2 * pi / 3), 1e-5));
  CHECK(cut == about(sharp - 6 * 0.5 * legs * legs * std::sin(2 * pi / 3), 1e-5));
  // A star's inner corners gain what an arc leaves outside.
  const double star = areaOf(get(makeStar(5, {w, 0})));
  CHECK(areaOf(get(makeStar(5, {w, 0}, {1, false}))) ==
        about(star - 5 * roundedOff(1, pi / 5) + 5 * roundedOff(1, pi - 2 * pi / 5), 1e-5));
  CHECK(areaOf(get(makeRoundedRectangle({40, 20}, 5, true))) == about(800 - 2 * 25, 1e-9));
  CHECK(areaOf(get(makeRoundedRectangle({40, 20}, 99, true))) == about(800 - 2 * 100, 1e-9));
  CHECK(areaOf(get(makeShield({40, 40}, {5, true}))) == about(areaOf(get(makeShield({40, 40}))) - 25, 1e-6));
  CHECK(areaOf(get(makeTag({60, 24}, 5, {5, false}))) ==
        about(areaOf(get(makeTag({60, 24}, 5))) - 2 * roundedOff(5, pi / 2), 1e-5));
}

TEST_CASE("any radius leaves a shape without crossings") {
  for (const double radius : {0.0, 0.001, 1.0, 7.0, 1e4}) {
    for (const bool chamfered : {false, true}) {
      CAPTURE(radius);
      CAPTURE(chamfered);
      const Corners corners{radius, chamfered};
      for (const Shape& shape : {get(makeHexagon({30, 12}, corners)), get(makeStar(7, {30, 40}, corners)),
                                 get(makeShield({30, 30}, corners)), get(makeTag({30, 31}, 5, corners))}) {
        double sum = 0;
        for (const Ring& ring : shape.paths.at(0).rings) sum += scenes::shoelace(ring);
        CHECK(areaOf(shape) == about(sum, 1e-6));
        CHECK(areaOf(shape) > 0.1 * shape.page.x * shape.page.y);
      }
    }
  }
}

TEST_CASE("built-in shapes refuse what is out of range, with its value") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  checkRefused(makeHexagon({-3, 5}), ErrorCode::InvalidArgument, {"shape.size.x is -3 mm", "at most 10000"});
  checkRefused(makeHeart({nan, 5}), ErrorCode::InvalidArgument, {"shape.size.x"});
  checkRefused(makeShield({5, 20000}), ErrorCode::InvalidArgument, {"shape.size.y is 20000 mm"});
  checkRefused(makeHexagon({5, 5}, {-1, false}), ErrorCode::InvalidArgument, {"radius is -1 mm", "0 or more"});
  checkRefused(makeStar(2, {5, 5}), ErrorCode::InvalidArgument, {"shape.points is 2", "3 to 24"});
  checkRefused(makeRing(30, 30), ErrorCode::InvalidArgument, {"shape.inner is 30 mm", "less than"});
  checkRefused(makeRing(0, 3), ErrorCode::InvalidArgument, {"shape.size.x is 0 mm"});
  checkRefused(makeTag({60, 5}, 0), ErrorCode::InvalidArgument, {"shape.inner is 5 mm", "shorter side of 5 mm"});
}

TEST_CASE("holes are cut out of any shape") {
  const double disc = pi / 4 * 60 * 60;
  const Shape plain = get(makeDisc(60));
  const Shape two = get(withHoles(plain, {{{20, 30}, 5}, {{40, 30}, 8.2}}));
  CHECK(areaOf(two) == about(disc - pi / 4 * (25 + 8.2 * 8.2), 1e-4));
  CHECK(two.page == plain.page);
  // Holes that overlap are one; one across the border is a notch.
  CHECK(areaOf(get(withHoles(plain, {{{30, 30}, 8}, {{30, 30}, 4}}))) == about(disc - pi / 4 * 64, 1e-4));
  const Shape notched = get(withHoles(get(makeRectangle({40, 20})), {{{0, 10}, 8}}));
  CHECK(areaOf(notched) == about(800 - pi / 8 * 64, 1e-4));
  // Nothing fills what was cut, where paths overlap.
  Shape paths = scenes::shapeOf({scenes::rectangle({0, 0}, {20, 20})}, {30, 20});
  paths.paths.push_back({{scenes::rectangle({10, 0}, {30, 20})}, FillRule::NonZero});
  CHECK(areaOf(get(withHoles(paths, {{{15, 10}, 6}}))) == about(600 - pi / 4 * 36, 1e-4));
  CHECK(get(withHoles(plain, {})) == plain);
}

TEST_CASE("holes take at most their own area from random shapes, or are refused as outside") {
  int cut = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    scenes::Random random(seed);
    std::string name;
    const Shape shape = scenes::randomShape(random, name);
    const Result<Outline> outline = resolveOutline(shape);
    if (!outline) continue;
    const double x = random.in(0, shape.page.x), y = random.in(0, shape.page.y);
    const double diameter = random.in(0.5, 3);
    const Result<Shape> made = withHoles(shape, {{{x, y}, diameter}});
    const double before = outline.value().area;
    if (!made) {
      const bool outside = made.error().reason == std::string("HoleOutside");
      CHECK((outside || before < pi / 4 * diameter * diameter));
      continue;
    }
    ++cut;
    const double taken = before - areaOf(made.value());
    CHECK(taken > 0);
    CHECK(taken < pi / 4 * diameter * diameter + 1e-9);
  }
  CHECK(cut > 60);
}

TEST_CASE("a hole that cuts nothing is refused with its place, and so is one that leaves nothing") {
  const Shape disc = get(makeDisc(60));
  checkRefused(withHoles(disc, {{{30, 30}, 5}, {{2, 58}, 5}}), ErrorCode::InvalidArgument,
               {"hole 2 at 2, 58 mm, 5 mm wide, lies outside", "from 0, 0 to 60, 60 mm"});
  checkRefused(withHoles(get(makeRing(60, 30)), {{{30, 30}, 20}}), ErrorCode::InvalidArgument, {"lies outside"});
  checkRefused(withHoles(disc, {{{30, 30}, 0}}), ErrorCode::InvalidArgument, {"shape.holes[0].diameter is 0 mm"});
  checkRefused(withHoles(disc, {{{30, 30}, 61}}), ErrorCode::EmptyShape, {"nothing of the shape"});
}
