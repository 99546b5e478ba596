// Relaxation, bead widths and the finished toolpath.
#include "toolpath/path.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/closed_curves.hpp"
#include "support/about.hpp"
#include "support/scenes.hpp"
#include "toolpath/relaxation_steps.hpp"

using namespace sillon;

namespace {

// A closed boustrophedon of straight rows in a large page: row k lies at y[k], joined at the ends, with a way back far
// off.
ClosedCurves rows(const std::vector<double>& heights, double width) {
  ClosedCurves curves;
  curves.begin.push_back(0);
  const auto add = [&](double x, double y) { curves.points.push_back({static_cast<float>(x), static_cast<float>(y)}); };
  for (std::size_t k = 0; k < heights.size(); ++k) {
    add(k % 2 == 0 ? 10 : 10 + width, heights[k]);
    add(k % 2 == 0 ? 10 + width : 10, heights[k]);
  }
  if (heights.size() % 2 == 1) {  // back round the right side and below
    add(15 + width, heights.back());
    add(15 + width, 5);
    add(5, 5);
  } else {
    add(5, heights.back());
  }
  add(5, heights.front());
  curves.begin.push_back(static_cast<int>(curves.points.size()));
  return curves;
}

BorderIndex farBorder() {
  const Shape shape = scenes::shapeOf({scenes::rectangle({0, 0}, {60, 40})}, {60, 40});
  const Outline outline = resolveOutline(shape).value();
  return buildBorderIndex(outline, makeGrid(outline.bounds, 0.4), RunContext(1)).value();
}

// Beads are asked to run along the rows, all over the page.
LineField levelLines() {
  LineField lines;
  lines.grid = makeGrid({{0, 0}, {60, 40}}, 0.4);
  lines.direction.assign(lines.grid.size(), {0, 1});
  lines.fixed.assign(lines.grid.size(), 1);
  return lines;
}

// Mean height of the points of row k in its middle.
double middleHeight(const ClosedCurves& curves, double guess) {
  double sum = 0;
  int count = 0;
  for (const Vec2f p : curves.points) {
    if (p.x < 18 || p.x > 22 || std::abs(static_cast<double>(p.y) - guess) > 0.19) continue;
    sum += static_cast<double>(p.y);
    ++count;
  }
  return count > 0 ? sum / count : -1;
}

// Turns by 60 degrees and more within a quarter of a spacing of 0.4, as they are measured.
int kinksOf(const ClosedCurves& curves) {
  const ClosedCurves fine = resampled(curves, 0.05f, RunContext(1));
  int kinks = 0;
  for (int c = 0; c < fine.count(); ++c) {
    for (int k = 0; k < fine.size(c); ++k) {
      Vec2f p[4];
      for (int n = 0; n < 4; ++n) p[n] = fine.points[fine.begin[c] + (k + n) % fine.size(c)];
      kinks += dot(p[1] - p[0], p[3] - p[2]) <= 0.5f * length(p[1] - p[0]) * length(p[3] - p[2]) ? 1 : 0;
    }
  }
  return kinks;
}

}  // namespace

TEST_CASE("gaps of parallel rows are their distances, left and right apart") {
  const ClosedCurves path = resampled(rows({10, 10.4, 10.75, 11.2}, 20), 0.1f, RunContext(1));
  const BeadGaps gaps = beadGaps(path, farBorder(), 0.4, 0.6f, RunContext(1));
  int checked = 0;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const Vec2f p = path.points[i];
    if (p.x < 15 || p.x > 25) continue;
    const bool second = std::abs(p.y - 10.4f) < 0.01f;  // runs to the left: its right side is up
    const bool third = std::abs(p.y - 10.75f) < 0.01f;
    if (second) {
      CHECK(gaps.left[i] == about(0.4, 0.02));
      CHECK(gaps.right[i] == about(0.35, 0.025));  // points 0.1 apart: the circle is up to 2 % larger
    }
    if (third) {
      CHECK(gaps.left[i] == about(0.45, 0.02));
      CHECK(gaps.right[i] == about(0.35, 0.025));
    }
    checked += second || third ? 1 : 0;
  }
  CHECK(checked > 150);
}

