#include "toolpath/relaxation_steps.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/bead_room.hpp"
#include "geometry/point_grid.hpp"

namespace sillon {
namespace {

constexpr int kPasses = 2;        ///< rounds over all points: a kink that is bent may leave another
constexpr float kSuspect = 0.9f;  ///< cosine of 26 degrees; points that turn by less are no kinks
constexpr float kKink =
    0.56f;  ///< cosine of the turn within tau/4 that is too sharp: 56 degrees, as points are rounded to 1 µm later
constexpr int kFixed = 3;  ///< points looked at on either side of those that move

// Compares the angle between two vectors with one of a given cosine, without square roots.
bool turnsMore(Vec2f u, Vec2f v, float cosine) {
  const float d = dot(u, v);
  return d * std::abs(d) < cosine * cosine * dot(u, u) * dot(v, v);
}

// Tells whether the headings of two pieces of tau/8 that lie tau/4 apart differ too much, wherever the first begins.
// Samples are tau/16 apart, so that the result does not depend on where the points are.
bool hasKink(const std::vector<Vec2f>& path, float spacing) {
  const float step = spacing / 16;
  std::vector<Vec2f> samples;
  samples.reserve(8 * path.size());  // points are some four steps apart
  float at = 0;                      // distance from a segment's begin to the next sample
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    const Vec2f along = path[k + 1] - path[k];
    const float size = length(along);
    for (; at < size; at += step) samples.push_back(path[k] + along * (at / size));
    at -= size;
  }
  for (std::size_t k = 0; k + 6 < samples.size(); ++k) {
    if (turnsMore(samples[k + 2] - samples[k], samples[k + 6] - samples[k + 4], kKink)) return true;
  }
  return false;
}

// A way to take a kink away. Bending moves the path least; shortening pulls the tip of a U-turn back to where its legs
// lie further apart.
struct Remedy {
  bool shorten;
  int half;         ///< points moved on either side of the kink
  int sweeps;       ///< most sweeps of straighten()
  float mostMoved;  ///< largest move of a point [tau]
  float border;     ///< points come no nearer to the border than this, or than the path is [tau]
};
// The remedies in order, the gentlest first: few points bent by little, then more points nearer to the border, then
// shortening.
constexpr Remedy kRemedies[] = {{false, 1, 30, 0.5f, 0.25f}, {false, 2, 30, 0.5f, 0.25f}, {false, 3, 30, 0.5f, 0.25f},
                                {false, 3, 60, 0.7f, 0.18f}, {false, 5, 90, 1, 0.18f},    {false, 7, 120, 1, 0.18f},
                                {true, 3, 60, 0.5f, 0.18f},  {true, 5, 120, 1.5f, 0.18f}, {true, 8, 240, 2, 0.18f},
                                {true, 12, 480, 3, 0.18f}};

// One step towards the least sum of squared second differences (bending), or of squared first ones (shortening); then
// equal steps again, without which points gather where the path turns most. The first and the last `kFixed` points
// stay.
void straighten(std::vector<Vec2f>& p, bool shorten) {
  const std::size_t begin = kFixed - 1;
  const std::size_t end = p.size() - kFixed;
  for (std::size_t k = begin + 1; k < end; ++k) {
    p[k] = shorten ? (p[k - 1] + p[k + 1]) * 0.5f : ((p[k - 1] + p[k + 1]) * 4.0f - p[k - 2] - p[k + 2]) * (1.0f / 6);
  }
  // Resample the moved stretch in equal steps.
  float total = 0;
  for (std::size_t k = begin; k < end; ++k) total += length(p[k + 1] - p[k]);
  const float step = total / static_cast<float>(end - begin);
  const std::vector<Vec2f> q = p;
  std::size_t k = begin;
  float passed = 0;  // length up to q[k]
  for (std::size_t m = begin + 1; m < end; ++m) {
    const float wanted = step * static_cast<float>(m - begin);
    float size = length(q[k + 1] - q[k]);
    for (; passed + size < wanted && k + 1 < end; size = length(q[k + 1] - q[k])) {
      passed += size;
      ++k;
    }
    if (size > 0) p[m] = q[k] + (q[k + 1] - q[k]) * std::min(1.0f, (wanted - passed) / size);
  }
}

// Rounds kinks of a path one by one, and makes sure that no move lets the path meet itself.
class Rounding {
 public:
  Rounding(ClosedCurves& curves, const BorderIndex& border, float spacing, const RunContext& run)
      : curves_(curves), border_(border), spacing_(spacing), curveOf_(curveOfPoints(curves)), run_(run) {}

  // Tries the remedies in order until one does, so that as few points as possible move.
  void roundAt(int point) {
    for (const Remedy& remedy : kRemedies) {
      if (isRound(point, remedy)) return;
    }
  }

