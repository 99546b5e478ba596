#include "geometry/bead_room.hpp"

namespace sillon {
namespace {

constexpr double kSlack = 1e-4;  ///< by which discs may stand out [tau]
constexpr int kPushes = 6;
constexpr double kAstray = 0.1;     ///< further than straight there: another place [tau]
constexpr double kOpposite = -0.9;  ///< cosine between the normals of two walls

// Discs that touch the border where it is nearest to a point.
struct Touching {
  const BorderIndex& border;
  Vec2 foot;
  Vec2 inward;
  double slack;

  Touching(const BorderIndex& index, Vec2 p, double spacing) : border(index), slack(kSlack * spacing) {
    const NearestBorder nearest = index.nearest(p);
    inward = wide(nearest.normal) * -1.0;
    foot = p + inward * static_cast<double>(nearest.distance);
  }
  [[nodiscard]] NearestBorder at(double radius) const { return border.nearest(foot + inward * radius); }
  [[nodiscard]] bool fits(double radius) const { return static_cast<double>(at(radius).distance) <= slack - radius; }
};

}  // namespace

bool hasBeadRoom(const BorderIndex& border, Vec2 p, double spacing) {
  const double radius = 0.5 * spacing;
  Vec2 centre = p;
  double furthest = 0;
  // Off the nearest border by what is missing; borders of short edges push again, from somewhere else.
  for (int push = 0; push < kPushes; ++push) {
    const NearestBorder nearest = border.nearest(centre);
    const double missing = radius + static_cast<double>(nearest.distance);
    if (missing <= kSlack * spacing) return true;
    if (push == 0) furthest = missing + kAstray * spacing;
    centre = centre - wide(nearest.normal) * missing;
    if (length(centre - p) > furthest) return false;
  }
  return false;
}

bool isNextToThinMiddle(const BorderIndex& border, Vec2 p, double depth, double spacing, double cell) {
  const Touching disc(border, p, spacing);
  double low = 0.5 * spacing;
  double high = kWidestThin * spacing;
  if (!disc.fits(low) || disc.fits(high)) return false;
  for (int k = 0; k < 8; ++k) {
    const double middle = 0.5 * (low + high);
    (disc.fits(middle) ? low : high) = middle;
  }
  if (depth < low - static_cast<double>(missedDepth(cell))) return false;
  return dot(wide(disc.at(high + 0.01 * spacing).normal), disc.inward) > -kOpposite;
}

}  // namespace sillon
