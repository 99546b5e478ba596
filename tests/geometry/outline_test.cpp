#include "geometry/outline.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "geometry/outline_steps.hpp"
#include "support/about.hpp"
#include "support/scenes.hpp"

using namespace sillon;
using scenes::circle;
using scenes::rectangle;
using scenes::shapeOf;

namespace {

double areaOf(const Shape& shape) {
  const auto outline = resolveOutline(shape);
  REQUIRE(outline.ok());
  return outline.value().area;
}

double intervalArea(const Shape& shape, double height, int rows) {
  double sum = 0;
  const double step = height / rows;
  for (const auto& row : insideIntervals(shape, 0.5 * step, step, rows)) {
    for (const Interval& interval : row) sum += (interval.end - interval.begin) * step;
  }
  return sum;
}

}  // namespace

TEST_CASE("pieces of one line do not cross where its crossings lie 12 nm apart") {
  // A thin triangle over two bars that all but touch, the upper of which is drawn twice.
  const Vec2 foot{14.571898, 4.743180};
  const Vec2 tip{1.214758, 13.651802};
  const double rows[] = {6.750035, 10.568253, 10.568265, 10.568267, 10.840414};
  const auto bar = [](double low, double high) { return FilledPath{{{{0, low}, {20, low}, {20, high}, {0, high}}}}; };
  const Shape drawing{{FilledPath{{{foot, tip, {foot.x + 3, foot.y}}}}, bar(rows[0], rows[1]), bar(rows[2], rows[4]),
                       bar(rows[3], rows[4])},
                      {20, 20}};
  const auto above = [&](double y) { return 1.5 * (tip.y - y) * (tip.y - y) / (tip.y - foot.y); };  // of the triangle
  const double outside = above(foot.y) - above(rows[0]) + above(rows[1]) - above(rows[2]) + above(rows[4]);
  const auto outline = resolveOutline(drawing);
  REQUIRE(outline);
  CHECK(outline.value().area == doctest::Approx(20 * (rows[1] - rows[0] + rows[4] - rows[2]) + outside).epsilon(1e-6));
}

TEST_CASE("crossings 0.15 nm apart are two points, at each of which pieces share their ends") {
  // Two lines cross a level one at the same place, but for rounding errors, and a third crosses it close by. The second
  // place was forgotten beside the first one, so pieces ended there at places that differed in their last digits.
  for (int k = 0; k < 100; ++k) {
    const double x = 1e-6 * (4711 * k % 1000);
    const auto through = [&](double px, double slope) {
      return PathEdge{{px - 0.7 * slope, -0.2}, {px + 1.1 * slope, 1.6}, 0};
    };
    const std::vector<PathEdge> edges{{{-2, 0.5}, {3, 0.5}, 0},
                                      through(x, 0.3 + 0.01 * k),
                                      through(x + 1.5e-7, -0.2 - 0.003 * k),
                                      through(x + 1.5e-7, -1.1 - 0.007 * k)};
    Bounds box;
    for (const PathEdge& edge : edges) {
      box.add(edge.a);
      box.add(edge.b);
    }
    const auto pieces = splitEdges(edges, box, Points::AsGiven);
    REQUIRE(pieces);
    int near = 0;
    for (const PathEdge& one : *pieces) {
      for (const PathEdge& other : *pieces) {
        const double apart = length(one.b - other.a);
        if (apart > 0 && apart <= kTouch) ++near;
      }
    }
    CHECK(near == 0);
  }
}

TEST_CASE("level edges 2 nm above the lowest point are read like others") {
  // As 2 nm is how near edges count as touching, they were looked for in infinitely many columns (breeze's
  // application-x-godot-shader at 33.3 mm), or in none.
  for (int k = 0; k < 64; ++k) {
    CAPTURE(k);
    const double low = std::round(1e6 + 1e4 * k) / 1e6;
    const double above = std::round(1e6 + 1e4 * k + 2) / 1e6;
    const Ring sheet{{0, above}, {0, 25}, {10, 25}, {10, above}};
    const Ring wedge{{8, low}, {12, low}, {10, 24}};
    const Shape shape{{{{sheet}, FillRule::NonZero}, {{wedge}, FillRule::NonZero}}, {20, 30}};
    CHECK(areaOf(shape) == about(10 * (25 - low) + 24 - low, 1e-6));
  }
}

