#include "toolpath/path.hpp"

#include <doctest/doctest.h>

#include "geometry/closed_curves.hpp"
#include "support/about.hpp"
#include "support/scenes.hpp"

using namespace sillon;

namespace {

ClosedCurves contourOf(const Grid& grid, const std::function<double(Vec2)>& value,
                       const RunContext& run = RunContext(1)) {
  std::vector<float> values(grid.size());
  for (int y = 0; y < grid.ny; ++y) {
    for (int x = 0; x < grid.nx; ++x) values[grid.index(x, y)] = static_cast<float>(value(grid.centre(x, y)));
  }
  auto curves = contourCycles(grid, values, std::vector<float>(grid.size(), 1.0f), 0.4, run);
  REQUIRE(curves.ok());
  return std::move(curves).value();
}

const Grid kGrid{{0, 0}, 0.1, 101, 81};

double areaOf(const ClosedCurves& curves, int c) {
  double sum = 0;
  for (int k = 0; k < curves.size(c); ++k) {
    const int i = curves.begin[c] + k;
    const Vec2f a = curves.points[i];
    const Vec2f b = curves.points[nextOf(curves, c, i)];
    sum += 0.5 * static_cast<double>(cross(a, b));
  }
  return sum;
}

}  // namespace

TEST_CASE("the contour of a circle's distance is that circle, with the larger values on its left") {
  const ClosedCurves curves = contourOf(kGrid, [](Vec2 p) { return length(p - Vec2{5, 4}) - 3; });
  REQUIRE(curves.count() == 1);
  for (const Vec2f p : curves.points) CHECK(length(p - Vec2f{5, 4}) == about(3, 1e-3));
  CHECK(areaOf(curves, 0) == about(-std::numbers::pi * 9, 2e-3));  // outside is larger: clockwise
}

TEST_CASE("a node that is exactly zero counts as positive and costs no vertex twice") {
  const ClosedCurves curves =
      contourOf(kGrid, [](Vec2 p) { return std::max(std::abs(p.x - 5.05), std::abs(p.y - 4.05)) - 2; });
  REQUIRE(curves.count() == 1);
  CHECK(findCrossings(curves, RunContext(1)).empty());
}

TEST_CASE("both kinds of saddle give disjoint curves") {
  for (const double shift : {-0.02, 0.02}) {
    const ClosedCurves curves = contourOf(kGrid, [=](Vec2 p) {
      const double frame = std::min({p.x, 10.1 - p.x, p.y, 8.1 - p.y}) - 0.3;
      return std::max(-frame, std::sin(3 * p.x) * std::sin(3 * p.y) + shift);
    });
    CHECK(curves.count() > 5);
    CHECK(findCrossings(curves, RunContext(1)).empty());
  }
}

TEST_CASE("random fields give disjoint closed curves whose edges stay within one square, for any number of threads") {
  scenes::Random random(3);
  for (int k = 0; k < 20; ++k) {
    std::vector<float> values(kGrid.size(), 1.0f);
    for (int y = 1; y + 1 < kGrid.ny; ++y) {
      for (int x = 1; x + 1 < kGrid.nx; ++x) values[kGrid.index(x, y)] = static_cast<float>(random.in(-1, 1));
    }
    const std::vector<float> inside(kGrid.size(), k % 2 == 0 ? -1.0f : 1.0f);  // roots on the phase, or on the value
    const auto curves = contourCycles(kGrid, values, inside, 0.4, RunContext(1));
    REQUIRE(curves.ok());
    const ClosedCurves& c = curves.value();
    std::size_t changes = 0;
    for (int y = 0; y < kGrid.ny; ++y) {
      for (int x = 0; x < kGrid.nx; ++x) {
        const bool here = values[kGrid.index(x, y)] >= 0;
        if (x + 1 < kGrid.nx && here != (values[kGrid.index(x + 1, y)] >= 0)) ++changes;
        if (y + 1 < kGrid.ny && here != (values[kGrid.index(x, y + 1)] >= 0)) ++changes;
      }
    }
    CHECK(c.points.size() == changes);  // one vertex per edge whose ends differ, none lost
    CHECK(findCrossings(c, RunContext(2)).empty());
    for (int curve = 0; curve < c.count(); ++curve) {
      for (int i = c.begin[curve]; i < c.begin[static_cast<std::size_t>(curve) + 1]; ++i) {
        const Vec2f step = c.points[nextOf(c, curve, i)] - c.points[i];
        REQUIRE(length(step) < 0.1415f);
      }
    }
    for (const int threads : {2, 3, 8}) {
      const auto again = contourCycles(kGrid, values, inside, 0.4, RunContext(threads));
      CHECK(again.value().points == c.points);
      CHECK(again.value().begin == c.begin);
    }
  }
}

