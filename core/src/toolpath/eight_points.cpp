// Compiled for AVX2: no inline function of other files may be compiled here that linkers could take for all.
#include "toolpath/eight_points.hpp"

#if defined(SILLON_AVX2)

#include "base/eight_lanes.hpp"

namespace sillon {
namespace {

I8 abs8(I8 a) { return (I8)_mm256_abs_epi32((__m256i)a); }
F8 abs8(F8 a) { return (F8)((I8)a & Eight::all(INT32_MAX)); }

float leastLane(F8 v) {
  float least = v[0];
  for (int k = 1; k < kEight; ++k) least = v[k] < least ? v[k] : least;
  return least;
}

// Calls visit(k) for all points of the runs.
template <class Visit>
void forPoints(const PointRuns& runs, const Visit& visit) {
  for (int row = 0; row < runs.count; ++row) {
    const int end = runs.end[row * runs.stride];
    for (int k = runs.begin[row * runs.stride]; k < end; ++k) visit(k);
  }
}

}  // namespace

EightInRow eightInRow(const Vec2f* point, int id, int following, float cap) {
  constexpr int kMost = 2 * kEight;
  float x[kMost];
  float y[kMost];
  for (int k = 0; k < kEight + 1 + following; ++k) {
    x[k] = point[k - 1].x;
    y[k] = point[k - 1].y;
  }
  // Each as tangentAt of closed_curves.hpp and turnsBack of bead_gaps.cpp compute it.
  const F8 chordX = Eight::load(x + 2) - Eight::load(x);
  const F8 chordY = Eight::load(y + 2) - Eight::load(y);
  const F8 size = Eight::sqrt(chordX * chordX + chordY * chordY);
  const F8 inverse = Eight::all(1.0f) / size;
  const I8 moves = size > Eight::all(0.0f);
  const F8 tangentX = (F8)((I8)(chordX * inverse) & moves);
  const F8 tangentY = (F8)((I8)(chordY * inverse) & moves);
  const F8 firstX = Eight::load(x + 2) - Eight::load(x + 1);
  const F8 firstY = Eight::load(y + 2) - Eight::load(y + 1);
  I8 turnsBack = Eight::all(0);
  for (int k = 2; k <= following; ++k) {
    const F8 along =
        firstX * (Eight::load(x + k + 1) - Eight::load(x + k)) + firstY * (Eight::load(y + k + 1) - Eight::load(y + k));
    turnsBack |= along < Eight::all(0.0f);
  }
  EightInRow row;
  Eight::store(row.points.x, Eight::load(x + 1));
  Eight::store(row.points.y, Eight::load(y + 1));
  Eight::store(row.points.tangentX, tangentX);
  Eight::store(row.points.tangentY, tangentY);
  Eight::store(row.points.id, I8{0, 1, 2, 3, 4, 5, 6, 7} + id);
  Eight::store(row.turnsBack, turnsBack);
  const F8 half = Eight::all(0.5f * cap * 1.001f);  // rounding must leave nothing out
  const F8 reachX = half + half * abs8(tangentY);
  const F8 reachY = half + half * abs8(tangentX);
  row.lowX = leastLane(Eight::load(x + 1) - reachX);
  row.lowY = leastLane(Eight::load(y + 1) - reachY);
  row.highX = -leastLane(-Eight::load(x + 1) - reachX);
  row.highY = -leastLane(-Eight::load(y + 1) - reachY);
  return row;
}

EightNearest nearestOfEight(const SortedPoints& sorted, const PointRuns& runs, const EightPoints& points, float cap,
                            int ownChain) {
  const F8 px = Eight::load(points.x);
  const F8 py = Eight::load(points.y);
  const F8 nx = -Eight::load(points.tangentY);
  const F8 ny = Eight::load(points.tangentX);
  const I8 id = Eight::load(points.id);
  F8 left = Eight::all(1 / cap);
  F8 right = -left;
  F8 closest = Eight::all(cap * cap);
  forPoints(runs, [&](int k) {
    const F8 dx = Eight::all(sorted.x[k]) - px;
    const F8 dy = Eight::all(sorted.y[k]) - py;
    const F8 distance2 = Eight::max(dx * dx + dy * dy, Eight::all(1e-12f));
    const I8 other = abs8(Eight::all(sorted.id[k]) - id) > Eight::all(ownChain - 1);
    const F8 curvature = (F8)((I8)((nx * dx + ny * dy) / distance2) & other);
    closest = Eight::min(closest, other ? distance2 : Eight::all(1e9f));
    left = Eight::max(left, curvature);
    right = Eight::min(right, curvature);
  });
  EightNearest nearest;
  Eight::store(nearest.left, left);
  Eight::store(nearest.right, -right);
  Eight::store(nearest.distance2, closest);
  return nearest;
}

EightShares sharesOfEight(const SortedPoints& sorted, const float* sortedHalf, const PointRuns& runs,
                          const EightPoints& points, const EightBeads& beads, float ahead2, float most, int ownChain) {
  const F8 px = Eight::load(points.x);
  const F8 py = Eight::load(points.y);
  const F8 tx = Eight::load(points.tangentX);
  const F8 ty = Eight::load(points.tangentY);
  const I8 id = Eight::load(points.id);
  const F8 half = Eight::load(beads.half);
  F8 least = Eight::all(most);
  F8 second = Eight::all(1e30f);  // the next but one, to tell ties
  F8 to2OfLeast = Eight::all(0.0f);
  I8 beside = Eight::all(-1);
  forPoints(runs, [&](int k) {
    const F8 dx = Eight::all(sorted.x[k]) - px;
    const F8 dy = Eight::all(sorted.y[k]) - py;
    const F8 along = tx * dx + ty * dy;
    const F8 to2 = dx * dx + dy * dy;
    const F8 distance2 = to2 - Eight::min(along * along, Eight::all(ahead2));
    const F8 needed = Eight::max(half + Eight::all(sortedHalf[k]), Eight::all(1e-6f));
    const I8 point = Eight::all(sorted.id[k]);
    const I8 own = abs8(point - id) < Eight::all(ownChain);
    const F8 share2 = (F8)((I8)(distance2 / (needed * needed)) | own);  // of its own no number, which is never taken
    const I8 nearer = share2 < least;
    second = Eight::min(Eight::max(least, share2), second);
    to2OfLeast = nearer ? to2 : to2OfLeast;
    beside = nearer ? point : beside;
    least = Eight::min(share2, least);
  });
  EightShares shares;
  Eight::store(shares.factor2, least);
  Eight::store(shares.beside, beside);
  // Of equal shares the search from one point takes another, and what lies beyond its reach it may not see.
  Eight::store(shares.unsure, (second == least) | (to2OfLeast > Eight::load(beads.reach2)));
  return shares;
}

}  // namespace sillon

#endif
