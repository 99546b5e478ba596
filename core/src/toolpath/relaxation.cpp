#include "toolpath/path.hpp"

#include <algorithm>

#include "base/free_memory.hpp"
#include "base/parallel_for.hpp"
#include "geometry/bead_room.hpp"
#include "geometry/closed_curves.hpp"
#include "toolpath/relaxation_steps.hpp"

namespace sillon {
namespace {

// Gaps wider than this count as this wide [tau]. It is also the width of a bead with nothing beside it.
constexpr float kCap = 1.5f;

// The largest move of a point in one round [tau].
constexpr float kMaxMove = 0.15f;

// Differences up to this [tau] are drift of the spacing. Evening them out tilts beads over long stretches: wave loses
// 0.0019 of alignment per round at a strength of 0.25. The difference beyond is room that a U-turn left, worth filling
// at once.
constexpr float kDrift = 0.24f;
constexpr float kVoidStrength = 0.7f;

// The least strength nearer to the border than one spacing, where U-turns lie.
constexpr float kBorderStrength = 0.2f;

// Keeping to lines leaves gaps uneven. Plates with pictures therefore have more rounds, for lines and gaps in turns
// (none more if one round is all there is), with at least this strength, and at most this smoothing: beads along the
// lines need less.
constexpr float kAskedStrength = 0.25f;
constexpr float kAskedSmoothing = 0.3f;
constexpr int kAskedRounds = 2;

// The pull of turning beads to lines: a move is felt over 18 points, or 4.5 tau. In the last but one round it is felt
// over 1.4 tau, so that the round that is left makes gaps even again.
constexpr float kAskedPull = 0.003f;
constexpr float kLastPull = 0.03f;

// Tries of a round with ever smaller moves, until the path does not meet itself. The later ones make no moves at all
// around crossings.
constexpr int kAttempts = 8;

// Cycles shorter than this [tau] are dots, which stay as they are.
constexpr float kDot = 1.8f;

// Computes the moves that even out gaps: towards the wider side, smoothed along the path with (1, 2, 4, 2, 1) / 10.
// They replace Eq. 15, which moves a point half-way to where its neighbours push it.
std::vector<Vec2f> movesOf(const ClosedCurves& curves, const BeadGaps& gaps, const BorderIndex& border, float spacing,
                           float strength, const RunContext& run) {
  const float atBorder = std::max(strength, kBorderStrength);
  std::vector<Vec2f> raw(curves.points.size());
  std::vector<Vec2f> moves(curves.points.size());
  for (int c = 0; c < curves.count(); ++c) {
    const int first = curves.begin[c];
    const int n = curves.size(c);
    parallelForEach(run, n, 8192, [&](int k) {
      const std::size_t i = first + k;
      const Vec2f tangent = tangentAt(curves, c, first + k);
      const Vec2 p = wide(curves.points[i]);
      const float part = border.blockDistance(p) < spacing ? atBorder : strength;
      const float difference = gaps.left[i] - gaps.right[i];
      const float drift = std::clamp(difference, -kDrift * spacing, kDrift * spacing);
      const float move =
          std::clamp(part * drift + kVoidStrength * (difference - drift), -kMaxMove * spacing, kMaxMove * spacing);
      raw[i] = Vec2f{-tangent.y, tangent.x} * move;
    });
    parallelForEach(run, n, 8192, [&](int k) {
      const auto at = [&](int offset) { return raw[first + wrapped(k + offset, n)]; };
      moves[first + k] = (at(-2) + at(2) + (at(-1) + at(1)) * 2.0f + at(0) * 4.0f) * 0.1f;
    });
  }
  return moves;
}

// Sends a point back to where it was if it would come nearer to the border than a quarter of a spacing and than it was.
Vec2f heldInside(Vec2f from, Vec2f to, const BorderIndex& border, BorderDepth& depth, float spacing) {
  const auto after = depth.nearerThan(0.25f * spacing, to);
  if (!after) return to;
  const float before = border.nearest(wide(from)).distance;
  return after->distance <= before ? to : from;
}

// Share of its move that each point makes. Points of cycles that are hardly more than a dot make none, as nothing
// inside of them keeps them from vanishing, and those that small_cycles made are round already.
std::vector<float> sharesOf(const ClosedCurves& curves, float spacing) {
  std::vector<float> share(curves.points.size(), 1.0f);
  for (int c = 0; c < curves.count(); ++c) {
    const int first = curves.begin[c];
    const float step = length(curves.points[first + 1] - curves.points[first]);
    if (step * static_cast<float>(curves.size(c)) < kDot * spacing)
      std::fill_n(share.begin() + first, curves.size(c), 0.0f);
  }
  return share;
}

// A round's moves of all points, to be scaled by their shares.
struct Moves {
  std::vector<Vec2f> by;
  float smoothing;  ///< pull of each point towards the middle of its neighbours
};

// Applies moves and smoothing, and holds points off the border. All points move at once, from the old places.
ClosedCurves moved(const ClosedCurves& curves, const Moves& moves, const std::vector<float>& share,
                   const BorderIndex& border, float spacing, const RunContext& run) {
  ClosedCurves out = curves;
  for (int c = 0; c < curves.count(); ++c) {
    const int first = curves.begin[c];
    const int n = curves.size(c);
    const auto at = [&](int k) {
      const std::size_t i = first + wrapped(k, n);
      return curves.points[i] + moves.by[i] * share[i];
    };
    parallelFor(run, n, 8192, [&](int begin, int end) {
      BorderDepth depth(border);
      for (int k = begin; k < end; ++k) {
        const std::size_t i = first + k;
        const Vec2f p = at(k);
        const Vec2f to = p + ((at(k - 1) + at(k + 1)) * 0.5f - p) * (moves.smoothing * share[i]);
        out.points[i] = heldInside(curves.points[i], to, border, depth, spacing);
      }
    });
  }
  return out;
}

}  // namespace

Result<Relaxed> relaxSpacing(ClosedCurves curves, const BorderIndex& border, const ToolpathParams& params,
                             const RunContext& run, const LineField* asked) {
  const float spacing = static_cast<float>(params.spacing);
  const float step = 0.25f * spacing;
  float smoothing = static_cast<float>(params.relaxationSmoothing);
  float strength = static_cast<float>(params.relaxationStrength);
  int rounds = params.relaxationRounds;
  if (asked != nullptr) {
    smoothing = std::min(smoothing, kAskedSmoothing);
    strength = std::max(strength, kAskedStrength);
    rounds += rounds > 1 ? kAskedRounds : 0;
  }
  // Equal steps of tau/4 to begin with, by a slower way if they would cut a corner and make the path meet itself.
  ClosedCurves path = resampled(curves, step, run);
  BeadGaps gaps = beadGaps(path, border, params.spacing, kCap * spacing, run);
  if (!findCrossings(path, run, gaps.tight).empty()) {
    path = resampledSimply(curves, step, run);
    gaps = beadGaps(path, border, params.spacing, kCap * spacing, run);
  }
  release(curves);
  // Each round: moves from the gaps, then attempts with smaller shares until the path is simple.
  for (int round = 0; round < rounds && !run.cancelled(); ++round) {
    const Moves moves{movesOf(path, gaps, border, spacing, strength, run), smoothing};
    std::vector<float> share = sharesOf(path, spacing);
    for (int attempt = 0; attempt < kAttempts && !run.cancelled(); ++attempt) {
      ClosedCurves to = moved(path, moves, share, border, spacing, run);
      // Turn beads towards the lines, but not in the last round: gaps must be even in the end.
      if (asked != nullptr && round + 1 < rounds) {
        const float pull = round + 2 < rounds ? kAskedPull : kLastPull;
        to = moved(to, {movesToLines(to, *asked, params.spacing, pull, run), 0}, share, border, spacing, run);
      }
      // Equal steps may cut corners where strands lie near to each other, however little was moved.
      ClosedCurves next = attempt == 0 ? resampled(to, step, run) : resampledSimply(to, step, run);
      // Round kinks in the last round only: smoothing points U-turns anew.
      if (round + 1 == rounds) roundKinks(next, border, params.spacing, run);
      BeadGaps nextGaps = beadGaps(next, border, params.spacing, kCap * spacing, run);
      // Segments of equal steps meet only where points lie near to each other; other segments may be longer, so that
      // all must be checked.
      const auto crossings = attempt == 0 ? findCrossings(next, run, nextGaps.tight) : findCrossings(next, run);
      if (crossings.empty()) {
        path = std::move(next);
        gaps = std::move(nextGaps);
        break;
      }
      damp(path, next, crossings, 8 << attempt, attempt < 3 ? 0.5f : 0.0f, share);
    }
    run.report((round + 1.0) / rounds);
  }
  if (run.cancelled()) return cancelledRun();
  return Relaxed{std::move(path), std::move(gaps)};
}

}  // namespace sillon
