// Toolpath to G-code that printers take. Rules and reasons: docs/reference/gcode.md.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/report/warning.hpp"
#include "sillon/settings/print_params.hpp"
#include "sillon/settings/printer.hpp"

namespace sillon {

/// Totals of what was written, and what the user should know.
struct GcodeSummary {
  double filamentMm = 0;
  double filamentCm3 = 0;
  double filamentGrams = 0;
  double seconds = 0;  ///< estimate: trapezoids with look-ahead
  std::int64_t moves = 0;
  std::int64_t bytes = 0;
  double clampedLengthMm = 0;  ///< extruded with a width held at 0.6 or 1.6 nozzle
  double curveSlowedMm = 0;    ///< of oriented beads that curveAcceleration slows, or that stay even beside slower ones
  std::vector<Warning> warnings;
};

/// Receives the file in pieces; returning false stops the writing (Cancelled).
using GcodeSink = std::function<bool(std::string_view)>;

/// Checks the whole job, then writes it. Nothing reaches the sink if anything is wrong.
/// \param across  of generateAcross, for the same shape; needed where needsAcross, not read elsewhere. \return
/// InvalidArgument, DoesNotFit (overhang per side), EmptyShape.
Result<GcodeSummary> writeGcode(const Toolpath& toolpath, const Shape& shape, const Printer& printer,
                                const PrintParams& params, const GcodeSink& sink, const Toolpath* across = nullptr);

}  // namespace sillon
