#include "geometry/outline_steps.hpp"

#include <algorithm>
#include <array>

#include "base/sort_key.hpp"

namespace sillon {
namespace {

constexpr std::size_t kMostCovers = 16;  ///< number of largest convex paths that are tested as covers; bounds the work

Bounds boxOf(const FilledPath& path) {
  Bounds box;
  for (const Ring& ring : path.rings) {
    for (const Vec2 p : ring) box.add(p);
  }
  return box;
}

// Counts how often a ring reverses in one coordinate; twice if it goes round once.
template <class Coordinate>
int reversals(const Ring& ring, const Coordinate& coordinate) {
  int count = 0;
  double first = 0;
  double last = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const double step = coordinate(ring[(k + 1) % ring.size()]) - coordinate(ring[k]);
    if (step == 0) continue;
    if (last != 0 && (step > 0) != (last > 0)) ++count;
    if (first == 0) first = step;
    last = step;
  }
  return count + (first != 0 && (first > 0) != (last > 0) ? 1 : 0);
}

// Returns 1 for a convex path that runs counter-clockwise, -1 for a clockwise one, and 0 for any other.
int turnOf(const FilledPath& path) {
  if (path.rings.size() != 1 || path.rings[0].size() < 3) return 0;
  const Ring& ring = path.rings[0];
  const std::size_t n = ring.size();
  bool left = false;
  bool right = false;
  for (std::size_t k = 0; k < n; ++k) {
    const double turn = cross(ring[(k + 1) % n] - ring[k], ring[(k + 2) % n] - ring[(k + 1) % n]);
    left = left || turn > 0;
    right = right || turn < 0;
  }
  if (left == right) return 0;
  const bool once =
      reversals(ring, [](Vec2 p) { return p.x; }) == 2 && reversals(ring, [](Vec2 p) { return p.y; }) == 2;
  return !once ? 0 : left ? 1 : -1;
}

// Tells whether a convex ring contains a box; its edge counts as inside.
bool holds(const Ring& convex, int turn, const Bounds& box) {
  const std::array<Vec2, 4> corners{box.min, Vec2{box.max.x, box.min.y}, box.max, Vec2{box.min.x, box.max.y}};
  for (std::size_t k = 0; k < convex.size(); ++k) {
    const Vec2 a = convex[k];
    const Vec2 along = convex[(k + 1) % convex.size()] - a;
    for (const Vec2 corner : corners) {
      if (turn * cross(along, corner - a) < 0) return false;
    }
  }
  return true;
}

}  // namespace

std::vector<char> coveredPaths(const std::vector<FilledPath>& paths) {
  struct Cover {
    double size;
    std::size_t path;
    int turn;
  };
  std::vector<char> covered(paths.size(), 0);
  if (paths.size() < 2) return covered;
  std::vector<Bounds> boxes;
  std::vector<Cover> covers;
  for (std::size_t k = 0; k < paths.size(); ++k) {
    boxes.push_back(boxOf(paths[k]));
    if (const int turn = turnOf(paths[k]); turn != 0)
      covers.push_back({boxes[k].size().x * boxes[k].size().y, k, turn});
  }
  sortBy(covers, [](const Cover& cover) { return -cover.size; });
  covers.resize(std::min(covers.size(), kMostCovers));
  for (const Cover& cover : covers) {
    if (covered[cover.path] != 0) continue;
    const Bounds& box = boxes[cover.path];
    for (std::size_t k = 0; k < paths.size(); ++k) {
      if (k == cover.path || covered[k] != 0 || boxes[k].empty()) continue;
      const bool within = boxes[k].min.x >= box.min.x && boxes[k].min.y >= box.min.y && boxes[k].max.x <= box.max.x &&
                          boxes[k].max.y <= box.max.y;
      if (within && holds(paths[cover.path].rings[0], cover.turn, boxes[k])) covered[k] = 1;
    }
  }
  return covered;
}

}  // namespace sillon
