#include "quality/bead_area.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel_for.hpp"
#include "base/simd.hpp"
#include "sillon/geometry/grid.hpp"
#include "sillon/geometry/outline.hpp"

namespace sillon {
namespace {

constexpr int kPixelsPerSpacing = 20;
constexpr int kTile = 128;          ///< pixels; the state of one tile stays in the second-level cache
constexpr double kAreaShare = 0.8;  ///< of the time that measuring takes

// A bead from a to b, with the arc length at a along its cycle. It is the union of discs centred on its segment.
struct Bead {
  Vec2f a;
  Vec2f b;
  float ra;
  float rb;
  float along;
  float length;
  std::int32_t cycle;
};

// Positions [0, length] at which a bead covers four points of a row, or -1.
class Cover {
 public:
  explicit Cover(const Bead& bead) : bead_(bead) {
    if (bead.length <= 0) return;
    u_ = (bead.b - bead.a) * (1 / bead.length);
    slope_ = (bead.rb - bead.ra) / bead.length;
    // The disc that reaches furthest towards a point is not the nearest one where the radius changes.
    if (std::abs(slope_) < 0.99f) {
      root_ = std::sqrt(1 - slope_ * slope_);
    } else {
      shift_ = slope_ * 1e3f;
    }
  }

  [[nodiscard]] F4 at(F4 px, float py) const {
    const F4 toX = px - splat(bead_.a.x);
    const F4 toY = splat(py - bead_.a.y);
    const F4 x = toX * splat(u_.x) + toY * splat(u_.y);
    const F4 y = abs4(splat(u_.x) * toY - splat(u_.y) * toX);
    const F4 shift = root_ > 0 ? splat(slope_) * y / splat(root_) : splat(shift_);
    const F4 s = min4(max4(x + shift, splat(0)), splat(bead_.length));
    const F4 r = splat(bead_.ra) + splat(slope_) * s;
    const F4 away2 = bead_.length > 0 ? (x - s) * (x - s) + y * y : toX * toX + toY * toY;
    return select4(away2 > r * r, splat(-1), s);
  }

 private:
  const Bead& bead_;
  Vec2f u_{};
  float slope_ = 0;
  float root_ = 0;  ///< 0: `shift_` says it
  float shift_ = 0;
};

std::vector<Bead> beadsOf(const Toolpath& toolpath, std::vector<float>& lengthOfCycle) {
  std::vector<Bead> beads;
  for (std::size_t c = 0; c < toolpath.cycles.size(); ++c) {
    const Cycle& cycle = toolpath.cycles[c];
    double along = 0;
    for (std::size_t k = 0; k < cycle.points.size(); ++k) {
      const std::size_t next = k + 1 < cycle.points.size() ? k + 1 : 0;
      const float size = length(cycle.points[next] - cycle.points[k]);
      beads.push_back({cycle.points[k], cycle.points[next], 0.5f * cycle.widths[k], 0.5f * cycle.widths[next],
                       static_cast<float>(along), size, static_cast<std::int32_t>(c)});
      along += static_cast<double>(size);
    }
    lengthOfCycle.push_back(static_cast<float>(along));
  }
  return beads;
}

// How often beads pass over each pixel of a tile. Positions at most `apart` from the last one belong to the same pass,
// the end of a cycle to its beginning.
class TilePasses {
 public:
  TilePasses(const std::vector<float>& lengthOfCycle, float apart)
      : lengthOfCycle_(lengthOfCycle), apart_(apart), pixels_(kTile * kTile) {}

  void reset() { std::fill(pixels_.begin(), pixels_.end(), Pixel{}); }

  void cover(int pixel, std::int32_t cycle, float along) {
    Pixel& p = pixels_[static_cast<std::size_t>(pixel)];
    if (p.cycle != cycle) {
      close(p);
      p.cycle = cycle;
      p.first = along;
      p.passes = 1;
    } else if (along - p.last > apart_) {
      ++p.passes;
    }
    p.last = along;
  }

  int passes(int pixel) {
    Pixel& p = pixels_[static_cast<std::size_t>(pixel)];
    close(p);
    return p.total;
  }

 private:
  struct Pixel {
    std::int32_t cycle = -1;
    float first = 0;
    float last = 0;
    std::int16_t passes = 0;  ///< of the current cycle
    std::int16_t total = 0;   ///< of the cycles before
  };