TEST_CASE("uneven rows move towards even spacing") {
  ToolpathParams params;
  params.relaxationRounds = 8;
  const auto relaxed = relaxSpacing(rows({10, 10.4, 10.7, 11.2, 11.6}, 20), farBorder(), params, RunContext(1));
  REQUIRE(relaxed.ok());
  const double second = middleHeight(relaxed.value().curves, 10.4);
  const double third = middleHeight(relaxed.value().curves, 10.75);
  const double fourth = middleHeight(relaxed.value().curves, 11.15);
  CHECK(third - second == about(fourth - third, 0.06));
}

TEST_CASE("no row is pressed nearer to the border than a quarter of a spacing, or than it was") {
  // The second row presses the first towards the border at y = 0.
  ToolpathParams params;
  params.relaxationRounds = 1;  // later the second row is far off
  for (const double away : {0.13, 0.07}) {
    const auto relaxed = relaxSpacing(rows({away, away + 0.06, 1.2, 1.6}, 20), farBorder(), params, RunContext(1));
    const double least = std::min(away, 0.1);
    int checked = 0;
    for (const Vec2f p : relaxed.value().curves.points) {
      if (p.x < 12 || p.x > 28 || p.y > 0.15f) continue;
      CHECK(static_cast<double>(p.y) >= least - 1e-5);
      ++checked;
    }
    CHECK(checked > 100);
  }
}

TEST_CASE("even rows stay where they are") {
  const auto relaxed = relaxSpacing(rows({10, 10.4, 10.8, 11.2, 11.6}, 20), farBorder(), {}, RunContext(1));
  CHECK(middleHeight(relaxed.value().curves, 10.8) == about(10.8, 1e-4));
}

TEST_CASE("lines that are asked for take waves out of beads, but not in the last round") {
  // One bead far from others, in waves as long as 15 spacings, which smoothing leaves alone.
  constexpr double kWave = 0.1, kPeriod = 6;
  ClosedCurves wavy = rows({10, 20}, 30);
  std::vector<Vec2f> bead;
  for (int k = 0; k <= 300; ++k) {
    const double x = 10 + 0.1 * k;
    bead.push_back(
        {static_cast<float>(x), static_cast<float>(10 + kWave * std::sin(2 * std::numbers::pi * x / kPeriod))});
  }
  wavy.points.erase(wavy.points.begin(), wavy.points.begin() + 2);
  wavy.points.insert(wavy.points.begin(), bead.begin(), bead.end());
  wavy.begin.back() = static_cast<int>(wavy.points.size());
  const LineField level = levelLines();
  const auto waveLeft = [&](int rounds, const LineField* asked) {
    ToolpathParams params;
    params.relaxationRounds = rounds;
    params.relaxationStrength = 0.25;  // as plates with pictures have at least
    params.relaxationSmoothing = 0;
    const auto relaxed = relaxSpacing(wavy, farBorder(), params, RunContext(1), asked);
    double highest = 0;
    for (const Vec2f p : relaxed.value().curves.points) {
      if (p.x > 22 && p.x < 28 && p.y < 12) highest = std::max(highest, std::abs(static_cast<double>(p.y) - 10));
    }
    return highest;
  };
  CHECK(waveLeft(3, nullptr) > 0.9 * kWave);
  // Two rounds more, of which the last leaves lines alone. Each takes pull / (pull + 2 - 2 cos of a step's phase) of a
  // wave, with a pull of 0.003, and of 0.03 the last time.
  const double stiff = 2 - 2 * std::cos(2 * std::numbers::pi * 0.1 / kPeriod);
  const auto left = [&](double pull) { return pull / (pull + stiff); };
  CHECK(waveLeft(2, &level) == about(kWave * left(0.003) * left(0.003) * left(0.03), 0.2));
  CHECK(waveLeft(1, &level) == waveLeft(1, nullptr));
}

