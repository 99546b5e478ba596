#include "sillon/quality/metrics.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <utility>

#include "report/told.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "sillon/report/report.hpp"
#include "sillon/report/warning.hpp"
#include "support/about.hpp"
#include "support/scenes.hpp"

using namespace sillon;

namespace {

const RunContext kRun(2);

Toolpath toolpathOf(std::vector<Vec2f> points, float width, double spacing = 0.4) {
  Cycle cycle;
  cycle.widths.assign(points.size(), width);
  cycle.points = std::move(points);
  return {{cycle}, spacing};
}

Measures measured(const Toolpath& path, const Shape& shape, double angle = 0) {
  const auto m =
      measureToolpath(path, scenes::plate(shape, scenes::mapOf(1, [=](double, double) { return angle; })), {}, kRun);
  REQUIRE(m.ok());
  return m.value();
}

std::vector<Vec2f> ringOf(const Ring& ring) {
  std::vector<Vec2f> points;
  for (const Vec2 p : ring) points.push_back({static_cast<float>(p.x), static_cast<float>(p.y)});
  return points;
}

}  // namespace

TEST_CASE("one bead round a thin ring covers it all, without overlap or spill") {
  const Shape shape = scenes::shapeOf({scenes::circle({6, 6}, 5.2, 720), scenes::circle({6, 6}, 4.8, 720)}, {12, 12});
  const Measures m = measured(toolpathOf(ringOf(scenes::circle({6, 6}, 5, 720)), 0.4f), shape);
  CHECK(m.coverage > 99.5);
  CHECK(m.overlap == 0);
  CHECK(m.spill < 0.5);
  CHECK(m.fillRatio == about(1, 2e-3));
  CHECK(m.lengthMm == about(10 * std::numbers::pi, 1e-4));
  CHECK(m.uTurns == 0);
  CHECK(m.kinks == 0);
  CHECK(m.crossings == 0);
  CHECK(m.alignment == about(-0.5, 1e-3));
}

TEST_CASE("coverage and spill of a bead that hangs half over the border") {
  const Shape shape = scenes::shapeOf({scenes::rectangle({0, 0}, {10, 10})}, {10, 10});
  // A square path along the border itself, 0.4 wide: 0.2 inside, 0.2 outside with round corners.
  const Measures m = measured(toolpathOf({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, 0.4f), shape);
  CHECK(m.coverage == about(100 - 9.6 * 9.6, 2e-3));
  CHECK(m.spill == about(40 * 0.2 + std::numbers::pi * 0.04, 5e-3));
}

TEST_CASE("a bead that is rounded over the border spills nothing, wherever the pixels lie") {
  // All but the bead's round ends of 10 mm: it reaches over the upper border by `over`.
  const auto spillOf = [](double height, double over) {
    const Shape shape = scenes::shapeOf({scenes::rectangle({0, 0}, {10, height})}, {10, height});
    const auto y = static_cast<float>(height - 0.2);
    Toolpath path = toolpathOf({{0.5f, y}, {9.5f, y}, {9.5f, 2}, {0.5f, 2}}, 0.4f);
    path.cycles[0].widths = {static_cast<float>(0.4 + 2 * over), static_cast<float>(0.4 + 2 * over), 0.4f, 0.4f};
    return measured(path, shape).spill * height * 10 / 100;  // [mm²]
  };
  // Pixels of 0.02 mm: from somewhere on a row of their centres lies just over the border.
  for (int k = 0; k < 200; ++k) {
    CAPTURE(k);
    CHECK(spillOf(4 + 0.0001 * k, 0.0004) == 0);
  }
  double mean = 0;
  for (int k = 0; k < 20; ++k) mean += spillOf(4 + 0.001 * k, 0.01) / 20;
  CHECK(mean == about(9 * 0.01, 0.15));
}

TEST_CASE("a bead that widens is as wide in between as it should be") {
  const Shape shape = scenes::shapeOf({scenes::rectangle({0, 0}, {20, 10})}, {20, 10});
  Toolpath path = toolpathOf({{2, 3}, {18, 3}, {18, 7}, {2, 7}}, 0.4f);
  path.cycles[0].widths = {0.4f, 0.8f, 0.8f, 0.4f};
  const Measures m = measured(path, shape);
  CHECK(m.coverage == about((2 * 16 * 0.6 + 4 * 0.8 + 4 * 0.4) / 2, 0.01));
  CHECK(m.width.p01 == doctest::Approx(1.0).epsilon(1e-6));
  CHECK(m.width.p99 == doctest::Approx(2.0).epsilon(1e-6));
}

TEST_CASE("each segment of a long path counts for the alignment once") {
  const Shape shape = scenes::shapeOf({scenes::rectangle({0, 0}, {10, 10})}, {10, 10});
  // Thousands of steps along the lines, then a long one across them: the first or last of what one thread takes.
  for (const int steps : {4094, 4095, 4096, 4097, 4098, 8192}) {
    CAPTURE(steps);
    std::vector<Vec2f> points;
    for (int k = 0; k <= steps; ++k) points.push_back({1 + static_cast<float>(k) / static_cast<float>(steps), 1});
    points.push_back({2, 9});
    points.push_back({1, 9});
    CHECK(measured(toolpathOf(points, 0.4f), shape).alignment == doctest::Approx(-2.0 / 18).epsilon(1e-4));
  }
}

TEST_CASE("quantiles of widths are those of all pieces in order") {
  const Shape shape = scenes::shapeOf({scenes::rectangle({0, 0}, {100, 100})}, {100, 100});
  std::mt19937 random(7);
  for (const int n : {3, 4, 50, 3000}) {
    CAPTURE(n);
    // Points on a circle: all pieces are equally long, so that each width has the same share.
    std::vector<Vec2f> points;
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * std::numbers::pi * k / n;
      points.push_back({static_cast<float>(50 + 40 * std::cos(angle)), static_cast<float>(50 + 40 * std::sin(angle))});
    }
    Toolpath path = toolpathOf(points, 0.4f);
    for (float& w : path.cycles[0].widths) w = 0.1f + static_cast<float>(random() % 5000) / 7000;
    std::vector<float> sorted = path.cycles[0].widths;
    std::sort(sorted.begin(), sorted.end());
    const auto within = [&](double q, double value) {
      // A piece where the sum of lengths happens to fall on its end may be told to lie on either side.
      const int at = static_cast<int>(q * n);
      const double low = static_cast<double>(sorted[std::max(0, at - 1)]) / 0.4;
      const double high = static_cast<double>(sorted[std::min(n - 1, at + 1)]) / 0.4;
      return value >= low - 1e-9 && value <= high + 1e-9;
    };
    const WidthMeasures width = measured(path, shape).width;
    CHECK(within(0.01, width.p01));
    CHECK(within(0.5, width.median));
    CHECK(within(0.99, width.p99));
  }
}