  void close(Pixel& p) {
    if (p.passes > 1 && p.first + lengthOfCycle_[static_cast<std::size_t>(p.cycle)] - p.last <= apart_) --p.passes;
    p.total = static_cast<std::int16_t>(p.total + p.passes);
    p.passes = 0;
    p.cycle = -1;
  }

  const std::vector<float>& lengthOfCycle_;
  float apart_;
  std::vector<Pixel> pixels_;
};

// The raster and what lies on it: made once, read by all tiles.
struct Scene {
  Grid raster;
  int tilesAcross = 0;
  int tiles = 0;
  std::vector<float> lengthOfCycle;
  std::vector<Bead> beads;
  std::vector<std::size_t> begin;             ///< tile t has beadOf[begin[t]] .. beadOf[begin[t + 1] - 1]
  std::vector<std::int32_t> beadOf;           ///< ascending within a tile
  std::vector<std::vector<Interval>> inside;  ///< of each row
  std::vector<float> columns;                 ///< x of the pixels' centres, filled up to whole vectors
};

Grid rasterOf(const Bounds& box, double spacing) {
  const double pixel = spacing / kPixelsPerSpacing;
  // Not a whole number of pixels: drawings like round numbers, and a border through pixel centres would be a tie.
  const double margin = 2 * spacing + 0.382 * pixel;
  return {{box.min.x - margin, box.min.y - margin},
          pixel,
          static_cast<int>((box.size().x + 2 * margin) / pixel) + 1,
          static_cast<int>((box.size().y + 2 * margin) / pixel) + 1};
}

// The pixels of the box around a bead, all inclusive.
struct Reach {
  int x0, x1, y0, y1;
};

Reach reachOf(const Bead& bead, const Grid& raster) {
  const auto pixelOf = [&](double v, double origin, int count) {
    return std::clamp(static_cast<int>(std::floor((v - origin) / raster.cell)), 0, count - 1);
  };
  const double r = static_cast<double>(std::max(bead.ra, bead.rb));
  const auto [x0, x1] = std::minmax({static_cast<double>(bead.a.x), static_cast<double>(bead.b.x)});
  const auto [y0, y1] = std::minmax({static_cast<double>(bead.a.y), static_cast<double>(bead.b.y)});
  return {pixelOf(x0 - r, raster.origin.x, raster.nx), pixelOf(x1 + r, raster.origin.x, raster.nx),
          pixelOf(y0 - r, raster.origin.y, raster.ny), pixelOf(y1 + r, raster.origin.y, raster.ny)};
}

// Counting sort: within a tile the beads stay in order, as TilePasses needs them.
void sortIntoTiles(Scene& scene) {
  const auto forTiles = [&](const Bead& bead, const auto& visit) {
    const Reach r = reachOf(bead, scene.raster);
    for (int y = r.y0 / kTile; y <= r.y1 / kTile; ++y) {
      for (int x = r.x0 / kTile; x <= r.x1 / kTile; ++x) visit(static_cast<std::size_t>(y * scene.tilesAcross + x));
    }
  };
  std::vector<std::size_t>& begin = scene.begin;
  begin.assign(static_cast<std::size_t>(scene.tiles) + 1, 0);
  for (const Bead& bead : scene.beads) forTiles(bead, [&](std::size_t t) { ++begin[t + 1]; });
  for (std::size_t t = 1; t < begin.size(); ++t) begin[t] += begin[t - 1];
  scene.beadOf.resize(begin.back());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for (std::size_t k = 0; k < scene.beads.size(); ++k) {
    forTiles(scene.beads[k], [&](std::size_t t) { scene.beadOf[next[t]++] = static_cast<std::int32_t>(k); });
  }
}

Scene sceneOf(const Toolpath& toolpath, const Shape& shape, const Bounds& box) {
  Scene scene;
  scene.raster = rasterOf(box, toolpath.spacing);
  const Grid& raster = scene.raster;
  scene.tilesAcross = (raster.nx - 1) / kTile + 1;
  scene.tiles = scene.tilesAcross * ((raster.ny - 1) / kTile + 1);
  scene.beads = beadsOf(toolpath, scene.lengthOfCycle);
  sortIntoTiles(scene);
  scene.inside = insideIntervals(shape, raster.centre(0, 0).y, raster.cell, raster.ny);
  scene.columns.resize(static_cast<std::size_t>(raster.nx) + 3);
  for (int x = 0; x < raster.nx; ++x) {
    scene.columns[static_cast<std::size_t>(x)] = static_cast<float>(raster.centre(x, 0).x);
  }
  return scene;
}

// Pixels of a tile, its last row and column left out.
struct Tile {
  int left, right, bottom, top;

