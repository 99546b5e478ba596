#include "toolpath/path.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/closed_curves.hpp"
#include "pipeline/stages.hpp"
#include "support/scenes.hpp"
#include "toolpath/joining.hpp"

using namespace sillon;

namespace {

struct Stitching {
  ClosedCurves before;
  Stitched after;
  int parts = 0;
  double cells = 0;
};

Stitching stitchingOf(const PlateInput& input, const ToolpathParams& params = {},
                      const RunContext& run = RunContext(1)) {
  Stages stages = generateStages(input, params, run).value();
  const double cells = static_cast<double>(stages.lines.grid.size());
  return {std::move(stages.cycles), std::move(stages.stitched), stages.stitched.parts, cells};
}

// Length of the curves that lies outside the shape [mm], by the rule it is filled with, point by point.
double outsideOf(const ClosedCurves& curves, const Shape& shape) {
  const auto inside = [&](Vec2 p) {
    int odd = 0, winding = 0;
    for (const Ring& ring : shape.paths[0].rings) {
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Vec2 a = ring[k], b = ring[(k + 1) % ring.size()];
        if ((a.y <= p.y) == (b.y <= p.y)) continue;
        if ((p.y - a.y) * (b.x - a.x) / (b.y - a.y) + a.x < p.x) continue;
        ++odd;
        winding += a.y <= p.y ? 1 : -1;
      }
    }
    return shape.paths[0].fillRule == FillRule::EvenOdd ? odd % 2 == 1 : winding != 0;
  };
  double outside = 0;
  for (int c = 0; c < curves.count(); ++c) {
    for (int k = 0; k < curves.size(c); ++k) {
      const int i = curves.begin[c] + k;
      const Vec2f from = curves.points[i];
      const Vec2f to = curves.points[nextOf(curves, c, i)];
      const Vec2 a{static_cast<double>(from.x), static_cast<double>(from.y)};
      const Vec2 b{static_cast<double>(to.x), static_cast<double>(to.y)};
      const int steps = static_cast<int>(length(b - a) / 0.01) + 1;
      for (int n = 0; n < steps; ++n) outside += inside(a + (b - a) * ((n + 0.5) / steps)) ? 0 : length(b - a) / steps;
    }
  }
  return outside;
}

}  // namespace

TEST_CASE("stitching leaves one simple cycle per connected part and moves no point (Sec. 5.5)") {
  for (const auto& scene : scenes::all()) {
    for (const PerimeterMode mode : scenes::kPerimeterModes) {
      CAPTURE(scene.name);
      CAPTURE(static_cast<int>(mode));
      ToolpathParams params;
      params.perimeterMode = mode;
      const Stitching s = stitchingOf(scene.input, params);
      CHECK(s.parts == scene.parts);
      CHECK(s.after.curves.count() == scene.parts);
      CHECK(findCrossings(s.before, RunContext(1)).empty());
      CHECK(findCrossings(s.after.curves, RunContext(1)).empty());
      // Every point is one of the contour's, used once; a sliver's cycles are so tiny that they are joined in two goes,
      // with equal steps between.
      std::vector<std::pair<float, float>> before;
      std::vector<std::pair<float, float>> after;
      for (const Vec2f p : s.before.points) before.emplace_back(p.x, p.y);
      for (const Vec2f p : s.after.curves.points) after.emplace_back(p.x, p.y);
      std::sort(before.begin(), before.end());
      std::sort(after.begin(), after.end());
      if (scene.name != "sliver") CHECK(std::includes(before.begin(), before.end(), after.begin(), after.end()));
      CHECK(after.size() > before.size() * 3 / 5);
    }
  }
}

