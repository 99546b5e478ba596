#include "quality/measured_parts.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

#include "base/capsule_rows.hpp"
#include "base/parallel_for.hpp"
#include "base/simd.hpp"
#include "geometry/outline.hpp"

namespace sillon {
namespace {

constexpr int kPixelsPerSpacing = 20;
constexpr int kTileWidth = 128;     ///< pixels: two words
constexpr int kTileHeight = 256;    ///< pixels; the data of one tile stays in the second-level cache
constexpr double kApart = 3;        ///< [tau] along a cycle; places further apart belong to two passes
constexpr int kNear = 2;            ///< stretches before one that belong to its pass; 2 to 3 of them make kApart
constexpr double kAreaShare = 0.8;  ///< share of the time of measuring
constexpr float kRounding = 1e-3f;  ///< rounding of a toolpath's numbers [mm]

// RowBits are the pixels of one row of a tile, one bit each.
using RowBits = U2;

bool any(RowBits row) { return (row[0] | row[1]) != 0; }
int countOf(RowBits row) { return any(row) ? std::popcount(row[0]) + std::popcount(row[1]) : 0; }

// Masks of the first n pixels, for n from 0 to all of them.
alignas(RowBits) constexpr std::array<std::array<std::uint64_t, 2>, kTileWidth + 1> kFirst = [] {
  std::array<std::array<std::uint64_t, 2>, kTileWidth + 1> first{};
  for (std::size_t n = 1; n < first.size(); ++n) {
    first[n] = first[n - 1];
    first[n][n <= 64 ? 0 : 1] |= std::uint64_t{1} << ((n - 1) % 64);
  }
  return first;
}();

RowBits firstPixels(int n) {
  RowBits row;
  std::memcpy(&row, &kFirst[n], sizeof row);
  return row;
}

RowBits rowOf(int begin, int end) { return firstPixels(end) & ~firstPixels(begin); }

// A bead from a to b, as the union of discs centred on its segment; `along` is the arc length of a on its cycle [mm].
struct MeasuredBead {
  Vec2f a;
  Vec2f b;
  float ra;
  float rb;
  float along;
  float length;
  std::int32_t cycle;
};

// Stretches of a cycle, of equal length: about kApart / (kNear + 1/2).
struct Stretches {
  int count = 1;
  float perMm = 0;
};

// The raster and the beads and shape on it; made once, read by all tiles.
struct TiledBeads {
  Grid raster;
  double perMm = 0;  ///< pixels per mm
  int tilesAcross = 0;
  int tiles = 0;
  float pieceLength = 0;               ///< longest piece of a bead that is laid at once [mm]
  std::vector<Stretches> stretchesOf;  ///< stretches of each cycle
  std::vector<MeasuredBead> beads;
  std::vector<std::size_t> begin;             ///< tile t has beadOf[begin[t]] .. beadOf[begin[t + 1] - 1]
  std::vector<std::int32_t> beadOf;           ///< indices of beads, ascending within a tile
  std::vector<std::vector<Interval>> inside;  ///< intervals of each row inside the shape
};

// Adds the beads of all cycles and cuts each cycle into stretches.
void addBeads(const Toolpath& toolpath, TiledBeads& laid) {
  const double stretch = kApart * toolpath.spacing / (kNear + 0.5);
  laid.pieceLength = static_cast<float>(stretch);
  for (std::size_t c = 0; c < toolpath.cycles.size(); ++c) {
    const Cycle& cycle = toolpath.cycles[c];
    double along = 0;
    for (std::size_t k = 0; k < cycle.points.size(); ++k) {
      const std::size_t next = k + 1 < cycle.points.size() ? k + 1 : 0;
      const float size = length(cycle.points[next] - cycle.points[k]);
      laid.beads.push_back({cycle.points[k], cycle.points[next], 0.5f * cycle.widths[k], 0.5f * cycle.widths[next],
                            static_cast<float>(along), size, static_cast<std::int32_t>(c)});
      along += static_cast<double>(size);
    }
    const double count = std::clamp(std::round(along / stretch), 1.0, 1e9);
    laid.stretchesOf.push_back({static_cast<int>(count), along > 0 ? static_cast<float>(count / along) : 0});
  }
}

// Makes the raster around a box.
Grid rasterOf(const Bounds& box, double spacing) {
  const double pixel = spacing / kPixelsPerSpacing;
  // The margin is not a whole number of pixels, because drawings like round numbers, and a border through pixel centres
  // would leave a tie.
  const double margin = 2 * spacing + 0.382 * pixel;
  return {{box.min.x - margin, box.min.y - margin},
          pixel,
          static_cast<int>((box.size().x + 2 * margin) / pixel) + 1,
          static_cast<int>((box.size().y + 2 * margin) / pixel) + 1};
}

// Range of the tiles that the box around a bead touches, both ends included.
struct Reach {
  int x0;
  int x1;
  int y0;
  int y1;
};

// Finds the tiles that a bead may touch.
Reach reachOf(const MeasuredBead& bead, const TiledBeads& laid) {
  const Grid& raster = laid.raster;
  const auto tileOf = [&](double v, double origin, int count, int size) {
    return static_cast<int>(std::clamp((v - origin) * laid.perMm, 0.0, static_cast<double>(count - 1))) / size;
  };
  const double r = static_cast<double>(std::max(bead.ra, bead.rb));
  const auto [x0, x1] = std::minmax({static_cast<double>(bead.a.x), static_cast<double>(bead.b.x)});
  const auto [y0, y1] = std::minmax({static_cast<double>(bead.a.y), static_cast<double>(bead.b.y)});
  return {
      tileOf(x0 - r, raster.origin.x, raster.nx, kTileWidth), tileOf(x1 + r, raster.origin.x, raster.nx, kTileWidth),
      tileOf(y0 - r, raster.origin.y, raster.ny, kTileHeight), tileOf(y1 + r, raster.origin.y, raster.ny, kTileHeight)};
}

// Sorts beads into tiles by a counting sort, which keeps them in order within a tile, as TilePasses needs.
void sortIntoTiles(TiledBeads& laid) {
  const auto forTiles = [&](const MeasuredBead& bead, const auto& visit) {
    const Reach r = reachOf(bead, laid);
    for (int y = r.y0; y <= r.y1; ++y) {
      for (int x = r.x0; x <= r.x1; ++x) visit(y * laid.tilesAcross + x);
    }
  };
  std::vector<std::size_t>& begin = laid.begin;
  begin.assign(laid.tiles + 1, 0);
  for (const MeasuredBead& bead : laid.beads) forTiles(bead, [&](std::size_t t) { ++begin[t + 1]; });
  for (std::size_t t = 1; t < begin.size(); ++t) begin[t] += begin[t - 1];
  laid.beadOf.resize(begin.back());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for (std::size_t k = 0; k < laid.beads.size(); ++k) {
    forTiles(laid.beads[k], [&](std::size_t t) { laid.beadOf[next[t]++] = static_cast<std::int32_t>(k); });
  }
}

// Makes the raster, with beads and shape.
TiledBeads tiledBeadsOf(const Toolpath& toolpath, const Shape& shape, const Bounds& box) {
  TiledBeads laid;
  laid.raster = rasterOf(box, toolpath.spacing);
  const Grid& raster = laid.raster;
  laid.perMm = 1 / raster.cell;
  laid.tilesAcross = (raster.nx - 1) / kTileWidth + 1;
  laid.tiles = laid.tilesAcross * ((raster.ny - 1) / kTileHeight + 1);
  addBeads(toolpath, laid);
  sortIntoTiles(laid);
  laid.inside = insideIntervals(shape, raster.centre(0, 0).y, raster.cell, raster.ny);
  return laid;
}

// The pixels of a tile that are passed over, and those passed over more than once. Positions at most kApart apart along
// a cycle belong to the same pass, also across its seam. Passes are told apart by whole stretches, each with a mask of
// its own.
class TilePasses {
 public:
  void lay(const Capsule& piece, std::int32_t cycle, int stretch, const Stretches& stretches) {
    if (cycle != cycle_) {
      close();
      coverAll();
      cycle_ = cycle;
      used_ = 0;
    } else if (stretch != masks_[current_].stretch) {
      close();
    }
    if (!open_) open(stretch, stretches.count);
    Mask& mask = masks_[current_];
    const int begin = piece.firstRow(kTileHeight);
    const int end = piece.endRow(kTileHeight);
    PixelRuns runs;
    for (int y = begin; y < end; y += PixelRuns::kMostRows) {
      const int count = std::min(PixelRuns::kMostRows, end - y);
      pixelsOf(piece, y, count, kTileWidth, runs);
      for (int k = 0; k < count; ++k) {
        RowBits& row = mask.rows[y + k];
        row = row | rowOf(runs.begin[k], runs.end[k]);
      }
    }
    mask.begin = std::min(mask.begin, begin);
    mask.end = std::max(mask.end, end);
  }