TEST_CASE("where lines are asked for, a quarter of the difference is moved at least") {
  const LineField level = levelLines();
  for (const auto& [strength, share] : {std::pair{0.0, 0.25}, {0.1, 0.25}, {0.5, 0.5}}) {
    ToolpathParams params;
    params.relaxationRounds = 1;
    params.relaxationSmoothing = 0;
    params.relaxationStrength = strength;
    CAPTURE(params.relaxationStrength);
    const auto relaxed =
        relaxSpacing(rows({10.9, 11.6, 12, 12.47, 13.17}, 20), farBorder(), params, RunContext(1), &level);
    REQUIRE(relaxed.ok());
    CHECK(std::abs(middleHeight(relaxed.value().curves, 12) - 12 - share * 0.07) < 0.006);
  }
}

TEST_CASE("where lines are asked for, paths are smoothed by 0.3 at most") {
  const LineField level = levelLines();
  ClosedCurves circle;
  for (const Vec2 p : scenes::circle({20, 20}, 3, 360))
    circle.points.push_back({static_cast<float>(p.x), static_cast<float>(p.y)});
  circle.begin = {0, 360};
  const ClosedCurves before = resampled(circle, 0.1f, RunContext(1));
  const double sagitta = 3 * (1 - std::cos(2 * std::numbers::pi / static_cast<double>(before.points.size())));
  for (const auto& [smoothing, share] : {std::pair{0.1, 0.1}, {0.5, 0.3}}) {
    ToolpathParams params;
    params.relaxationRounds = 1;
    params.relaxationSmoothing = smoothing;
    const auto relaxed = relaxSpacing(circle, farBorder(), params, RunContext(1), &level);
    REQUIRE(relaxed.ok());
    double drawnIn = 0;
    for (const Vec2f p : relaxed.value().curves.points)
      drawnIn += 3 - std::hypot(static_cast<double>(p.x) - 20, static_cast<double>(p.y) - 20);
    drawnIn /= static_cast<double>(relaxed.value().curves.points.size());
    CHECK(std::abs(drawnIn - share * sagitta) < 0.1 * sagitta);
  }
}

TEST_CASE("a circle's gaps inside are its diameter, so a U-turn's tip keeps its size") {
  ClosedCurves curves;
  for (const Vec2 p : scenes::circle({20, 20}, 0.25, 40))
    curves.points.push_back({static_cast<float>(p.x), static_cast<float>(p.y)});
  curves.begin = {0, 40};
  const ClosedCurves path = resampled(curves, 0.1f, RunContext(1));
  const BeadGaps gaps = beadGaps(path, farBorder(), 0.4, 0.6f, RunContext(1));
  for (const float gap : gaps.left) CHECK(gap == about(0.5, 0.02));
  for (const float gap : gaps.right) CHECK(gap == doctest::Approx(0.6));
}

TEST_CASE("a path that would be pushed through itself stays simple") {
  // Rows far too close: one round wants to move them by more than their distance.
  ToolpathParams params;
  params.relaxationRounds = 4;
  params.relaxationSmoothing = 0;
  const std::vector<double> heights = {10, 10.03, 10.5, 10.52, 10.54, 11.2};
  const auto relaxed = relaxSpacing(rows(heights, 20), farBorder(), params, RunContext(1));
  REQUIRE(relaxed.ok());
  CHECK(findCrossings(relaxed.value().curves, RunContext(1)).empty());
}

TEST_CASE("a path moves the same whichever way it is walked") {
  ToolpathParams params;
  params.relaxationSmoothing = 0.5;
  const ClosedCurves there = rows({10, 10.4, 10.75, 11.2, 11.5}, 20);
  ClosedCurves back = there;
  std::reverse(back.points.begin() + 1, back.points.end());  // from the same first point
  const auto one = relaxSpacing(there, farBorder(), params, RunContext(1));
  const auto other = relaxSpacing(back, farBorder(), params, RunContext(1));
  REQUIRE(one.ok());
  REQUIRE(other.ok());
  const std::vector<Vec2f>& a = one.value().curves.points;
  const std::vector<Vec2f>& b = other.value().curves.points;
  REQUIRE(a.size() == b.size());
  for (std::size_t k = 0; k < a.size(); ++k) CHECK(length(a[k] - b[(b.size() - k) % b.size()]) < 2e-3f);
}

