// The map from one plane onto another as a camera sees it, through pairs of points.
#pragma once

#include <vector>

#include "calibrate/space.hpp"

namespace sillon {

struct PointPair {
  Vec2 plate, pixel;
  double weight = 1;
  Vec2 first{1, 0}, second{0, 1};  ///< what is measured of the pixel: its products with these
};

/// Direct linear transform, on coordinates of about 1. At least four pairs, of which no three are in line.
/// \param side  of the plate [mm], whose middle gets depth 1. \return plate to pixels, homogeneous.
Mat3 mapThrough(const std::vector<PointPair>& pairs, double side);

/// What a map leaves of what is measured [pixels].
double leftOf(const PointPair& pair, const Mat3& map);

/// The same, where pairs count less the farther they are off, half at 0.1 mm: some are seen where they are not.
/// \param scale  [pixels/mm] \return weighted RMS of what is left, of what is measured [mm].
double fitMap(Mat3& map, const std::vector<PointPair>& pairs, double side, double scale);

}  // namespace sillon