TEST_CASE("curves nearer than chords may be are resampled where there is room, and still do not meet") {
  // Two stadiums of fine points, one just inside the other: steps of 0.4 mm would cut their round ends.
  ClosedCurves fine;
  for (const double radius : {0.5, 0.48}) {
    fine.begin.push_back(static_cast<int>(fine.points.size()));
    for (const double side : {1.0, -1.0}) {
      for (int k = 0; k < 60; ++k) {
        const double a = side * (std::numbers::pi * k / 60 - std::numbers::pi / 2);
        fine.points.push_back(
            {static_cast<float>(side * (10 + radius * std::cos(a))), static_cast<float>(radius * std::sin(a))});
      }
    }
  }
  fine.begin.push_back(static_cast<int>(fine.points.size()));
  ClosedCurves dense = resampled(fine, 0.02f, RunContext(1));
  const auto inner = dense.points.begin() + dense.begin[1];
  std::rotate(inner, inner + 10, dense.points.end());  // steps of both begin elsewhere
  REQUIRE(findCrossings(dense, RunContext(1)).empty());
  REQUIRE_FALSE(findCrossings(resampled(dense, 0.4f, RunContext(1)), RunContext(1)).empty());
  const ClosedCurves out = resampledSimply(dense, 0.4f, RunContext(1));
  CHECK(findCrossings(out, RunContext(1)).empty());
  CHECK(out.points.size() < dense.points.size() / 2);
}

TEST_CASE("islands stay apart with bridge 0 and join when the bridge spans their gap") {
  const auto island = [](double gap) {
    return scenes::plate(
        scenes::shapeOf({scenes::rectangle({0, 0}, {6, 6}), scenes::rectangle({6 + gap, 0}, {12, 6})}, {12, 6}),
        scenes::waves());
  };
  ToolpathParams params;
  params.bridge = 0;
  CHECK(stitchingOf(island(0.07), params).after.curves.count() == 2);
  params.bridge = 0.1;
  CHECK(stitchingOf(island(0.07), params).after.curves.count() == 1);
  params.bridge = 1.5;
  CHECK(stitchingOf(island(1.2), params).after.curves.count() == 1);
  CHECK(stitchingOf(island(1.7), params).after.curves.count() == 2);
}

TEST_CASE("a neck too narrow for a bead still joins its two sides, inside the shape") {
  const PlateInput input = scenes::plate(
      scenes::shapeOf({scenes::circle({5, 5}, 5), scenes::circle({17, 5}, 5), scenes::rectangle({9, 4.85}, {13, 5.15})},
                      {22, 10}, FillRule::NonZero),
      scenes::waves());
  const Stitching s = stitchingOf(input);
  CHECK(s.after.curves.count() == 1);
  CHECK(s.after.longestJoint > 2);
}

TEST_CASE("a joint leaves the shape by half a bridge and half a bead at most") {
  // Two teeth on a bar too thin for a bead, hollow below them: only across the room between them, over the bar, can
  // they be joined. A thread at the height of their middles would lie 0.6 mm from it.
  ToolpathParams params;
  params.bridge = 0.2;
  const double bar = 0.37;
  const double from = 3, to = 5.1;
  const Shape shape =
      scenes::shapeOf({scenes::rectangle({0, 0}, {12, bar}), scenes::rectangle({1, bar - 0.12}, {from, bar + 1.2}),
                       scenes::rectangle({to, bar - 0.12}, {to + 2, bar + 1.2})},
                      {12, bar + 1.2});
  for (const double angle : {0.0, 0.5 * std::numbers::pi}) {
    CAPTURE(angle);
    const Stitching s =
        stitchingOf(scenes::plate(shape, scenes::mapOf(1, [&](double, double) { return angle; })), params);
    CHECK(s.after.parts == 1);
    CHECK(s.after.curves.count() == 1);
    double farthest = 0;
    const ClosedCurves fine = resampled(s.after.curves, 0.01f, RunContext(1));
    for (const Vec2f q : fine.points) {
      const Vec2 p{static_cast<double>(q.x), static_cast<double>(q.y)};
      farthest = std::max(farthest, std::min({p.y - bar, p.x - from, to - p.x}));
    }
    CHECK(farthest > 0.05);
    CHECK(farthest < 0.31);
  }
}