TEST_CASE("a square's outline is its four edges with the inside on the left, whatever the winding") {
  Ring ring = rectangle({1, 2}, {4, 6});
  for (int turn = 0; turn < 2; ++turn) {
    const auto outline = resolveOutline(shapeOf({ring}, {5, 7}));
    REQUIRE(outline.ok());
    CHECK(outline.value().segments.size() == 4);
    CHECK(outline.value().area == doctest::Approx(12));
    for (const BorderSegment& s : outline.value().segments) CHECK(cross(s.b - s.a, Vec2{2.5, 4} - s.a) > 0);
    std::reverse(ring.begin(), ring.end());
  }
}

TEST_CASE("overlapping paths are united, and edges inside the union are no border") {
  const Shape shape{
      {{{rectangle({0, 0}, {4, 4})}, FillRule::NonZero}, {{rectangle({2, 1}, {6, 3})}, FillRule::NonZero}}, {6, 4}};
  CHECK(areaOf(shape) == doctest::Approx(16 + 8 - 4));
  CHECK(intervalArea(shape, 4, 4000) == about(20, 1e-3));
}

TEST_CASE("the same path drawn twice counts once under nonzero and vanishes under even-odd") {
  const Ring ring = circle({5, 5}, 4);
  const double once = areaOf(shapeOf({ring}, {10, 10}));
  CHECK(areaOf(shapeOf({ring, ring}, {10, 10}, FillRule::NonZero)) == doctest::Approx(once));
  const auto none = resolveOutline(shapeOf({ring, ring}, {10, 10}, FillRule::EvenOdd));
  REQUIRE(!none.ok());
  CHECK(none.error().code == ErrorCode::EmptyShape);
}

TEST_CASE("what lies on one plain sheet does not count among the pieces of a drawing") {
  // Bars that cross in 4.4 million places: more pieces than are read where they count.
  const auto bars = [](int count) {
    std::vector<FilledPath> paths;
    for (int k = 0; k < count; ++k) {
      const double at = 1 + 98.0 * k / count;
      paths.push_back({{rectangle({1, at}, {99, at + 0.01})}, FillRule::NonZero});
      paths.push_back({{rectangle({at, 1}, {at + 0.01, 99})}, FillRule::EvenOdd});
    }
    return paths;
  };
  std::vector<FilledPath> paths = bars(1050);
  CHECK(resolveOutline({paths, {100, 100}}).error().code == ErrorCode::TooLarge);
  paths.push_back({{rectangle({0, 0}, {100, 100})}, FillRule::NonZero});
  const auto outline = resolveOutline({paths, {100, 100}});
  REQUIRE(outline.ok());
  CHECK(outline.value().segments.size() == 4);
  CHECK(outline.value().area == 10000);
}

TEST_CASE("only a convex path that goes round once hides what lies within its corners") {
  // The star's edges all turn left, but it goes round twice: between its tips lies nothing of it.
  Ring star;
  for (int k = 0; k < 5; ++k)
    star.push_back(
        {10 + 10 * std::sin(4 * std::numbers::pi * k / 5), 10 + 10 * std::cos(4 * std::numbers::pi * k / 5)});
  const Ring between = rectangle({16, 15}, {17, 16});
  const FilledPath stars{{star}, FillRule::NonZero};
  const double alone = areaOf({{stars}, {20, 20}});
  CHECK(areaOf({{stars, {{between}, FillRule::NonZero}}, {20, 20}}) == doctest::Approx(alone + 1));
  // A frame has a convex ring, but is not filled within it.
  const FilledPath frame{{rectangle({0, 0}, {9, 9}), rectangle({1, 1}, {8, 8})}, FillRule::EvenOdd};
  const FilledPath inner{{rectangle({3, 3}, {5, 5})}, FillRule::NonZero};
  CHECK(areaOf({{frame, inner}, {9, 9}}) == doctest::Approx(81 - 49 + 4));
  // One of two equal paths stays, and so does what looks out by a corner.
  const FilledPath disc{{circle({5, 5}, 4, 64)}, FillRule::NonZero};
  CHECK(areaOf({{disc, disc}, {9, 9}}) == doctest::Approx(areaOf({{disc}, {9, 9}})));
  const FilledPath corner{{rectangle({2, 2}, {5, 5})}, FillRule::NonZero};
  CHECK(areaOf({{disc, corner}, {9, 9}}) > areaOf({{disc}, {9, 9}}) + 0.01);
}