TEST_CASE("overlap counts beads laid twice, not the bead's own joints and bends") {
  const Shape shape = scenes::shapeOf({scenes::rectangle({0, 0}, {20, 10})}, {20, 10});
  // A long loop whose legs lie 0.3 mm apart with beads of 0.4: 0.1 mm of overlap over its length.
  const Measures narrow = measured(toolpathOf({{2, 5}, {18, 5}, {18, 5.3f}, {2, 5.3f}}, 0.4f), shape);
  CHECK(narrow.overlap == about((16 - 1.1) * 0.1 / 2, 0.1));
  // At 0.42 mm they do not touch.
  CHECK(measured(toolpathOf({{2, 5}, {18, 5}, {18, 5.42f}, {2, 5.42f}}, 0.4f), shape).overlap == 0);
}

TEST_CASE("where a cycle ends and begins is no overlap") {
  const Shape shape = scenes::shapeOf({scenes::circle({6, 6}, 6)}, {12, 12});
  std::vector<Vec2f> points = ringOf(scenes::circle({6, 6}, 5, 720));
  CHECK(measured(toolpathOf(points, 0.4f), shape).overlap == 0);
  Toolpath twice = toolpathOf(points, 0.4f);
  twice.cycles.push_back(twice.cycles[0]);
  CHECK(measured(twice, shape).overlap == about(100 * 0.4 * 10 / 36, 0.01));
  CHECK(measured(twice, shape).crossings > 0);
}

TEST_CASE("alignment of straight rows is minus cos² of their angle to the map") {
  const Shape shape = scenes::shapeOf({scenes::rectangle({0, 0}, {40, 20})}, {40, 20});
  for (const double angle : {0.0, 0.3, 1.0, std::numbers::pi / 2}) {
    const Measures m = measured(toolpathOf({{2, 10}, {38, 10}, {38, 10.02f}, {2, 10.02f}}, 0.4f), shape, angle);
    CHECK(std::abs(m.alignment + std::pow(std::cos(angle), 2)) < 2e-3);
    CHECK(m.alignmentInterior == about(m.alignment, 1e-3));
  }
}

