// What photographs of one spool are off by alike: large lamps look like rough surfaces, and the model is not exact.
#pragma once

#include <cmath>
#include <numbers>
#include <optional>

#include "sillon/calibrate/read_photo.hpp"

namespace sillon {

inline constexpr double kModelShare = 0.03;  ///< of a slope, as rendered photographs have it

struct LampPart {
  double variance = 0;  ///< of slopes
  double error = 0;     ///< of `variance`
};

/// \param slope  of the lamp, known within a twentieth; unset: evenly spread up to kUnknownLampSlope.
inline LampPart lampPartOf(const std::optional<double>& slope) {
  if (slope) return {*slope * *slope, 0.1 * *slope * *slope};
  constexpr double kMost = kUnknownLampSlope * kUnknownLampSlope;
  return {kMost / 3, kMost * std::sqrt(4.0 / 45)};
}

/// Of a slope, out of that of its variance [degrees].
inline double slopeErrorOf(double degrees, double varianceError) {
  const double slope = std::tan(degrees * std::numbers::pi / 180);
  return varianceError / (2 * slope) / (1 + slope * slope) * 180 / std::numbers::pi;
}

}  // namespace sillon
