// A photograph of the coupon, read back: how rough the filament's surface is, which flow closes it,
// how wide its beads are. docs/internals/photographs.md says what of that a photograph can show.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// A figure and one standard deviation of it.
struct Measured {
  double value = 0;
  double error = 0;
};

struct PhotoRequest {
  Project project;                  ///< that the coupon was made with; nozzle and flow count
  std::optional<double> from;       ///< its first flow; unset: the coupon's own
  std::optional<double> to;         ///< its last flow
  std::optional<double> lampSlope;  ///< Lamp::slope, 0..2; unset: any lamp up to kUnknownLampSlope
  std::optional<double> lampElevation;  ///< measured, within 2 degrees, 10..80; unset: 47 within 9
};

/// Slope of a lamp that looks small. Rough surfaces and large lamps blur alike: no photograph tells
/// them apart.
inline constexpr double kUnknownLampSlope = 0.03;

struct CouponReading {
  Measured along;   ///< RMS slope of the side that the nozzle passed over [degrees]
  Measured across;  ///< [degrees]
  /// The lowest that closes the surface; none: out of range, or cannot be told
  std::optional<Measured> flow;
  bool flowIsLower = false;   ///< without `flow`: all discs are closed, surely
  bool flowIsHigher = false;  ///< without `flow`: no disc is closed, surely
  Measured width;             ///< of a bead of one nozzle at the project's flow [mm]
  Measured azimuth;           ///< of the lamp, in the coupon's own directions [degrees], 0..360
  Measured elevation;         ///< [degrees]
  double tilt = 0;            ///< of the camera off the coupon's normal [degrees]
  double pixelsPerMm = 0;     ///< in the middle of the coupon
  double blur = 0;            ///< standard deviation [mm]
  double veil = 0;            ///< stray light over the picture, by the light of the brightest beads
  double sharpening = 0;  ///< amount of an unsharp mask of 1.5 pixels that looks like it; 0: none
  int lamps = 1;          ///< places of the lamp that it was read under; see joinReadings
  /// sRGB, of the beads that do not shine, as bright as it gets
  std::array<std::uint8_t, 3> colour{};
};

/// Finds the coupon, and fits the appearance model to its spirals.
/// \param photograph  1 to 4 channels, at most 64 million pixels.
/// \return InvalidFile with one sentence if there is no coupon, or it is cut off, too small,
/// blurred, burnt or lit so that nothing can be measured; InvalidArgument, TooLarge, Cancelled.
Result<CouponReading> readCouponPhoto(const Image& photograph, const PhotoRequest& request,
                                      const RunContext& run);

/// Joins readings of several photographs of one coupon, weighted by their error bars. Lamp and
/// camera are of the first. Photographs whose lamps stand within 10 degrees of each other are wrong
/// alike, or are copies, and count as one.
/// \param request  they were read with.
/// \return InvalidFile where one differs so much that it shows another spool.
Result<CouponReading> joinReadings(const std::vector<CouponReading>& readings,
                                   const PhotoRequest& request);

/// A file of one spool, as readSpools takes it. Both nozzles and both sides get the slopes of the
/// side that was seen.
/// \param key  1 to 40 letters, digits, - and _.
/// \param source  who measured it.
std::string spoolFile(const CouponReading& reading, std::string_view key, std::string_view source);

}  // namespace sillon