TEST_CASE("rows joined by U-turns have one U-turn each") {
  const Shape shape = scenes::shapeOf({scenes::rectangle({0, 0}, {40, 20})}, {40, 20});
  std::vector<Vec2f> points;
  constexpr int kRows = 10;
  for (int row = 0; row < kRows; ++row) {
    const float y = 5 + 0.4f * static_cast<float>(row);
    const float left = 10;
    const float right = 30;
    points.push_back({row % 2 == 0 ? left : right, y});
    points.push_back({row % 2 == 0 ? right : left, y});
  }
  points.push_back({8, 8.6f});
  points.push_back({8, 5});
  const Measures m = measured(toolpathOf(points, 0.4f), shape);
  CHECK(m.uTurns == kRows - 1);
  CHECK(m.crossings == 0);
}

TEST_CASE("what no bead can reach is lost: a thin bar, not the corners of a square") {
  CHECK(measured(toolpathOf({{2, 2}, {8, 2}, {8, 8}, {2, 8}}, 0.4f),
                 scenes::shapeOf({scenes::rectangle({0, 0}, {10, 10})}, {10, 10}))
            .lostAreaMm2 == 0);
  const Shape withBar = scenes::shapeOf({scenes::rectangle({0, 0}, {10, 10}), scenes::rectangle({10, 4}, {15, 4.3})},
                                        {15, 10}, FillRule::NonZero);
  CHECK(measured(toolpathOf({{2, 2}, {8, 2}, {8, 8}, {2, 8}}, 0.4f), withBar).lostAreaMm2 == about(1.5, 0.1));
}

TEST_CASE("lost lines are told as wide as they are, also where they cross") {
  // A net of lines of 0.9 or 0.99 beads: a disc in a crossing is half as wide again as they are.
  for (const double width : {0.36, 0.396}) {
    std::vector<Ring> rings{scenes::rectangle({0, 0}, {1, 1})};
    for (int k = 0; k < 5; ++k) {
      rings.push_back(scenes::rectangle({2, 2 + 3.0 * k}, {16, 2 + 3.0 * k + width}));
      rings.push_back(scenes::rectangle({2 + 3.0 * k, 2}, {2 + 3.0 * k + width, 16}));
    }
    const Measures m = measured(toolpathOf({{0.4f, 0.4f}, {0.6f, 0.4f}, {0.6f, 0.6f}, {0.4f, 0.6f}}, 0.4f),
                                scenes::shapeOf(std::move(rings), {18, 18}, FillRule::NonZero));
    CAPTURE(width);
    REQUIRE(!m.lostPlaces.empty());
    CHECK(m.lostPlaces.front().width == about(width, 0.1));
    CHECK(m.lostPlaces.front().width <= 0.4);
  }
}

TEST_CASE("the page that would print what is lost is a larger one") {
  for (const auto& [width, size] : {std::pair{0.25, 40.0}, {0.4, 25.0}, {0.49, 21.0}, {0.5, 21.0}}) {
    Measures m;
    m.shapeAreaMm2 = 10;
    m.lostAreaMm2 = 5;
    m.lostPlaces = {{{1, 1}, 5, width}};
    const auto warnings = plateWarnings({}, {}, {}, m, {20, 20}, 0.5);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].code == WarningCode::DetailLost);
    REQUIRE(warnings[0].value("size") != nullptr);
    CHECK(warnings[0].value("size")->number == size);
  }
}

TEST_CASE("lost pieces of less than a quarter of a squared spacing do not count") {
  const auto lostBar = [](double size) {
    const Shape shape =
        scenes::shapeOf({scenes::rectangle({0, 0}, {10, 10}), scenes::rectangle({10, 4}, {10 + size, 4.3})}, {11, 10},
                        FillRule::NonZero);
    return measured(toolpathOf({{2, 2}, {8, 2}, {8, 8}, {2, 8}}, 0.4f), shape).lostAreaMm2;
  };
  CHECK(lostBar(0.1) == 0);
  CHECK(lostBar(0.5) > 0.1);
  CHECK(lostBar(0.5) < 0.2);
}

