// Where a bead has room.
#pragma once

#include <optional>

#include "geometry/signed_distance.hpp"

namespace sillon {

// Depths of points inside a shape that are asked for one after the other, each near to the one before.

/// Depth changes by no more than a point moves, so that most points away from the border need no search, and most of
/// these not even a look at the index: on brain it halves both. What it answers does not depend on what was asked
/// before.
class BorderDepth {
 public:
  explicit BorderDepth(const BorderIndex& border) : border_(border) {}

  /// The border nearest to p, unless p lies `depth` [mm] or deeper inside.
  std::optional<NearestBorder> nearerThan(float depth, Vec2f p);

 private:
  const BorderIndex& border_;
  Vec2f at_{};
  float known_ = 0;  ///< at_ lies at least so deep
};

/// Discs that touch the border where it is nearest to a point inside. They may stand out by tau/10000.
class TouchingDiscs {
 public:
  /// \param p        a point inside
  /// \param spacing  tau [mm]
  TouchingDiscs(const BorderIndex& border, Vec2 p, double spacing);

  [[nodiscard]] bool fits(double radius) const { return static_cast<double>(at(radius).distance) <= slack_ - radius; }
  /// The largest radius that fits, of one that does and one that does not, halved so many times [mm].
  [[nodiscard]] double largest(double fitting, double tooLarge, int halvings) const;
  [[nodiscard]] Vec2 centre(double radius) const { return foot_ + inward_ * radius; }
  /// Cosine between the normal of the border here and the one nearest to a disc's centre: -1 of parallel walls.
  [[nodiscard]] double facing(double radius) const { return -dot(wide(at(radius).normal), inward_); }

 private:
  [[nodiscard]] NearestBorder at(double radius) const { return border_.nearest(centre(radius)); }

  const BorderIndex& border_;
  double slack_;
  Vec2 foot_;
  Vec2 inward_;
};

/// Whether a disc as wide as a bead lies inside whose centre is next to p, off the nearest border: points of a lattice
/// miss the middles of places hardly wider than a bead. Discs may stand out by tau/10000.
/// \param p        a point inside, less deep than spacing / 2
/// \param spacing  tau [mm]
bool hasBeadRoom(const BorderIndex& border, Vec2 p, double spacing);

inline constexpr double kWidestThin = 1.35 / 2;  ///< radius from which points tau/4 apart find the middle [tau]

/// Whether p lies next to the middle of a line that is wide enough for a bead, and for hardly more: between walls
/// that are parallel within 25 degrees, and from one bead to 2 kWidestThin beads apart.
/// \param depth  of p [mm], >= 0
/// \param cell   of a square lattice [mm]: one of its points is next to each point of the middle
bool isNextToThinMiddle(const BorderIndex& border, Vec2 p, double depth, double spacing, double cell);

/// How much less deep than half a bead a point of a square lattice may be that lies next to the middle of a place that
/// has room for a bead. \param cell  of the lattice [mm]
inline float missedDepth(double cell) { return static_cast<float>(0.7072 * cell); }

}  // namespace sillon
