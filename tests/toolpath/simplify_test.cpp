#include "toolpath/path.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "quality/measured_parts.hpp"
#include "sillon/quality/metrics.hpp"
#include "support/scenes.hpp"

using namespace sillon;

namespace {

// How far the points between two of a curve lie from the straight line, at most [mm].
double deviation(const std::vector<Vec2f>& points, std::size_t a, std::size_t b) {
  const auto at = [&](std::size_t k) {
    const Vec2f p = points[k % points.size()];
    return Vec2{static_cast<double>(p.x), static_cast<double>(p.y)};
  };
  const Vec2 along = at(b) - at(a);
  double most = 0;
  for (std::size_t k = a + 1; k < b; ++k) most = std::max(most, std::abs(cross(along, at(k) - at(a))) / length(along));
  return most;
}

}  // namespace

TEST_CASE("a bead stands for as many points as the tolerance lets it, all along a path of many pieces") {
  constexpr int kCount = 40000;
  ClosedCurves curves;
  curves.begin = {0, kCount};
  for (int k = 0; k < kCount; ++k) {
    const double angle = 2 * std::numbers::pi * k / kCount;
    const double radius = 400 + 2 * std::sin(61 * angle) + 0.05 * std::sin(997 * angle);
    const auto rounded = [](double v) { return static_cast<float>(std::round(v * 1000) / 1000); };
    curves.points.push_back({rounded(radius * std::cos(angle)), rounded(radius * std::sin(angle))});
  }
  const BeadWidths widths{std::vector<float>(kCount, 0.4f), std::vector<float>(kCount, 1e9f)};
  ToolpathParams params;
  params.simplifyTolerance = 0.004;
  for (const int threads : {1, 3}) {
    const auto toolpath = finishToolpath(curves, widths, params, RunContext(threads));
    REQUIRE(toolpath.ok());
    REQUIRE(toolpath.value().cycles.size() == 1);
    const std::vector<Vec2f>& kept = toolpath.value().cycles.front().points;
    REQUIRE(kept.size() > 4000);
    REQUIRE(kept.size() < kCount / 3);
    REQUIRE(kept.front() == curves.points.front());
    std::size_t from = 0;
    for (std::size_t k = 1; k <= kept.size(); ++k) {
      std::size_t to = from + 1;
      while (to < kCount && !(k < kept.size() && curves.points[to] == kept[k])) ++to;
      CAPTURE(from);
      REQUIRE((to < kCount || k == kept.size()));
      CHECK(deviation(curves.points, from, to) < params.simplifyTolerance + 1e-5);
      if (to < kCount) CHECK(deviation(curves.points, from, to + 1) > params.simplifyTolerance - 1e-5);
      from = to;
    }
  }
}

TEST_CASE("a cancelled run never returns a path that crosses itself") {
  // Without its bump, which the tolerance allows, the first curve would run through the tip of the second.
  const ClosedCurves curves =
      scenes::closed({{{0, 0}, {1, 0.5f}, {2, 0}, {2, 5}, {0, 5}}, {{1, 0.3f}, {0.5f, -2}, {1.5f, -2}}});
  const BeadWidths widths{std::vector<float>(8, 0.2f), std::vector<float>(8, 1e9f)};
  ToolpathParams params;
  params.simplifyTolerance = 1;
  bool cancelled = true;
  for (int last = 1; cancelled; ++last) {
    RunContext run(1);
    int asked = 0;
    run.onPoll([&] { return ++asked == last; });
    const auto toolpath = finishToolpath(curves, widths, params, run);
    cancelled = run.cancelled();
    CAPTURE(last);
    CHECK(toolpath.ok() == !cancelled);
    if (toolpath.ok()) CHECK(countCrossings(toolpath.value()) == 0);
    if (!cancelled) CHECK(last > 4);
  }
}

TEST_CASE("a cycle that is smaller than the tolerance does not vanish") {
  ClosedCurves curves;
  curves.begin = {0, 12};
  for (int k = 0; k < 12; ++k) {
    const double angle = 2 * std::numbers::pi * k / 12;
    curves.points.push_back(
        {static_cast<float>(5 + 0.2 * std::cos(angle)), static_cast<float>(5 + 0.2 * std::sin(angle))});
  }
  const BeadWidths widths{std::vector<float>(12, 0.2f), std::vector<float>(12, 1e9f)};
  ToolpathParams params;
  params.simplifyTolerance = 1;
  const auto toolpath = finishToolpath(curves, widths, params, RunContext(1));
  REQUIRE(toolpath.ok());
  REQUIRE(toolpath.value().cycles.size() == 1);
  CHECK(toolpath.value().cycles.front().points.size() >= 3);
}