TEST_CASE("a toolpath that cannot be is refused, and an empty one covers nothing") {
  const Shape shape = scenes::shapeOf({scenes::rectangle({0, 0}, {5, 5})}, {5, 5});
  const auto refusal = [&](const Toolpath& toolpath) {
    const auto m =
        measureToolpath(toolpath, scenes::plate(shape, scenes::mapOf(1, [](double, double) { return 0.0; })), {}, kRun);
    return m ? std::string() : m.error().message;
  };
  CHECK(refusal(toolpathOf({{1, 1}, {4, 1}, {4, 4}}, 0.4f, 0)) == "toolpath.spacing is 0 mm; it must be 0.05 to 20");
  CHECK(refusal(toolpathOf({{1, 1}, {NAN, 1}, {4, 4}}, 0.4f)) ==
        "the toolpath has a point outside -100000 to 100000 mm");
  CHECK(refusal({{{}}, 0.4}) == "cycle 0 (from 0) has 0 different points at 0.001 mm; it must have at least 3");
  CHECK(refusal(toolpathOf({{1, 1}}, 0.4f)).empty());
  CHECK(refusal(toolpathOf({{1, 1}, {4, 1}}, 0.4f)).empty());
  Toolpath lacking = toolpathOf({{1, 1}, {4, 1}, {4, 4}}, 0.4f);
  lacking.cycles[0].widths.pop_back();
  CHECK(refusal(lacking) ==
        "the toolpath has a line with 3 points and 2 widths; there must be one width per point, and at least 2");
  CHECK(measured({{}, 0.4}, shape).coverage == 0);
}

TEST_CASE("maps, parameters and memory that no plate could be made with are refused") {
  const Shape shape = scenes::shapeOf({scenes::rectangle({0, 0}, {5, 5})}, {5, 5});
  const Toolpath toolpath = toolpathOf({{1, 1}, {4, 1}, {4, 4}}, 0.4f);
  const DirectionMap map = scenes::mapOf(1, [](double, double) { return 0.0; });
  const ModeMap mode = uniformMode(DirectionMode::Constrained);
  const auto refusal = [&](const DirectionMap& directions, const ModeMap& modes, const ToolpathParams& params) {
    const auto m = measureToolpath(toolpath, {shape, directions, modes}, params, kRun);
    return m ? std::string() : m.error().message;
  };
  CHECK(refusal(map, mode, {}).empty());
  CHECK(refusal({}, mode, {}).find("the map of directions is 0 x 0 pixels with 0 values") == 0);
  CHECK(refusal(map, {3, 2, mode.mode}, {}).find("the map of modes is 3 x 2 pixels with 1 values") == 0);
  ToolpathParams params;
  params.kernelRadius = NAN;
  CHECK(refusal(map, mode, params).find("toolpath.kernelRadius is") == 0);
  RunContext little;
  little.limitMemory(1e5);
  const auto refused = measureToolpath(toolpath, {shape, map, mode}, {}, little);
  REQUIRE(!refused.ok());
  CHECK(refused.error().code == ErrorCode::OutOfMemory);
}

TEST_CASE("measures are equal for any number of threads, and digests tell plates apart") {
  const auto scene = scenes::all()[0];
  const auto plate = generateToolpath(scene.input, {}, kRun);
  REQUIRE(plate.ok());
  const Toolpath& path = plate.value().toolpath;
  const auto one = measureToolpath(path, scene.input, {}, RunContext(1));
  const auto many = measureToolpath(path, scene.input, {}, RunContext(5));
  CHECK(one.value().coverage == many.value().coverage);
  CHECK(one.value().overlap == many.value().overlap);
  CHECK(one.value().alignment == many.value().alignment);
  CHECK(one.value().alignmentConstrained == many.value().alignmentConstrained);
  CHECK(one.value().uTurns == many.value().uTurns);
  CHECK(one.value().kinks == many.value().kinks);
  CHECK(one.value().digest == many.value().digest);
  Toolpath other = path;
  other.cycles[0].points[3].x += 0.001f;
  CHECK(digestOf(other) != digestOf(path));
  Toolpath bare = path, flat = path;
  bare.cycles[0].widths.clear();
  std::fill(flat.cycles[0].widths.begin(), flat.cycles[0].widths.end(), 0.0f);
  CHECK(digestOf(bare) == digestOf(flat));
}