  [[nodiscard]] int pixel(int x, int y) const { return (y - bottom) * kTile + x - left; }
};

Tile tileAt(const Scene& scene, int tile) {
  const int left = tile % scene.tilesAcross * kTile;
  const int bottom = tile / scene.tilesAcross * kTile;
  return {left, std::min(left + kTile, scene.raster.nx), bottom, std::min(bottom + kTile, scene.raster.ny)};
}

void lay(const Scene& scene, const Bead& bead, const Tile& tile, TilePasses& passes) {
  const Reach r = reachOf(bead, scene.raster);
  const Cover cover(bead);
  const int right = std::min(r.x1 + 1, tile.right);
  for (int y = std::max(r.y0, tile.bottom); y < std::min(r.y1 + 1, tile.top); ++y) {
    const float py = static_cast<float>(scene.raster.centre(0, y).y);
    for (int x = std::max(r.x0, tile.left); x < right; x += 4) {
      const F4 s = cover.at(load4(&scene.columns[static_cast<std::size_t>(x)]), py);
      for (int k = 0; k < 4 && x + k < right; ++k) {
        if (s[k] >= 0) passes.cover(tile.pixel(x + k, y), bead.cycle, bead.along + s[k]);
      }
    }
  }
}

BeadArea countTile(const Scene& scene, const Tile& tile, TilePasses& passes) {
  BeadArea count;
  for (int y = tile.bottom; y < tile.top; ++y) {
    const std::vector<Interval>& row = scene.inside[static_cast<std::size_t>(y)];
    std::size_t interval = 0;
    for (int x = tile.left; x < tile.right; ++x) {
      const double px = scene.raster.centre(x, y).x;
      while (interval < row.size() && row[interval].end < px) ++interval;
      const bool in = interval < row.size() && row[interval].begin <= px;
      const int n = passes.passes(tile.pixel(x, y));
      count.shape += in ? 1 : 0;
      count.covered += in && n > 0 ? 1 : 0;
      count.spilled += !in && n > 0 ? 1 : 0;
      count.overlapped += n > 1 ? 1 : 0;
    }
  }
  return count;
}

}  // namespace

BeadArea beadArea(const Toolpath& toolpath, const Shape& shape, const Bounds& box, const RunContext& run) {
  const Scene scene = sceneOf(toolpath, shape, box);
  std::vector<BeadArea> counts(static_cast<std::size_t>(scene.tiles));
  const auto countTiles = [&](int firstTile, int lastTile) {
    TilePasses passes(scene.lengthOfCycle, static_cast<float>(3 * toolpath.spacing));
    for (int t = firstTile; t < lastTile && !run.cancelled(); ++t) {
      passes.reset();
      const Tile tile = tileAt(scene, t);
      const std::size_t end = scene.begin[static_cast<std::size_t>(t) + 1];
      for (std::size_t at = scene.begin[static_cast<std::size_t>(t)]; at < end; ++at) {
        lay(scene, scene.beads[static_cast<std::size_t>(scene.beadOf[at])], tile, passes);
      }
      counts[static_cast<std::size_t>(t)] = countTile(scene, tile, passes);
    }
  };
  const int step = (scene.tiles - 1) / 24 + 1;  // between reports of progress
  for (int done = 0; done < scene.tiles && !run.cancelled(); done += step) {
    const int count = std::min(step, scene.tiles - done);
    parallelFor(run, count, std::max(1, count / (4 * run.threads())),
                [&](int first, int last) { countTiles(done + first, done + last); });
    run.report(kAreaShare * std::min(done + step, scene.tiles) / scene.tiles);
  }
  BeadArea total;
  for (const BeadArea& count : counts) {
    total.covered += count.covered;
    total.spilled += count.spilled;
    total.overlapped += count.overlapped;
    total.shape += count.shape;
  }
  return total;
}

}  // namespace sillon
