#include "sillon/toolpath/bead_width.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/cancelled.hpp"
#include "base/parallel_for.hpp"
#include "base/simd.hpp"
#include "geometry/border_depth.hpp"
#include "geometry/closed_curves.hpp"
#include "geometry/point_grid.hpp"

namespace sillon {
namespace {

constexpr float kThread =
    0.002f;  ///< what a joint across a gap or a neck keeps, or the cycle would not print as one [tau]

constexpr float kWidthStep =
    0.006f;                 ///< of two points of which a move has to be the mean [mm]; see docs/internals/quality.md
constexpr int kRounds = 3;  ///< one to give way, two to grow; more gain less than 0.02 points of coverage
constexpr float kGrowth = 1.2f;      ///< at most, in one round
constexpr float kYielding = 0.995f;  ///< less is not worth another look: half of the time of this stage

constexpr int kOwnChain = 7;  ///< points tau/4 apart: a U-turn's legs do not count as neighbours of each other

// How wide beads may become between others: see holdApart.
struct WidthLimits {
  float spacing;  ///< [mm]
  float low;      ///< widths do not fall below it [mm]
  float allowed;  ///< overlap [mm]
  float growth;   ///< widths grow by no more than this factor
};

// Points lie tau/4 apart: the bead beside passes nearer than its nearest point, which is at most tau/8 ahead.
float ahead2(const WidthLimits& limits) { return limits.spacing * limits.spacing / 64; }

// How much wider a bead may be before it meets another.
struct Share {
  float factor;  // both give way, or grow, alike
  int beside;    // the point it would meet first; -1: none
};

// `width`, and the halves in `sortedHalf`, are as wide as moves are that meet there.
Share shareBeside(const PointGrid& grid, const std::vector<float>& sortedHalf, Vec2f p, Vec2f tangent, float width,
                  float reach, const WidthLimits& limits, const OwnChain& chain) {
  const F4 px = splat(p.x);
  const F4 py = splat(p.y);
  const F4 tx = splat(tangent.x);
  const F4 ty = splat(tangent.y);
  const F4 own = splat(0.5f * width - limits.allowed);
  const F4 mostAhead2 = splat(ahead2(limits));
  F4 least = splat(limits.growth * limits.growth);
  I4 beside = splatInt(-1);
  grid.around(p, reach, [&](int from, int to) {
    for (int k = from; k < to; k += 4) {
      const std::size_t s = static_cast<std::size_t>(k);
      const F4 dx = load4(&grid.x[s]) - px;
      const F4 dy = load4(&grid.y[s]) - py;
      const F4 along = tx * dx + ty * dy;
      const F4 distance2 = dx * dx + dy * dy - min4(along * along, mostAhead2);
      const F4 needed = max4(own + load4(&sortedHalf[s]), splat(1e-6f));
      const I4 id = load4(&grid.id[s]);
      const F4 share2 = select4(chain.holds(id), splat(limits.growth * limits.growth), distance2 / (needed * needed));
      beside = beside + ((share2 < least) & (id - beside));
      least = min4(least, share2);
    }
  });
  int lane = 0;
  for (int k = 1; k < 4; ++k) lane = least[k] < least[lane] ? k : lane;
  return {std::sqrt(least[lane]), beside[lane]};
}

// Widths that moves have at their ends: a written move has one width from end to end, the mean, so that beside a wider
// point it is wider than its own end by up to half the step. Longer steps are written as several moves.
std::vector<float> movesWidths(const ClosedCurves& curves, const std::vector<float>& width) {
  std::vector<float> widths(width.size());
  for (int c = 0; c < curves.count(); ++c) {
    for (int k = curves.begin[static_cast<std::size_t>(c)]; k < curves.begin[static_cast<std::size_t>(c) + 1]; ++k) {
      const std::size_t i = static_cast<std::size_t>(k);
      const float wider = std::max(width[static_cast<std::size_t>(previousOf(curves, c, k))],
                                   width[static_cast<std::size_t>(nextOf(curves, c, k))]);
      widths[i] = width[i] + 0.5f * std::clamp(wider - width[i], 0.0f, kWidthStep);
    }
  }
  return widths;
}

// Narrows beads where two would overlap by more than `allowed`. Then they grow again where a neighbour has given way to
// another: those that touch grow alike, so that none meets one that stays as it is.
void holdApart(const ClosedCurves& curves, const std::vector<std::int32_t>& curveOf, WidthLimits limits,
               std::vector<float>& width, const RunContext& run) {
  const PointGrid grid(curves.points, 0.75f * limits.spacing, run);
  const std::vector<float> wanted = width;
  std::vector<Share> shares(width.size(), {1, -1});
  std::vector<char> open(width.size(), 1);              // whether the width may still change; all at first, later a few
  std::vector<float> sortedHalf(grid.id.size(), 0.0f);  // as the grid has them, and no width for its padding
  for (int round = 0; round < kRounds && !run.cancelled(); ++round) {
    const std::vector<float> moves = movesWidths(curves, width);
    for (std::size_t s = 0; s < static_cast<std::size_t>(grid.count()); ++s) {
      sortedHalf[s] = 0.5f * moves[static_cast<std::size_t>(grid.id[s])];
    }
    const float widest = moves.empty() ? 0 : *std::max_element(moves.begin(), moves.end());
    const auto reachOf = [&](std::size_t i) {
      return std::max(limits.growth * (0.5f * (moves[i] + widest) - limits.allowed), 0.0f);
    };
    const auto note = [&](std::size_t i, Share share) {
      shares[i] = share;
      width[i] = std::min(wanted[i], std::max(std::min(limits.low, width[i]), width[i] * share.factor));
    };
    const auto look = [&](int k) {
      const std::size_t i = static_cast<std::size_t>(k);
      const int c = curveOf[i];
      const OwnChain chain(k, curves.begin[static_cast<std::size_t>(c)], curves.size(c), kOwnChain);
      note(i, shareBeside(grid, sortedHalf, curves.points[i], tangentAt(curves, c, k), moves[i], reachOf(i), limits,
                          chain));
    };
    parallelFor(run, grid.count(), 2048, [&](int begin, int end) {
      for (int k = begin; k < end; ++k) {
        const std::size_t i = static_cast<std::size_t>(k);
        if (open[i] == 0) continue;
        look(k);
      }
    });
    parallelFor(run, grid.count(), 8192, [&](int begin, int end) {
      for (int k = begin; k < end; ++k) {
        const std::size_t i = static_cast<std::size_t>(k);
        const int beside = shares[i].beside;
        const bool gaveWay =  // to another, so that there is room now
            beside >= 0 && shares[static_cast<std::size_t>(beside)].factor < kYielding * shares[i].factor;
        open[i] = static_cast<char>(open[i] != 0 && width[i] < wanted[i] && (round > 0 || gaveWay));
      }
    });
    limits.growth = kGrowth;
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
      const std::size_t i = static_cast<std::size_t>(k);
      const float least = std::min(gaps.left[i], gaps.right[i]);  // Eq. 16
      const float both = 0.5f * (gaps.left[i] + gaps.right[i]);
      float width = std::clamp(least + balance * (both - least), low, high);
      const Vec2f p = curves.points[i];
      const std::array<Vec2f, 2> neighbours = {
          curves.points[static_cast<std::size_t>(previousOf(curves, curveOf[i], k))],
          curves.points[static_cast<std::size_t>(nextOf(curves, curveOf[i], k))]};
      // Deeper than this the border limits no width of the bead between its neighbours.
      const float deep = 0.5f * high + 2 * tolerance + std::max(length(neighbours[0] - p), length(neighbours[1] - p));
      if (const auto at = depth.nearerThan(deep, p)) {
        // Half-way to the neighbours too: round a reflex corner the bead's straight segments pass nearer than its
        // points. And at a neighbour that lies outside: what reaches out to it is a thread from here on.
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
  // What simplification may still move counts as overlap already.
  const float allowed = static_cast<float>(params.beadOverlap * params.spacing - params.simplifyTolerance);
  holdApart(curves, curveOf, {spacing, low, allowed, 1}, widths.width, run);
  if (run.cancelled()) return cancelledRun();
  return widths;
}

}  // namespace sillon