TEST_CASE("where a path would cross itself it is held back, and moves elsewhere") {
  // Three rows that press a fourth through a fifth, and far from them three that are to even out, on one path.
  ToolpathParams params;
  params.relaxationRounds = 1;
  params.relaxationSmoothing = 0;
  params.relaxationStrength = 0.5;
  const std::vector<double> heights = {10, 10.03, 10.5, 10.52, 10.54, 11.2, 20, 20.7, 21.1, 21.57, 22.27};
  const auto relaxed = relaxSpacing(rows(heights, 20), farBorder(), params, RunContext(1));
  REQUIRE(relaxed.ok());
  CHECK(findCrossings(relaxed.value().curves, RunContext(1)).empty());
  CHECK(std::abs(middleHeight(relaxed.value().curves, 21.1) - 21.1 - 0.5 * 0.07) < 0.006);
}

TEST_CASE("kinks are rounded, and only what lies within a spacing of one moves") {
  const ClosedCurves corners = rows({10, 10.4, 10.8, 11.2}, 20);
  const ClosedCurves before = resampled(corners, 0.1f, RunContext(1));
  ClosedCurves after = before;
  roundKinks(after, farBorder(), 0.4, RunContext(1));
  CHECK(kinksOf(before) >= 10);
  CHECK(kinksOf(after) == 0);
  CHECK(findCrossings(after, RunContext(1)).empty());
  CHECK(after.begin == before.begin);
  for (std::size_t k = 0; k < before.points.size(); ++k) {
    float near = 1e9f;
    for (const Vec2f corner : corners.points) near = std::min(near, length(before.points[k] - corner));
    CHECK(length(after.points[k] - before.points[k]) <= (near > 0.4f ? 0.0f : 0.2f));
  }
}

TEST_CASE("a U-turn whose legs lie too near to each other is pulled back to where it can turn") {
  // A wedge of 2 mm, from legs 0.6 mm apart to a point.
  ClosedCurves curves = resampled(
      scenes::closed({{{10, 10}, {12, 9.7f}, {12, 8}, {20, 8}, {20, 12}, {12, 12}, {12, 10.3f}}}), 0.1f, RunContext(1));
  const int before = kinksOf(curves);
  roundKinks(curves, farBorder(), 0.4, RunContext(1));
  CHECK(before >= 5);
  CHECK(kinksOf(curves) == 0);
  CHECK(findCrossings(curves, RunContext(1)).empty());
  float tip = 1e9f;
  for (const Vec2f p : curves.points) tip = std::min(tip, p.x);
  CHECK(tip > 10.2f);
  CHECK(tip < 12.0f);
}

TEST_CASE("a kink stays where another path lies in its corner") {
  for (const bool there : {false, true}) {
    std::vector<std::vector<Vec2f>> corners = {{{20, 10}, {10, 20}, {10, 10}}};
    if (there) corners.push_back({{19.985f, 10.004f}, {19, 10.45f}, {19, 10.3f}});
    ClosedCurves curves = resampledSimply(scenes::closed(corners), 0.1f, RunContext(1));
    REQUIRE(findCrossings(curves, RunContext(1)).empty());
    roundKinks(curves, farBorder(), 0.4, RunContext(1));
    CHECK(findCrossings(curves, RunContext(1)).empty());
    float tip = 0;
    for (const Vec2f p : curves.points) tip = std::max(tip, p.x);
    CHECK((tip == 20) == there);
  }
}

TEST_CASE("a run that is cancelled while neighbours are sorted rounds no kink") {
  const ClosedCurves before = resampled(rows({10, 10.4, 10.8, 11.2}, 20), 0.1f, RunContext(1));
  const BorderIndex border = farBorder();
  for (const int last : {1, 2}) {  // of the two loops that sort
    ClosedCurves after = before;
    RunContext run(1);
    int asked = 0;
    run.onPoll([&] { return ++asked == last; });
    roundKinks(after, border, 0.4, run);
    CHECK(run.cancelled());
    CHECK(after.points == before.points);
  }
}

