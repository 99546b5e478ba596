// Zones of one colour, as pictures, outlines and slabs.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/signed_distance.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/export/export.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

// The picture of directions from which zones are cut, and the steps of cutting.

/// Directions of the cells of a page.
struct DirectionPicture {
  Grid grid;
  std::vector<char> inside;
  std::vector<float> degrees;  ///< 0 <= degrees < 180, counter-clockwise from +x
};

/// Angle between two directions [degrees], 0..90, because a direction equals its opposite.
inline double angleBetween(double a, double b) {
  const double d = std::fmod(std::abs(a - b), 180);
  return std::min(d, 180 - d);
}

/// Chooses at most `most` directions that approximate the picture's with the least mean square error; rising, in whole
/// tenths of a degree.
std::vector<double> zoneDirections(const DirectionPicture& picture, int most);

/// Gives each cell the index of a direction, -1 outside of the shape: the nearest one, smoothed along the borders of
/// zones. Places narrower than `least` [mm] or smaller than its square go to their neighbours. After cancelling, the
/// result is incomplete.
std::vector<std::int32_t> zoneLabels(const DirectionPicture& picture, const std::vector<double>& directions,
                                     double least, const RunContext& run);

/// Gives cells without a label that of the nearest ones, ring by ring. \param where  cells that may take one.
void spreadLabels(std::vector<std::int32_t>& label, const std::vector<char>& where, const Grid& grid);

// Borders of a picture of zones.

/// Traces the rings of each zone, inside on their left. Neighbours share their border, point for point, so that they
/// neither overlap nor leave a gap. Steps of cells become straight lines within 0.75 cells. \param zone  zone of each
/// cell, 0 to count - 1, row 0 at the bottom; cells that meet in a corner only are separated.
std::vector<std::vector<Ring>> zoneOutlines(std::vector<std::int32_t> zone, int count, const Grid& grid);

// Heights at which zones turn a slicer's lines.

/// A range of heights.
struct Slab {
  double bottom = 0;  ///< [mm]
  double top = 0;     ///< [mm]
};

/// Finds the slabs in which zones turn the lines, from the bottom up. A slab lies below each level top and each slope
/// that is gentle enough to show lines, and is as deep as the solid layers of usual settings. Between slabs the slicer
/// is free. The highest and lowest slab reach beyond the body. \param layerHeight  [mm], > 0. \param most  largest
/// number of slabs, at least 1; if there were more, one slab covers the whole body.
std::vector<Slab> slabsOf(const Mesh& body, double layerHeight, std::size_t most);

/// A slab below one top, as deep as those of slabsOf. It ends a layer above the top, because only the slicer knows
/// where that layer begins.
Slab slabUnder(double top, double layerHeight);

}  // namespace sillon
