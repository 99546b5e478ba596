// Compiled for AVX2: no inline function of other files may be compiled here that linkers could take for all.
#include "toolpath/eight_points.hpp"

#if defined(SILLON_AVX2)

#include "base/eight_lanes.hpp"

namespace sillon {
namespace {

F8 load8(const float* p) { return Eight::load(p); }
I8 load8(const std::int32_t* p) { return Eight::load(p); }
void store8(float* p, F8 v) { Eight::store(p, v); }
void store8(std::int32_t* p, I8 v) { Eight::store(p, v); }
F8 splat8(float v) { return Eight::all(v); }
I8 splat8(std::int32_t v) { return Eight::all(v); }
I8 abs8(I8 a) { return (I8)_mm256_abs_epi32((__m256i)a); }
F8 abs8(F8 a) { return (F8)((I8)a & splat8(INT32_MAX)); }
F8 sqrt8(F8 a) { return Eight::sqrt(a); }
F8 max8(F8 a, F8 b) { return Eight::max(a, b); }
F8 min8(F8 a, F8 b) { return Eight::min(a, b); }

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
  // Each as tangentAt and turnsBack of bead_gaps.cpp compute it.
  const F8 chordX = load8(x + 2) - load8(x);
  const F8 chordY = load8(y + 2) - load8(y);
  const F8 size = sqrt8(chordX * chordX + chordY * chordY);
  const F8 inverse = splat8(1.0f) / size;
  const I8 moves = size > splat8(0.0f);
  const F8 tangentX = (F8)((I8)(chordX * inverse) & moves);
  const F8 tangentY = (F8)((I8)(chordY * inverse) & moves);
  const F8 firstX = load8(x + 2) - load8(x + 1);
  const F8 firstY = load8(y + 2) - load8(y + 1);
  I8 turnsBack = splat8(0);
  for (int k = 2; k <= following; ++k) {
    const F8 along = firstX * (load8(x + k + 1) - load8(x + k)) + firstY * (load8(y + k + 1) - load8(y + k));
    turnsBack |= along < splat8(0.0f);
  }
  EightInRow row;
  store8(row.points.x, load8(x + 1));
  store8(row.points.y, load8(y + 1));
  store8(row.points.tangentX, tangentX);
  store8(row.points.tangentY, tangentY);
  store8(row.points.id, I8{0, 1, 2, 3, 4, 5, 6, 7} + id);
  store8(row.turnsBack, turnsBack);
  const F8 half = splat8(0.5f * cap * 1.001f);  // rounding must leave nothing out
  const F8 reachX = half + half * abs8(tangentY);
  const F8 reachY = half + half * abs8(tangentX);
  row.lowX = leastLane(load8(x + 1) - reachX);
  row.lowY = leastLane(load8(y + 1) - reachY);
  row.highX = -leastLane(-load8(x + 1) - reachX);
  row.highY = -leastLane(-load8(y + 1) - reachY);
  return row;
}

EightNearest nearestOfEight(const SortedPoints& sorted, const PointRuns& runs, const EightPoints& points, float cap,
                            int ownChain) {
  const F8 px = load8(points.x);
  const F8 py = load8(points.y);
  const F8 nx = -load8(points.tangentY);
  const F8 ny = load8(points.tangentX);
  const I8 id = load8(points.id);
  F8 left = splat8(1 / cap);
  F8 right = -left;
  F8 closest = splat8(cap * cap);
  forPoints(runs, [&](int k) {
    const F8 dx = splat8(sorted.x[k]) - px;
    const F8 dy = splat8(sorted.y[k]) - py;
    const F8 distance2 = max8(dx * dx + dy * dy, splat8(1e-12f));
    const I8 other = abs8(splat8(sorted.id[k]) - id) > splat8(ownChain - 1);
    const F8 curvature = (F8)((I8)((nx * dx + ny * dy) / distance2) & other);
    closest = min8(closest, other ? distance2 : splat8(1e9f));
    left = max8(left, curvature);
    right = min8(right, curvature);
  });
  EightNearest nearest;
  store8(nearest.left, left);
  store8(nearest.right, -right);
  store8(nearest.distance2, closest);
  return nearest;
}

EightShares sharesOfEight(const SortedPoints& sorted, const float* sortedHalf, const PointRuns& runs,
                          const EightPoints& points, const EightBeads& beads, float ahead2, float most, int ownChain) {
  const F8 px = load8(points.x);
  const F8 py = load8(points.y);
  const F8 tx = load8(points.tangentX);
  const F8 ty = load8(points.tangentY);
  const I8 id = load8(points.id);
  const F8 half = load8(beads.half);
  F8 least = splat8(most);
  F8 second = splat8(1e30f);  // the next but one, to tell ties
  F8 to2OfLeast = splat8(0.0f);
  I8 beside = splat8(-1);
  forPoints(runs, [&](int k) {
    const F8 dx = splat8(sorted.x[k]) - px;
    const F8 dy = splat8(sorted.y[k]) - py;
    const F8 along = tx * dx + ty * dy;
    const F8 to2 = dx * dx + dy * dy;
    const F8 distance2 = to2 - min8(along * along, splat8(ahead2));
    const F8 needed = max8(half + splat8(sortedHalf[k]), splat8(1e-6f));
    const I8 point = splat8(sorted.id[k]);
    const I8 own = abs8(point - id) < splat8(ownChain);
    const F8 share2 = (F8)((I8)(distance2 / (needed * needed)) | own);  // of its own no number, which is never taken
    const I8 nearer = share2 < least;
    second = min8(max8(least, share2), second);
    to2OfLeast = nearer ? to2 : to2OfLeast;
    beside = nearer ? point : beside;
    least = min8(share2, least);
  });
  EightShares shares;
  store8(shares.factor2, least);
  store8(shares.beside, beside);
  // Of equal shares the search from one point takes another, and what lies beyond its reach it may not see.
  store8(shares.unsure, (second == least) | (to2OfLeast > load8(beads.reach2)));
  return shares;
}

}  // namespace sillon

#endif
