#include "sillon/stitch.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "curves.hpp"
#include "sillon/contour.hpp"
#include "sillon/narrow_places.hpp"
#include "sillon/sine_field.hpp"
#include "sillon/tiny_cycles.hpp"
#include "support/scenes.hpp"

using namespace sillon;

namespace {

struct Stitching {
  ClosedCurves before;
  Stitched after;
  int parts = 0;
};

Stitching stitchingOf(const PlateInput& input, const ToolpathParams& params = {},
                      const RunContext& run = RunContext(1)) {
  const Outline outline = resolveOutline(input.shape).value();
  const Grid grid = makeGrid(outline.bounds, params.spacing);
  const BorderIndex border = buildBorderIndex(outline, grid, run).value();
  const SignedDistanceField sdf = signedDistanceField(input.shape, border, grid, run).value();
  const CellConstraints cells =
      cellConstraints(sdf, input.directions, input.modes, input.shape.page, params, run).value();
  const LineField lines = lineField(sdf, cells, params, run).value();
  const SineField waves = alignPhases(lines, std::vector<float>(grid.size(), 1.0f), sdf, cells, params, run).value();
  const Grid nodes = nodeLattice(grid);
  const float spacing = static_cast<float>(params.spacing);
  const std::vector<float> distance = bandDistance(input.shape, border, nodes, spacing, run).value();
  std::vector<float> values = evaluateSineField(waves, distance, params, run).value();
  const Parts parts = labelParts(sdf, border, params.spacing, params.bridge.value_or(params.spacing));
  keepThinParts(parts, sdf, params.spacing, values);
  fillNarrowPlaces(nodes, distance, params.spacing, values);
  const ClosedCurves contour = contourCycles(nodes, values, distance, params.spacing, run).value();
  Stitching s;
  s.before = settleTinyCycles(resampledSimply(contour, 0.25f * spacing, run), border, params.spacing, run);
  s.after = stitchCycles(s.before, lines, border, parts, params, run).value();
  s.parts = s.after.parts;
  return s;
}

}  // namespace

TEST_CASE("stitching leaves one simple cycle per connected part and moves no point (Sec. 5.5)") {
  for (const auto& scene : scenes::all()) {
    for (const PerimeterMode mode : {PerimeterMode::None, PerimeterMode::Soft, PerimeterMode::Count}) {
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

TEST_CASE("misaligned length is avoided when it costs more") {
  // Alignment of the joined path with the map, with and without a price on it.
  const auto misaligned = [](double price) {
    ToolpathParams params;
    params.stitchAlignment = price;
    const PlateInput input =
        scenes::plate(scenes::shapeOf({scenes::rectangle({0, 0}, {24, 20})}, {24, 20}), scenes::swirl());
    const Stitching s = stitchingOf(input, params);
    double sum = 0;
    for (int c = 0; c < s.after.curves.count(); ++c) {
      for (int i = s.after.curves.begin[static_cast<std::size_t>(c)];
           i < s.after.curves.begin[static_cast<std::size_t>(c) + 1]; ++i) {
        const Vec2f a = s.after.curves.points[static_cast<std::size_t>(i)];
        const Vec2f b = s.after.curves.points[static_cast<std::size_t>(nextOf(s.after.curves, c, i))];
        const Vec2 p{static_cast<double>(0.5f * (a.x + b.x)), static_cast<double>(0.5f * (a.y + b.y))};
        const TexelIndex t = texelAt(p, input.shape.page, 96, 96);
        const Vec2f z = beadLine(input.directions.angle[static_cast<std::size_t>(t.y * 96 + t.x)]);
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