TEST_CASE("a kink round a corner of the shape comes no nearer to it") {
  // An L whose inner corner lies at (10, 10), and paths so far from it.
  const Shape shape = scenes::shapeOf({{{0, 0}, {20, 0}, {20, 10}, {10, 10}, {10, 20}, {0, 20}}}, {20, 20});
  const Outline outline = resolveOutline(shape).value();
  const BorderIndex border = buildBorderIndex(outline, makeGrid(outline.bounds, 0.4), RunContext(1)).value();
  const auto nearest = [&](const ClosedCurves& curves) {
    float distance = -1e9f;
    for (const Vec2f p : curves.points)
      distance = std::max(distance, border.nearest({static_cast<double>(p.x), static_cast<double>(p.y)}).distance);
    return distance;
  };
  for (const float away : {0.05f, 0.2f}) {
    const float inner = 10 - away;
    const ClosedCurves before = resampled(
        scenes::closed({{{2, 2}, {18, 2}, {18, inner}, {inner, inner}, {inner, 18}, {2, 18}}}), 0.1f, RunContext(1));
    ClosedCurves after = before;
    roundKinks(after, border, 0.4, RunContext(1));
    CHECK(kinksOf(after) < kinksOf(before));  // the outer corners
    CHECK(nearest(after) <= std::max(nearest(before), -0.1f) + 1e-6f);
  }
}

TEST_CASE("widths of parallel rows: twice the smaller half gap without balance, the mean of both with it") {
  // Not held apart: that has its own case.
  const ClosedCurves path = resampled(rows({10, 10.4, 10.75, 11.2}, 20), 0.1f, RunContext(1));
  const BorderIndex border = farBorder();
  const BeadGaps gaps = beadGaps(path, border, 0.4, 0.6f, RunContext(1));
  for (const double balance : {0.0, 1.0}) {
    ToolpathParams params;
    params.widthBalance = balance;
    params.beadOverlap = 1;
    const auto widths = beadWidths(path, gaps, border, params, RunContext(1));
    for (std::size_t i = 0; i < path.points.size(); ++i) {
      const Vec2f p = path.points[i];
      if (p.x < 15 || p.x > 25 || std::abs(p.y - 10.75f) > 0.01f) continue;
      CHECK(widths.value().width[i] == about(balance == 0.0 ? 0.35 : 0.4, 0.025));
    }
  }
}

TEST_CASE("beads that would overlap give way in proportion, by no more than needed") {
  const ClosedCurves path = resampled(rows({10, 10.4, 10.75, 11.2}, 20), 0.1f, RunContext(1));
  const BorderIndex border = farBorder();
  const BeadGaps gaps = beadGaps(path, border, 0.4, 0.6f, RunContext(1));
  ToolpathParams params;
  params.widthBalance = 1;
  params.simplifyTolerance = 0;
  for (const double overlap : {0.0, 0.05}) {
    params.beadOverlap = overlap;
    const auto widths = beadWidths(path, gaps, border, params, RunContext(1));
    REQUIRE(widths.ok());
    // Rows of 0.375 and 0.4 mm, 0.35 mm apart: what is too much is taken from both alike.
    const double share = (0.35 + overlap * 0.4) / (0.5 * (0.375 + 0.4));
    int checked = 0;
    for (std::size_t i = 0; i < path.points.size(); ++i) {
      const Vec2f p = path.points[i];
      if (p.x < 15 || p.x > 25) continue;
      if (std::abs(p.y - 10.4f) < 0.01f) CHECK(widths.value().width[i] == about(0.375 * share, 0.02));
      if (std::abs(p.y - 10.75f) < 0.01f) CHECK(widths.value().width[i] == about(0.4 * share, 0.02));
      checked += std::abs(p.y - 10.4f) < 0.01f || std::abs(p.y - 10.75f) < 0.01f ? 1 : 0;
    }
    CHECK(checked > 150);
  }
}

// Of beads that may not overlap at all.
std::vector<float> widthsHeldApart(const ClosedCurves& path, const BeadGaps& gaps) {
  ToolpathParams params;
  params.simplifyTolerance = 0;
  params.beadOverlap = 0;
  const auto widths = beadWidths(path, gaps, farBorder(), params, RunContext(1));
  REQUIRE(widths.ok());
  return widths.value().width;
}

