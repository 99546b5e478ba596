#include "sillon/toolpath/bead_gaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel_for.hpp"
#include "base/simd.hpp"
#include "geometry/closed_curves.hpp"
#include "geometry/point_grid.hpp"

namespace sillon {
namespace {

constexpr int kOwnChain = 4;          ///< points tau/4 apart
constexpr float kTight = 0.3f;        ///< segments of tau/4 can only meet if ends of theirs are nearer than this [tau]
constexpr double kBorderReach = 1.2;  ///< the border is a neighbour nearer than this [tau]
constexpr float kBeyond = 1.001f;     ///< of the box looked through, so that rounding leaves nothing out

// Up to four points that follow each other on a curve, a lane each: they look through the same box. A box of its own
// for each takes a tenth longer, although it is smaller: presumably since processors cannot foretell the ends of its
// short loops.
struct Four {
  std::array<int, 4> id;  ///< the last one repeated where there are fewer
  F4 x, y;
  F4 nx, ny;  ///< normals
};

// Curvatures 1/g of the touching circles, the largest on either side.
struct Nearest {
  F4 left;
  F4 right;
  F4 distance2;  ///< to the nearest point of another piece
};

Four fourFrom(const ClosedCurves& curves, int curve, int begin, int end) {
  Four four;
  for (int k = 0; k < 4; ++k) {
    const int id = std::min(begin + k, end - 1);
    const Vec2f p = curves.points[static_cast<std::size_t>(id)];
    const Vec2f tangent = tangentAt(curves, curve, id);
    four.id[static_cast<std::size_t>(k)] = id;
    four.x[k] = p.x;
    four.y[k] = p.y;
    four.nx[k] = -tangent.y;
    four.ny[k] = tangent.x;
  }
  return four;
}

float laneMin(F4 v) { return std::min(std::min(v[0], v[1]), std::min(v[2], v[3])); }
float laneMax(F4 v) { return std::max(std::max(v[0], v[1]), std::max(v[2], v[3])); }

// Over all sorted points: (N . to) / |to|² is the signed curvature of the circle through `to` touching the path at p.
Nearest nearestOn(const PointGrid& grid, const Four& p, float cap, const OwnChain& own) {
  Nearest nearest{splat(1 / cap), splat(1 / cap), splat(cap * cap)};
  // Circles as wide as `cap` that touch the path at p lie in a box half as high as wide if it runs along an axis.
  const F4 half = splat(0.5f * kBeyond * cap);
  const F4 reachX = half + half * abs4(p.nx);
  const F4 reachY = half + half * abs4(p.ny);
  const Vec2f low{laneMin(p.x - reachX), laneMin(p.y - reachY)};
  const Vec2f high{laneMax(p.x + reachX), laneMax(p.y + reachY)};
  grid.within(low, high, [&](int from, int to) {
    for (int k = from; k < to; ++k) {
      const std::size_t s = static_cast<std::size_t>(k);
      const F4 dx = splat(grid.x[s]) - p.x;
      const F4 dy = splat(grid.y[s]) - p.y;
      const F4 distance2 = max4(dx * dx + dy * dy, splat(1e-12f));
      const I4 ownChain = own.holds(splatInt(grid.id[s]));
      const F4 curvature = select4(ownChain, splat(0), (p.nx * dx + p.ny * dy) / distance2);
      nearest.distance2 = min4(nearest.distance2, select4(ownChain, splat(1e9f), distance2));
      nearest.left = max4(nearest.left, curvature);
      nearest.right = max4(nearest.right, -curvature);
    }
  });
  return nearest;
}

// Whether one of the next segments within the own chain heads backwards: only then can it meet this one.
bool turnsBack(const ClosedCurves& curves, int curve, int point) {
  const auto at = [&](int k) { return curves.points[static_cast<std::size_t>(k)]; };
  int next = nextOf(curves, curve, point);
  const Vec2f first = at(next) - at(point);
  bool back = false;
  for (int k = 1; k <= kOwnChain + 1; ++k) {
    const int after = nextOf(curves, curve, next);
    back = back || dot(first, at(after) - at(next)) < 0;
    next = after;
  }
  return back;
}

// A segment that turns back meets one of those that follow: both are tight.
void markFollowing(const ClosedCurves& curves, std::vector<char>& tight) {
  for (int c = 0; c < curves.count(); ++c) {
    const int first = curves.begin[static_cast<std::size_t>(c)];
    const int n = curves.size(c);
    int left = 0;
    for (int k = std::max(0, n - kOwnChain - 1); k < 2 * n; ++k) {  // from before the first point on
      const std::size_t i = static_cast<std::size_t>(first + (k < n ? k : k - n));
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

Vec2f tangentAt(const ClosedCurves& curves, int curve, int point) {
  const Vec2f chord = curves.points[static_cast<std::size_t>(nextOf(curves, curve, point))] -
                      curves.points[static_cast<std::size_t>(previousOf(curves, curve, point))];
  const float size = length(chord);
  return size > 0 ? chord * (1 / size) : Vec2f{};
}

BeadGaps beadGaps(const ClosedCurves& curves, const BorderIndex& border, double spacing, float cap,
                  const RunContext& run) {
  const std::vector<std::int32_t> curveOf = curveOfPoints(curves);
  const std::size_t count = curves.points.size();
  BeadGaps gaps{std::vector<float>(count, cap), std::vector<float>(count, cap), std::vector<char>(count, 0)};
  const float tight = kTight * static_cast<float>(spacing);
  const PointGrid grid(curves.points, 0.75f * static_cast<float>(spacing), run);
  // In path order: the next point's buckets are mostly the same.
  parallelFor(run, grid.count(), 2048, [&](int begin, int end) {
    for (int k = begin; k < end;) {
      const int curve = curveOf[static_cast<std::size_t>(k)];
      const int first = curves.begin[static_cast<std::size_t>(curve)];
      const Four four = fourFrom(curves, curve, k, std::min(end, first + curves.size(curve)));
      const Nearest nearest = nearestOn(grid, four, cap, OwnChain(four.id, first, curves.size(curve), kOwnChain));
      for (int lane = 0; lane < 4 && k == four.id[static_cast<std::size_t>(lane)]; ++lane, ++k) {
        const std::size_t i = static_cast<std::size_t>(k);
        const Vec2f normal{four.nx[lane], four.ny[lane]};
        float left = nearest.left[lane];
        float right = nearest.right[lane];
        const Vec2 at{static_cast<double>(four.x[lane]), static_cast<double>(four.y[lane])};
        if (static_cast<double>(border.blockDistance(at)) < kBorderReach * spacing) {
          const NearestBorder b = border.nearest(at);
          const float along = dot(b.normal, normal);
          if (static_cast<double>(b.distance) > -kBorderReach * spacing && std::abs(along) > 0.5f) {
            const float curvature = std::abs(along) / std::max(2 * std::abs(b.distance), 1e-6f);
            (along > 0 ? left : right) = std::max(along > 0 ? left : right, curvature);
          }
        }
        gaps.tight[i] = nearest.distance2[lane] < tight * tight || turnsBack(curves, curve, k) ? 1 : 0;
        gaps.left[i] = 1 / left;
        gaps.right[i] = 1 / right;
      }
    }
  });
  markFollowing(curves, gaps.tight);
  return gaps;
}

}  // namespace sillon
