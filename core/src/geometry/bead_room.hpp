// Tests whether a bead has room at a point.
#pragma once

#include <optional>

#include "geometry/signed_distance.hpp"

namespace sillon {

// Queries for the depths of points inside a shape, each point near the one before.

/// Answers depth queries with few searches. Depth changes by no more than a point moves, so that most points away from
/// the border need no search, and most of these not even a look at the index; on the shape "brain" both costs halve. An
/// answer does not depend on earlier queries.
class BorderDepth {
 public:
  explicit BorderDepth(const BorderIndex& border) : border_(border) {}

  /// Returns the border nearest to p, unless p lies `depth` [mm] or deeper inside.
  std::optional<NearestBorder> nearerThan(float depth, Vec2f p);

 private:
  const BorderIndex& border_;
  Vec2f at_{};
  float known_ = 0;  ///< lower bound of the depth of at_ [mm]
};

/// Discs that touch the border at the point nearest to a given point inside. They may stand out by tau/10000.
class TouchingDiscs {
 public:
  /// \param p        a point inside
  /// \param spacing  tau [mm]
  TouchingDiscs(const BorderIndex& border, Vec2 p, double spacing);

  [[nodiscard]] bool fits(double radius) const { return static_cast<double>(at(radius).distance) <= slack_ - radius; }
  /// Finds the largest radius that fits [mm] by bisection between one that fits and one that does not.
  [[nodiscard]] double largest(double fitting, double tooLarge, int halvings) const;
  [[nodiscard]] Vec2 centre(double radius) const { return foot_ + inward_ * radius; }
  /// Returns the cosine between the normal at the touched border point and the normal nearest to the disc's centre; -1
  /// for parallel walls.
  [[nodiscard]] double facing(double radius) const { return -dot(wide(at(radius).normal), inward_); }

 private:
  [[nodiscard]] NearestBorder at(double radius) const { return border_.nearest(centre(radius)); }

  const BorderIndex& border_;
  double slack_;
  Vec2 foot_;
  Vec2 inward_;
};

/// Tells whether a disc as wide as a bead lies inside with its centre near p, off the nearest border. Points of a
/// lattice miss the middles of places hardly wider than a bead. Discs may stand out by tau/10000.
/// \param p        a point inside, less deep than spacing / 2
/// \param spacing  tau [mm]
bool hasBeadRoom(const BorderIndex& border, Vec2 p, double spacing);

inline constexpr double kWidestThin = 1.35 / 2;  ///< radius from which on points tau/4 apart find the middle [tau]

/// Tells whether p lies next to the middle of a line that is hardly wider than a bead: between walls that are parallel
/// within 25 degrees, and one bead to 2 kWidestThin beads apart.
/// \param depth  depth of p [mm], >= 0
/// \param cell   cell of a square lattice [mm]; each point of the middle has one of the lattice's points next to it
bool isNextToThinMiddle(const BorderIndex& border, Vec2 p, double depth, double spacing, double cell);

/// Returns how much shallower than half a bead a lattice point may be that lies next to the middle of a place with room
/// for a bead. \param cell  cell of the lattice [mm]
inline float missedDepth(double cell) { return static_cast<float>(0.7072 * cell); }

}  // namespace sillon
