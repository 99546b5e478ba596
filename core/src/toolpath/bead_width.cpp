#include "toolpath/path.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel_for.hpp"
#include "base/simd.hpp"
#include "geometry/bead_room.hpp"
#include "geometry/closed_curves.hpp"
#include "geometry/point_grid.hpp"

namespace sillon {
namespace {

// A joint across a gap or a neck keeps at least this width [tau]. It is far too little to be seen, and without any the
// cycle would not print as one.
constexpr float kThread = 0.002f;

// A written move has the mean width of its ends, so that it is too wide at the narrower one. Beads leave room for steps
// up to this [mm]. Larger: more stays uncovered; smaller: written moves overlap (docs/internals/quality.md).
constexpr float kWidthStep = 0.006f;

// The first round lets beads give way, the others let them grow again. More rounds gain less than 0.02 points of
// coverage.
constexpr int kRounds = 3;

// Beads grow by no more than this factor in one round. It also sets how far each point looks for others.
constexpr float kGrowth = 1.2f;

// A neighbour has given way to another bead if it is narrowed to less than this share of what this bead is. Looking
// again at smaller differences would take half of the time of this stage.
constexpr float kYielding = 0.995f;

// Points of the same curve fewer than this many steps of tau/4 away are no neighbours: the legs of a U-turn must not
// count as neighbours of each other round its tip.
constexpr int kOwnChain = 7;

// Limits of the widths that holdApart gives beads.
struct WidthLimits {
  float spacing;  ///< [mm]
  float low;      ///< widths do not fall below it [mm]
  float allowed;  ///< largest overlap of two beads [mm]
};

// Factor by which a bead may be wider before it meets another.
struct SharedRoom {
  float factor = 1;  ///< the same for both beads: both give way, or grow, alike
  int beside = -1;   ///< the point that the bead would meet first; -1: none
};

// Widths of moves at their ends. A written move has one width from end to end, the mean, so that beside a wider point
// it is wider than its own end by up to half the step. Longer steps are written as several moves.
std::vector<float> movesWidths(const ClosedCurves& curves, const std::vector<float>& width) {
  std::vector<float> widths(width.size());
  for (int c = 0; c < curves.count(); ++c) {
    for (int k = curves.begin[c]; k < curves.begin[c + 1]; ++k) {
      const std::size_t i = k;
      const float wider = std::max(width[previousOf(curves, c, k)], width[nextOf(curves, c, k)]);
      widths[i] = width[i] + 0.5f * std::clamp(wider - width[i], 0.0f, kWidthStep);
    }
  }
  return widths;
}

// All beads of a path, each as wide as the moves that meet at its points.
class WideBeads {
 public:
  WideBeads(const ClosedCurves& curves, const std::vector<std::int32_t>& curveOf, const PointGrid& grid,
            const WidthLimits& limits)
      : curves_(curves), curveOf_(curveOf), grid_(grid), limits_(limits), sortedHalf_(grid.id.size(), 0.0f) {}

  void setWidths(const std::vector<float>& width) {
    moves_ = movesWidths(curves_, width);
    widest_ = moves_.empty() ? 0 : *std::max_element(moves_.begin(), moves_.end());
    for (std::size_t s = 0, count = grid_.count(); s < count; ++s) {
      sortedHalf_[s] = 0.5f * moves_[grid_.id[s]];
    }
  }

  /// Computes by which factor a point's bead and each of its neighbours may be scaled until they overlap by no more
  /// than is allowed, and returns the smallest. \param growth  the largest factor looked for.
  [[nodiscard]] SharedRoom shareOf(int point, float growth) const {
    const std::size_t i = point;
    const int c = curveOf_[i];
    const OwnChain chain(point, curves_.begin[c], curves_.size(c), kOwnChain);
    const float reach = std::max(growth * (0.5f * (moves_[i] + widest_) - limits_.allowed), 0.0f);
    // Points lie tau/4 apart: the bead beside passes nearer than its nearest point, which is at most tau/8 ahead.
    const F4 mostAhead2 = splat(limits_.spacing * limits_.spacing / 64);
    const Vec2f tangent = tangentAt(curves_, c, point);
    const F4 px = splat(curves_.points[i].x);
    const F4 py = splat(curves_.points[i].y);
    const F4 tx = splat(tangent.x);
    const F4 ty = splat(tangent.y);
    const F4 own = splat(0.5f * moves_[i] - limits_.allowed);
    const F4 most = splat(growth * growth);
    F4 least = most;
    I4 beside = splatInt(-1);
    grid_.around(curves_.points[i], reach, [&](int from, int to) {
      for (int k = from; k < to; k += 4) {
        const std::size_t s = k;
        const F4 dx = load4(&grid_.x[s]) - px;
        const F4 dy = load4(&grid_.y[s]) - py;
        const F4 along = tx * dx + ty * dy;
        const F4 distance2 = dx * dx + dy * dy - min4(along * along, mostAhead2);
        const F4 needed = max4(own + load4(&sortedHalf_[s]), splat(1e-6f));
        const I4 id = load4(&grid_.id[s]);
        const F4 share2 = select4(chain.holds(id), most, distance2 / (needed * needed));
        beside = beside + ((share2 < least) & (id - beside));
        least = min4(least, share2);
      }
    });
    int lane = 0;
    for (int k = 1; k < 4; ++k) lane = least[k] < least[lane] ? k : lane;
    return {std::sqrt(least[lane]), beside[lane]};
  }

