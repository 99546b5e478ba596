#include "toolpath/path.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "sillon/geometry/shape.hpp"
#include "support/scenes.hpp"

using namespace sillon;

namespace {

constexpr double kSpacing = 0.4;
constexpr float kTau = 0.4f;

BorderIndex borderOf(std::vector<scenes::Ring> rings) {
  const Outline outline = resolveOutline(scenes::shapeOf(std::move(rings), {20, 20})).value();
  return buildBorderIndex(outline, makeGrid(outline.bounds, kSpacing), RunContext(1)).value();
}

// Points on a circle, to the left, or to the right with a negative radius.
std::vector<Vec2f> round(Vec2 centre, double radius, int points) {
  std::vector<Vec2f> circle;
  for (int k = 0; k < points; ++k) {
    const double a = 2 * std::numbers::pi * k / points;
    circle.push_back({static_cast<float>(centre.x + std::abs(radius) * std::cos(a)),
                      static_cast<float>(centre.y + radius * std::sin(a))});
  }
  return circle;
}

double areaOf(const std::vector<Vec2f>& p) {
  double area = 0;
  for (std::size_t k = 0; k < p.size(); ++k) area += 0.5 * static_cast<double>(cross(p[k], p[(k + 1) % p.size()]));
  return area;
}

}  // namespace

TEST_CASE("a dot beside a longer cycle is left out, further away and beyond a border it stays") {
  const std::vector<Vec2f> longer = round({5, 10}, 3, 200);
  const auto settled = [&](double gap, const BorderIndex& border) {
    const double r = 0.03;
    return regularizeSmallCycles(scenes::closed({longer, round({8 + gap + r, 10}, r, 6)}), border, kSpacing,
                                 RunContext(1));
  };
  const BorderIndex page = borderOf({scenes::rectangle({0, 0}, {20, 20})});
  const ClosedCurves near = settled(0.4 * kSpacing, page);
  REQUIRE(near.count() == 1);
  CHECK(near.points == longer);
  CHECK(settled(0.7 * kSpacing, page).count() == 2);
  const BorderIndex slit = borderOf({scenes::rectangle({0, 0}, {8.05, 20}), scenes::rectangle({8.08, 0}, {20, 20})});
  CHECK(settled(0.4 * kSpacing, slit).count() == 2);
}

TEST_CASE("a cycle in which no bead has room is left out, whatever its length") {
  const auto kept = [&](double room) {
    const BorderIndex border =
        borderOf({scenes::rectangle({1, 5}, {9, 5 + 2 * room}), scenes::rectangle({1, 10}, {9, 15})});
    const auto low = static_cast<float>(5 + 0.5 * room);
    const auto high = static_cast<float>(5 + 1.5 * room);
    std::vector<Vec2f> slender;
    for (int k = 0; k <= 60; ++k) slender.push_back({2 + 0.1f * static_cast<float>(k), low});
    for (int k = 60; k >= 0; --k) slender.push_back({2 + 0.1f * static_cast<float>(k), high});
    const std::vector<Vec2f> dot = round({5, 5 + room}, 0.5 * room, 6);
    const ClosedCurves one = regularizeSmallCycles(scenes::closed({slender}), border, kSpacing, RunContext(1));
    const ClosedCurves other = regularizeSmallCycles(scenes::closed({dot}), border, kSpacing, RunContext(1));
    return std::pair{one.count(), other.count()};
  };
  CHECK(kept(0.04 * kSpacing) == std::pair{0, 0});
  CHECK(kept(0.2 * kSpacing) == std::pair{1, 1});
}

TEST_CASE("of two dots beside each other one stays") {
  const BorderIndex page = borderOf({scenes::rectangle({0, 0}, {20, 20})});
  const ClosedCurves pair = scenes::closed({round({10, 10}, 0.03, 6), round({10.2, 10}, 0.03, 6)});
  CHECK(regularizeSmallCycles(pair, page, kSpacing, RunContext(1)).count() == 1);
}

TEST_CASE("a tiny cycle alone becomes a circle at the deepest place, of the same sense, without a kink") {
  // A disc that holds just a bead, and a dot off its middle.
  const Vec2 middle{5, 5};
  const double radius = 0.52 * kSpacing;
  scenes::Ring disc;
  for (const Vec2f p : round(middle, radius, 100)) disc.push_back({static_cast<double>(p.x), static_cast<double>(p.y)});
  const BorderIndex border = borderOf({disc});
  for (const double sense : {1.0, -1.0}) {
    const ClosedCurves speck = scenes::closed({round({5.05, 4.97}, sense * 0.02, 6)});
    const ClosedCurves settled = regularizeSmallCycles(speck, border, kSpacing, RunContext(1));
    REQUIRE(settled.count() == 1);
    const std::vector<Vec2f>& p = settled.points;
    CHECK(areaOf(p) * sense > 0);
    for (std::size_t k = 0; k < p.size(); ++k) {
      const Vec2f before = p[(k + 1) % p.size()] - p[k];
      const Vec2f after = p[(k + 2) % p.size()] - p[(k + 1) % p.size()];
      CHECK(std::abs(length(before) - kTau / 4) < 1e-4f);
      CHECK(dot(before, after) > 0.6f * length(before) * length(after));  // 53 degrees
      const Vec2f off = p[k] - Vec2f{5, 5};
      CHECK(std::abs(length(off) - 0.288f * kTau) < 0.02f * kTau);
    }
  }
}

TEST_CASE("a cycle stays bit for bit where a circle has no room, or another cycle is near, or it is long enough") {
  const BorderIndex bar = borderOf({scenes::rectangle({0, 5}, {20, 5 + 0.8 * kSpacing})});
  const std::vector<Vec2f> dot = round({10, 5 + 0.4 * kSpacing}, 0.02, 6);
  CHECK(regularizeSmallCycles(scenes::closed({dot}), bar, kSpacing, RunContext(1)).points == dot);

  const BorderIndex page = borderOf({scenes::rectangle({0, 0}, {20, 20})});
  const ClosedCurves pair = scenes::closed({round({10, 10}, 0.06, 6), round({10, 11}, 0.5, 40)});
  CHECK(regularizeSmallCycles(pair, page, kSpacing, RunContext(1)).points == pair.points);

  const std::vector<Vec2f> longer = round({10, 10}, 0.4 * kSpacing, 10);  // 2.5 spacings
  CHECK(regularizeSmallCycles(scenes::closed({longer}), page, kSpacing, RunContext(1)).points == longer);
}