TEST_CASE(
    "dislocations: none on straight beads, what the divergence asks for on a fan, half turns where lines have them") {
  const Shape square = scenes::shapeOf({scenes::rectangle({0, 0}, {24, 24})}, {24, 24});
  const Toolpath any = toolpathOf(ringOf(scenes::rectangle({5, 5}, {15, 15})), 0.4f);
  ToolpathParams params;
  params.perimeterMode = PerimeterMode::None;
  params.spacingVariation = 0;
  const auto of = [&](const std::function<double(double, double)>& angle) {
    const DirectionMap map = scenes::mapOf(480, [&](double x, double y) { return angle(24 * x, 24 * y); });
    return measureToolpath(any, scenes::plate(square, map), params, kRun).value();
  };
  const Measures straight = of([](double, double) { return 0.7; });
  CHECK(straight.dislocations == 0);
  CHECK(straight.singularities == 0);
  CHECK(straight.dislocationBound < 0.5);
  // Beads end at all four sides, one and a half spacings inside: the integral of |t . n| over 2 tau.
  CHECK(straight.turnBound == about(2 * 22.8 * (std::cos(0.7) + std::sin(0.7)) / 0.8, 0.04));

  // Beads fan out from (-20, 12): div t = 1/r, and N = the integral of 1/r over 2 tau.
  const auto fromPoint = [](double x, double y) { return std::atan2(y - 12, x + 20); };
  double integral = 0;
  for (double y = 0.45; y < 23.6; y += 0.1) {  // one spacing inside
    for (double x = 0.45; x < 23.6; x += 0.1) integral += 0.01 / std::hypot(x + 20, y - 12);
  }
  const Measures fan = of(fromPoint);
  CHECK(fan.dislocationBound == about(integral / 0.8, 0.08));
  CHECK(fan.singularities == 0);
  CHECK(static_cast<double>(fan.dislocations) == about(integral / 0.8, 0.35));
  params.spacingVariation = 0.5;
  CHECK(of(fromPoint).dislocations < fan.dislocations);
  params.spacingVariation = 0;

  // Lines that turn by half a turn round a point, one way or the other.
  CHECK(of([](double x, double y) { return 0.5 * std::atan2(y - 12.1, x - 12.1); }).singularities == 1);
  CHECK(of([](double x, double y) { return -0.5 * std::atan2(y - 12.1, x - 12.1); }).singularities == 1);
}

TEST_CASE("measures are the same whether dislocations were counted while the plate was made, in a session, or anew") {
  const auto scene = scenes::all()[0];
  ToolpathParams params;
  for (const double give : {0.0, 4.0}) {
    params.directionTolerance = give;
    Session session;
    const ToolpathResult plate = generateToolpath(scene.input, params, kRun, true).value();
    const ToolpathResult kept = session.generateToolpath(scene.input, params, kRun, true).value();
    const auto report = [&](const std::optional<Dislocations>& known) {
      const auto measures = measureToolpath(plate.toolpath, scene.input, params, kRun, known);
      return reportJson(reportOf(ToolpathResult{}, measures.value()));
    };
    const std::string anew = report(std::nullopt);
    REQUIRE(plate.dislocations.has_value());
    CHECK(plate.dislocations->count > 0);
    CHECK(report(plate.dislocations) == anew);
    CHECK(report(kept.dislocations) == anew);
    CHECK_FALSE(generateToolpath(scene.input, params, kRun).value().dislocations.has_value());
  }
}

TEST_CASE("measuring tells its progress: from 0 to 1, never falling") {
  RunContext run(2);
  std::vector<double> seen;
  run.onProgress([&](std::string_view stage, double fraction) {
    CHECK(stage == "measure");
    seen.push_back(fraction);
  });
  const Shape square = scenes::shapeOf({scenes::rectangle({0, 0}, {40, 40})}, {40, 40});
  const auto m = measureToolpath(toolpathOf(ringOf(scenes::rectangle({5, 5}, {35, 35})), 0.4f),
                                 scenes::plate(square, scenes::waves()), {}, run);
  REQUIRE(m.ok());
  REQUIRE(seen.size() > 10);
  CHECK(seen.front() == 0);
  CHECK(seen.back() == 1);
  CHECK(std::is_sorted(seen.begin(), seen.end()));
}

TEST_CASE("a toolpath that reaches far away is refused, not counted on more tiles than there are numbers") {
  const Shape shape = scenes::shapeOf({scenes::rectangle({0, 0}, {10, 10})}, {10, 10});
  for (const float far : {1e4f, 6e4f, 1e5f}) {  // up to 10^12 tiles
    const Toolpath path = toolpathOf({{0, 0}, {far, 0}, {far, far}, {0, far}}, 0.4f, 0.05);
    const auto m =
        measureToolpath(path, scenes::plate(shape, scenes::mapOf(1, [](double, double) { return 0.0; })), {}, kRun);
    REQUIRE(!m.ok());
    CHECK(m.error().code == ErrorCode::TooLarge);
    CHECK(m.error().message.find("million cells at spacing 0.05 mm") != std::string::npos);
  }
}
