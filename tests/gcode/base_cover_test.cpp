// What base layers cover of drawings whose shapes touch, overlap or all but do.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "gcode/job.hpp"
#include "geometry/outline.hpp"
#include "geometry/shape_points.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "support/about.hpp"
#include "support/scenes.hpp"

using namespace sillon;
using scenes::circle;
using scenes::Random;
using scenes::rectangle;

namespace {

constexpr double kWidth = 0.4;     // of beads
constexpr double kCell = 0.05;     // of the raster
constexpr double kNarrow = 0.25;   // half a line, and a fourth as lines keep off slanting borders by more
constexpr Vec2 kPlace{20, 20};     // of the plate on the bed
constexpr double kMargin = 1.019;  // of the raster round the page: no border runs through centres of cells

// Cells over a page.
struct Cells {
  int columns, rows;
  std::vector<char> set;

  explicit Cells(Vec2 page)
      : columns(static_cast<int>((page.x + 2 * kMargin) / kCell)),
        rows(static_cast<int>((page.y + 2 * kMargin) / kCell)),
        set(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0) {}

  [[nodiscard]] char& at(int x, int y) {
    return set[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x)];
  }
  [[nodiscard]] Vec2 centre(int x, int y) const { return {(x + 0.5) * kCell - kMargin, (y + 0.5) * kCell - kMargin}; }
  [[nodiscard]] double area() const {
    return kCell * kCell * static_cast<double>(std::count(set.begin(), set.end(), 1));
  }

  // What lies within `radius` of the line from a to b.
  void draw(Vec2 a, Vec2 b, double radius) {
    const auto cell = [](double v) { return static_cast<int>(std::floor((v + kMargin) / kCell)); };
    for (int y = std::max(0, cell(std::min(a.y, b.y) - radius));
         y <= std::min(rows - 1, cell(std::max(a.y, b.y) + radius)); ++y) {
      for (int x = std::max(0, cell(std::min(a.x, b.x) - radius));
           x <= std::min(columns - 1, cell(std::max(a.x, b.x) + radius)); ++x) {
        const Vec2 p = centre(x, y) - a;
        const Vec2 along = b - a;
        const double t = std::clamp(dot(p, along) / dot(along, along), 0.0, 1.0);
        if (length(p - t * along) <= radius) at(x, y) = 1;
      }
    }
  }
};

// The share of `whole` that is in `part` too.
double shareOf(const Cells& whole, const Cells& part) {
  double all = 0;
  double both = 0;
  for (std::size_t k = 0; k < whole.set.size(); ++k) {
    all += whole.set[k];
    both += whole.set[k] & part.set[k];
  }
  return all > 0 ? both / all : 1;
}

Cells insideOf(const Shape& shape) {
  Cells cells(shape.page);
  const auto rows = insideIntervals(shape, cells.centre(0, 0).y, kCell, cells.rows);
  for (int y = 0; y < cells.rows; ++y) {
    for (int x = 0; x < cells.columns; ++x) {
      for (const Interval& piece : rows[y]) {
        if (piece.begin <= cells.centre(x, y).x && cells.centre(x, y).x <= piece.end) cells.at(x, y) = 1;
      }
    }
  }
  return cells;
}

// All cells within `radius` of a set one.
Cells grown(Cells cells, double radius) {
  Cells out = cells;
  const int reach = static_cast<int>(radius / kCell);
  for (int y = 0; y < cells.rows; ++y) {
    for (int x = 0; x < cells.columns; ++x) {
      if (cells.at(x, y) == 0) continue;
      const bool within = x > 0 && y > 0 && x + 1 < cells.columns && y + 1 < cells.rows && cells.at(x - 1, y) != 0 &&
                          cells.at(x + 1, y) != 0 && cells.at(x, y - 1) != 0 && cells.at(x, y + 1) != 0;
      if (within) continue;
      for (int v = -reach; v <= reach; ++v) {
        for (int u = -reach; u <= reach; ++u) {
          const bool on = x + u >= 0 && y + v >= 0 && x + u < cells.columns && y + v < cells.rows;
          if (on && std::hypot(u, v) * kCell <= radius) out.at(x + u, y + v) = 1;
        }
      }
    }
  }
  return out;
}

// Where a disc of this radius fits.
Cells opened(Cells cells, double radius) {
  const auto inverted = [](Cells some) {
    for (char& cell : some.set) cell = cell == 0 ? 1 : 0;
    return some;
  };
  return grown(inverted(grown(inverted(std::move(cells)), radius)), radius - kCell);
}

Cells coverOf(const std::vector<BeadPath>& paths, Vec2 page, double radius) {
  Cells cells(page);
  for (const BeadPath& path : paths) {
    for (std::size_t i = 0; i + (path.closed ? 0 : 1) < path.points.size(); ++i) {
      const PointUm to = path.points[i + 1 < path.points.size() ? i + 1 : 0];
      cells.draw(wide(path.points[i]) * 0.001 - kPlace, wide(to) * 0.001 - kPlace, radius);
    }
  }
  return cells;
}

void turn(Shape& shape, double angle) {
  const Vec2 middle = shape.page * 0.5;
  movePoints(shape, [&](Vec2 p) {
    const Vec2 d = p - middle;
    p = middle + Vec2{std::cos(angle) * d.x - std::sin(angle) * d.y, std::sin(angle) * d.x + std::cos(angle) * d.y};
    return Vec2{std::round(p.x * 1e6) / 1e6, std::round(p.y * 1e6) / 1e6};  // as drawings are read
  });
}

