#include "quality/measured_parts.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "sillon/geometry/shape.hpp"
#include "support/about.hpp"
#include "support/scenes.hpp"

using namespace sillon;

namespace {

constexpr double kSpacing = 0.4;

Cycle cycleOf(std::vector<Vec2f> points, float width) {
  Cycle cycle;
  cycle.widths.assign(points.size(), width);
  cycle.points = std::move(points);
  return cycle;
}

// Rows and back, each bead a little over the one before; the first bead of every row is one long segment.
Cycle rows(Vec2f at, int count, float size, float apart, float width) {
  std::vector<Vec2f> points;
  for (int row = 0; row < count; ++row) {
    const float y = at.y + apart * static_cast<float>(row);
    points.push_back({row % 2 == 0 ? at.x : at.x + size, y});
    for (int k = 1; k < 8 && row % 3 == 1; ++k) {
      const float share = static_cast<float>(k) / 8;
      points.push_back({at.x + size * (row % 2 == 0 ? share : 1 - share), y});
    }
    points.push_back({row % 2 == 0 ? at.x + size : at.x, y});
  }
  points.push_back({at.x - 1, points.back().y});
  points.push_back({at.x - 1, at.y});
  return cycleOf(std::move(points), width);
}

// By the definition, on samples of arc length and of area: docs/reference/metrics.md.
BeadArea byDefinition(const Toolpath& toolpath, Vec2 low, Vec2 high, double pixel) {
  const int nx = static_cast<int>((high.x - low.x) / pixel);
  const int ny = static_cast<int>((high.y - low.y) / pixel);
  struct Pass {
    int cycle = -1;
    double first = 0;
    double last = 0;
    int passes = 0;
    int total = 0;
  };
  std::vector<Pass> pixels(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny));
  const double apart = 3 * toolpath.spacing;
  std::vector<double> lengths;
  const auto close = [&](Pass& p) {
    if (p.passes > 1 && p.first + lengths[p.cycle] - p.last <= apart) --p.passes;
    p.total += p.passes;
    p.passes = 0;
  };
  for (std::size_t c = 0; c < toolpath.cycles.size(); ++c) {
    const Cycle& cycle = toolpath.cycles[c];
    double along = 0;
    for (std::size_t k = 0; k < cycle.points.size(); ++k) {
      const std::size_t next = (k + 1) % cycle.points.size();
      const Vec2f step = cycle.points[next] - cycle.points[k];
      const double size = static_cast<double>(length(step));
      const int samples = static_cast<int>(size / (0.02 * toolpath.spacing)) + 1;
      for (int s = 0; s < samples; ++s) {
        const double t = static_cast<double>(s) / samples;
        const Vec2 p{cycle.points[k].x + t * step.x, cycle.points[k].y + t * step.y};
        const double r = 0.5 * (cycle.widths[k] + t * (cycle.widths[next] - cycle.widths[k]));
        const auto index = [&](double v, int count) { return std::clamp(static_cast<int>(v / pixel), 0, count - 1); };
        for (int y = index(p.y - r - low.y, ny); y <= index(p.y + r - low.y, ny); ++y) {
          for (int x = index(p.x - r - low.x, nx); x <= index(p.x + r - low.x, nx); ++x) {
            const Vec2 centre{low.x + (x + 0.5) * pixel, low.y + (y + 0.5) * pixel};
            if (length(centre - p) > r) continue;
            Pass& at = pixels[y * nx + x];
            const double here = along + t * size;
            if (at.cycle != static_cast<int>(c)) {
              if (at.cycle >= 0) close(at);
              at.cycle = static_cast<int>(c);
              at.first = here;
              at.passes = 1;
            } else if (here - at.last > apart) {
              ++at.passes;
            }
            at.last = here;
          }
        }
      }
      along += size;
    }
    lengths.push_back(along);
  }
  BeadArea area;
  for (Pass& p : pixels) {
    if (p.cycle >= 0) close(p);
    area.covered += p.total > 0 ? 1 : 0;
    area.overlapped += p.total > 1 ? 1 : 0;
  }
  return area;
}