TEST_CASE("solids of one part that nothing can join stay apart after bounded work, and are counted") {
  // A frame too thin for a bead makes the two squares one part; a wall of another part stands between them.
  using scenes::rectangle;
  const double line = 0.15;
  const Shape shape =
      scenes::shapeOf({rectangle({0, 0}, {30, line}), rectangle({0, 20 - line}, {30, 20}),
                       rectangle({0, 0}, {line, 20}), rectangle({30 - line, 0}, {30, 20}), rectangle({0, 6}, {8, 14}),
                       rectangle({22, 6}, {30, 14}), rectangle({14, 0.75}, {16, 19.25})},
                      {30, 20}, FillRule::NonZero);
  const Stitching s = stitchingOf(scenes::plate(shape, scenes::waves()));
  CHECK(s.after.parts == 2);
  CHECK(s.after.curves.count() == 3);
  CHECK(s.after.unjoined() == 1);
  CHECK(s.after.gapJoints == 0);
  CHECK(static_cast<double>(s.after.work) < 5 * s.cells);
}

TEST_CASE("the work on a drawing of many solids grows with its cells, and each part becomes one cycle") {
  // Dots 0.2 to 1.2 spacings apart: the nearer ones are one part.
  double least = 1e9, most = 0;
  for (const int count : {6, 12, 24}) {
    std::vector<Ring> dots;
    for (int k = 0; k < count * count; ++k) {
      const int x = k % count, y = k / count;
      const double radius = 0.7 + 0.1 * std::sin(1.7 * x) * std::cos(1.3 * y);
      dots.push_back(scenes::circle({1.7 * x + 1, 1.7 * y + 1}, radius, 32));
    }
    const double side = 1.7 * count + 0.3;
    const Stitching s = stitchingOf(scenes::plate(scenes::shapeOf(std::move(dots), {side, side}),
                                                  scenes::mapOf(1, [](double, double) { return 0.5; })));
    CAPTURE(count);
    CHECK(s.after.unjoined() == 0);
    CHECK(s.after.parts < count * count);
    const double perCell = static_cast<double>(s.after.work) / s.cells;
    least = std::min(least, perCell);
    most = std::max(most, perCell);
  }
  CHECK(most < 60);
  CHECK(most < 2.5 * least);
}

namespace {

// Curves by hand on a page of 40 x 40 mm, far from its border, where all beads are asked to run along x.
struct ByHand {
  ToolpathParams params;
  BorderIndex border;
  LineField lines;
  Parts parts;

  explicit ByHand(const Shape& shape = scenes::shapeOf({scenes::rectangle({0, 0}, {40, 40})}, {40, 40})) {
    const RunContext run(1);
    const Outline outline = resolveOutline(shape).value();
    const Grid grid = makeGrid(outline.bounds, params.spacing);
    border = buildBorderIndex(outline, grid, run).value();
    lines = {grid, std::vector<Vec2f>(grid.size(), {0, 1}), std::vector<std::uint8_t>(grid.size(), 1)};
    parts = {grid, std::vector<std::int32_t>(grid.size(), 0), 1};
  }
  [[nodiscard]] Stitched stitch(const ClosedCurves& curves) const {
    return stitchCycles(curves, lines, border, parts, params, RunContext(1)).value();
  }
};

// Points of `before` that a joint has taken out.
std::vector<Vec2f> takenOut(const ClosedCurves& before, const ClosedCurves& after) {
  std::vector<Vec2f> taken;
  for (const Vec2f p : before.points) {
    if (std::find(after.points.begin(), after.points.end(), p) == after.points.end()) taken.push_back(p);
  }
  return taken;
}

}  // namespace