  // Counts the pixels on the first `rows` rows and `columns` columns, and clears the tile.
  template <class InsideRow, class SpilledOf>
  BeadArea take(int rows, int columns, const InsideRow& insideRow, const SpilledOf& spilledOf) {
    close();
    coverAll();
    used_ = 0;
    cycle_ = -1;
    BeadArea count;
    for (int y = 0; y < rows; ++y) {
      const RowBits tile = rowOf(0, columns);
      const RowBits in = insideRow(y) & tile;
      const RowBits covered = covered_[y] & tile;
      count.shape += countOf(in);
      count.covered += countOf(covered & in);
      count.spilled += spilledOf(y, covered & ~in);
      count.overlapped += countOf(again_[y] & tile);
    }
    covered_.fill(RowBits{});
    again_.fill(RowBits{});
    return count;
  }

 private:
  struct Mask {
    int stretch = 0;
    int begin = kTileHeight;  ///< range of rows that may hold pixels
    int end = 0;
    bool covers = false;  ///< covered_ contains this mask
    std::array<RowBits, kTileHeight> rows{};

    void clear() {
      std::fill(rows.begin() + begin, rows.begin() + std::max(begin, end), RowBits{});
      begin = kTileHeight;
      end = 0;
      covers = false;
    }
  };

  // A mask is added to covered_ only when it is no longer near the current stretch, because near stretches do not count
  // as covered for it. Where nothing else lies, nothing need be compared. Joining all near masks for each stretch took
  // a twelfth more instructions.
  void cover(Mask& mask) {
    mask.covers = true;
    for (int y = mask.begin; y < mask.end; ++y) {
      RowBits& covered = covered_[y];
      covered = covered | mask.rows[y];
    }
  }

