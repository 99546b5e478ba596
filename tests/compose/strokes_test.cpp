// Gestures of brushes over a stack of layers, in closed forms.
#include "compose/strokes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "sillon/geometry/shape.hpp"

using namespace sillon;

namespace {

const Vec2 kPage{60, 40};
constexpr int kWidth = 120, kHeight = 80;
constexpr std::size_t kNumber = 1;

/// A layer at 0 degrees on the whole page, and strokes over it.
struct Painted {
  Project project;
  Shape shape = makeRectangle(kPage).value();
  LayerStack stack;
  StrokesLayer strokes;

  Painted() {
    stack.width = kWidth;
    stack.height = kHeight;
    LayerStack::Texel texel;
    texel.line = {1, 0};
    texel.through = 0;
    texel.cover = 1;
    texel.top = 1;
    texel.ink = LayerStack::Ink::Turned;
    texel.mode = DirectionMode::Constrained;
    stack.texels.assign(static_cast<std::size_t>(kWidth) * kHeight, texel);
  }
  Stroke& add(StrokeTool tool, std::vector<Vec2> points) {
    Stroke& stroke = strokes.strokes.emplace_back();
    stroke.tool = tool;
    stroke.soft = 0;
    stroke.points = std::move(points);
    return stroke;
  }
  void draw() {
    const LayerPlate plate{project, shape, kWidth, kHeight};
    CHECK_FALSE(drawStrokes(strokes, kNumber, plate, stack, RunContext()));
  }
  [[nodiscard]] const LayerStack::Texel& at(Vec2 place) const {
    const auto x = static_cast<std::size_t>(place.x / kPage.x * kWidth);
    const auto y = static_cast<std::size_t>((1 - place.y / kPage.y) * kHeight);
    return stack.texels[y * kWidth + x];
  }
};

Vec2 middleOf(int x, int y) { return {(x + 0.5) * kPage.x / kWidth, (kHeight - y - 0.5) * kPage.y / kHeight}; }

bool same(const LayerStack::Texel& a, const LayerStack::Texel& b) {
  return a.line == b.line && a.through == b.through && a.cover == b.cover && a.top == b.top && a.place == b.place &&
         a.ink == b.ink && a.mode == b.mode;
}

bool near(Vec2f a, Vec2f b) { return length(a - b) < 1e-5F; }

/// Distance from an upright line.
double distanceFrom(Vec2 place, double x, double low, double high) {
  return std::hypot(place.x - x, place.y - std::min(std::max(place.y, low), high));
}

}  // namespace

TEST_CASE("a comb turns the texels under it to its way, and no others") {
  Painted painted;
  painted.add(StrokeTool::Comb, {{30, 10}, {30, 12}, {30, 30}});
  const LayerStack before = painted.stack;
  painted.draw();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const auto k = static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x);
      const LayerStack::Texel& texel = painted.stack.texels[k];
      if (distanceFrom(middleOf(x, y), 30, 10, 30) >= 4) {
        REQUIRE(same(texel, before.texels[k]));
        continue;
      }
      REQUIRE(near(texel.line, {-1, 0}));
      REQUIRE(texel.through == 0);
      REQUIRE(texel.cover == 1);
      REQUIRE(texel.top == kNumber + 1);
      REQUIRE(texel.ink == LayerStack::Ink::None);
    }
  }
}

TEST_CASE("brushes come in from beside the page and leave it again") {
  Painted painted;
  painted.add(StrokeTool::Comb, {{-100, 20}, {31, 20}, {200, 20}}).radius = 3;
  painted.add(StrokeTool::Comb, {{20, -90}, {20, 130}});
  painted.draw();
  CHECK(near(painted.at({0.1, 20}).line, {1, 0}));
  CHECK(painted.at({59.9, 20}).top == kNumber + 1);
  CHECK(painted.at({50, 23.6}).top == 1);
  CHECK(near(painted.at({20, 0.1}).line, {-1, 0}));
  CHECK(near(painted.at({20, 39.9}).line, {-1, 0}));
  painted.strokes.strokes.clear();
  painted.add(StrokeTool::Comb, {{-200, -100}, {150, 120}});
  painted.add(StrokeTool::Erase, {{-200, -100}, {150, 120}}).radius = 5;
  const LayerStack combed = painted.stack;
  painted.draw();
  for (std::size_t k = 0; k < combed.texels.size(); ++k) REQUIRE(same(painted.stack.texels[k], combed.texels[k]));
}

TEST_CASE("a soft rim blends lines where beads are constrained") {
  Painted painted;
  painted.add(StrokeTool::Comb, {{10, 10}, {30, 30}}).soft = 0.5;
  painted.draw();
  for (const double away : {0.0, 1.0, 2.5, 3.0, 3.5}) {
    const Vec2 near_by = Vec2{20, 20} + Vec2{1, -1} * (away / std::sqrt(2.0));
    const Vec2 middle = middleOf(static_cast<int>(near_by.x * 2), static_cast<int>((40 - near_by.y) * 2));
    const double inner = std::min(1.0, (4 - std::abs(middle.x - middle.y) / std::sqrt(2.0)) / 2);
    const auto strength = static_cast<float>(inner * inner * (3 - 2 * inner));
    const LayerStack::Texel& texel = painted.at(near_by);
    CHECK(near(texel.line, Vec2f{1, 0} * (1 - strength) + Vec2f{0, 1} * strength));
    CHECK(texel.top == (strength >= 0.5F ? 2 : 1));
  }
}