 private:
  const ClosedCurves& curves_;
  const std::vector<std::int32_t>& curveOf_;
  const PointGrid& grid_;
  const WidthLimits& limits_;
  std::vector<float> moves_;       ///< widths of moves, by points of the path
  std::vector<float> sortedHalf_;  ///< half of these in the grid's order; the padding has width 0
  float widest_ = 0;
};

// Tells whether the bead that a point would meet first has given way to a third one, so that there is room now.
bool gaveWay(const std::vector<SharedRoom>& shares, std::size_t point) {
  const SharedRoom& share = shares[point];
  return share.beside >= 0 && shares[share.beside].factor < kYielding * share.factor;
}

// Narrows beads where two would overlap by more than `allowed`. Then they grow again where a neighbour has given way to
// another: beads that touch grow alike, so that none meets one that stays as it is.
void holdApart(const ClosedCurves& curves, const std::vector<std::int32_t>& curveOf, const WidthLimits& limits,
               std::vector<float>& width, const RunContext& run) {
  const PointGrid grid(curves.points, 0.75f * limits.spacing, run);
  WideBeads beads(curves, curveOf, grid, limits);
  const std::vector<float> wanted = width;
  std::vector<SharedRoom> shares(width.size());
  std::vector<char> open(width.size(), 1);  // tells whether the width may still change: all at first, later a few
  for (int round = 0; round < kRounds && !run.cancelled(); ++round) {
    const float growth = round == 0 ? 1 : kGrowth;
    beads.setWidths(width);
    parallelForEach(run, grid.count(), 2048, [&](std::size_t i) {
      if (open[i] == 0) return;
      shares[i] = beads.shareOf(static_cast<int>(i), growth);
      const float least = std::min(limits.low, width[i]);
      width[i] = std::min(wanted[i], std::max(least, width[i] * shares[i].factor));
    });
    parallelForEach(run, grid.count(), 8192, [&](std::size_t i) {
      const bool mayGrow = width[i] < wanted[i] && (round > 0 || gaveWay(shares, i));
      open[i] = static_cast<char>(open[i] != 0 && mayGrow);
    });
  }
}

}  // namespace

Result<BeadWidths> beadWidths(const ClosedCurves& curves, const BeadGaps& gaps, const BorderIndex& border,
                              const ToolpathParams& params, const RunContext& run) {
  const float spacing = static_cast<float>(params.spacing);
  const float low = static_cast<float>(params.minWidth) * spacing;
  const float balance = static_cast<float>(params.widthBalance);
  const float high = static_cast<float>(params.maxWidth) * spacing;
  BeadWidths widths{std::vector<float>(curves.points.size()), std::vector<float>(curves.points.size(), 1e9f)};
  const std::vector<std::int32_t> curveOf = curveOfPoints(curves);
  const float tolerance = static_cast<float>(params.simplifyTolerance);
  parallelFor(run, static_cast<int>(curves.points.size()), 4096, [&](int begin, int end) {
    BorderDepth depth(border);
    for (int k = begin; k < end; ++k) {
      const std::size_t i = k;
      const float least = std::min(gaps.left[i], gaps.right[i]);  // Eq. 16
      const float both = 0.5f * (gaps.left[i] + gaps.right[i]);
      float width = std::clamp(least + balance * (both - least), low, high);
      const Vec2f p = curves.points[i];
      const std::array<Vec2f, 2> neighbours = {curves.points[previousOf(curves, curveOf[i], k)],
                                               curves.points[nextOf(curves, curveOf[i], k)]};
      // Deeper than this the border limits no width of the bead between its neighbours.
      const float deep = 0.5f * high + 2 * tolerance + std::max(length(neighbours[0] - p), length(neighbours[1] - p));
      if (const auto at = depth.nearerThan(deep, p)) {
        // Look half-way to the neighbours, too: round a reflex corner the bead's straight segments pass nearer to the
        // border than its points. If a neighbour lies outside, the bead that reaches out to it is a thread from this
        // point on.
        float distance = at->distance;
        for (const Vec2f end : neighbours) {
          const Vec2f q = (p + end) * 0.5f;
          distance = std::max(distance, border.nearest(wide(q)).distance);
          if (distance > -0.25f * spacing && border.outside(wide(end))) distance = 0;
        }
        widths.limit[i] = std::max(-2 * distance, kThread * spacing);
        width = std::min(width, widths.limit[i]);
      }
      widths.width[i] = width;
    }
  });
  // Simplification may still move points by its tolerance: count that as overlap already.
  const float allowed = static_cast<float>(params.beadOverlap * params.spacing - params.simplifyTolerance);
  holdApart(curves, curveOf, {spacing, low, allowed}, widths.width, run);
  if (run.cancelled()) return cancelledRun();
  return widths;
}

}  // namespace sillon