  void coverAll() {
    for (std::size_t k = 0; k < std::min(used_, masks_.size()); ++k) {
      if (!masks_[k].covers) cover(masks_[k]);
    }
  }

  [[nodiscard]] bool isNear(const Mask& mask, int stretch) const {
    const int apart = stretch - mask.stretch;
    return apart <= kNear || stretches_ - apart <= kNear;
  }

  // Begins the mask of a stretch. The first masks of a cycle are kept until its end, which meets them.
  void open(int stretch, int stretches) {
    stretches_ = stretches;
    current_ = used_ < kNear ? used_ : kNear + (used_ - kNear) % (kNear + 1);
    for (std::size_t k = 0; k < std::min(used_, masks_.size()); ++k) {
      if (!masks_[k].covers && (k == current_ || !isNear(masks_[k], stretch))) cover(masks_[k]);
    }
    masks_[current_].clear();
    masks_[current_].stretch = stretch;
    ++used_;
    open_ = true;
  }

  // Ends the current stretch and counts its overlap with covered pixels.
  void close() {
    if (!open_) return;
    open_ = false;
    const Mask& mask = masks_[current_];
    RowBits met{};
    for (int y = mask.begin; y < mask.end; ++y) {
      met = met | (mask.rows[y] & covered_[y]);
    }
    if (any(met)) countTwice(mask);
  }

  // Marks the pixels of a mask that are covered by stretches that are not near it.
  void countTwice(const Mask& mask) {
    for (int y = mask.begin; y < mask.end; ++y) {
      const std::size_t row = y;
      RowBits twice = mask.rows[row] & covered_[row];
      for (std::size_t k = 0; k < std::min(used_, masks_.size()) && any(twice); ++k) {
        const Mask& near = masks_[k];
        if (k == current_ || y < near.begin || y >= near.end || !isNear(near, mask.stretch)) continue;
        twice = twice & ~near.rows[row];
      }
      again_[row] = again_[row] | twice;
    }
  }

