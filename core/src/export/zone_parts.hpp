// Zones of one colour, as pictures, outlines and slabs.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/signed_distance.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/export/zones.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

// The picture of directions that zones are cut from, and the steps of cutting it.

/// Directions of the cells of a page.
struct DirectionPicture {
  Grid grid;
  std::vector<char> inside;
  std::vector<float> degrees;  ///< 0 <= degrees < 180, counter-clockwise from +x
};

/// Angle between two directions, which are the same after half a turn: 0..90 [degrees].
inline double angleBetween(double a, double b) {
  const double d = std::fmod(std::abs(a - b), 180);
  return std::min(d, 180 - d);
}

/// At most `most` directions that are nearest to the picture's in the mean square, rising, in whole tenths.
std::vector<double> zoneDirections(const DirectionPicture& picture, int most);

/// Gives each cell one of the directions, -1 outside of the shape: the nearest ones, as even as their borders allow;
/// what is narrower than `least` [mm] or smaller than its square goes to its neighbours. Of a cancelled run of no use.
std::vector<std::int32_t> zoneLabels(const DirectionPicture& picture, const std::vector<double>& directions,
                                     double least, const RunContext& run);

/// Cells without a label take that of the nearest ones, ring by ring. \param where  which may.
void spreadLabels(std::vector<std::int32_t>& label, const std::vector<char>& where, const Grid& grid);

// The borders of a picture of zones.

/// Rings of each zone, inside on their left. Neighbours share their border, point for point, so that they neither
/// overlap nor leave a gap; steps of cells become straight lines within 0.75 cells.
/// \param zone  of each cell, 0 to count - 1, row 0 below; zones that meet in a corner only are parted there.
std::vector<std::vector<Ring>> zoneOutlines(std::vector<std::int32_t> zone, int count, const Grid& grid);

// The heights at which zones set a slicer's lines.

struct Slab {
  double bottom = 0;  ///< [mm]
  double top = 0;     ///< [mm]
};

/// From the bottom up: as deep as the solid layers of usual settings below each level top and each slope that is gentle
/// enough to show lines. What lies between them is left to the slicer. The highest and lowest slab go on beyond the
/// body. \param layerHeight  [mm], > 0. \param most  slabs, at least 1; where there would be more, one reaches through
/// the whole body.
std::vector<Slab> slabsOf(const Mesh& body, double layerHeight, std::size_t most);

/// A slab as deep as those of slabsOf, up to a layer above the top: only the slicer knows where that layer begins.
Slab slabUnder(double top, double layerHeight);

}  // namespace sillon
