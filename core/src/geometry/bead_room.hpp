// Where a bead has room.
#pragma once

#include "sillon/geometry/signed_distance.hpp"

namespace sillon {

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
