#include <algorithm>
#include <cmath>

#include "base/parallel_for.hpp"
#include "geometry/point_grid.hpp"
#include "toolpath/path.hpp"

namespace sillon {
namespace {

constexpr int kOwnChain = 10;  ///< points along its curve that do not push a point: two spacings

// An edge of the lattice, from its lower or left node, and a point's place on it.
struct OnEdge {
  Vec2f from;
  Vec2f along;  ///< unit vector
  float at;     ///< [mm]
};

// Finds the lattice edge on which a contour's vertex lies.
OnEdge edgeOf(Vec2f point, const Grid& lattice) {
  const Vec2 node = lattice.centre(0, 0);
  const double x = (static_cast<double>(point.x) - node.x) / lattice.cell;
  const double y = (static_cast<double>(point.y) - node.y) / lattice.cell;
  // Contours keep off the nodes, so that only one of the two coordinates is a whole number.
  const bool horizontal = std::abs(y - std::round(y)) < std::abs(x - std::round(x));
  const Vec2 from = lattice.centre(static_cast<int>(horizontal ? std::floor(x) : std::round(x)),
                                   static_cast<int>(horizontal ? std::round(y) : std::floor(y)));
  const Vec2f begin{static_cast<float>(from.x), static_cast<float>(from.y)};
  return {begin, horizontal ? Vec2f{1, 0} : Vec2f{0, 1}, horizontal ? point.x - begin.x : point.y - begin.y};
}

// Place at which the circle around `centre` cuts the edge's line nearest to the point; the point itself if it does not.
float cutNearest(const OnEdge& edge, Vec2f centre, float radius) {
  const Vec2f to = centre - edge.from;
  const float middle = dot(to, edge.along);
  const float across2 = dot(to, to) - middle * middle;
  const float half2 = radius * radius - across2;
  if (half2 <= 0) return edge.at;
  const float half = std::sqrt(half2);
  return edge.at < middle ? middle - half : middle + half;
}

}  // namespace

// Eq. 15: every vertex moves half-way to the mean of the places at which circles of tau/2 around its neighbours cut its
// edge. All vertices of a round move at once, from the old places.
ClosedCurves repulsed(ClosedCurves curves, const Grid& lattice, const ToolpathParams& params, const RunContext& run) {
  if (params.repulsionRounds == 0) return curves;
  const float reach = 0.5f * static_cast<float>(params.spacing);
  const float cell = static_cast<float>(lattice.cell);
  // The curve of each point tells which points are its own chain.
  std::vector<int> curveOf(curves.points.size());
  for (int c = 0; c < curves.count(); ++c) {
    std::fill(curveOf.begin() + curves.begin[c], curveOf.begin() + curves.begin[c + 1], c);
  }
  for (int round = 0; round < params.repulsionRounds && !run.cancelled(); ++round) {
    // Nearer points than half a spacing push, unless they are the bead's own.
    const PointGrid grid(curves.points, reach, run);
    std::vector<Vec2f> moved = curves.points;
    parallelForEach(run, static_cast<int>(moved.size()), 4096, [&](int i) {
      const OnEdge edge = edgeOf(curves.points[i], lattice);
      const int size = curves.size(curveOf[i]);
      float sum = 0;
      int neighbours = 0;
      grid.around(curves.points[i], reach, [&](int first, int last) {
        for (int k = first; k < last; ++k) {
          const int j = grid.id[k];
          const Vec2f other{grid.x[k], grid.y[k]};
          if (length(other - curves.points[i]) >= reach) continue;
          const int apart = std::abs(i - j);
          if (curveOf[i] == curveOf[j] && std::min(apart, size - apart) <= kOwnChain) continue;
          sum += cutNearest(edge, other, reach);
          ++neighbours;
        }
      });
      if (neighbours == 0) return;
      // Half-way, and held off the ends of the edge as contours are.
      const float to = 0.5f * (edge.at + sum / static_cast<float>(neighbours));
      moved[i] = edge.from + edge.along * std::clamp(to, kMinRoot * cell, (1 - kMinRoot) * cell);
    });
    curves.points = std::move(moved);
  }
  return curves;
}

}  // namespace sillon
