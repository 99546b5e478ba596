#include "toolpath/path.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "geometry/closed_curves.hpp"
#include "support/about.hpp"
#include "support/scenes.hpp"

using namespace sillon;

namespace {

// A page of 60 x 40 mm, or so many times that.
BorderIndex pageBorder(double scale = 1) {
  const Vec2 page = scale * Vec2{60, 40};
  const Outline outline = resolveOutline(scenes::shapeOf({scenes::rectangle({0, 0}, page)}, page)).value();
  return buildBorderIndex(outline, makeGrid(outline.bounds, 0.4 * scale), RunContext(1)).value();
}

// Rows from x = 10 to 40 at these heights, each a loop of its own with its way back 8 mm above, where all lie apart.
ClosedCurves rowsAt(const std::vector<float>& heights) {
  std::vector<std::vector<Vec2f>> loops;
  for (std::size_t k = 0; k < heights.size(); ++k) {
    const float out = static_cast<float>(heights.size() - k);  // the loops lie in each other
    loops.push_back({{10 - out, heights[k]}, {40 + out, heights[k]}, {40 + out, 20 + out}, {10 - out, 20 + out}});
  }
  return resampled(scenes::closed(loops), 0.1f, RunContext(1));
}

// Widths in the middle of each row, of beads that are asked to be so wide there: the least and the largest.
std::vector<std::pair<float, float>> rowWidths(const std::vector<float>& heights, const std::vector<float>& wanted,
                                               const ToolpathParams& params) {
  const ClosedCurves curves = rowsAt(heights);
  BeadGaps gaps;
  for (int c = 0; c < curves.count(); ++c) {
    gaps.left.insert(gaps.left.end(), static_cast<std::size_t>(curves.size(c)), wanted[c]);
  }
  gaps.right = gaps.left;
  const auto widths = beadWidths(curves, gaps, pageBorder(), params, RunContext(1));
  REQUIRE(widths.ok());
  std::vector<std::pair<float, float>> out;
  for (int c = 0; c < curves.count(); ++c) {
    std::pair<float, float> range{1e9f, -1e9f};
    for (int k = curves.begin[c]; k < curves.begin[static_cast<std::size_t>(c) + 1]; ++k) {
      const Vec2f p = curves.points[k];
      if (p.y > heights[c] + 0.01f || p.x < 15 || p.x > 35) continue;
      const float width = widths.value().width[k];
      range = {std::min(range.first, width), std::max(range.second, width)};
    }
    out.push_back(range);
  }
  return out;
}

void checkRow(const std::pair<float, float>& range, double expected) {
  CHECK(range.first == about(expected, 1e-3));
  CHECK(range.second == about(expected, 1e-3));
}

// No tolerance for simplification, no balance to think of.
ToolpathParams apartBy(double overlap) {
  ToolpathParams params;
  params.simplifyTolerance = 0;
  params.beadOverlap = overlap;
  return params;
}

}  // namespace

TEST_CASE("where nothing is near, widths are the balance of the smaller gap and the mean, held to their range") {
  const ClosedCurves curves = rowsAt({10, 10.8f, 11.6f});
  scenes::Random random(2);
  BeadGaps gaps;
  for (std::size_t k = 0; k < curves.points.size(); ++k) {
    gaps.left.push_back(static_cast<float>(random.in(0.05, 1)));
    gaps.right.push_back(static_cast<float>(random.in(0.05, 1)));
  }
  for (const double balance : {0.0, 0.3, 1.0}) {
    ToolpathParams params = apartBy(1);  // beads may lie upon each other
    params.widthBalance = balance;
    params.minWidth = 0.4;
    params.maxWidth = 1.8;
    const auto widths = beadWidths(curves, gaps, pageBorder(), params, RunContext(1));
    REQUIRE(widths.ok());
    for (std::size_t k = 0; k < curves.points.size(); ++k) {
      const double left = static_cast<double>(gaps.left[k]), right = static_cast<double>(gaps.right[k]);
      const double least = std::min(left, right);
      const double wanted = least + balance * ((left + right) / 2 - least);
      CHECK(widths.value().width[k] == about(std::clamp(wanted, 0.16, 0.72), 1e-5));
      CHECK(widths.value().limit[k] > 1e6f);
    }
  }
}