BeadArea counted(const Toolpath& toolpath, const Shape& shape, const Bounds& box) {
  const RunContext run(2);
  const Outline outline = resolveOutline(shape).value();
  const BorderIndex border = buildBorderIndex(outline, makeGrid(box, toolpath.spacing), run).value();
  return beadArea(toolpath, shape, border, box, run);
}

// [mm²]
struct Areas {
  double covered;
  double overlapped;
};

Areas measured(const Toolpath& toolpath, const Shape& shape, Vec2 low, Vec2 high) {
  Bounds box;
  box.add(low);
  box.add(high);
  const BeadArea area = counted(toolpath, shape, box);
  const double pixel = toolpath.spacing / 20;
  return {static_cast<double>(area.covered + area.spilled) * pixel * pixel,
          static_cast<double>(area.overlapped) * pixel * pixel};
}

}  // namespace

TEST_CASE("covered and overlapped areas are those of the definition, over many tiles and stretches") {
  const Shape shape = scenes::shapeOf({scenes::rectangle({0, 0}, {24, 24})}, {24, 24});
  Toolpath toolpath;
  toolpath.spacing = kSpacing;
  toolpath.cycles.push_back(rows({2, 2}, 14, 9, 0.33f, 0.4f));
  toolpath.cycles.push_back(rows({8.5f, 5}, 11, 11, 0.45f, 0.5f));  // over a part of the first
  std::vector<Vec2f> coil;                                          // crosses itself soon after, again and again
  for (int k = 0; k < 240; ++k) {
    const float angle = static_cast<float>(k) * 0.13f;
    coil.push_back({8 + 0.03f * static_cast<float>(k) + 0.5f * std::cos(angle), 16 + 0.5f * std::sin(angle)});
  }
  coil.push_back({15, 20});
  coil.push_back({8, 20});
  toolpath.cycles.push_back(cycleOf(coil, 0.3f));
  toolpath.cycles.back().widths[5] = 0.9f;
  const Areas areas = measured(toolpath, shape, {0, 0}, {24, 24});
  constexpr double kPixel = 0.01;
  const BeadArea reference = byDefinition(toolpath, {0, 0}, {24, 24}, kPixel);
  CHECK(areas.covered == about(static_cast<double>(reference.covered) * kPixel * kPixel, 1e-3));
  CHECK(areas.overlapped == about(static_cast<double>(reference.overlapped) * kPixel * kPixel, 1e-2));
}

TEST_CASE("a short cycle is one pass all round, and another one over it a second") {
  const Shape shape = scenes::shapeOf({scenes::rectangle({0, 0}, {10, 10})}, {10, 10});
  std::vector<Vec2f> ring;
  for (const Vec2 p : scenes::circle({5, 5}, 0.15, 24))
    ring.push_back({static_cast<float>(p.x), static_cast<float>(p.y)});
  Toolpath toolpath;
  toolpath.spacing = kSpacing;
  toolpath.cycles.push_back(cycleOf(ring, 0.4f));
  CHECK(measured(toolpath, shape, {0, 0}, {10, 10}).overlapped == 0);
  toolpath.cycles.push_back(cycleOf(ring, 0.4f));
  const double area = std::numbers::pi * 0.35 * 0.35;
  CHECK(measured(toolpath, shape, {0, 0}, {10, 10}).overlapped == about(area, 0.02));
}

TEST_CASE("a bead over the whole plate and far beyond it covers each pixel once") {
  const Shape shape = scenes::shapeOf({scenes::rectangle({0, 0}, {10, 10})}, {10, 10});
  Toolpath toolpath;
  toolpath.spacing = kSpacing;
  toolpath.cycles.push_back(cycleOf({{-500, 5}, {500, 5}, {500, 5.01f}}, 100));
  Bounds box;
  box.add({0, 0});
  box.add({10, 10});
  const BeadArea area = counted(toolpath, shape, box);
  CHECK(area.shape == about(500.0 * 500, 1e-3));
  CHECK(area.covered == area.shape);
  CHECK(area.overlapped == area.covered + area.spilled);  // there and back
}