TEST_CASE("of two joints alike but for their length the shorter one is made (Eq. 14)") {
  // The lower curve's top comes within 0.5 mm of the upper one at x = 15 and within 0.4 mm at x = 25, or the other way
  // round. Slopes are so long that directions do not matter; the first point of either curve lies at the wider place.
  for (const bool first : {true, false}) {
    ByHand page;
    page.params.stitchAlignment = 0;
    const float at15 = first ? 9.6f : 9.5f;
    const float at25 = first ? 9.5f : 9.6f;
    const ClosedCurves curves =
        resampled(scenes::closed({{{first ? 25.0f : 15.0f, 10}, {35, 10}, {35, 14}, {5, 14}, {5, 10}},
                                  {{20, 6},
                                   {32, 6},
                                   {32, 9.2f},
                                   {26, at25},
                                   {24, at25},
                                   {20, 9.2f},
                                   {16, at15},
                                   {14, at15},
                                   {8, 9.2f},
                                   {8, 6}}}),
                  0.1f, RunContext(1));
    // Neighbours run in opposite senses: both are anticlockwise.
    const Stitched s = page.stitch(curves);
    REQUIRE(s.curves.count() == 1);
    const std::vector<Vec2f> taken = takenOut(curves, s.curves);
    CHECK(taken.size() >= 4);
    for (const Vec2f p : taken) CHECK(std::abs(p.x - (first ? 15.0f : 25.0f)) < 1.6f);
  }
}

TEST_CASE("of two joints equally long the one along the wanted beads is made") {
  // An L: the inner curve lies 0.4 mm from the outer one's upper side and from its right side. Joints run across: at
  // the upper side along y, at the right side along x, where beads are asked to run.
  for (const bool alongX : {true, false}) {
    ByHand page;
    page.params.stitchAlignment = 2;
    for (Vec2f& d : page.lines.direction) d = alongX ? Vec2f{0, 1} : Vec2f{1, 0};
    const ClosedCurves curves = resampled(scenes::closed({{{10, 20}, {20, 20}, {20, 10}, {24, 10}, {24, 24}, {10, 24}},
                                                          {{12, 12}, {19.6f, 12}, {19.6f, 19.6f}, {12, 19.6f}}}),
                                          0.1f, RunContext(1));
    const Stitched s = page.stitch(curves);
    REQUIRE(s.curves.count() == 1);
    for (const Vec2f p : takenOut(curves, s.curves)) CHECK((alongX ? p.x > 19.5f : p.y > 19.5f));
  }
}

TEST_CASE("a joint does not turn a tiny cycle inside out") {
  // A hexagon above a row. With the three segments of its far side taken out, both edges to a row of the wrong sense
  // pass beside what is left of it and meet nothing; only the line between the pieces' middles does.
  const ByHand page;
  for (const bool far : {true, false}) {
    std::vector<Vec2f> square = {{15, 15}, {25, 15}, {25, 5}, {15, 5}};
    if (!far) std::reverse(square.begin(), square.end());
    ClosedCurves curves = resampled(scenes::closed({square}), 0.1f, RunContext(1));
    const int first = static_cast<int>(curves.points.size());
    for (int k = 0; k < 6; ++k) {
      const double a = std::numbers::pi * (1 + 2 * k) / 6;
      curves.points.push_back(
          {static_cast<float>(20 + 0.15 * std::cos(a)), static_cast<float>(15.4 + 0.15 * std::sin(a))});
    }
    curves.begin.push_back(first + 6);
    int below = -1;  // the row's point under the hexagon's middle
    for (int k = 0; k < first; ++k) {
      const Vec2f p = curves.points[k];
      if (std::abs(p.x - 20) < 0.05f && std::abs(p.y - 15) < 0.01f) below = k;
    }
    REQUIRE(below >= 0);
    const PointGrid grid(curves.points, 0.4f, RunContext(1));
    Joining joining(curves, grid, page.lines, page.border, page.params);
    CHECK(joining.join({0, below, first + (far ? 1 : 4), 4}, 0) == !far);
    CHECK(joining.joined().count() == (far ? 2 : 1));
  }
}

