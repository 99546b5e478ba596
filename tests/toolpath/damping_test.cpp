#include "toolpath/relaxation_steps.hpp"

#include <doctest/doctest.h>

#include <vector>

using namespace sillon;

namespace {

/// Curves of so many points each; where these lie does not count.
ClosedCurves curvesOf(const std::vector<int>& sizes) {
  ClosedCurves curves;
  curves.begin.push_back(0);
  for (const int size : sizes) curves.begin.push_back(curves.begin.back() + size);
  curves.points.resize(static_cast<std::size_t>(curves.begin.back()));
  return curves;
}

/// Shares of 1 that are `factor` at these points.
std::vector<float> onesBut(int count, const std::vector<int>& points, float factor) {
  std::vector<float> share(static_cast<std::size_t>(count), 1.0f);
  for (const int point : points) share[point] = factor;
  return share;
}

}  // namespace

TEST_CASE("shares fall within reach of both sides of a crossing, at the same part of the way round, and nowhere else") {
  const ClosedCurves before = curvesOf({20, 40});
  const ClosedCurves after = curvesOf({10, 80});  // of other steps
  std::vector<float> share(60, 1.0f);
  // 2 of 10 is 4 of 20, half-way round the second is 20 of 40.
  damp(before, after, {{2, 10 + 40}}, 2, 0.5f, share);
  CHECK(share == onesBut(60, {2, 3, 4, 5, 6, 38, 39, 40, 41, 42}, 0.5f));
  damp(before, after, {{2, 10 + 40}}, 0, 0.5f, share);
  CHECK(share[4] == 0.25f);
  CHECK(share[40] == 0.25f);
  CHECK(share[5] == 0.5f);
}

TEST_CASE("the reach goes on past a curve's first and last point, and never over another curve") {
  const ClosedCurves curves = curvesOf({10, 12, 10});
  std::vector<float> share(32, 1.0f);
  damp(curves, curves, {{10, 10}}, 3, 0.5f, share);
  CHECK(share == onesBut(32, {19, 20, 21, 10, 11, 12, 13}, 0.5f));
  share.assign(32, 1.0f);
  damp(curves, curves, {{21, 21}}, 2, 0.0f, share);
  CHECK(share == onesBut(32, {19, 20, 21, 10, 11}, 0.0f));
  share.assign(32, 1.0f);
  damp(curves, curves, {{31, 0}}, 1, 0.0f, share);
  CHECK(share == onesBut(32, {30, 31, 22, 9, 0, 1}, 0.0f));
  // As far as half-way round, however long the reach.
  share.assign(32, 1.0f);
  damp(curves, curves, {{15, 15}}, 1000, 0.5f, share);
  std::vector<int> second;
  for (int k = 10; k < 22; ++k) second.push_back(k);
  CHECK(share == onesBut(32, second, 0.5f));
}

TEST_CASE("where crossings lie close to each other a share falls once; without any none does") {
  const ClosedCurves curves = curvesOf({30});
  std::vector<float> share(30, 0.5f);
  damp(curves, curves, {{10, 11}, {11, 12}}, 1, 0.5f, share);
  for (int k = 0; k < 30; ++k) CHECK(share[k] == (k >= 9 && k <= 13 ? 0.25f : 0.5f));
  damp(curves, curves, {}, 5, 0.0f, share);
  CHECK(share[10] == 0.25f);
  CHECK(share[0] == 0.5f);
}
