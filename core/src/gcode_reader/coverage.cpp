#include "gcode_reader/coverage.hpp"

#include <bit>
#include <cstddef>

namespace sillon {
namespace {

constexpr double kFinest = 0.05;                   // [mm], side of a cell
constexpr std::int64_t kMostVisits = 200'000'000;  // visits to cells, a second's worth; 120 x 80 mm take a quarter

// Two rasters of a stack: cells under its base beads, and cells under the current oriented layer.
class StackRasters {
 public:
  explicit StackRasters(const Bounds& box) : raster_(box, kFinest), base_(raster_.none()), oriented_(raster_.none()) {}

  /// Draws a bead on the raster of its kind. \return number of cells that it visited.
  std::int64_t draw(const LaidBead& bead) {
    return raster_.draw(bead.from, bead.to, static_cast<double>(bead.width), bead.base ? base_ : oriented_);
  }

  // Share of the base that the oriented layer covers, -1 without a base; clears the oriented raster for the next layer.
  double takeCoverage() {
    const std::int64_t all = countOf(base_);
    std::int64_t covered = 0;
    for (std::size_t k = 0; k < base_.size(); ++k) {
      covered += std::popcount(base_[k] & oriented_[k]);
      oriented_[k] = 0;
    }
    return all > 0 ? static_cast<double>(covered) / static_cast<double>(all) : -1;
  }

  [[nodiscard]] std::int64_t cells() const { return raster_.cells(); }

 private:
  BeadRaster raster_;
  BeadRaster::Bits base_;
  BeadRaster::Bits oriented_;
};

// Adds -1 for each oriented layer of a stack that has no base or would take too long.
void addUnknown(std::vector<double>& shares, const LaidBead* begin, const LaidBead* end) {
  int last = -1;
  for (const LaidBead* bead = begin; bead != end; ++bead) {
    if (!bead->base && bead->layer != last) shares.push_back(-1);
    if (!bead->base) last = bead->layer;
  }
}

/// Adds the shares that the oriented layers of one stack cover. \param rest  visits to cells that are still allowed.
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
  StackRasters raster(box);
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

const LaidBead* stackEnd(const LaidBead* begin, const LaidBead* end) {
  const LaidBead* last = begin + 1;
  while (last != end && (last->layer == (last - 1)->layer || last->top > (last - 1)->top)) ++last;
  return last;
}

std::vector<double> orientedCoverage(const std::vector<LaidBead>& beads) {
  std::vector<double> shares;
  std::int64_t rest = kMostVisits;
  const LaidBead* const end = beads.data() + beads.size();
  for (const LaidBead* begin = beads.data(); begin != end;) {
    const LaidBead* last = stackEnd(begin, end);
    addStack(shares, begin, last, rest);
    begin = last;
  }
  return shares;
}

}  // namespace sillon
