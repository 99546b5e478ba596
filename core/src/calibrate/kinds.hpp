// What each kind of calibration tries: its values, their ranges, and what is said of them.
#pragma once

#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/calibrate/calibrate.hpp"
#include "sillon/settings/printer.hpp"

namespace sillon {

struct CalibrationRow {
  const char* name;
  double from, to;
  int count;
  int digits;  ///< of the values
  const char* setting;
  const char* unit;
  const char* advice;
};

inline constexpr double kLeastWidth = 0.6;  ///< [nozzle], the narrowest and the widest bead that is printed
inline constexpr double kMostWidth = 1.6;

const CalibrationRow& rowOf(CalibrationKind kind);

/// What hot end and machine manage [mm/s]. \param width  of the widest bead [nozzle].
double fastest(const Printer& printer, const PrintParams& print, double width);

/// The values that a plate tries. \return InvalidArgument (what, value, range).
Result<std::vector<double>> valuesToTry(const CalibrationRequest& request);

}  // namespace sillon
