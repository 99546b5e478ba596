#include "gcode_reader/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace sillon {
namespace {

constexpr double kFinest = 0.05;  // [mm]
constexpr double kMostCells = 4e6;
constexpr std::int64_t kMostVisits = 200'000'000;  // of cells, a second; a plate of 120 x 80 mm takes a quarter

// One byte per cell: which kinds of beads have touched its middle.
struct Raster {
  static constexpr std::uint8_t kBase = 1;
  static constexpr std::uint8_t kOriented = 2;

  explicit Raster(const Bounds& box) : min(box.min) {
    const Vec2 size = box.size();
    cell = std::max(kFinest, std::sqrt(size.x * size.y / kMostCells));
    cell = std::max({cell, size.x / kMostCells, size.y / kMostCells});
    columns = static_cast<int>(size.x / cell) + 1;
    rows = static_cast<int>(size.y / cell) + 1;
    cells.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0);
  }

  /// \return how many cells it has looked at
  std::int64_t draw(const LaidBead& bead) {
    std::int64_t visits = 0;
    const Vec2 a = Vec2{bead.from.x, bead.from.y} - min;
    const Vec2 d = Vec2{bead.to.x, bead.to.y} - min - a;
    const double reach = bead.width / 2;
    const double along = dot(d, d);
    const std::uint8_t kind = bead.base ? kBase : kOriented;
    // Beads of a hostile file lie anywhere, further away than an int counts.
    const auto index = [&](double at, int count) {
      return at > 0 ? static_cast<int>(std::min(at / cell, count - 1.0)) : 0;
    };
    const int firstRow = index(std::min(a.y, a.y + d.y) - reach, rows);
    const int lastRow = index(std::max(a.y, a.y + d.y) + reach, rows);
    const int firstColumn = index(std::min(a.x, a.x + d.x) - reach, columns);
    const int lastColumn = index(std::max(a.x, a.x + d.x) + reach, columns);
    for (int row = firstRow; row <= lastRow; ++row) {
      // Long slanted beads cross a row over a small part of their box only.
      const double y = (row + 0.5) * cell - a.y;
      int from = firstColumn;
      int to = lastColumn;
      if (std::abs(d.y) > reach) {
        const double low = std::clamp((y - reach) / d.y, 0.0, 1.0) * d.x;
        const double high = std::clamp((y + reach) / d.y, 0.0, 1.0) * d.x;
        from = std::max(from, index(a.x + std::min(low, high) - reach, columns));
        to = std::min(to, index(a.x + std::max(low, high) + reach, columns));
      }
      visits += std::max(1, to - from + 1);
      std::uint8_t* line = cells.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(columns);
      for (int column = from; column <= to; ++column) {
        const Vec2 p{(column + 0.5) * cell - a.x, y};
        const Vec2 off = p - (along > 0 ? std::clamp(dot(p, d) / along, 0.0, 1.0) : 0.0) * d;
        if (dot(off, off) <= reach * reach) line[column] |= kind;
      }
    }
    return visits;
  }

  // Share of the base that is covered; the oriented layer is taken off again.
  double takeCoverage() {
    std::int64_t base = 0;
    std::int64_t covered = 0;
    for (std::uint8_t& cell : cells) {
      if ((cell & kBase) == 0) continue;
      ++base;
      if ((cell & kOriented) != 0) ++covered;
    }
    for (std::uint8_t& cell : cells) cell &= kBase;
    return base > 0 ? static_cast<double>(covered) / static_cast<double>(base) : -1;
  }

  Vec2 min;
  double cell = 0;
  int columns = 0;
  int rows = 0;
  std::vector<std::uint8_t> cells;
};

// Without a base, or where that would take too long, the shares are -1.
void addUnknown(std::vector<double>& shares, const LaidBead* begin, const LaidBead* end) {
  int last = -1;
  for (const LaidBead* bead = begin; bead != end; ++bead) {
    if (!bead->base && bead->layer != last) shares.push_back(-1);
    if (!bead->base) last = bead->layer;
  }
}

/// \param rest  cells that may still be looked at
void addStack(std::vector<double>& shares, const LaidBead* begin, const LaidBead* end, std::int64_t& rest) {
  Bounds box;
  bool based = false;
  for (const LaidBead* bead = begin; bead != end; ++bead) {
    if (!bead->base) continue;
    based = true;
    const Vec2 half{bead->width / 2, bead->width / 2};
    for (const Vec2f p : {bead->from, bead->to}) {
      box.add(Vec2{p.x, p.y} - half);
      box.add(Vec2{p.x, p.y} + half);
    }
  }
  if (!based || rest < 0) {
    addUnknown(shares, begin, end);
    return;
  }
  Raster raster(box);
  rest -= static_cast<std::int64_t>(raster.cells.size());
  for (const LaidBead* bead = begin; bead != end && rest >= 0; ++bead) {
    if (bead->base) rest -= raster.draw(*bead);
  }
  for (const LaidBead* bead = begin; bead != end;) {
    if (bead->base) {
      ++bead;
      continue;
    }
    const int layer = bead->layer;
    for (; bead != end && bead->layer == layer; ++bead) {
      if (!bead->base && rest >= 0) rest -= raster.draw(*bead);
    }
    rest -= static_cast<std::int64_t>(raster.cells.size());
    shares.push_back(rest >= 0 ? raster.takeCoverage() : -1);
  }
}

}  // namespace

std::vector<double> orientedCoverage(const std::vector<LaidBead>& beads) {
  std::vector<double> shares;
  std::int64_t rest = kMostVisits;
  const LaidBead* const end = beads.data() + beads.size();
  for (const LaidBead* begin = beads.data(); begin != end;) {
    const LaidBead* last = begin + 1;
    while (last != end && (last->layer == (last - 1)->layer || last->top > (last - 1)->top)) ++last;
    addStack(shares, begin, last, rest);
    begin = last;
  }
  return shares;
}

}  // namespace sillon