TEST_CASE("two strands in one cell are joined to what lies beyond the outer one") {
  // A path as thin as a thread, out of reach of a square on its right: the cells know the strand that comes first, here
  // the left one, and no joint gets from it across the other.
  const ByHand page;
  for (const float left : {10.02f, 10.1f, 10.16f}) {
    CAPTURE(left);
    const float right = left + 0.02f;
    const ClosedCurves curves = resampled(
        scenes::closed({{{right, 30}, {left, 30}, {left, 10}, {right, 10}}, {{13, 19}, {15, 19}, {15, 21}, {13, 21}}}),
        0.1f, RunContext(1));
    const Stitched s = page.stitch(curves);
    CHECK(s.curves.count() == 1);
    CHECK(findCrossings(s.curves, RunContext(1)).empty());
  }
}

TEST_CASE("where solids have no gaps no joint leaves the shape") {
  // Teeth on a back, as far apart as beads may be joined; and what all scenes of one solid are.
  std::vector<Ring> comb = {scenes::rectangle({0, 0}, {16, 2})};
  for (int k = 0; k < 8; ++k) comb.push_back(scenes::rectangle({2.1 * k, 1}, {2.1 * k + 1.9, 9}));
  std::vector<scenes::Scene> scenes = scenes::all();
  std::erase_if(scenes, [](const scenes::Scene& s) { return s.name.find("island") != std::string::npos; });
  std::erase_if(scenes, [](const scenes::Scene& s) { return s.name == "neck"; });  // no bead fits into it
  scenes.push_back({"comb", scenes::plate(scenes::shapeOf(comb, {17, 9}, FillRule::NonZero), scenes::waves())});
  scenes.push_back({"across the comb", scenes::plate(scenes::shapeOf(comb, {17, 9}, FillRule::NonZero),
                                                     scenes::mapOf(1, [](double, double) { return 0.0; }))});
  for (const scenes::Scene& scene : scenes) {
    for (const PerimeterMode mode : scenes::kPerimeterModes) {
      CAPTURE(scene.name);
      CAPTURE(static_cast<int>(mode));
      ToolpathParams params;
      params.perimeterMode = mode;
      const Stitching s = stitchingOf(scene.input, params);
      CHECK(s.after.gapJoints == 0);
      CHECK(outsideOf(s.after.curves, scene.input.shape) < 0.01);
    }
  }
}

TEST_CASE("misaligned length is avoided when it costs more") {
  // Alignment of the joined path with the map, with and without a price on it.
  const std::vector<Vec2f> lines = beadLines();
  const auto misaligned = [&](double price) {
    ToolpathParams params;
    params.stitchAlignment = price;
    const PlateInput input =
        scenes::plate(scenes::shapeOf({scenes::rectangle({0, 0}, {24, 20})}, {24, 20}), scenes::swirl());
    const Stitching s = stitchingOf(input, params);
    double sum = 0;
    for (int c = 0; c < s.after.curves.count(); ++c) {
      for (int i = s.after.curves.begin[c]; i < s.after.curves.begin[static_cast<std::size_t>(c) + 1]; ++i) {
        const Vec2f a = s.after.curves.points[i];
        const Vec2f b = s.after.curves.points[nextOf(s.after.curves, c, i)];
        const Vec2 p{static_cast<double>(0.5f * (a.x + b.x)), static_cast<double>(0.5f * (a.y + b.y))};
        const TexelIndex t = texelAt(p, input.shape.page, 96, 96);
        const Vec2f z = lines[input.directions.angle[t.y * 96 + t.x]];
        const Vec2f e = b - a;
        const float size = length(e);
        if (size > 0)
          sum += static_cast<double>(0.5f * (size - ((e.x * e.x - e.y * e.y) * z.x + 2 * e.x * e.y * z.y) / size));
      }
    }
    return sum;
  };
  CHECK(misaligned(2.0) < misaligned(0.0));
}

TEST_CASE("stitching is equal for any number of threads") {
  const auto scene = scenes::all()[8];
  const Stitching one = stitchingOf(scene.input, {}, RunContext(1));
  for (const int threads : {2, 3, 8})
    CHECK(stitchingOf(scene.input, {}, RunContext(threads)).after.curves.points == one.after.curves.points);
}
