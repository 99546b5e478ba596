#include "toolpath/path.hpp"

#include <algorithm>

#include "base/fast_math.hpp"
#include "geometry/closed_curves.hpp"
#include "geometry/point_grid.hpp"

namespace sillon {
namespace {

constexpr float kShallow = 0.05f;  ///< depth [tau]; a cycle that gets no deeper inside holds no bead
constexpr float kDot = 1;          ///< longest cycle that may be left out [tau]
constexpr float kBeside = 0.5f;    ///< distance of a longer cycle within which a dot is left out [tau]
constexpr float kTurn = 2.25f;     ///< longest cycle that may become a circle [tau]
constexpr int kFewest = 7;  ///< points of a circle, at least: with six, a quarter of a spacing apart, each is a kink
constexpr float kBorder = 0.15f;  ///< least distance of a circle from the border [tau]
constexpr float kAlone = 1.25f;   ///< distance of a cycle [tau] that will be joined to the dot: no circle is needed
constexpr int kLook = 8;          ///< places looked at on either side for the deepest one
constexpr float kLookStep = 1.0f / 16;  ///< distance of these places [tau]

// Decides for each short cycle whether it is left out, becomes a circle or stays.
class Settling {
 public:
  Settling(const ClosedCurves& curves, const BorderIndex& border, float spacing, const RunContext& run)
      : curves_(curves),
        border_(border),
        spacing_(spacing),
        curveOf_(curveOfPoints(curves)),
        grid_(curves.points, spacing, run) {
    // Lengths only matter up to kTurn, so that long cycles need not be walked to their end.
    for (int c = 0; c < curves.count(); ++c) {
      float size = 0;
      for (int k = begin(c); k < begin(c + 1) && size < kTurn * spacing; ++k)
        size += length(at(nextOf(curves, c, k)) - at(k));
      size_.push_back(size);
    }
  }

  [[nodiscard]] bool isTiny(int c) const { return size_[c] < kTurn * spacing_; }

  // Tells whether the cycle lies so near to the border all round that its bead would be next to nothing: spurs and
  // cracks of drawings whose sides fall together. A tiny cycle may still have a deeper place nearby.
  [[nodiscard]] bool hasNoRoom(int c) const {
    const float shallow = -kShallow * spacing_;
    for (int k = begin(c); k < begin(c + 1); ++k) {
      if (distanceAt(at(k)) < shallow) return false;
    }
    return !isTiny(c) || distanceAt(deepestNear(c)) >= shallow;
  }

  // Tells whether a longer cycle runs beside a dot, with no border between. Of two as long, the one of lower index
  // counts as longer, so that one of them stays.
  [[nodiscard]] bool isBesideLonger(int c) const {
    const float mine = size_[c];
    return mine < kDot * spacing_ && hasBeside(c, kBeside, [&](int other) {
             const float its = size_[other];
             return its > mine || (its == mine && other < c);
           });
  }

  // Makes a circle of the cycle's own length at the deepest place nearby, or a smaller one where there is no room for
  // it; empty where no circle fits.
  [[nodiscard]] std::vector<Vec2f> circleFor(int c) const {
    if (!isAlone(c)) return {};
    const Vec2f centre = deepestNear(c);
    // Try regular polygons with sides of tau/4, from the own number of points down to the fewest that can be printed.
    const float own = 4 * size_[c] / spacing_;
    for (int n = std::max(kFewest, static_cast<int>(own + 0.5f)); n >= kFewest; --n) {
      const float sense = runsLeft(c) ? 1.0f : -1.0f;  // contours keep what they go round on one side
      const SinCos half = sinCos(sense * kPi / static_cast<float>(n));
      const SinCos turn = sinCos(2 * sense * kPi / static_cast<float>(n));
      std::vector<Vec2f> circle;
      Vec2f arm{0.125f * spacing_ / half.sin, 0};  // for sides of tau/4
      bool fits = true;
      for (int k = 0; k < n; ++k) {
        circle.push_back(centre + arm);
        fits = fits && distanceAt(circle.back()) <= -kBorder * spacing_;
        arm = {arm.x * turn.cos - arm.y * turn.sin, arm.x * turn.sin + arm.y * turn.cos};
      }
      if (fits) return circle;
    }
    return {};
  }