TEST_CASE("rectangles that share an edge, or a part of one, have no border between them") {
  const Shape shape = shapeOf({rectangle({0, 0}, {3, 4}), rectangle({3, 1}, {5, 3})}, {5, 4}, FillRule::NonZero);
  CHECK(areaOf(shape) == doctest::Approx(16));
  const Outline outline = resolveOutline(shape).value();
  for (const BorderSegment& s : outline.segments) {
    const Vec2 middle = (s.a + s.b) * 0.5;
    CHECK_FALSE((std::abs(middle.x - 3) < 1e-9 && middle.y > 1 && middle.y < 3));
  }
}

TEST_CASE("a bow tie crosses itself: two triangles, both inside, whichever rule") {
  const Ring bow = {{0, 0}, {4, 4}, {4, 0}, {0, 4}};
  for (const FillRule rule : {FillRule::NonZero, FillRule::EvenOdd})
    CHECK(areaOf(shapeOf({bow}, {4, 4}, rule)) == doctest::Approx(8));
}

TEST_CASE("a pentagram's middle is inside under nonzero and outside under even-odd") {
  Ring star;
  for (int k = 0; k < 5; ++k) {
    const double a = std::numbers::pi * (0.5 + 0.8 * k);
    star.push_back({5 + 5 * std::cos(a), 5 + 5 * std::sin(a)});
  }
  const double full = areaOf(shapeOf({star}, {10, 10}, FillRule::NonZero));
  const double holed = areaOf(shapeOf({star}, {10, 10}, FillRule::EvenOdd));
  const double inner = 5 * std::pow(5 * 0.3819660112501051, 2) / 2 * std::sin(2 * std::numbers::pi / 5);
  CHECK(full - holed == doctest::Approx(inner));
}

TEST_CASE("nested rings of one sense are filled under nonzero, a hole under even-odd") {
  const std::vector<Ring> rings = {rectangle({0, 0}, {6, 6}), rectangle({2, 2}, {4, 4})};
  CHECK(areaOf(shapeOf(rings, {6, 6}, FillRule::NonZero)) == doctest::Approx(36));
  CHECK(areaOf(shapeOf(rings, {6, 6}, FillRule::EvenOdd)) == doctest::Approx(32));
}

TEST_CASE("the area of the outline is that of its intervals for random overlapping polygons") {
  scenes::Random random(5);
  for (int k = 0; k < 40; ++k) {
    std::vector<Ring> rings;
    for (int r = 0; r < 3; ++r) {
      Ring ring;
      for (int c = 0; c < 3 + random.index(9); ++c) ring.push_back({random.in(0, 10), random.in(0, 10)});
      rings.push_back(ring);
    }
    const Shape shape = shapeOf(rings, {10, 10}, k % 2 == 0 ? FillRule::NonZero : FillRule::EvenOdd);
    CAPTURE(k);
    CHECK(areaOf(shape) == about(intervalArea(shape, 10, 5000), 2e-3));
  }
}

TEST_CASE("on the grid pieces meet at their ends only, and from each point as many go as come") {
  using Point = std::pair<std::int64_t, std::int64_t>;
  scenes::Random random(4);
  for (int round = 0; round < 60; ++round) {
    CAPTURE(round);
    // Spokes through a region of a few steps, along one line, or anywhere: next to nothing lies on the grid already.
    const double size = round % 3 == 0 ? 0.02 : 5;
    Ring ring;
    for (int k = 0; k < 14; ++k) {
      const double x = random.in(0, size);
      ring.push_back(round % 3 == 1 ? Vec2{x, 0.7 * x + random.in(0, 0.004)} : Vec2{x, random.in(0, size)});
    }
    const Shape shape = shapeOf({ring}, {5, 5});
    const auto exact = resolveOutline(shape);
    const auto outline = outlineOnGrid(shape);
    REQUIRE(exact.ok());
    REQUIRE(outline.ok());
    double border = 0;
    for (const BorderSegment& s : exact.value().segments) border += length(s.b - s.a);
    CHECK(std::abs(outline.value().area - exact.value().area) <= 0.001 * border);
    const auto point = [](Vec2 p) { return Point{std::llround(p.x * 1000), std::llround(p.y * 1000)}; };
    const auto turn = [](Point a, Point b, Point c) {
      return (b.first - a.first) * (c.second - a.second) - (b.second - a.second) * (c.first - a.first);
    };
    std::map<Point, int> balance;
    std::vector<std::pair<Point, Point>> pieces;
    for (const BorderSegment& s : outline.value().segments) {
      pieces.emplace_back(point(s.a), point(s.b));
      CHECK(
          length(Vec2{static_cast<double>(pieces.back().first.first), static_cast<double>(pieces.back().first.second)} -
                 s.a * 1000.0) < 1e-9);
      ++balance[pieces.back().first];
      --balance[pieces.back().second];
    }
    CHECK(std::all_of(balance.begin(), balance.end(), [](const auto& at) { return at.second == 0; }));
    const auto side = [](std::int64_t v) { return v > 0 ? 1 : v < 0 ? -1 : 0; };
    for (const auto& [a, b] : pieces) {
      for (const auto& [c, d] : pieces) {
        const bool across =
            side(turn(a, b, c)) * side(turn(a, b, d)) < 0 && side(turn(c, d, a)) * side(turn(c, d, b)) < 0;
        CHECK(!across);
        const bool between = std::min(a.first, b.first) <= c.first && c.first <= std::max(a.first, b.first) &&
                             std::min(a.second, b.second) <= c.second && c.second <= std::max(a.second, b.second);
        CHECK((c == a || c == b || !between || turn(a, b, c) != 0));
      }
    }
  }
  CHECK(outlineOnGrid(shapeOf({rectangle({0, 0}, {1e-4, 1e-4})}, {1, 1})).error().code == ErrorCode::EmptyShape);
}

