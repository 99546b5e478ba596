#include "gcode_reader/coverage.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include "base/capsule_rows.hpp"

namespace sillon {
namespace {

constexpr double kMostCells = 4e6;  // greatest number of cells, one bit each: half a megabyte

// Sets the bits of a row from cell `first` to cell `last`, both included.
void fillCells(std::uint64_t* row, int first, int last) {
  std::uint64_t* word = row + first / 64;
  std::uint64_t* const end = row + last / 64;
  std::uint64_t mask = ~std::uint64_t{0} << first % 64;
  for (; word != end; ++word) {
    *word |= mask;
    mask = ~std::uint64_t{0};
  }
  *word |= mask & ~std::uint64_t{0} >> (63 - last % 64);
}

}  // namespace

BeadRaster::BeadRaster(const Bounds& box, double finest) : min_(box.min) {
  const Vec2 size = box.size();
  cell_ = std::max(finest, std::sqrt(size.x * size.y / kMostCells));
  // A box that is almost a line has hardly any area, but must not get more columns or rows either.
  cell_ = std::max({cell_, size.x / kMostCells, size.y / kMostCells});
  perMm_ = 1 / cell_;
  columns_ = static_cast<int>(size.x / cell_) + 1;
  rows_ = static_cast<int>(size.y / cell_) + 1;
  rowWords_ = (columns_ - 1) / 64 + 1;
}

std::int64_t BeadRaster::draw(Vec2f from, Vec2f to, double width, Bits& bits) const {
  const auto onRaster = [&](Vec2f p) {
    return Vec2f{static_cast<float>((static_cast<double>(p.x) - min_.x) * perMm_ - 0.5),
                 static_cast<float>((static_cast<double>(p.y) - min_.y) * perMm_ - 0.5)};
  };
  const auto radius = static_cast<float>(width / 2 * perMm_);
  const Capsule capsule(onRaster(from), onRaster(to), radius, radius);
  std::int64_t visits = 0;
  const int end = capsule.endRow(rows_);
  PixelRuns runs;
  for (int row = capsule.firstRow(rows_); row < end; row += PixelRuns::kMostRows) {
    const int count = std::min(PixelRuns::kMostRows, end - row);
    pixelsOf(capsule, row, count, columns_, runs);
    for (int k = 0; k < count; ++k) {
      const int first = runs.begin[k];
      const int last = runs.end[k];
      if (first < last) fillCells(&bits[(row + k) * rowWords_], first, last - 1);
      visits += std::max(1, last - first);
    }
  }
  return visits;
}

void BeadRaster::fill(int row, double begin, double end, Bits& bits) const {
  const auto onRaster = [&](double x) { return std::clamp((x - min_.x) * perMm_ - 0.5, -1.0, columns_ + 0.0); };
  const int first = std::max(0, static_cast<int>(std::ceil(onRaster(begin))));
  const int last = std::min(columns_ - 1, static_cast<int>(std::floor(onRaster(end))));
  if (first <= last) fillCells(&bits[row * rowWords_], first, last);
}

std::int64_t countOf(const BeadRaster::Bits& bits) {
  std::int64_t count = 0;
  for (const std::uint64_t word : bits) count += std::popcount(word);
  return count;
}

}  // namespace sillon