TEST_CASE("a bead grows again where its neighbour gave way to another") {
  // 0.4 mm wide, but for the second row: pressed by the first, it leaves room for the third.
  const ClosedCurves path = resampled(rows({10, 10.3, 10.65, 11.15}, 20), 0.1f, RunContext(1));
  BeadGaps gaps;
  gaps.left.assign(path.points.size(), 0.4f);
  gaps.right = gaps.left;
  const std::vector<float> w = widthsHeldApart(path, gaps);
  int checked = 0;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const Vec2f p = path.points[i];
    if (p.x < 15 || p.x > 25) continue;
    const float width = w[i];
    if (std::abs(p.y - 10.3f) < 0.01f) CHECK(width == about(0.3, 0.02));
    // Its own share of the 0.35 mm was 0.35.
    if (std::abs(p.y - 10.65f) < 0.01f) CHECK(width > 0.38f);
    checked += std::abs(p.y - 10.65f) < 0.01f ? 1 : 0;
  }
  CHECK(checked > 50);
}

TEST_CASE("where widths change, beads leave room for moves, which have one width from end to end") {
  const ClosedCurves path = resampled(rows({10, 10.4}, 20), 0.1f, RunContext(1));
  BeadGaps gaps;
  for (const Vec2f p : path.points) {
    const float along = 0.02f * std::clamp(p.x - 20, -4.0f, 4.0f);  // one grows where the other shrinks
    gaps.left.push_back(p.y < 10.2f ? 0.37f + along : 0.45f - along);
  }
  gaps.right = gaps.left;
  const std::vector<float> w = widthsHeldApart(path, gaps);
  const auto move = [&](std::size_t i) { return (w[i] + std::max(w[i - 1], w[i + 1])) / 2; };
  int checked = 0;
  for (std::size_t i = 1; i + 1 < path.points.size(); ++i) {
    for (std::size_t j = i + 1; j + 1 < path.points.size(); ++j) {
      const Vec2f d = path.points[j] - path.points[i];
      if (std::abs(d.x) > 0.01f || std::abs(d.y) < 0.3f || std::abs(path.points[i].x - 20) > 3) continue;
      CHECK((move(i) + move(j)) / 2 <= 0.4f + 3e-4f);
      CHECK((w[i] + w[j]) / 2 >= 0.395f);
      ++checked;
    }
  }
  CHECK(checked > 20);
}

TEST_CASE("no bead reaches over the border") {
  ClosedCurves path;
  for (int k = 0; k < 400; ++k) path.points.push_back({10 + 0.1f * static_cast<float>(k), 0.12f});
  for (int k = 400; k-- > 0;) path.points.push_back({10 + 0.1f * static_cast<float>(k), 3.0f});
  path.begin = {0, static_cast<int>(path.points.size())};
  const BorderIndex border = farBorder();
  const BeadGaps gaps = beadGaps(path, border, 0.4, 0.6f, RunContext(1));
  const auto widths = beadWidths(path, gaps, border, {}, RunContext(1));
  for (std::size_t k = 0; k < 400; ++k) CHECK(widths.value().width[k] <= 0.24f + 1e-5f);
}

