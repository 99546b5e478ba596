#include "gcode_reader/coverage.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/capsule_rows.hpp"

namespace sillon {
namespace {

constexpr double kFinest = 0.05;  // [mm]
constexpr double kMostCells = 4e6;
constexpr std::int64_t kMostVisits = 200'000'000;  // of cells, a second; a plate of 120 x 80 mm takes a quarter

// One bit per cell and kind of beads: whether one has touched its middle.
class Raster {
 public:
  using Bits = std::vector<std::uint64_t>;

  explicit Raster(const Bounds& box) : min_(box.min) {
    const Vec2 size = box.size();
    cell_ = std::max(kFinest, std::sqrt(size.x * size.y / kMostCells));
    cell_ = std::max({cell_, size.x / kMostCells, size.y / kMostCells});
    perMm_ = 1 / cell_;
    columns_ = static_cast<int>(size.x / cell_) + 1;
    rows_ = static_cast<int>(size.y / cell_) + 1;
    rowWords_ = static_cast<std::size_t>(columns_ - 1) / 64 + 1;
    base_.assign(rowWords_ * static_cast<std::size_t>(rows_), 0);
    oriented_ = base_;
  }

  /// \return how many cells it has looked at
  std::int64_t draw(const LaidBead& bead) {
    const auto onRaster = [&](Vec2f p) {
      return Vec2f{static_cast<float>((static_cast<double>(p.x) - min_.x) * perMm_ - 0.5),
                   static_cast<float>((static_cast<double>(p.y) - min_.y) * perMm_ - 0.5)};
    };
    const auto radius = static_cast<float>(static_cast<double>(bead.width) / 2 * perMm_);
    const Capsule capsule(onRaster(bead.from), onRaster(bead.to), radius, radius);
    Bits& bits = bead.base ? base_ : oriented_;
    std::int64_t visits = 0;
    const int end = capsule.endRow(rows_);
    PixelRuns runs;
    for (int row = capsule.firstRow(rows_); row < end; row += PixelRuns::kMostRows) {
      const int count = std::min(PixelRuns::kMostRows, end - row);
      pixelsOf(capsule, row, count, columns_, runs);
      for (int k = 0; k < count; ++k) {
        const int from = runs.begin[k];
        const int to = runs.end[k];
        if (from < to) fill(&bits[static_cast<std::size_t>(row + k) * rowWords_], from, to - 1);
        visits += std::max(1, to - from);
      }
    }
    return visits;
  }

  // Share of the base that is covered; the oriented layer is taken off again.
  double takeCoverage() {
    std::int64_t all = 0;
    std::int64_t covered = 0;
    for (std::size_t k = 0; k < base_.size(); ++k) {
      all += std::popcount(base_[k]);
      covered += std::popcount(base_[k] & oriented_[k]);
      oriented_[k] = 0;
    }
    return all > 0 ? static_cast<double>(covered) / static_cast<double>(all) : -1;
  }

  [[nodiscard]] std::int64_t cells() const { return static_cast<std::int64_t>(columns_) * rows_; }

 private:
  static void fill(std::uint64_t* row, int first, int last) {
    std::uint64_t* word = row + first / 64;
    std::uint64_t* const end = row + last / 64;
    std::uint64_t mask = ~std::uint64_t{0} << first % 64;
    for (; word != end; ++word) {
      *word |= mask;
      mask = ~std::uint64_t{0};
    }
    *word |= mask & ~std::uint64_t{0} >> (63 - last % 64);
  }

  Vec2 min_;
  double cell_ = 0;
  double perMm_ = 0;  ///< cells
  int columns_ = 0;
  int rows_ = 0;
  std::size_t rowWords_ = 0;
  Bits base_;
  Bits oriented_;
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
  rest -= raster.cells();
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
    rest -= raster.cells();
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
