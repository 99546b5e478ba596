#include "geometry/triangulate.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "base/sort_key.hpp"

namespace sillon {
namespace {

using Point = Vec2T<std::int64_t>;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint64_t kMostWork = 1'000'000'000;  // limit on tested points, a few seconds, for hostile shapes

// Positive if a, b, c turn left; exact.
std::int64_t turn(Point a, Point b, Point c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

// A node of a ring. A hole is joined to the ring around it by a bridge, whose two points then have two nodes each.
struct Node {
  std::uint32_t point;
  std::uint32_t before;
  std::uint32_t after;
};

class Ears {
 public:
  explicit Ears(const std::vector<Point>& points) : points_(points) {}

  // Adds a ring. \return one of its nodes.
  std::uint32_t addRing(const std::vector<std::uint32_t>& ring) {
    const auto first = static_cast<std::uint32_t>(nodes_.size());
    const auto count = static_cast<std::uint32_t>(ring.size());
    for (std::uint32_t k = 0; k < count; ++k) {
      nodes_.push_back({ring[k], first + (k > 0 ? k - 1 : count - 1), first + (k + 1 < count ? k + 1 : 0)});
    }
    return first;
  }

  /// Joins a hole, the ring added last, to the ring left of its leftmost point; drops it if there is none.
  /// \param hole  first node of the hole.
  bool bridge(std::uint32_t hole);

  /// Cuts all rings into triangles; joined rings count as one. \return false if that would take too long.
  bool cut(const std::vector<std::uint32_t>& starts, std::vector<Triangle>& triangles);

 private:
  [[nodiscard]] Point at(std::uint32_t node) const { return points_[nodes_[node].point]; }
  [[nodiscard]] bool opensTo(std::uint32_t node, Point target) const;
  [[nodiscard]] bool isEar(std::uint32_t node);
  [[nodiscard]] bool blocks(std::uint32_t node, Point a, Point b, Point c) const;

  const std::vector<Point>& points_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> dents_;  // nodes that are no convex corner, sorted by x
  std::vector<char> gone_;
  std::uint64_t work_ = 0;
};

// Tells whether a line from the node to the target begins inside.
bool Ears::opensTo(std::uint32_t node, Point target) const {
  const Point here = at(node);
  const Point before = at(nodes_[node].before);
  const Point after = at(nodes_[node].after);
  const bool leftOfIn = turn(before, here, target) > 0;
  const bool leftOfOut = turn(here, after, target) > 0;
  return turn(before, here, after) > 0 ? leftOfIn && leftOfOut : leftOfIn || leftOfOut;
}

bool Ears::bridge(std::uint32_t hole) {
  std::uint32_t from = hole;
  for (std::uint32_t k = nodes_[hole].after; k != hole; k = nodes_[k].after) {
    if (at(k).x < at(from).x || (at(k).x == at(from).x && at(k).y < at(from).y)) from = k;
  }
  const Point tip = at(from);
  const Point left{tip.x - 1, tip.y};
  for (std::uint32_t k = nodes_[hole].after; k != hole && !opensTo(from, left); k = nodes_[k].after) {
    if (at(k) == tip && opensTo(k, left)) from = k;  // holes that touch at the tip are one ring
  }
  // Finds the nearest edge to the left that has the inside on the tip's side: one that runs down.
  double nearest = -std::numeric_limits<double>::infinity();
  std::uint32_t best = from;
  std::vector<char> own(nodes_.size(), 0);
  own[hole] = 1;
  for (std::uint32_t k = nodes_[hole].after; k != hole; k = nodes_[k].after) own[k] = 1;
  for (std::uint32_t k = 0; k < nodes_.size(); ++k) {
    const Point a = at(k);
    const Point b = at(nodes_[k].after);
    if (own[k] || a.y < tip.y || b.y > tip.y || a.y == b.y) continue;
    const double x = static_cast<double>(a.x) +
                     static_cast<double>(tip.y - a.y) * static_cast<double>(b.x - a.x) / static_cast<double>(b.y - a.y);
    if (x > static_cast<double>(tip.x) || x <= nearest) continue;
    const std::uint32_t corner = a.y == tip.y ? k : b.y == tip.y ? nodes_[k].after : kNone;
    // If several nodes lie at one place, only one of them faces the tip.
    if (corner != kNone && !opensTo(corner, tip)) continue;
    nearest = x;
    best = corner != kNone ? corner : a.x < b.x ? k : nodes_[k].after;
  }
  work_ += nodes_.size();
  if (best == from || work_ > kMostWork) {
    nodes_.resize(hole);
    return false;
  }
  // A corner inside the triangle of the tip, the point that was hit and that edge's end would be crossed by the bridge;
  // of such corners, the one at the flattest angle is visible.
  const Point end = at(best);
  const double run = static_cast<double>(tip.x) - nearest;
  double flattest = std::numeric_limits<double>::infinity();
  for (std::uint32_t k = 0; k < nodes_.size() && end.y != tip.y; ++k) {
    const Point p = at(k);
    if (own[k] || p.x < end.x || p.x > tip.x || p == tip) continue;
    const bool side = end.y > tip.y ? p.y >= tip.y && p.y <= end.y : p.y <= tip.y && p.y >= end.y;
    const std::int64_t ofLine = turn(tip, end, p);
    if (!side || (end.y > tip.y ? ofLine < 0 : ofLine > 0)) continue;
    const double rise = static_cast<double>(std::abs(p.y - tip.y));
    // Left of the edge that was hit, nothing is visible.
    const double hit =
        nearest + (static_cast<double>(end.x) - nearest) * rise / static_cast<double>(std::abs(end.y - tip.y));
    if (static_cast<double>(p.x) < hit - 1e-3 * (1 + run)) continue;
    const double slope = rise / std::max(1e-9, static_cast<double>(tip.x - p.x));
    if (slope > flattest || (slope == flattest && p.x <= at(best).x) || !opensTo(k, tip)) continue;
    flattest = slope;
    best = k;
  }
  if (end.y != tip.y && !opensTo(best, tip)) {
    // Another node at the same place, of a bridge or of a touching ring, may be the one that faces the tip.
    for (std::uint32_t k = 0; k < nodes_.size(); ++k) {
      if (!own[k] && at(k) == at(best) && opensTo(k, tip)) best = k;
    }
  }
  // The order becomes best, from ... round the hole ... from', best'.
  const auto twinFrom = static_cast<std::uint32_t>(nodes_.size());
  const std::uint32_t twinBest = twinFrom + 1;
  nodes_.push_back({nodes_[from].point, nodes_[from].before, twinBest});
  nodes_.push_back({nodes_[best].point, twinFrom, nodes_[best].after});
  nodes_[nodes_[from].before].after = twinFrom;
  nodes_[nodes_[best].after].before = twinBest;
  nodes_[best].after = from;
  nodes_[from].before = best;
  return true;
}

// Tells whether a node that is no convex corner prevents the triangle from being cut off.
bool Ears::blocks(std::uint32_t node, Point a, Point b, Point c) const {
  const Point p = at(node);
  if (p != a && p != b && p != c) return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
  // A node at one of the corners blocks only if its path continues within the triangle.
  for (const std::uint32_t next : {nodes_[node].before, nodes_[node].after}) {
    const Point q = at(next);
    if (turn(a, b, q) > 0 && turn(b, c, q) > 0 && turn(c, a, q) > 0) return true;
    if (p == b && turn(a, b, q) > 0 && turn(b, c, q) > 0) return true;
  }
  return false;
}

// Tells whether a node is a convex corner whose triangle contains no other node.
bool Ears::isEar(std::uint32_t node) {
  const std::uint32_t before = nodes_[node].before;
  const std::uint32_t after = nodes_[node].after;
  const Point a = at(before);
  const Point b = at(node);
  const Point c = at(after);
  ++work_;
  if (turn(a, b, c) <= 0) return false;
  const auto [left, right] = std::minmax({a.x, b.x, c.x});
  const auto [low, high] = std::minmax({a.y, b.y, c.y});
  auto k = std::lower_bound(dents_.begin(), dents_.end(), left,
                            [&](std::uint32_t dent, std::int64_t x) { return at(dent).x < x; });
  for (; k != dents_.end() && at(*k).x <= right; ++k) {
    ++work_;
    if (gone_[*k] || *k == before || *k == node || *k == after || at(*k).y < low || at(*k).y > high) continue;
    if (blocks(*k, a, b, c)) return false;
  }
  return true;
}

bool Ears::cut(const std::vector<std::uint32_t>& starts, std::vector<Triangle>& triangles) {
  gone_.assign(nodes_.size(), 0);
  // A convex corner stays convex while its neighbours are cut off, so that the list of dents stays complete.
  for (std::uint32_t k = 0; k < nodes_.size(); ++k) {
    if (turn(at(nodes_[k].before), at(k), at(nodes_[k].after)) <= 0) dents_.push_back(k);
  }
  sortBy(dents_, [&](std::uint32_t k) { return at(k).x; });
  for (const std::uint32_t start : starts) {
    std::uint32_t node = start;
    std::size_t left = 1;
    for (std::uint32_t k = nodes_[start].after; k != start; k = nodes_[k].after) ++left;
    std::size_t refused = 0;
    while (left >= 3) {
      if (work_ > kMostWork) return false;
      // Invalid rings may have no ear at all; then any corner is cut off, and the surface still closes.
      if (left > 3 && refused < left && !isEar(node)) {
        node = nodes_[node].after;
        ++refused;
        continue;
      }
      const std::uint32_t before = nodes_[node].before;
      const std::uint32_t after = nodes_[node].after;
      const Triangle t{nodes_[before].point, nodes_[node].point, nodes_[after].point};
      // Going there and back along a bridge makes no triangle.
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
      nodes_[before].after = after;
      nodes_[after].before = before;
      gone_[node] = 1;
      --left;
      refused = 0;
      node = nodes_[after].after;  // skipping one node makes fewer slivers
    }
  }
  return true;
}

}  // namespace

Triangulation triangulate(const std::vector<Point>& points, const std::vector<std::vector<std::uint32_t>>& rings) {
  Triangulation result;
  Ears ears(points);
  struct Hole {
    Point tip;  ///< leftmost point
    std::size_t ring;
  };
  std::vector<Hole> holes;
  std::vector<std::uint32_t> starts;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    double area = 0;
    Point tip = points[rings[r][0]];
    for (std::size_t k = 0; k < rings[r].size(); ++k) {
      const Point a = points[rings[r][k]];
      const Point b = points[rings[r][k + 1 < rings[r].size() ? k + 1 : 0]];
      area += static_cast<double>(a.x) * static_cast<double>(b.y) - static_cast<double>(a.y) * static_cast<double>(b.x);
      if (a.x < tip.x || (a.x == tip.x && a.y < tip.y)) tip = a;
    }
    if (area > 0) {
      starts.push_back(ears.addRing(rings[r]));
      result.rings.push_back(rings[r]);
    } else if (area < 0) {
      holes.push_back({tip, r});
    }
  }
  // Holes are joined from left to right, so that the ring that a hole is joined to is already joined itself.
  sortBy(holes, [](const Hole& hole) { return hole.tip.y; });
  sortBy(holes, [](const Hole& hole) { return hole.tip.x; });
  for (const Hole& hole : holes) {
    if (ears.bridge(ears.addRing(rings[hole.ring]))) result.rings.push_back(rings[hole.ring]);
  }
  result.complete = ears.cut(starts, result.triangles);
  return result;
}

}  // namespace sillon