TEST_CASE("near the border widths are twice the distance to it, half-way to the neighbours too; outside a thread") {
  // The left side of the loop crosses the border at y = 0 in steps of 0.1, 0.3 or 0.36 mm.
  const double thread = 0.002 * 0.4;
  struct Row {
    std::vector<float> heights;  // of the points down to the border and beyond
    std::vector<double> limits;  // [mm]; 0: a thread
  };
  const Row rows[] = {
      {{0.25f, 0.15f, 0.05f, -0.05f, -0.15f}, {0.4, 0.2, 0, 0, 0}},
      {{0.5f, 0.2f, -0.1f, -0.4f, -0.7f}, {0.7, 0, 0, 0, 0}},
      // A neighbour outside does not count while the way to it stays a quarter of a spacing within at its middle.
      {{0.65f, 0.29f, -0.07f, -0.43f, -0.79f}, {0.94, 0.22, 0, 0, 0}},
      // The border is near only to the way to the neighbour that is farther off.
      {{0.9f, 0.1f, -0.7f}, {1.0, 0, 0}},
  };
  for (const Row& row : rows) {
    std::vector<Vec2f> loop;
    for (float y = 30; y > row.heights[0] + 0.01f; y -= 0.5f) loop.push_back({20, std::max(y, row.heights[0] + 0.3f)});
    const std::size_t first = loop.size();
    for (const float y : row.heights) loop.push_back({20, y});
    for (float x = 20.5f; x < 30; x += 0.5f) loop.push_back({x, row.heights.back()});
    for (float y = -1; y < 30; y += 0.5f) loop.push_back({30, y});
    const ClosedCurves curves = scenes::closed({loop});
    const BeadGaps gaps{std::vector<float>(loop.size(), 2.0f), std::vector<float>(loop.size(), 2.0f), {}};
    ToolpathParams params = apartBy(1);
    params.maxWidth = 2.4;
    const auto widths = beadWidths(curves, gaps, pageBorder(), params, RunContext(1));
    REQUIRE(widths.ok());
    for (std::size_t k = 0; k < row.limits.size(); ++k) {
      CAPTURE(row.heights[k]);
      CHECK(widths.value().limit[first + k] == about(row.limits[k] > 0 ? row.limits[k] : thread, 1e-4));
      CHECK(widths.value().width[first + k] <= widths.value().limit[first + k]);
    }
  }
}

TEST_CASE("along the border a bead is as wide as there is room, and no wider than asked for") {
  for (const auto& [away, expected] : {std::pair{0.05f, 0.1}, {0.12f, 0.24}, {0.3f, 0.6}, {0.55f, 0.8}, {1.5f, 0.8}}) {
    ToolpathParams params = apartBy(1);
    checkRow(rowWidths({away}, {2.0f}, params)[0], expected);
    params.maxWidth = 1;
    checkRow(rowWidths({away}, {2.0f}, params)[0], std::min(expected, 0.4));
  }
}

TEST_CASE("two beads side by side give way in proportion, until they overlap by no more than they may") {
  for (const double overlap : {0.0, 0.05, 0.2}) {
    for (const auto& [low, high] : {std::pair{0.5f, 0.3f}, {0.3f, 0.5f}, {0.4f, 0.4f}}) {
      const auto widths = rowWidths({10, 10.3f}, {low, high}, apartBy(overlap));
      // 0.3 mm for half of either width, together 0.4 mm, of which the overlap needs no room.
      const double share = std::min(1.0, 0.3 / (0.4 - 0.4 * overlap));
      checkRow(widths[0], std::max(0.2, static_cast<double>(low) * share));
      checkRow(widths[1], std::max(0.2, static_cast<double>(high) * share));
    }
  }
  // What simplification may move counts as overlap already.
  ToolpathParams params = apartBy(0.1);
  params.simplifyTolerance = 0.02;
  checkRow(rowWidths({10, 10.3f}, {0.4f, 0.4f}, params)[0], 0.4 * 0.3 / (0.4 - 0.04 + 0.02));
  // Nothing falls below the least width, and what is narrower already stays.
  checkRow(rowWidths({10, 10.1f}, {0.4f, 0.4f}, apartBy(0))[0], 0.2);
  // Beads that have room touch nothing.
  for (const auto& range : rowWidths({10, 10.41f, 10.82f}, {0.41f, 0.41f, 0.41f}, apartBy(0))) checkRow(range, 0.41);
}

