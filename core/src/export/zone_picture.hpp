// What zones are cut from: the directions as a picture, and the steps of cutting it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "sillon/base/run_context.hpp"
#include "sillon/geometry/grid.hpp"

namespace sillon {

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

/// Which of the directions each cell takes, -1 outside of the shape: the nearest ones, as even as their borders allow;
/// what is narrower than `least` [mm] or smaller than its square goes to its neighbours. Of a cancelled run of no use.
std::vector<std::int32_t> zoneLabels(const DirectionPicture& picture, const std::vector<double>& directions,
                                     double least, const RunContext& run);

/// Cells without a label take that of the nearest ones, ring by ring. \param where  which may.
void spreadLabels(std::vector<std::int32_t>& label, const std::vector<char>& where, const Grid& grid);

}  // namespace sillon