TEST_CASE("where beads are not constrained, a comb counts whole or not at all") {
  for (const bool ground : {false, true}) {
    Painted painted;
    // Said by the texels themselves, or by the lowest layer where no other one lies.
    if (ground) painted.project.layers.emplace_back().mode = DirectionMode::Parallel;
    for (LayerStack::Texel& texel : painted.stack.texels) {
      texel.through = 1;
      texel.line = {};
      texel.mode = ground ? std::nullopt : std::optional(DirectionMode::Smoothest);
    }
    painted.add(StrokeTool::Comb, {{30, 10}, {30, 30}}).soft = 1;
    painted.draw();
    CHECK(painted.at({31.8, 20}).through == 0);
    CHECK(near(painted.at({31.8, 20}).line, {-1, 0}));
    CHECK(painted.at({31.8, 20}).mode == DirectionMode::Constrained);
    CHECK(painted.at({32.3, 20}).through == 1);
    CHECK(painted.at({32.3, 20}).mode != DirectionMode::Constrained);
  }
}

TEST_CASE("without any layer below, a comb blends with what lies below all") {
  Painted painted;
  for (LayerStack::Texel& texel : painted.stack.texels) texel = {};
  painted.add(StrokeTool::Comb, {{30, 10}, {30, 30}}).soft = 1;
  painted.draw();
  const LayerStack::Texel& texel = painted.at({32.1, 20.1});
  const double inner = (4 - 2.25) / 4;
  const auto strength = static_cast<float>(inner * inner * (3 - 2 * inner));
  CHECK(std::abs(texel.through - (1 - strength)) < 1e-5F);
  CHECK(near(texel.line, Vec2f{-1, 0} * strength));
  CHECK(std::abs(texel.cover - strength) < 1e-5F);
  CHECK(texel.mode == DirectionMode::Constrained);
}

TEST_CASE("a brush that turns leaves each place in the way that it went there") {
  Painted painted;
  painted.add(StrokeTool::Comb, {{10, 10}, {40, 10}, {40, 35}}).radius = 2;
  painted.draw();
  CHECK(near(painted.at({20, 10}).line, {1, 0}));
  CHECK(near(painted.at({40, 25}).line, {-1, 0}));
  CHECK(painted.at({39.75, 10.25}).line.y > -0.9F);
  CHECK(painted.at({25, 25}).top == 1);
}

TEST_CASE("a stroke of modes sets them where it is strong, and leaves the lines") {
  Painted painted;
  painted.add(StrokeTool::Mode, {{30, 20}}).mode = DirectionMode::Orthogonal;
  const LayerStack before = painted.stack;
  painted.draw();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const auto k = static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x);
      const LayerStack::Texel& texel = painted.stack.texels[k];
      const bool inside = length(middleOf(x, y) - Vec2{30, 20}) < 4;
      REQUIRE(texel.mode == (inside ? DirectionMode::Orthogonal : DirectionMode::Constrained));
      REQUIRE(texel.line == before.texels[k].line);
      REQUIRE(texel.through == before.texels[k].through);
    }
  }
}

TEST_CASE("an eraser brings back what lay below, exactly") {
  Painted painted;
  const LayerStack before = painted.stack;
  painted.add(StrokeTool::Comb, {{10, 10}, {50, 30}});
  painted.add(StrokeTool::Mode, {{10, 30}, {50, 10}}).mode = DirectionMode::Parallel;
  painted.add(StrokeTool::Erase, {{30, 40}, {60, 0}}).radius = 3;
  painted.add(StrokeTool::Erase, {{0, 0}, {60, 40}}).radius = 60;
  painted.draw();
  for (std::size_t k = 0; k < before.texels.size(); ++k) REQUIRE(same(painted.stack.texels[k], before.texels[k]));
}

TEST_CASE("the soft rim of an eraser lies between both") {
  Painted painted;
  painted.add(StrokeTool::Comb, {{10, 20}, {50, 20.001}});
  for (Vec2& point : painted.strokes.strokes[0].points) point = {point.y + 10, point.x - 10};  // upright at x = 30
  painted.add(StrokeTool::Erase, {{30, 20}}).soft = 1;
  painted.draw();
  CHECK(painted.at({30.1, 20.1}).line.x > 0.8F);
  const LayerStack::Texel& rim = painted.at({30.1, 22.1});
  const double inner = (4 - std::hypot(0.25, 2.25)) / 4;
  const auto strength = static_cast<float>(inner * inner * (3 - 2 * inner));
  CHECK(std::abs(rim.line.x - (2 * strength - 1)) < 1e-3F);
  CHECK(rim.top == 2);
}

TEST_CASE("strokes without a way, without points and beside the page change nothing") {
  Painted painted;
  painted.add(StrokeTool::Comb, {{30, 20}});
  painted.add(StrokeTool::Comb, {{30, 20}, {30, 20}});
  for (const StrokeTool tool : {StrokeTool::Comb, StrokeTool::Mode, StrokeTool::Erase}) {
    painted.add(tool, {});
    painted.add(tool, {{-50, 20}, {-10, 90}});
    painted.add(tool, {{1e6, -1e6}});
  }
  const LayerStack before = painted.stack;
  painted.draw();
  for (std::size_t k = 0; k < before.texels.size(); ++k) REQUIRE(same(painted.stack.texels[k], before.texels[k]));
}
