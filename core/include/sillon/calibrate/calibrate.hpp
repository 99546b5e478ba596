// Small prints that teach the settings of a printer and a filament. Each lays out several values,
// and says which setting to type back.
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
#include "sillon/gcode/writer.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// Kinds of calibration prints.
enum class CalibrationKind {
  Flow,        ///< discs, each with a flow of its own
  Speed,       ///< rows, each with a speed of its own, once at that speed and once at constant flow
  Fan,         ///< strips, each with a fan of its own
  Width,       ///< a wedge of beads from 0.6 to 1.6 nozzle
  Directions,  ///< a star of 24 sectors in a dial
  Swatch,      ///< a card with the filament's name and settings
  Coupon,      ///< star, flow, width, ruler and corner marks in one
};

/// Returns the names that the command line uses ("flow", "speed", ...), in the order of
/// CalibrationKind.
const std::vector<std::string>& calibrationKinds();

/// The calibration print that is asked for.
struct CalibrationRequest {
  CalibrationKind kind = CalibrationKind::Coupon;
  std::optional<double> from;  ///< first value, in the kind's unit; unset: the kind's own
  std::optional<double> to;    ///< last value, likewise
  /// Project whose printer, print and toolpath settings, and whose names of profiles, count
  Project project;
};

/// One value that is tried, and its place on the plate.
struct CalibrationValue {
  std::string label;      ///< text written beside it
  double value = 0;       ///< value in the kind's unit
  Vec2 at;                ///< its middle on the plate, from the lower left [mm]
  std::size_t patch = 0;  ///< index of the first of its patches; 0 for the swatch
};

/// A calibration plate, ready to be written.
struct CalibrationPlate {
  CalibrationKind kind = CalibrationKind::Coupon;
  std::string setting;  ///< setting to type back: "print.flow"; several are separated by ", "
  std::string unit;     ///< unit of the values: "mm", "mm/s", "degrees", "%" or empty
  std::string advice;   ///< one sentence that tells which of the values is right
  std::vector<CalibrationValue> values;
  PatchPlate patches;  ///< shape and patches of the plate; no patches where `toolpath` has cycles
  Toolpath toolpath;   ///< path of the swatch; empty for other kinds
  Printer printer;
  PrintParams print;  ///< the project's, changed as the kind needs; its notes list the values
};

/// Lays out a calibration plate.
/// \return InvalidArgument (what is wrong, its value, its range), or the errors of generateToolpath
/// for the swatch. The bed and the hot end are checked only when the plate is written.
Result<CalibrationPlate> makeCalibration(const CalibrationRequest& request, const RunContext& run);

/// Writes the G-code of a plate, by writePatches or, for the swatch, by writeGcode.
/// \return the errors of that function.
Result<GcodeSummary> writeCalibration(const CalibrationPlate& plate, const GcodeSink& sink);

/// Makes cycles of the beads above the base, for previews. Widths are multiplied by the flow, so
/// that too low a flow leaves gaps.
Toolpath shownCalibration(const CalibrationPlate& plate);

// Reads a photograph of the coupon: how rough the filament's surface is, which flow closes it, and
// how wide its beads are. docs/internals/photographs.md says what a photograph can show of that.

/// A measured figure and its standard deviation.
struct Measured {
  double value = 0;
  double error = 0;
};

/// Facts that the photograph does not tell.
struct PhotoRequest {
  Project project;                  ///< project that made the coupon; only nozzle and flow count
  std::optional<double> from;       ///< first flow of the coupon; unset: the coupon's own
  std::optional<double> to;         ///< last flow of the coupon, likewise
  std::optional<double> lampSlope;  ///< Lamp::slope, 0..2; unset: any lamp up to kUnknownLampSlope
  /// Elevation of the lamp [degrees], measured to within 2, 10..80; unset: 47 to within 9
  std::optional<double> lampElevation;
};

/// Largest slope that is assumed for a lamp whose slope is not given; such a lamp looks small.
/// Rough surfaces and large lamps blur alike, so that no photograph tells them apart.
inline constexpr double kUnknownLampSlope = 0.03;

/// Results of one photograph, or of several that were joined.
struct CouponReading {
  Measured along;   ///< RMS slope along the bead, on the side that the nozzle passed over [degrees]
  Measured across;  ///< RMS slope across the bead, likewise [degrees]
  /// Lowest flow that closes the surface; none: it is out of range, or cannot be told
  std::optional<Measured> flow;
  bool flowIsLower = false;   ///< without `flow`: all discs are surely closed
  bool flowIsHigher = false;  ///< without `flow`: surely no disc is closed
  Measured width;             ///< width of a bead of one nozzle at the project's flow [mm]
  Measured azimuth;        ///< azimuth of the lamp in the coupon's own directions [degrees], 0..360
  Measured elevation;      ///< elevation of the lamp [degrees]
  double tilt = 0;         ///< angle between the camera and the coupon's normal [degrees]
  double pixelsPerMm = 0;  ///< resolution in the middle of the coupon
  double blur = 0;         ///< standard deviation of the picture's blur [mm]
  double veil = 0;  ///< stray light over the picture, relative to the light of the brightest beads
  /// Amount of an unsharp mask of 1.5 pixels that would look like it; 0: none
  double sharpening = 0;
  int lamps = 1;  ///< number of lamp positions that it was read under; see joinReadings
  /// sRGB colour of the beads that do not shine, where it is brightest
  std::array<std::uint8_t, 3> colour{};
};

/// Finds the coupon in a photograph and fits the appearance model to its spirals.
/// \param photograph  picture of 1 to 4 channels, at most 64 million pixels.
/// \return InvalidFile with one sentence if there is no coupon, or it is cut off, too small,
/// blurred, burnt or lit so that nothing can be measured; InvalidArgument, TooLarge, Cancelled.
Result<CouponReading> readCouponPhoto(const Image& photograph, const PhotoRequest& request,
                                      const RunContext& run);

/// Joins readings of several photographs of one coupon, weighted by their errors. Lamp and camera
/// are those of the first. Photographs whose lamps stand within 10 degrees of each other are wrong
/// in the same way, or are copies, and count as one.
/// \param request  the request that they were read with.
/// \return InvalidFile where one differs so much that it shows another spool.
Result<CouponReading> joinReadings(const std::vector<CouponReading>& readings,
                                   const PhotoRequest& request);

/// Writes a file of one spool, as readSpools takes it. Both nozzles and both sides get the slopes
/// of the side that was seen.
/// \param key  name of the spool: 1 to 40 letters, digits, - and _.
/// \param source  name of the person who measured it.
std::string spoolFile(const CouponReading& reading, std::string_view key, std::string_view source);

}  // namespace sillon
