// Test pieces to G-code: open beads in patches, each printed with a flow, speed or fan of its own.
#pragma once

#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/gcode/writer.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/settings/print_params.hpp"
#include "sillon/settings/printer.hpp"

namespace sillon {

/// One open bead.
struct PatchLine {
  std::vector<Vec2> points;    ///< on the page [mm], at least 2 that differ
  std::vector<double> widths;  ///< one per point [mm], 0.6 to 1.6 nozzle
};

/// Beads of one layer that are printed alike, one after the other.
struct Patch {
  int layer = 0;  ///< counted from the bed, 0 the lowest; `base` layers are filled by themselves and take none
  std::vector<PatchLine> lines;
  double flow = 1;            ///< 0.01..2
  double speed = 0;           ///< [mm/s], 0..1000, never lowered for minLayerTime; 0: as oriented layers
  bool constantFlow = false;  ///< speed * spacing / width, at most 1.5 speed, as PrintParams::constantFlow
  double spacing = 0;         ///< of constantFlow [mm], > 0 there
  double fan = -1;            ///< [%], 0..100; below 0: the layer's
};

/// A plate of patches, all within its shape.
struct PatchPlate {
  Shape shape;                 ///< what the base layers fill
  std::vector<Patch> patches;  ///< in the order of printing, layer by layer
};

/// Checks the whole job, then writes it like writeGcode: PrintParams::base plain layers, then `layers` layers of
/// patches. The page is neither turned nor mirrored, shown from above, on the bed, and there is one of it.
/// \return InvalidArgument (also where maxFlow or machineSpeed would slow a patch's own speed), DoesNotFit, EmptyShape.
Result<GcodeSummary> writePatches(const PatchPlate& plate, const Printer& printer, const PrintParams& params,
                                  const GcodeSink& sink);

}  // namespace sillon
