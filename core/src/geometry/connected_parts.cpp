#include "geometry/parts.hpp"

#include <algorithm>
#include <numeric>

#include "geometry/bead_room.hpp"

namespace sillon {
namespace {

class UnionFind {
 public:
  explicit UnionFind(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::int32_t find(std::int32_t k) {
    while (parent_[k] != k) {
      std::int32_t& up = parent_[k];
      up = parent_[up];
      k = up;
    }
    return k;
  }
  void join(std::int32_t a, std::int32_t b) {
    a = find(a);
    b = find(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::int32_t> parent_;
};

// Returns the largest distance on the way between two neighbouring cells. A ridge can lie between them only if their
// gradients oppose each other; only then is the way sampled.
float highest(const SignedDistanceField& sdf, const BorderIndex& border, std::size_t i, std::size_t j, Vec2 from,
              Vec2 to) {
  constexpr int kSamples = 16;
  float high = std::max(sdf.distance[i], sdf.distance[j]);
  if (dot(sdf.normal[i], sdf.normal[j]) > 0.9f) return high;
  for (int k = 1; k < kSamples; ++k) {
    high = std::max(high, border.nearest(from + (to - from) * (static_cast<double>(k) / kSamples)).distance);
  }
  return high;
}

}  // namespace

Parts labelParts(const SignedDistanceField& sdf, const BorderIndex& border, double spacing, double bridge) {
  const Grid& grid = sdf.grid;
  const float limit = static_cast<float>(0.5 * bridge);
  const float safe = limit - static_cast<float>(grid.cell);  // below this depth, each neighbour is reached in any case
  Parts parts{grid, std::vector<std::int32_t>(grid.size(), -1), 0};

  // Finds runs of connected cells in each row and joins them to the runs of the row below.
  struct CellRun {
    int begin;
    int end;
  };
  std::vector<CellRun> runs;
  std::vector<std::size_t> rowBegin;
  for (int y = 0; y < grid.ny; ++y) {
    rowBegin.push_back(runs.size());
    for (int x = 0; x < grid.nx; ++x) {
      const std::size_t i = grid.index(x, y);
      if (sdf.distance[i] > limit) continue;
      const bool joinsLeft =
          x > 0 && sdf.distance[i - 1] <= limit &&
          (sdf.distance[i] < safe || highest(sdf, border, i - 1, i, grid.centre(x - 1, y), grid.centre(x, y)) <= limit);
      if (!joinsLeft) runs.push_back({x, x});
      runs.back().end = x + 1;
      parts.label[i] = static_cast<std::int32_t>(runs.size() - 1);
    }
  }
  UnionFind sets(runs.size());
  for (int y = 1; y < grid.ny; ++y) {
    for (int x = 0; x < grid.nx; ++x) {
      const std::size_t i = grid.index(x, y);
      const std::size_t below = grid.index(x, y - 1);
      if (parts.label[i] < 0 || parts.label[below] < 0) continue;
      if (sets.find(parts.label[i]) == sets.find(parts.label[below])) continue;
      if (sdf.distance[i] < safe || highest(sdf, border, below, i, grid.centre(x, y - 1), grid.centre(x, y)) <= limit)
        sets.join(parts.label[i], parts.label[below]);
    }
  }

  // Numbers the parts that can hold a bead first; both groups are in the order of their lowest cells.
  std::vector<char> deep(runs.size(), 0);
  const float depth = static_cast<float>(-0.5 * spacing);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (parts.label[i] >= 0 && sdf.distance[i] <= depth) deep[sets.find(parts.label[i])] = 1;
  }
  const float missed = depth + missedDepth(grid.cell);
  for (int y = 0; y < grid.ny; ++y) {
    for (int x = 0; x < grid.nx; ++x) {
      const std::size_t i = grid.index(x, y);
      if (parts.label[i] < 0 || sdf.distance[i] > missed) continue;
      char& found = deep[sets.find(parts.label[i])];
      if (found == 0 && hasBeadRoom(border, grid.centre(x, y), spacing)) found = 1;
    }
  }
  std::vector<std::int32_t> number(runs.size(), -1);
  std::int32_t next = 0;
  for (const char wanted : {char{1}, char{0}}) {
    for (std::size_t k = 0; k < runs.size(); ++k) {
      const std::size_t root = sets.find(static_cast<std::int32_t>(k));
      if (deep[root] == wanted && number[root] < 0) number[root] = next++;
    }
    if (wanted == 1) parts.count = next;
  }
  for (std::int32_t& label : parts.label) {
    if (label >= 0) label = number[sets.find(label)];
  }
  return parts;
}

}  // namespace sillon
