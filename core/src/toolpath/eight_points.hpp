// What lies around eight points of a path at once, for processors with AVX2. Elsewhere, and next to the first point of
// a curve, bead_gaps.cpp and bead_width.cpp look around one point after the other, with the same result to the last
// bit. This takes half the time: eight points share the ends of the short loops, which processors cannot foretell.
#pragma once

#include <cstdint>

#include "geometry/point_grid.hpp"

namespace sillon {

constexpr int kEight = 8;

/// Points of one curve, a lane each.
struct EightPoints {
  alignas(32) float x[kEight];
  alignas(32) float y[kEight];
  alignas(32) float tangentX[kEight];
  alignas(32) float tangentY[kEight];
  alignas(32) std::int32_t id[kEight];  ///< of the point
};

/// What PointGrid sorts.
struct SortedPoints {
  const float* x;
  const float* y;
  const std::int32_t* id;
};

/// Eight points that follow each other, and what beadGaps() needs of the path around them.
struct EightInRow {
  EightPoints points;
  float lowX, lowY, highX, highY;  ///< box of all circles of diameter `cap` that touch the path at one of the points
  alignas(32) std::int32_t turnsBack[kEight];  ///< not 0 where one of the next segments heads backwards
};
/// \param point  the first of them; those before it and up to `following` after the last are of the same curve.
EightInRow eightInRow(const Vec2f* point, int id, int following, float cap);

/// As Nearest of bead_gaps.cpp.
struct EightNearest {
  alignas(32) float left[kEight];
  alignas(32) float right[kEight];
  alignas(32) float distance2[kEight];
};
/// \param ownChain  points with indices less than this apart are the same stretch of path.
EightNearest nearestOfEight(const SortedPoints& sorted, const PointRuns& runs, const EightPoints& points, float cap,
                            int ownChain);

/// What holdApart() of bead_width.cpp knows of the beads at the points.
struct EightBeads {
  alignas(32) float half[kEight];    ///< half the width, less what they may overlap
  alignas(32) float reach2[kEight];  ///< squared, of the search from one point
};

/// As Share of bead_width.cpp.
struct EightShares {
  alignas(32) float factor2[kEight];
  alignas(32) std::int32_t beside[kEight];
  alignas(32) std::int32_t unsure[kEight];  ///< not 0 where a search from this point alone may find another `beside`
};
/// \param sortedHalf  half the widths of the sorted points.
/// \param ahead2      what the squared distance along the path counts at most.
/// \param most        largest factor, squared.
EightShares sharesOfEight(const SortedPoints& sorted, const float* sortedHalf, const PointRuns& runs,
                          const EightPoints& points, const EightBeads& beads, float ahead2, float most, int ownChain);

}  // namespace sillon
