#include "toolpath/eight_points.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "geometry/closed_curves.hpp"
#include "sillon/toolpath/bead_width.hpp"
#include "support/scenes.hpp"

using namespace sillon;

namespace {

constexpr float kSpacing = 0.4f;

// Squares in each other round the middle of a page of 40 x 40 mm, turned by `angle`, with points tau/4 apart, and
// `apart` from each other but for `unevenness` [mm]. Even ones have many neighbours at the same distance.
ClosedCurves nestedLoops(double angle, double apart, double unevenness, scenes::Random& random) {
  std::vector<std::vector<Vec2f>> loops;
  for (double side = 1; side < 19; side += apart) {
    std::vector<Vec2f> loop;
    const int steps = static_cast<int>(4 * side / static_cast<double>(kSpacing));  // of half a side
    for (int s = 0; s < 8 * steps; ++s) {
      const double along = -side + 2 * side * (s % (2 * steps)) / (2 * steps);
      const double across = side + random.in(-unevenness, unevenness);
      const double turn = angle + 0.5 * std::numbers::pi * (s / (2 * steps));
      loop.push_back({static_cast<float>(20 + across * std::cos(turn) - along * std::sin(turn)),
                      static_cast<float>(20 + across * std::sin(turn) + along * std::cos(turn))});
    }
    loops.push_back(std::move(loop));
  }
  return scenes::closed(loops);
}

struct Made {
  BeadGaps gaps;
  BeadWidths widths;
};

Made madeOf(const ClosedCurves& curves, const BorderIndex& border, const ToolpathParams& params, bool eight) {
  eightAtOnce = eight;
  Made made;
  made.gaps = beadGaps(curves, border, params.spacing, 1.5f * kSpacing, RunContext(1));
  made.widths = beadWidths(curves, made.gaps, border, params, RunContext(1)).value();
  return made;
}

}  // namespace

TEST_CASE("room and widths of points taken eight at once are those of points taken alone, to the last bit") {
  if (!eightAtOnce) {
    MESSAGE("skipped: this processor, or this program, has no AVX2");
    return;
  }
  const Shape shape = scenes::shapeOf({scenes::rectangle({0, 0}, {40, 40})}, {40, 40});
  const Outline outline = resolveOutline(shape).value();
  const BorderIndex border = buildBorderIndex(outline, makeGrid(outline.bounds, 0.4), RunContext(1)).value();
  scenes::Random random(5);
  ToolpathParams params;
  params.spacing = static_cast<double>(kSpacing);
  for (int k = 0; k < 80; ++k) {
    CAPTURE(k);
    const double unevenness = std::vector<double>{0, 0.01, 0.1, 0.3}[static_cast<std::size_t>(k % 4)];
    const double angle = k == 0 ? 0 : unevenness > 0 ? random.in(0, 2) : 0.1 * random.index(3);
    const double apart = params.spacing * (k % 8 == 0 ? 1 : random.in(0.8, 1.6));
    params.beadOverlap = random.in(0, 0.01);
    const ClosedCurves curves = nestedLoops(angle, apart, unevenness, random);
    const Made together = madeOf(curves, border, params, true);
    const Made alone = madeOf(curves, border, params, false);
    eightAtOnce = true;
    CHECK(together.gaps.left == alone.gaps.left);
    CHECK(together.gaps.right == alone.gaps.right);
    CHECK(together.gaps.tight == alone.gaps.tight);
    CHECK(together.widths.width == alone.widths.width);
    CHECK(together.widths.limit == alone.widths.limit);
  }
}

#if defined(SILLON_AVX2)
TEST_CASE(
    "a point is left to the search from it alone where two are as near, or what is nearest lies out of its reach") {
  if (!eightAtOnce) {
    MESSAGE("skipped: this processor has no AVX2");
    return;
  }
  EightPoints points{};
  EightBeads beads{};
  for (int l = 0; l < kEight; ++l) {
    points.tangentX[l] = 1;
    points.id[l] = l;
    beads.half[l] = 0.2f;
    beads.reach2[l] = 0.01f * static_cast<float>(l * l);  // 0 to 0.7 mm
  }
  // Beads 0.4 mm wide, the nearest 0.55 mm aside of the eight points at the origin.
  const auto sharesBeside = [&](Vec2f second) {
    const float x[] = {0, second.x};
    const float y[] = {0.55f, second.y};
    const std::int32_t id[] = {100, 200};
    const float half[] = {0.2f, 0.2f};
    const std::int32_t begin = 0;
    const std::int32_t end = 2;
    return sharesOfEight({x, y, id}, half, {&begin, &end, 0, 1}, points, beads, 0, 4, 50);
  };
  const EightShares farther = sharesBeside({0, -0.6f});
  const EightShares tie = sharesBeside({0, -0.55f});
  for (int l = 0; l < kEight; ++l) {
    CAPTURE(l);
    CHECK(farther.beside[l] == 100);
    CHECK(std::sqrt(farther.factor2[l]) == doctest::Approx(0.55 / 0.4));
    CHECK((farther.unsure[l] != 0) == (l < 6));
    CHECK(tie.unsure[l] != 0);
  }
}
#endif