TEST_CASE("roots on the phase put a sine's zeros where they are") {
  const double wave = std::numbers::pi / 0.4;
  std::vector<float> values(kGrid.size());
  std::vector<float> distance(kGrid.size(), -1.0f);
  for (int y = 0; y < kGrid.ny; ++y) {
    for (int x = 0; x < kGrid.nx; ++x) {
      const Vec2 p = kGrid.centre(x, y);
      const bool frame = x == 0 || y == 0 || x + 1 == kGrid.nx || y + 1 == kGrid.ny;
      values[kGrid.index(x, y)] = frame ? 1.0f : static_cast<float>(std::sin(wave * (p.x - 0.033)));
      if (frame) distance[kGrid.index(x, y)] = 1;
    }
  }
  const auto curves = contourCycles(kGrid, values, distance, 0.4, RunContext(1));
  REQUIRE(curves.ok());
  for (const Vec2f p : curves.value().points) {
    if (p.y < 0.5f || p.y > 7.5f || p.x < 0.5f || p.x > 9.5f) continue;
    const double beads = (static_cast<double>(p.x) - 0.033) / 0.4;
    CHECK(std::abs(beads - std::round(beads)) < 2e-3);  // the value ratio would be off by up to 0.02
  }
}

TEST_CASE("points nearer than half a spacing leave each other along their lattice edges (Eq. 15)") {
  // Two level lines at a distance of 0.12 cross the vertical edges of columns 2 to 8 above and below row 4.
  const Grid lattice{{0, 0}, 0.1, 20, 20};
  ToolpathParams params;
  params.spacing = 0.4;
  ClosedCurves curves{{}, {0}};
  for (const float y : {0.39f, 0.51f}) {
    for (int x = 2; x < 15; ++x) curves.points.push_back({0.05f + 0.1f * static_cast<float>(x), y});
    curves.begin.push_back(static_cast<int>(curves.points.size()));
  }
  CHECK(repulsed(curves, lattice, params, RunContext(1)).points == curves.points);
  params.repulsionRounds = 1;
  const ClosedCurves once = repulsed(curves, lattice, params, RunContext(1));
  // The other line has points at across 0, 0.1 within a radius of 0.2: the edge meets their circles at 0.2 and 0.1732.
  const double mean = (0.2 + 2 * std::sqrt(0.04 - 0.01)) / 3;
  CHECK(once.points[6].x == curves.points[6].x);
  CHECK(static_cast<double>(once.points[6].y) == about(0.5 * (0.39 + 0.51 - mean), 1e-6));
  CHECK(static_cast<double>(once.points[19].y) == about(0.5 * (0.51 + 0.39 + mean), 1e-6));
  params.repulsionRounds = 100;
  for (const Vec2f p : repulsed(curves, lattice, params, RunContext(1)).points) {
    CHECK((p.y > 0.35f && p.y < 0.45f) != (p.y > 0.45f && p.y < 0.55f));
  }
}

TEST_CASE("repulsion leaves curves simple, and equal for any number of threads") {
  const ClosedCurves curves = contourOf(kGrid, [](Vec2 p) {
    const double frame = std::min({p.x, 10.1 - p.x, p.y, 8.1 - p.y}) - 0.3;
    return std::max(-frame, std::sin(12 * p.x + std::sin(3 * p.y)) + 0.6 * std::sin(4 * p.x * p.y));
  });
  ToolpathParams params;
  params.repulsionRounds = 8;
  const ClosedCurves one = repulsed(curves, kGrid, params, RunContext(1));
  CHECK(one.points != curves.points);
  CHECK(findCrossings(one, RunContext(1)).empty());
  CHECK(repulsed(curves, kGrid, params, RunContext(3)).points == one.points);
}