TEST_CASE("four times as large, beads are four times as wide") {
  const auto widthsOf = [](float scale) {
    std::vector<std::vector<Vec2f>> loops;
    for (int k = 0; k < 4; ++k) {  // slanted, so that points do not face each other
      const float y = 10 + 0.31f * static_cast<float>(k), out = 4 - 0.97f * static_cast<float>(k);
      loops.push_back({{10 - out, y}, {40 + out, y + 0.7f}, {40 + out, 20 + out}, {10 - out, 20 + out}});
      for (Vec2f& p : loops.back()) p = scale * p;
    }
    const ClosedCurves curves = resampled(scenes::closed(loops), 0.1f * scale, RunContext(1));
    BeadGaps gaps;
    gaps.left.assign(curves.points.size(), 0.4f * scale);
    gaps.right = gaps.left;
    ToolpathParams params = apartBy(0.05);
    params.spacing = static_cast<double>(0.4f * scale);
    const auto widths = beadWidths(curves, gaps, pageBorder(static_cast<double>(scale)), params, RunContext(1));
    REQUIRE(widths.ok());
    return widths.value().width;
  };
  const std::vector<float> once = widthsOf(1), four = widthsOf(4);
  REQUIRE(once.size() == four.size());
  CHECK(*std::min_element(once.begin(), once.end()) < 0.35f);
  // Moves of the G-code change their widths in steps that are the same for both: that makes a hundredth at most.
  for (std::size_t k = 0; k < once.size(); ++k) CHECK(four[k] == about(4 * static_cast<double>(once[k]), 0.012));
}

TEST_CASE("a bead grows again, in two rounds, where its neighbour gave way to another") {
  // The first two give way to 0.3 mm each. The third has 0.35 mm to the second: it gives way to 0.35, and then takes
  // in each round the share that is left between it and the second.
  const auto grown = [](double width, double beside, double room) { return width * room / ((width + beside) / 2); };
  for (const float y : {10.0f, 10.05f, 10.1f, 10.15f, 10.2f, 10.25f}) {  // wherever cells of the search begin
    const auto widths = rowWidths({y, y + 0.3f, y + 0.65f}, {0.4f, 0.4f, 0.4f}, apartBy(0));
    checkRow(widths[0], 0.3);
    checkRow(widths[1], 0.3);
    checkRow(widths[2], grown(grown(0.35, 0.3, 0.35), 0.3, 0.35));
  }
  // By no more than a fifth in a round: the second cannot be less than 0.2 mm.
  const auto most = rowWidths({10, 10.1f, 10.45f}, {0.8f, 0.8f, 0.8f}, apartBy(0));
  checkRow(most[1], 0.2);
  checkRow(most[2], grown(1.2 * 0.35, 0.2, 0.35));
}

TEST_CASE("the legs of a U-turn make room for each other, but for seven steps round its tip") {
  // Two legs 0.25 mm apart, for beads of 0.4 mm.
  const ClosedCurves curves =
      resampled(scenes::closed({{{10, 10}, {20, 10}, {20, 10.25f}, {10, 10.25f}}}), 0.1f, RunContext(1));
  const std::vector<float> wanted(curves.points.size(), 0.4f);
  const auto widths = beadWidths(curves, {wanted, wanted, {}}, pageBorder(), apartBy(0), RunContext(1));
  REQUIRE(widths.ok());
  int legs = 0, tips = 0;
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const float away = std::min(curves.points[k].x - 10, 20 - curves.points[k].x);
    // The opposite point lies twice as far and 0.25 mm away along the path: 0.7 mm are seven steps.
    if (away > 0.3f) CHECK(widths.value().width[k] == about(0.25, 0.02));
    if (away < 0.04f) CHECK(widths.value().width[k] == about(0.4, 1e-3));
    legs += away > 0.3f ? 1 : 0;
    tips += away < 0.04f ? 1 : 0;
  }
  CHECK(legs > 150);
  CHECK(tips >= 4);
}
