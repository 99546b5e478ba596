// Small prints that teach the settings of a printer and a filament. Each lays out several values,
// and says which setting to type back.
#pragma once

#include <optional>
#include <string>
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

}  // namespace sillon
