#include "geometry/parts.hpp"

#include <algorithm>
#include <cstring>

#include "base/parallel_for.hpp"
#include "geometry/bead_room.hpp"

namespace sillon {
namespace {

// Returns the first marked sample from `from` on, or `end`.
std::size_t nextMarked(const std::vector<char>& marks, std::size_t from, std::size_t end) {
  const void* found = from < end ? std::memchr(&marks[from], 1, end - from) : nullptr;
  return found != nullptr ? toSize(static_cast<const char*>(found) - marks.data()) : end;
}

// Returns how many samples after one with this distance certainly do not lie between `deep` and `shallow`, or -1 if the
// sample itself does. Most samples lie deeper or outside, so that many are skipped at once.
int samplesBeyond(float distance, float deep, float shallow, float perMm) {
  const float beyond = distance > shallow ? distance - shallow : deep - distance;
  return beyond < 0 ? -1 : std::max(0, static_cast<int>(beyond * perMm - 1.01f));
}

// Sets samples beside the middles of places hardly wider than a bead to the depth of a bead, because a lattice misses
// these middles.
void deepenMiddles(const BorderIndex& border, const Grid& grid, double spacing, const RunContext& run,
                   std::vector<float>& distance) {
  const auto deep = static_cast<float>(-0.5 * spacing);
  const float missed = deep + missedDepth(grid.cell);
  const auto perMm = static_cast<float>(1 / grid.cell);
  const std::size_t nx = grid.nx;
  std::vector<std::vector<std::size_t>> found(grid.ny);
  parallelFor(run, grid.ny - 2, 16, [&](int begin, int end) {
    for (int y = begin + 1; y < end + 1; ++y) {
      for (int x = 1; x < grid.nx - 1; ++x) {
        const std::size_t i = grid.index(x, y);
        if (const int beyond = samplesBeyond(distance[i], deep, missed, perMm); beyond >= 0) {
          x += beyond;
          continue;
        }
        // Along most of a border, the next sample inwards is deep.
        if (std::min({distance[i - 1], distance[i + 1], distance[i - nx], distance[i + nx]}) <= deep) continue;
        if (hasBeadRoom(border, grid.centre(x, y), spacing)) found[y].push_back(i);
      }
    }
  });
  for (const std::vector<std::size_t>& row : found) {
    for (const std::size_t i : row) distance[i] = deep;
  }
}

}  // namespace

Result<LostCells> lostCells(const Shape& shape, const BorderIndex& border, const Bounds& box, double spacing,
                            const RunContext& run) {
  constexpr int kSamples = 8;
  const double cell = spacing / kSamples;
  LostCells out;
  out.grid = {{box.min.x - spacing, box.min.y - spacing},
              cell,
              static_cast<int>((box.size().x + 2 * spacing) / cell) + 1,
              static_cast<int>((box.size().y + 2 * spacing) / cell) + 1};
  const Grid& grid = out.grid;
  const float deep = static_cast<float>(-0.5 * spacing);
  Result<std::vector<float>> distance = bandDistance(shape, border, grid, -deep, run);  // exact down to `deep`
  if (!distance) return distance.error();
  out.distance = std::move(distance).value();
  deepenMiddles(border, grid, spacing, run, out.distance);
  const std::vector<float>& sd = out.distance;
  std::vector<char> lost(grid.size(), 0);
  constexpr int kReach = kSamples / 2 + 1;
  // Squared reach of a disc [samples²]; a deep sample stands for its whole cell.
  constexpr double kLimit = (kSamples / 2 + 0.75) * (kSamples / 2 + 0.75);
  const auto perMm = static_cast<float>(1 / cell);
  parallelForEach(run, grid.ny, 16, [&](int y) {
    const std::size_t row = grid.index(0, y);
    int deepX = 0;  // offset of the deep sample found last; mostly it fits the next sample, too
    int deepY = 0;
    for (int x = 0; x < grid.nx; ++x) {
      const std::size_t i = row + x;
      if (const int beyond = samplesBeyond(sd[i], deep, 0, perMm); beyond >= 0) {
        x += beyond;
        continue;
      }
      const auto isDeep = [&](int dx, int dy) {
        if (dx * dx + dy * dy > kLimit || x + dx < 0 || y + dy < 0 || x + dx >= grid.nx || y + dy >= grid.ny)
          return false;
        return sd[grid.index(x + dx, y + dy)] <= deep;
      };
      bool reached = isDeep(deepX, deepY);
      for (int dy = -kReach; dy <= kReach && !reached; ++dy) {
        for (int dx = -kReach; dx <= kReach && !reached; ++dx) {
          reached = isDeep(dx, dy);
          if (reached) deepX = dx, deepY = dy;
        }
      }
      lost[i] = reached ? 0 : 1;
    }
  });
  if (run.cancelled()) return cancelledRun();
  std::vector<std::size_t> place;
  for (std::size_t start = nextMarked(lost, 0, lost.size()); start < lost.size();
       start = nextMarked(lost, start + 1, lost.size())) {
    place.assign(1, start);
    lost[start] = 0;
    for (std::size_t k = 0; k < place.size(); ++k) {
      const std::size_t i = place[k];
      const std::size_t nx = grid.nx;
      for (const std::size_t j : {i - 1, i + 1, i - nx, i + nx}) {  // the frame is never lost: no index leaves the grid
        if (!lost[j]) continue;
        lost[j] = 0;
        place.push_back(j);
      }
    }
    if (static_cast<double>(place.size()) * cell * cell > 0.25 * spacing * spacing) out.places.push_back(place);
  }
  return out;
}

}  // namespace sillon