// Many small solids, each a path of its own, that meet in one way or another.
Shape drawing(Random& random, std::string& name) {
  const Vec2 page{14, 14};
  Shape shape{{}, page};
  const auto add = [&](Vec2 low, Vec2 high) { shape.paths.push_back({{rectangle(low, high)}, FillRule::NonZero}); };
  const double hair[] = {0, 1e-6, -1e-6};
  const double gap = hair[random.index(3)];
  switch (random.index(6)) {
    case 0: {
      name = "columns";
      double x = 2;
      while (x < 11) {
        const double next = std::min(12.0, x + random.in(0.7, 4));
        add({x, 2}, {next - gap, 12});
        x = next;
      }
      break;
    }
    case 1: {
      name = "mosaic";
      const int count = 3 + random.index(8);
      const double cell = 10.0 / count;
      for (int y = 0; y < count; ++y) {
        for (int x = 0; x < count; ++x)
          add({2 + x * cell, 2 + y * cell}, {2 + (x + 1) * cell - gap, 2 + (y + 1) * cell - gap});
      }
      break;
    }
    case 2: {
      name = "modules";
      for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 8; ++x) {
          if (random.index(3) != 0) add({2 + 1.25 * x, 2 + 1.25 * y}, {3.25 + 1.25 * x, 3.25 + 1.25 * y});
        }
      }
      break;
    }
    case 3: {
      name = "corners";
      for (int y = 0; y < 4; ++y) {
        for (int x = y % 2; x < 4; x += 2) add({2 + 2.5 * x, 2 + 2.5 * y}, {4.5 + 2.5 * x, 4.5 + 2.5 * y});
      }
      break;
    }
    case 4: {
      name = "overlaps";
      for (int k = 0; k < 12; ++k) {
        const double x = random.in(2, 8);
        const double y = random.in(2, 8);
        const double width = random.in(1, 4);
        const double height = random.in(1, 4);
        add({x, y}, {x + width, y + height});
      }
      break;
    }
    default: {
      name = "rings";
      double outer = 5;
      while (outer > 0.5) {  // one in the other
        const double inner = std::max(0.0, outer - random.in(0.6, 2));
        std::vector<Ring> rings{circle(page * 0.5, outer, 60)};
        if (inner > 0.5) rings.push_back(circle(page * 0.5, inner, 60));
        shape.paths.push_back({rings, FillRule::EvenOdd});
        outer = inner;
      }
    }
  }
  if (random.index(2) == 0) {
    const double angles[] = {0.25 * std::numbers::pi, 0.2, 1.1};
    turn(shape, angles[random.index(3)]);
  }
  return shape;
}

GcodeJob jobOf(const Shape& shape, const Toolpath& face, const PrintParams& params) {
  Result<GcodeJob> job = prepareGcodeJob(face, nullptr, shape, Printer{}, params);
  REQUIRE_MESSAGE(job.ok(), job.error().message);
  return std::move(job).value();
}

const NamedValue* toldCover(const GcodeJob& job) {
  for (const Warning& warning : job.warnings) {
    if (warning.code == WarningCode::BaseTooThin) return warning.value("percent");
  }
  return nullptr;
}

PrintParams placed() {
  PrintParams params;
  params.place = kPlace;
  return params;
}

}  // namespace

TEST_CASE("base layers lie below all of the face, but for places too narrow for their lines, and say how much") {
  Random random(20);
  int told = 0;
  for (int round = 0; round < 40; ++round) {
    std::string name;
    const Shape shape = drawing(random, name);
    CAPTURE(round);
    CAPTURE(name);
    PrintParams params = placed();
    params.base = 3;
    params.basePattern = round % 4 == 3 ? BasePattern::Concentric : BasePattern::Hatched;
    params.basePerimeters = round % 3;
    if (round % 2 == 0) params.elephantFoot = 0;
    ToolpathParams path;
    path.spacing = kWidth;
    const auto face = generateToolpath(scenes::plate(shape, scenes::waves()), path, RunContext(1));
    REQUIRE(face.ok());
    const GcodeJob job = jobOf(shape, face.value().toolpath, params);

    const Cells inside = insideOf(shape);
    Cells shown = coverOf(job.cycles, shape.page, kWidth / 2);
    for (std::size_t k = 0; k < shown.set.size(); ++k) shown.set[k] &= inside.set[k];
    double least = 1;
    const auto check = [&](const std::vector<BeadPath>& layer, double inset) {
      const Cells cover = coverOf(layer, shape.page, kWidth / 2 + kCell / 2 + inset);
      least = std::min(least, shareOf(inside, cover));
      Cells bare = shown;
      for (std::size_t k = 0; k < bare.set.size(); ++k) bare.set[k] = shown.set[k] > cover.set[k] ? 1 : 0;
      CHECK(opened(bare, kNarrow).area() == 0);
    };
    for (const std::vector<BeadPath>& layer : job.bases) check(layer, 0);
    if (params.elephantFoot > 0) check(job.firstBase, params.elephantFoot);
    const NamedValue* percent = toldCover(job);
    CAPTURE(least);
    if (percent == nullptr) {
      CHECK(least > 0.97);
    } else {
      CHECK(std::abs(percent->number - 100 * least) < 1);
      ++told;
    }
  }
  CHECK(told > 2);
  CHECK(told < 30);
}