  std::array<RowBits, kTileHeight> covered_{};
  std::array<RowBits, kTileHeight> again_{};
  std::int32_t cycle_ = -1;
  std::array<Mask, 2 * kNear + 1> masks_;  ///< masks of stretches of this cycle
  std::size_t used_ = 0;                   ///< number of stretches of this cycle so far
  std::size_t current_ = 0;
  int stretches_ = 0;  ///< stretches of this whole cycle
  bool open_ = false;
};

// Pixels of a tile on the raster.
struct Tile {
  /// Half-open range in pixels: without column `right` and row `top`.
  int left;
  int right;
  int bottom;
  int top;
};

Tile tileAt(const TiledBeads& laid, int tile) {
  const int left = tile % laid.tilesAcross * kTileWidth;
  const int bottom = tile / laid.tilesAcross * kTileHeight;
  return {left, std::min(left + kTileWidth, laid.raster.nx), bottom, std::min(bottom + kTileHeight, laid.raster.ny)};
}

// Clips the way from a to b to `reach` around a tile. \return its shares; none if the second is the lesser one.
std::pair<float, float> withinTile(Vec2f a, Vec2f b, float reach) {
  float t0 = 0;
  float t1 = 1;
  const auto clip = [&](float from, float to, float size) {
    if (from == to) return;
    const float low = (-reach - from) / (to - from);
    const float high = (size + reach - from) / (to - from);
    t0 = std::max(t0, std::min(low, high));
    t1 = std::min(t1, std::max(low, high));
  };
  clip(a.x, b.x, kTileWidth);
  clip(a.y, b.y, kTileHeight);
  return {t0, t1};
}

// Lays a bead on a tile in pieces, because a long bead crosses several stretches and tiles.
void lay(const TiledBeads& laid, const MeasuredBead& bead, const Tile& tile, TilePasses& passes) {
  const Vec2 origin = laid.raster.centre(tile.left, tile.bottom);
  const auto onTile = [&](Vec2f p) {
    return Vec2f{static_cast<float>((static_cast<double>(p.x) - origin.x) * laid.perMm),
                 static_cast<float>((static_cast<double>(p.y) - origin.y) * laid.perMm)};
  };
  const auto perMm = static_cast<float>(laid.perMm);
  const Vec2f a = onTile(bead.a);
  const Vec2f b = onTile(bead.b);
  const float ra = bead.ra * perMm;
  const float rb = bead.rb * perMm;
  const Stretches& stretches = laid.stretchesOf[bead.cycle];
  const int count = std::max(1, static_cast<int>(std::ceil(bead.length / laid.pieceLength)));
  const auto pieces = static_cast<float>(count);
  int first = 0;
  int last = count;
  if (count > 4) {
    const auto [t0, t1] = withinTile(a, b, std::max(ra, rb) + 1);
    first = std::max(first, static_cast<int>(t0 * pieces));
    last = std::min(last, static_cast<int>(std::ceil(t1 * pieces)));
  }
  for (int k = first; k < last; ++k) {
    const float from = static_cast<float>(k) / pieces;
    const float to = static_cast<float>(k + 1) / pieces;
    const Capsule piece(a + (b - a) * from, a + (b - a) * to, ra + (rb - ra) * from, ra + (rb - ra) * to);
    const float middle = bead.along + bead.length * 0.5f * (from + to);
    const int stretch = std::min(static_cast<int>(middle * stretches.perMm), stretches.count - 1);
    passes.lay(piece, bead.cycle, stretch, stretches);
  }
}

// Pixels of a row of the tile whose centres lie in the shape.
RowBits insideRow(const TiledBeads& laid, const Tile& tile, int y) {
  const Grid& raster = laid.raster;
  const double x0 = raster.centre(tile.left, 0).x;
  const auto pixelFrom = [&](double x) {
    return static_cast<int>(std::clamp(std::ceil((x - x0) / raster.cell), 0.0, static_cast<double>(kTileWidth)));
  };
  RowBits inside{};
  for (const Interval& interval : laid.inside[y]) {
    inside = inside | rowOf(pixelFrom(interval.begin), pixelFrom(interval.end));
  }
  return inside;
}

// Counts the pixels outside the shape that lie off its border. Beads touch a straight border over its whole length, and
// if a row of pixels lies on it as well, rounding would decide for all of them.
int offBorder(const TiledBeads& laid, const BorderIndex& border, const Tile& tile, int y, RowBits outside) {
  int count = 0;
  for (int word = 0; word < 2; ++word) {
    for (std::uint64_t bits = outside[word]; bits != 0; bits &= bits - 1) {
      const Vec2 p = laid.raster.centre(tile.left + 64 * word + std::countr_zero(bits), tile.bottom + y);
      const bool off = border.blockDistance(p) > kRounding || std::abs(border.nearest(p).distance) > kRounding;
      count += off ? 1 : 0;
    }
  }
  return count;
}

}  // namespace

BeadArea beadArea(const Toolpath& toolpath, const Shape& shape, const BorderIndex& border, const Bounds& box,
                  const RunContext& run) {
  const TiledBeads laid = tiledBeadsOf(toolpath, shape, box);
  std::vector<BeadArea> counts(laid.tiles);
  const auto countTiles = [&](int firstTile, int lastTile) {
    TilePasses passes;
    for (int t = firstTile; t < lastTile && !run.cancelled(); ++t) {
      const Tile tile = tileAt(laid, t);
      const std::size_t end = laid.begin[t + 1];
      for (std::size_t at = laid.begin[t]; at < end; ++at) {
        lay(laid, laid.beads[laid.beadOf[at]], tile, passes);
      }
      counts[t] = passes.take(
          tile.top - tile.bottom, tile.right - tile.left, [&](int y) { return insideRow(laid, tile, tile.bottom + y); },
          [&](int y, RowBits outside) { return offBorder(laid, border, tile, y, outside); });
    }
  };
  const int step = (laid.tiles - 1) / 24 + 1;  // tiles between reports of progress
  for (int done = 0; done < laid.tiles && !run.cancelled(); done += step) {
    const int count = std::min(step, laid.tiles - done);
    parallelFor(run, count, std::max(1, count / (4 * run.threads())),
                [&](int first, int last) { countTiles(done + first, done + last); });
    run.report(kAreaShare * std::min(done + step, laid.tiles) / laid.tiles);
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