 private:
  [[nodiscard]] Vec2f at(int id) const { return curves_.points[id]; }
  void put(const std::vector<int>& ids, const std::vector<Vec2f>& points) {
    for (std::size_t k = 0; k < ids.size(); ++k) curves_.points[ids[k]] = points[k];
  }

  // Tells whether there is no kink at a point, or the remedy took it away.
  bool isRound(int point, const Remedy& remedy) {
    const int curve = curveOf_[point];
    const int count = 2 * (remedy.half + kFixed) + 1;
    if (count > curves_.size(curve)) return false;
    // The stretch around the point, with the fixed points at both ends.
    std::vector<int> ids{point};
    while (static_cast<int>(ids.size()) <= remedy.half + kFixed) ids.push_back(previousOf(curves_, curve, ids.back()));
    std::reverse(ids.begin(), ids.end());
    while (static_cast<int>(ids.size()) < count) ids.push_back(nextOf(curves_, curve, ids.back()));
    std::vector<Vec2f> before;
    before.reserve(ids.size());
    for (const int id : ids) before.push_back(at(id));
    if (!hasKink(before, spacing_)) return true;
    // Straighten until the kink is gone; give up if that moves points too far or takes too long.
    std::vector<Vec2f> after = before;
    bool stays = true;
    for (int sweep = 0; sweep < remedy.sweeps && stays; ++sweep) {
      straighten(after, remedy.shorten);
      stays = hasKink(after, spacing_);
    }
    if (stays || movesTooFar(before, after, remedy)) return false;
    if (!grid_) grid_.emplace(curves_.points, spacing_, run_);  // takes half of the time: one grid serves all passes
    if (run_.cancelled()) return false;                         // the grid may be half made
    // Take the moves back if the path would meet itself.
    put(ids, after);
    if (!meets(ids, remedy.mostMoved)) {
      for (std::size_t k = 0; k < ids.size(); ++k) moved_ = std::max(moved_, length(after[k] - before[k]));
      return true;
    }
    put(ids, before);
    return false;
  }

  // Tells whether a point moves more than the remedy allows, or comes nearer to the border than it may.
  [[nodiscard]] bool movesTooFar(const std::vector<Vec2f>& before, const std::vector<Vec2f>& after,
                                 const Remedy& remedy) const {
    const float kept = remedy.border * spacing_;
    BorderDepth depth(border_);
    float nearest = -kept;
    for (const Vec2f p : before) {
      if (const auto border = depth.nearerThan(kept, p)) nearest = std::max(nearest, border->distance);
    }
    for (std::size_t k = kFixed; k + kFixed < after.size(); ++k) {
      if (length(after[k] - before[k]) > remedy.mostMoved * spacing_) return true;
      const auto border = depth.nearerThan(kept, after[k]);
      if (border && border->distance > nearest) return true;
    }
    return false;
  }

  // Tells whether one of the segments that moved meets any other.
  [[nodiscard]] bool meets(const std::vector<int>& ids, float mostMoved) const {
    bool met = false;
    for (std::size_t k = kFixed - 1; k + kFixed < ids.size() && !met; ++k) {
      const int a = ids[k];
      const int b = ids[k + 1];
      // Segments are about tau/4 long, and points may have moved since the grid was made.
      grid_->around(at(a), (1 + mostMoved) * spacing_ + moved_, [&](int first, int last) {
        for (int s = first; s < last && !met; ++s) {
          const int c = grid_->id[s];
          const int d = nextOf(curves_, curveOf_[c], c);
          if (c != a && c != b && d != a) met = segmentsMeet(at(a), at(b), at(c), at(d));
        }
      });
    }
    return met;
  }

  ClosedCurves& curves_;
  const BorderIndex& border_;
  float spacing_;
  std::vector<std::int32_t> curveOf_;
  const RunContext& run_;
  std::optional<PointGrid> grid_;  ///< the points as they were before the first moved
  float moved_ = 0;                ///< farthest move of any point in one go since [mm]
};

}  // namespace

void roundKinks(ClosedCurves& curves, const BorderIndex& border, double spacing, const RunContext& run) {
  const auto at = [&](int id) { return curves.points[id]; };
  std::optional<Rounding> rounding;
  for (int pass = 0; pass < kPasses && !run.cancelled(); ++pass) {
    // Points whose two segments differ by 26 degrees or more are looked at closely; few are.
    std::vector<int> suspects;
    for (int c = 0; c < curves.count(); ++c) {
      const int end = curves.begin[c + 1];
      for (int k = curves.begin[c]; k < end; ++k) {
        const Vec2f p = at(k);
        if (turnsMore(p - at(previousOf(curves, c, k)), at(nextOf(curves, c, k)) - p, kSuspect)) suspects.push_back(k);
      }
    }
    if (suspects.empty()) return;
    if (!rounding) rounding.emplace(curves, border, static_cast<float>(spacing), run);
    for (const int point : suspects) rounding->roundAt(point);
  }
}

}  // namespace sillon