 private:
  // Tells whether one of the other cycles for which wanted(cycle) holds comes within `reach` [tau], with no border
  // between.
  template <class Wanted>
  [[nodiscard]] bool hasBeside(int c, float reach, const Wanted& wanted) const {
    bool beside = false;
    for (int k = begin(c); k < begin(c + 1) && !beside; ++k) {
      const Vec2f p = at(k);
      grid_.around(p, reach * spacing_, [&](int first, int last) {
        for (int s = first; s < last && !beside; ++s) {
          const int id = grid_.id[s];
          const int other = curveOf_[id];
          beside = other != c && length(at(id) - p) <= reach * spacing_ && wanted(other) && isInside(p, at(id));
        }
      });
    }
    return beside;
  }
  [[nodiscard]] bool isAlone(int c) const {
    return !hasBeside(c, kAlone, [](int) { return true; });
  }
  // The sign of the area tells the sense of travel (shoelace formula).
  [[nodiscard]] bool runsLeft(int c) const {
    float area = 0;
    for (int k = begin(c); k < begin(c + 1); ++k) {
      area += cross(at(k) - at(begin(c)), at(nextOf(curves_, c, k)) - at(begin(c)));
    }
    return area > 0;
  }
  [[nodiscard]] int begin(int c) const { return curves_.begin[c]; }
  [[nodiscard]] Vec2f at(int point) const { return curves_.points[point]; }
  [[nodiscard]] float distanceAt(Vec2f p) const { return border_.nearest(wide(p)).distance; }
  // Samples the line between two points; it must not leave the shape.
  [[nodiscard]] bool isInside(Vec2f a, Vec2f b) const {
    for (int k = 1; k < 8; ++k) {
      const Vec2f p = a + (b - a) * (static_cast<float>(k) / 8);
      if (border_.outside(wide(p))) return false;
    }
    return true;
  }
  // Searches a lattice around the cycle's centre, then a finer one around the best place, for the greatest depth.
  [[nodiscard]] Vec2f deepestNear(int c) const {
    Vec2f deepest{0, 0};
    for (int k = begin(c); k < begin(c + 1); ++k) deepest = deepest + at(k) * (1 / static_cast<float>(curves_.size(c)));
    float depth = distanceAt(deepest);
    for (const float step : {kLookStep * spacing_, kLookStep * spacing_ / kLook}) {
      const Vec2f middle = deepest;
      for (int y = -kLook; y <= kLook; ++y) {
        for (int x = -kLook; x <= kLook; ++x) {
          const Vec2f p = middle + Vec2f{static_cast<float>(x), static_cast<float>(y)} * step;
          const float distance = distanceAt(p);
          if (distance >= depth) continue;
          depth = distance;
          deepest = p;
        }
      }
    }
    return deepest;
  }

  const ClosedCurves& curves_;
  const BorderIndex& border_;
  float spacing_;
  std::vector<std::int32_t> curveOf_;
  PointGrid grid_;
  std::vector<float> size_;  ///< length of each cycle, as far as it counts [mm]
};

}  // namespace

// Leaves out cycles without room and dots beside longer cycles, makes circles of other tiny ones, and copies the rest.
ClosedCurves regularizeSmallCycles(const ClosedCurves& curves, const BorderIndex& border, double spacing,
                                   const RunContext& run) {
  const Settling settling(curves, border, static_cast<float>(spacing), run);
  ClosedCurves settled;
  settled.begin.push_back(0);
  for (int c = 0; c < curves.count() && !run.cancelled(); ++c) {
    std::vector<Vec2f> circle;
    // The order matters: a cycle without room must not become a circle.
    if (settling.hasNoRoom(c)) continue;
    if (settling.isTiny(c)) {
      if (settling.isBesideLonger(c)) continue;
      circle = settling.circleFor(c);
    }
    if (circle.empty()) {
      settled.points.insert(settled.points.end(), curves.points.begin() + curves.begin[c],
                            curves.points.begin() + curves.begin[c + 1]);
    } else {
      settled.points.insert(settled.points.end(), circle.begin(), circle.end());
    }
    settled.begin.push_back(static_cast<int>(settled.points.size()));
  }
  return settled;
}

}  // namespace sillon
