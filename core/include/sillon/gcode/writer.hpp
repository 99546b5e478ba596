// Writes toolpaths and test pieces as G-code.
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
#include "sillon/settings/project.hpp"

namespace sillon {

// Toolpath to G-code that printers take. docs/reference/gcode.md has the rules and their reasons.

/// Totals of what was written, and warnings that the user should know.
struct GcodeSummary {
  double filamentMm = 0;
  double filamentCm3 = 0;
  double filamentGrams = 0;
  double seconds = 0;  ///< estimate from trapezoidal speed profiles with look-ahead
  std::int64_t moves = 0;
  std::int64_t bytes = 0;
  double clampedLengthMm = 0;  ///< length extruded with a width held at 0.6 or 1.6 nozzle
  /// Length of oriented beads slowed by curveAcceleration, or to stay even beside slower ones
  double curveSlowedMm = 0;
  std::vector<Warning> warnings;
};

/// Receives the file in pieces; returning false stops the writing (Cancelled).
using GcodeSink = std::function<bool(std::string_view)>;

/// Checks the whole job, then writes it. Nothing reaches the sink if anything is wrong.
/// \param across  path of generateAcross for the same shape; needed where needsAcross holds,
/// otherwise not read.
/// \return InvalidArgument, DoesNotFit (with the overhang on each side), EmptyShape.
Result<GcodeSummary> writeGcode(const Toolpath& toolpath, const Shape& shape,
                                const Printer& printer, const PrintParams& params,
                                const GcodeSink& sink, const Toolpath* across = nullptr);

// Test pieces to G-code: open beads in patches, each printed with a flow, speed or fan of its own.

/// One open bead.
struct PatchLine {
  std::vector<Vec2> points;    ///< points on the page [mm], at least 2 that differ
  std::vector<double> widths;  ///< width at each point [mm], 0.6 to 1.6 nozzle
};

/// Beads of one layer that are printed alike, one after the other.
struct Patch {
  /// Number of its layer, 0 the lowest; the `base` layers are filled by themselves and take none
  int layer = 0;
  std::vector<PatchLine> lines;
  double flow = 1;  ///< 0.01..2
  /// Speed [mm/s], 0..1000, never lowered for minLayerTime; 0: the speed of oriented layers
  double speed = 0;
  /// Beads at speed * spacing / width, at most 1.5 speed, as with PrintParams::constantFlow
  bool constantFlow = false;
  double spacing = 0;  ///< spacing that constantFlow refers to [mm], > 0 there
  double fan = -1;     ///< fan [%], 0..100; below 0: the layer's own
};

/// A plate of patches, all within its shape.
struct PatchPlate {
  Shape shape;                 ///< area that the base layers fill
  std::vector<Patch> patches;  ///< patches in the order of printing, layer by layer
};

/// Checks the whole job, then writes it like writeGcode: PrintParams::base plain layers, then
/// `layers` layers of patches. The page is neither turned nor mirrored, is shown from above, lies
/// on the bed, and is printed once.
/// \return InvalidArgument (also where maxFlow or machineSpeed would slow a patch's own speed),
/// DoesNotFit, EmptyShape.
Result<GcodeSummary> writePatches(const PatchPlate& plate, const Printer& printer,
                                  const PrintParams& params, const GcodeSink& sink);

}  // namespace sillon
