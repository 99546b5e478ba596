#include "geometry/bead_room.hpp"

namespace sillon {
namespace {

constexpr double kSlack = 1e-4;     ///< distance by which discs may stand out [tau]
constexpr int kPushes = 6;          ///< steps of the search; two suffice at smooth borders
constexpr double kAstray = 0.1;     ///< allowed detour; a disc further away is in another place [tau]
constexpr double kOpposite = -0.9;  ///< largest cosine between the normals of two opposite walls

}  // namespace

TouchingDiscs::TouchingDiscs(const BorderIndex& border, Vec2 p, double spacing)
    : border_(border), slack_(kSlack * spacing) {
  const NearestBorder nearest = border.nearest(p);
  inward_ = wide(nearest.normal) * -1.0;
  foot_ = p + inward_ * static_cast<double>(nearest.distance);
}

double TouchingDiscs::largest(double fitting, double tooLarge, int halvings) const {
  for (int k = 0; k < halvings; ++k) {
    const double middle = 0.5 * (fitting + tooLarge);
    (fits(middle) ? fitting : tooLarge) = middle;
  }
  return fitting;
}

bool hasBeadRoom(const BorderIndex& border, Vec2 p, double spacing) {
  const double radius = 0.5 * spacing;
  Vec2 centre = p;
  double furthest = 0;
  // Moves off the nearest border by the missing distance; near short edges, the new place may need another step.
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
  const TouchingDiscs discs(border, p, spacing);
  const double bead = 0.5 * spacing;
  const double widest = kWidestThin * spacing;
  if (!discs.fits(bead) || discs.fits(widest)) return false;
  const double radius = discs.largest(bead, widest, 8);
  return depth >= radius - static_cast<double>(missedDepth(cell)) && discs.facing(radius + 0.01 * spacing) < kOpposite;
}

}  // namespace sillon
