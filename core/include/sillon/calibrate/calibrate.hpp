// Small prints that teach a printer's and a filament's settings: which values lie where, and what to type back.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/gcode/patches.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

enum class CalibrationKind {
  Flow,        ///< discs
  Speed,       ///< rows, at one speed and at one flow
  Fan,         ///< strips
  Width,       ///< a wedge of beads from 0.6 to 1.6 nozzle
  Directions,  ///< a star of 24 sectors in a dial
  Swatch,      ///< a card with the filament's name and settings
  Coupon,      ///< star, flow, width, ruler and corner marks in one
};

/// "flow", "speed", ...: as the command line calls them, in the order of CalibrationKind.
const std::vector<std::string>& calibrationKinds();

struct CalibrationRequest {
  CalibrationKind kind = CalibrationKind::Coupon;
  std::optional<double> from;  ///< first value, in the kind's unit; unset: the kind's own
  std::optional<double> to;    ///< last value
  Project project;             ///< of which printer, print and toolpath count, and the names of the profiles
};

/// A value that was tried, and where.
struct CalibrationValue {
  std::string label;      ///< as written beside it
  double value = 0;       ///< in the kind's unit
  Vec2 at;                ///< its middle on the plate, from the lower left [mm]
  std::size_t patch = 0;  ///< the first of its patches; of the swatch, 0
};

/// A plate, ready to be written.
struct CalibrationPlate {
  CalibrationKind kind = CalibrationKind::Coupon;
  std::string setting;  ///< what to type back: "print.flow"; of several, separated by ", "
  std::string unit;     ///< of the values: "mm", "mm/s", "degrees", "%" or empty
  std::string advice;   ///< one sentence: which of the values is right
  std::vector<CalibrationValue> values;
  PatchPlate patches;  ///< without patches where `toolpath` has cycles
  Toolpath toolpath;   ///< of the swatch
  Printer printer;
  PrintParams print;  ///< the project's, with what the kind needs; its notes tell the values
};

/// Lays out a plate.
/// \return InvalidArgument (what, value, range), or as generateToolpath for the swatch. Whether it fits the bed and the
/// hot end shows when it is written.
Result<CalibrationPlate> makeCalibration(const CalibrationRequest& request, const RunContext& run);

/// As writePatches, or as writeGcode for the swatch.
Result<GcodeSummary> writeCalibration(const CalibrationPlate& plate, const GcodeSink& sink);

/// The beads above the base as cycles there and back, for previews; widths times flow, so that too little leaves gaps.
Toolpath shownCalibration(const CalibrationPlate& plate);

}  // namespace sillon