TEST_CASE("paths that overlap, share an edge or all but touch are united into one ring") {
  for (const double gap : {0.0, 1e-6, -1e-6, 4e-4, -0.5}) {
    CAPTURE(gap);
    Shape shape{{}, {20, 12}};
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 6; ++x) {
        const Vec2 low{2.0 + 3 * x, 1.0 + 2 * y};
        shape.paths.push_back({{rectangle(low, low + Vec2{3 - gap, 2 - gap})}, FillRule::NonZero});
      }
    }
    const Shape united = unitedOnGrid(shape).value();
    CHECK(united.page == shape.page);
    REQUIRE(united.paths.size() == 1);
    REQUIRE(united.paths[0].rings.size() == 1);
    CHECK(scenes::shoelace(united.paths[0].rings[0]) == doctest::Approx(areaOf(shape)).epsilon(1e-3));
    CHECK(intervalArea(united, 12, 240) == doctest::Approx(areaOf(shape)).epsilon(1e-3));
  }
  // Two squares at a corner, and a hole.
  const Shape corner{
      {{{rectangle({0, 0}, {4, 4})}}, {{rectangle({4, 4}, {8, 8}), rectangle({5, 5}, {6, 6})}, FillRule::EvenOdd}},
      {8, 8}};
  CHECK(areaOf(unitedOnGrid(corner).value()) == doctest::Approx(31));
  CHECK(unitedOnGrid(Shape{}).error().code == ErrorCode::EmptyShape);
}

TEST_CASE("shapes without area say so") {
  for (const Shape& shape :
       {Shape{{}, {5, 5}}, shapeOf({{{0, 0}, {5, 0}, {2, 0}}}, {5, 5}), shapeOf({{{1, 1}, {1, 1}, {1, 1}}}, {5, 5})}) {
    const auto outline = resolveOutline(shape);
    REQUIRE(!outline.ok());
    CHECK(outline.error().code == ErrorCode::EmptyShape);
  }
}

TEST_CASE("a point that is no place on a plate is refused") {
  const double nan = std::nan("");
  const double infinite = std::numeric_limits<double>::infinity();
  const Shape square = shapeOf({rectangle({0, 0}, {10, 10})}, {10, 10});
  for (const double odd : {nan, infinite, -infinite, 1e200, -1e15, 1.000001e6}) {
    for (const Vec2 p : {Vec2{odd, 5}, Vec2{5, odd}}) {
      Shape ring = square;
      ring.paths[0].rings[0][2] = p;
      CAPTURE(odd);
      for (const auto& outline : {resolveOutline(ring), outlineOnGrid(ring)}) {
        REQUIRE(!outline.ok());
        CHECK(outline.error().code == ErrorCode::InvalidArgument);
      }
    }
  }
  CHECK(resolveOutline(shapeOf({rectangle({-1e6, 0}, {1e6, 10})}, {10, 10})).value().area == doctest::Approx(2e7));
}

TEST_CASE("a drawing that meets itself too often is refused, not computed for ever") {
  Ring zigzag;
  for (int k = 0; k < 200000; ++k)
    zigzag.push_back({k % 2 == 0 ? 0.0 : 100.0, 100.0 * ((k * 7919) % 200000) / 200000.0});
  const auto outline = resolveOutline(shapeOf({zigzag}, {100, 100}));
  REQUIRE(!outline.ok());
  CHECK(outline.error().code == ErrorCode::TooLarge);
}