TEST_CASE("the finished path is within the tolerance of the full one, in position and width, on whole micrometres") {
  ClosedCurves path;
  std::vector<float> widths;
  for (int k = 0; k < 2000; ++k) {
    const double a = 2 * std::numbers::pi * k / 2000;
    path.points.push_back({static_cast<float>(30 + (15 + std::sin(9 * a)) * std::cos(a)),
                           static_cast<float>(20 + (15 + std::sin(9 * a)) * std::sin(a))});
    widths.push_back(static_cast<float>(0.4 + 0.1 * std::sin(31 * a)));
  }
  path.begin = {0, 2000};
  ToolpathParams params;
  params.simplifyTolerance = 0.01;
  auto toolpath = finishToolpath(path, {widths, std::vector<float>(widths.size(), 1e9f)}, params, RunContext(1));
  REQUIRE(toolpath.ok());
  REQUIRE(toolpath.value().cycles.size() == 1);
  const Cycle& cycle = toolpath.value().cycles[0];
  CHECK(cycle.points.size() < 1000);
  for (const Vec2f p : cycle.points) {
    CHECK(std::abs(p.x * 1000 - std::round(p.x * 1000)) < 0.01f);
  }
  for (std::size_t k = 0; k < path.points.size(); ++k) {
    double best = 1e9;
    double width = 0;
    for (std::size_t i = 0; i < cycle.points.size(); ++i) {
      const Vec2f a = cycle.points[i];
      const std::size_t n = (i + 1) % cycle.points.size();
      const Vec2f u = cycle.points[n] - a;
      const float t = std::clamp(dot(path.points[k] - a, u) / dot(u, u), 0.0f, 1.0f);
      const double distance = static_cast<double>(length(path.points[k] - (a + u * t)));
      if (distance < best) {
        best = distance;
        width = static_cast<double>(cycle.widths[i] + (cycle.widths[n] - cycle.widths[i]) * t);
      }
    }
    CHECK(best <= 0.0112);  // the tolerance and the rounding
    CHECK(std::abs(width - static_cast<double>(widths[k])) <= 0.0125);
  }
}

TEST_CASE("leaving out points never makes strands meet") {
  // Two wavy strands 0.012 mm apart: straightening both at 0.2 mm would cross them.
  ClosedCurves path;
  for (int k = 0; k <= 400; ++k)
    path.points.push_back({10 + 0.05f * static_cast<float>(k), 10 + 0.15f * static_cast<float>(std::sin(0.3 * k))});
  for (int k = 400; k >= 0; --k)
    path.points.push_back(
        {10 + 0.05f * static_cast<float>(k), 10.012f + 0.15f * static_cast<float>(std::sin(0.3 * k))});
  path.begin = {0, static_cast<int>(path.points.size())};
  REQUIRE(findCrossings(path, RunContext(1)).empty());
  ToolpathParams params;
  params.simplifyTolerance = 0.2;
  auto toolpath =
      finishToolpath(path, {std::vector<float>(path.points.size(), 0.4f), std::vector<float>(path.points.size(), 1e9f)},
                     params, RunContext(1));
  ClosedCurves out;
  out.points = toolpath.value().cycles[0].points;
  out.begin = {0, static_cast<int>(out.points.size())};
  CHECK(findCrossings(out, RunContext(1)).empty());
  CHECK(out.points.size() < path.points.size());
}

TEST_CASE("crossings are found exactly: proper, touching and overlapping, but not between neighbours") {
  const auto count = [](std::vector<Vec2f> points) {
    ClosedCurves c;
    c.begin = {0, static_cast<int>(points.size())};
    c.points = std::move(points);
    return findCrossings(c, RunContext(1)).size();
  };
  CHECK(count({{0, 0}, {4, 0}, {4, 4}, {0, 4}}) == 0);
  CHECK(count({{0, 0}, {4, 4}, {4, 0}, {0, 4}}) == 1);                  // bow tie
  CHECK(count({{0, 0}, {4, 0}, {4, 2}, {2, 0}, {0, 2}}) == 2);          // a corner touches an edge: two of its segments
  CHECK(count({{0, 0}, {4, 0}, {4, 2}, {2, 0.002f}, {0, 2}}) == 0);     // 2 µm off
  CHECK(count({{0, 0}, {4, 0}, {4, 1}, {3, 0}, {1, 0}, {0, 1}}) >= 1);  // lies on it
  CHECK(count({{0, 0}, {4, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 4}}) == 0);  // repeated points
}

