#include "toolpath/path.hpp"

#include <cmath>

#include "base/parallel_for.hpp"
#include "base/simd.hpp"
#include "geometry/bead_room.hpp"
#include "geometry/closed_curves.hpp"
#include "geometry/point_grid.hpp"

namespace sillon {

namespace {

constexpr int kOwnChain = 4;  ///< points on either side that are no neighbours: one spacing, as points are tau/4 apart
constexpr int kFollowing = kOwnChain + 2;  ///< points after one that are looked at for a turn
constexpr float kTight = 0.3f;             ///< distance [tau]; segments of tau/4 meet only if ends of theirs are nearer

// Largest 1/g on either side, where g is the diameter of a circle that touches the path at a point.
struct Nearest {
  float left;
  float right;
  float distance2;  ///< to the nearest point of another piece
};

float laneMin(F4 v) { return std::min(std::min(v[0], v[1]), std::min(v[2], v[3])); }
float laneMax(F4 v) { return std::max(std::max(v[0], v[1]), std::max(v[2], v[3])); }

// Goes over all points within `cap` of p. The circle that touches the path at p with normal n and passes through p + v
// has the diameter |v|² / (n . v); the largest inverse on a side belongs to the smallest circle, the gap there. Four
// points are looked at at once, without branches.
Nearest nearestOn(const PointGrid& grid, Vec2f p, Vec2f normal, float cap, const OwnChain& own) {
  F4 left = splat(1 / cap);
  F4 right = splat(1 / cap);
  F4 closest = splat(cap * cap);
  const F4 px = splat(p.x);
  const F4 py = splat(p.y);
  const F4 nx = splat(normal.x);
  const F4 ny = splat(normal.y);
  grid.around(p, cap, [&](int from, int to) {
    for (int k = from; k < to; k += 4) {
      const std::size_t s = k;
      const F4 dx = load4(&grid.x[s]) - px;
      const F4 dy = load4(&grid.y[s]) - py;
      const I4 id = load4(&grid.id[s]);
      const F4 distance2 = max4(dx * dx + dy * dy, splat(1e-12f));
      // Points of the own chain give no curvature, and are infinitely far.
      const I4 ownChain = own.holds(id);
      const F4 curvature = select4(ownChain, splat(0), (nx * dx + ny * dy) / distance2);
      closest = min4(closest, select4(ownChain, splat(1e9f), distance2));
      left = max4(left, curvature);
      right = max4(right, -curvature);
    }
  });
  return {laneMax(left), laneMax(right), laneMin(closest)};
}

// Tells whether one of the next segments within the own chain heads backwards: only then can it meet this one.
bool turnsBack(const ClosedCurves& curves, int curve, int point) {
  const auto at = [&](int k) { return curves.points[k]; };
  int next = nextOf(curves, curve, point);
  const Vec2f first = at(next) - at(point);
  bool back = false;
  for (int k = 2; k <= kFollowing; ++k) {
    const int after = nextOf(curves, curve, next);
    back = back || dot(first, at(after) - at(next)) < 0;
    next = after;
  }
  return back;
}

// A segment that turns back may meet one of those that follow it, so that these are tight, too.
void markFollowing(const ClosedCurves& curves, std::vector<char>& tight) {
  for (int c = 0; c < curves.count(); ++c) {
    const int first = curves.begin[c];
    const int n = curves.size(c);
    int left = 0;
    for (int k = std::max(0, n - kOwnChain - 1); k < 2 * n; ++k) {  // from before the first point on
      const std::size_t i = first + (k < n ? k : k - n);
      if (tight[i] == 1) {
        left = kOwnChain + 1;
      } else if (left > 0) {
        tight[i] = 2;
        --left;
      }
    }
  }
}

}  // namespace

BeadGaps beadGaps(const ClosedCurves& curves, const BorderIndex& border, double spacing, float cap,
                  const RunContext& run) {
  // Gaps on either side (Eq. 16, taken separately to the left and to the right).
  const std::vector<std::int32_t> curveOf = curveOfPoints(curves);
  const std::size_t count = curves.points.size();
  BeadGaps gaps{std::vector<float>(count, cap), std::vector<float>(count, cap), std::vector<char>(count, 0)};
  const float tight = kTight * static_cast<float>(spacing);
  const PointGrid grid(curves.points, 0.75f * static_cast<float>(spacing), run);
  // Points are visited in path order, as the next point's buckets are mostly the same.
  parallelFor(run, grid.count(), 2048, [&](int begin, int end) {
    BorderDepth depth(border);
    for (int k = begin; k < end; ++k) {
      const std::size_t i = k;
      const int curve = curveOf[i];
      const Vec2f p = curves.points[i];
      const Vec2f tangent = tangentAt(curves, curve, k);
      const Vec2f normal{-tangent.y, tangent.x};
      const OwnChain own(k, curves.begin[curve], curves.size(curve), kOwnChain);
      Nearest nearest = nearestOn(grid, p, normal, cap, own);
      // The border counts as a neighbour at twice its distance, on the side on which it lies. Deeper inside, twice the
      // distance is more than the cap.
      if (const auto b = depth.nearerThan(0.5f * cap, p)) {
        const float along = dot(b->normal, normal);
        if (std::abs(along) > 0.5f) {
          const float curvature = std::abs(along) / std::max(2 * std::abs(b->distance), 1e-6f);
          float& side = along > 0 ? nearest.left : nearest.right;
          side = std::max(side, curvature);
        }
      }
      gaps.tight[i] = nearest.distance2 < tight * tight || turnsBack(curves, curve, k) ? 1 : 0;
      gaps.left[i] = 1 / nearest.left;
      gaps.right[i] = 1 / nearest.right;
    }
  });
  // Both segments of a place where the path may meet itself are tight.
  markFollowing(curves, gaps.tight);
  return gaps;
}

}  // namespace sillon
