// Beads that are turned towards the lines asked for.
#include "toolpath/relaxation_steps.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "geometry/closed_curves.hpp"

using namespace sillon;

namespace {

constexpr double kSpacing = 0.4;
constexpr float kStep = 0.1f;
constexpr int kRow = 401;  // points of a row

/// Beads at `angle`(x) [rad].
template <class Angle>
LineField linesAlong(const Angle& angle) {
  LineField lines;
  lines.grid = {{-5, -5}, kSpacing / 2, 300, 100};
  for (std::size_t k = 0; k < lines.grid.size(); ++k) {
    const double at = angle(lines.grid.centre(static_cast<int>(k % 300), 0).x);
    lines.direction.push_back({static_cast<float>(-std::sin(at)), static_cast<float>(std::cos(at))});
  }
  lines.fixed.assign(lines.grid.size(), 1);
  return lines;
}

LineField linesAt(double angle) {
  return linesAlong([angle](double) { return angle; });
}

/// A row from (0, 0) to the right, `height` above the axis, and straight back 4 mm above it.
template <class Height>
ClosedCurves loopWith(const Height& height) {
  ClosedCurves curves;
  for (int k = 0; k < kRow; ++k) curves.points.push_back({static_cast<float>(k) * kStep, height(k)});
  for (int k = 1; k < 40; ++k) curves.points.push_back({(kRow - 1) * kStep, static_cast<float>(k) * kStep});
  for (int k = kRow - 1; k >= 0; --k) curves.points.push_back({static_cast<float>(k) * kStep, 4});
  for (int k = 39; k > 0; --k) curves.points.push_back({0, static_cast<float>(k) * kStep});
  curves.begin = {0, static_cast<int>(curves.points.size())};
  return curves;
}

}  // namespace

TEST_CASE("a path that runs as asked stays, and so do its U-turns") {
  const ClosedCurves curves = loopWith([](int) { return 0.0f; });
  for (const Vec2f move : movesToLines(curves, linesAt(0), kSpacing, 0.003f, RunContext(1))) {
    CHECK(std::abs(move.x) < 1e-6f);
    CHECK(std::abs(move.y) < 1e-6f);
  }
}

TEST_CASE("waves of a bead are damped by 1 / (1 + pull / (2 - 2 cos of a step's phase))") {
  constexpr double kPeriod = 25, kPull = 0.003;  // points per wave
  const auto height = [](int k) { return 0.02f * static_cast<float>(std::sin(2 * 3.14159265358979 * k / kPeriod)); };
  const ClosedCurves curves = loopWith(height);
  const std::vector<Vec2f> moves = movesToLines(curves, linesAt(0), kSpacing, 0.003f, RunContext(1));
  const double stiff = 2 - 2 * std::cos(2 * 3.14159265358979 / kPeriod);
  for (int k = 150; k < 250; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double left = static_cast<double>(height(k) + moves[i].y);
    CHECK(std::abs(left - static_cast<double>(height(k)) * kPull / (kPull + stiff)) < 5e-4);
  }
}

TEST_CASE("no point moves further than half a spacing, and lines across change nothing") {
  const ClosedCurves curves = loopWith([](int) { return 0.0f; });
  const LineField hilly = linesAlong([](double x) { return 0.5 * std::sin(x * 0.4); });
  bool moved = false;
  for (const Vec2f move : movesToLines(curves, hilly, kSpacing, 0.003f, RunContext(2))) {
    CHECK(length(move) <= 0.5f * static_cast<float>(kSpacing) + 1e-6f);
    moved = moved || length(move) > 0.1f;
  }
  CHECK(moved);
  const std::vector<Vec2f> across = movesToLines(curves, linesAt(1), kSpacing, 0.003f, RunContext(2));
  CHECK(across[200] == Vec2f{});
}

TEST_CASE("the moves are the same for any number of threads") {
  const ClosedCurves curves = loopWith([](int k) { return k % 7 == 0 ? 0.02f : 0.0f; });
  CHECK(movesToLines(curves, linesAt(0.1), kSpacing, 0.003f, RunContext(1)) ==
        movesToLines(curves, linesAt(0.1), kSpacing, 0.003f, RunContext(3)));
}