TEST_CASE("a row moves towards its wider side by its share of the difference, and what is beyond a drift by more") {
  struct Row {
    double below, above, strength, moves;
  };
  // Up to a drift of 0.24 spacings by `strength`, what is beyond by 0.7, by no more than 0.15 spacings. Gaps count up
  // to 1.5 spacings.
  const double drift = 0.24 * 0.4;
  const Row moving[] = {
      {0.4, 0.47, 0.5, 0.5 * 0.07},
      {0.47, 0.4, 0.5, -0.5 * 0.07},
      {0.4, 0.47, 0.0, 0},
      {0.4, 0.54, 0.0, 0.7 * (0.14 - drift)},
      {0.54, 0.4, 0.1, -0.1 * drift - 0.7 * (0.14 - drift)},
      {0.4, 0.6, 0.0, 0.06},
      {0.6, 0.4, 0.5, -0.06},
      {0.6, 0.9, 0.5, 0},
      {0.7, 0.62, 0.5, 0},
  };
  for (const Row& row : moving) {
    CAPTURE(row.below);
    CAPTURE(row.above);
    ToolpathParams params;
    params.relaxationRounds = 1;
    params.relaxationSmoothing = 0;
    params.relaxationStrength = row.strength;
    // The outer rows lie 0.7 mm from the next ones.
    const double middle = 12;
    const double below = middle - row.below, above = middle + row.above;
    const auto relaxed =
        relaxSpacing(rows({below - 0.7, below, middle, above, above + 0.7}, 20), farBorder(), params, RunContext(1));
    REQUIRE(relaxed.ok());
    // Gaps are up to 2 % larger, as points lie 0.1 mm apart; those that are held at a limit are exact.
    const bool exact = row.moves == 0 || std::abs(row.moves) == 0.06;
    CHECK(std::abs(middleHeight(relaxed.value().curves, middle) - middle - row.moves) < (exact ? 1e-4 : 0.006));
  }
}

TEST_CASE("beside the border rows even out at a fifth at least, others as they are asked to") {
  // The border counts as a neighbour at twice its distance.
  for (const auto& [strength, moves] : {std::pair{0.0, 0.2 * 0.08}, {0.4, 0.4 * 0.08}}) {
    ToolpathParams params;
    params.relaxationRounds = 1;
    params.relaxationSmoothing = 0;
    params.relaxationStrength = strength;
    const auto relaxed = relaxSpacing(rows({0.21, 0.71, 1.71, 2.13, 2.63}, 20), farBorder(), params, RunContext(1));
    REQUIRE(relaxed.ok());
    CHECK(std::abs(middleHeight(relaxed.value().curves, 0.21) - 0.21 - moves) < 0.005);
    CHECK(std::abs(middleHeight(relaxed.value().curves, 2.13) - 2.13 - strength * 0.08) < 0.005);
  }
}

TEST_CASE("smoothing draws a circle in by its share of the sagitta, and leaves dots alone") {
  for (const double radius : {3.0, 1.0, 0.112, 0.12}) {
    CAPTURE(radius);
    ClosedCurves curves;
    for (const Vec2 p : scenes::circle({20, 20}, radius, 360))
      curves.points.push_back({static_cast<float>(p.x), static_cast<float>(p.y)});
    curves.begin = {0, 360};
    ToolpathParams params;
    params.relaxationRounds = 1;
    params.relaxationSmoothing = 0.5;
    const ClosedCurves before = resampled(curves, 0.1f, RunContext(1));
    const auto relaxed = relaxSpacing(curves, farBorder(), params, RunContext(1));
    REQUIRE(relaxed.ok());
    const auto radiusOf = [](const ClosedCurves& of) {
      double least = 1e9;
      double most = 0;
      for (const Vec2f p : of.points) {
        const double r = std::hypot(static_cast<double>(p.x) - 20, static_cast<double>(p.y) - 20);
        least = std::min(least, r);
        most = std::max(most, r);
      }
      CHECK(most - least < 0.1 * most);
      return most;
    };
    // A cycle of less than 1.8 spacings, 0.72 mm, is a dot. One hardly longer has less room inside than outside, and
    // widens.
    if (radius == 0.12) {
      CHECK(radiusOf(relaxed.value().curves) > 1.1 * radius);
      continue;
    }
    const double turn = 2 * std::numbers::pi / static_cast<double>(before.points.size());
    const double expected = radius == 0.112 ? radius : radius * (1 - 0.5 * (1 - std::cos(turn)));
    CHECK(radiusOf(relaxed.value().curves) == about(expected, 0.005));
  }
}
