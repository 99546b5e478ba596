// What surrounds the layers: the start block, heat and purge before them, and the end block.
#pragma once

#include "gcode/job.hpp"
#include "gcode/nozzle.hpp"
#include "sillon/settings/printer.hpp"

namespace sillon {

/// From cold to a primed nozzle beside the plate.
void writeStart(Nozzle& nozzle, const GcodeJob& job, const Printer& printer, const PrintParams& params);

/// Above the plate: what was changed of the machine goes back, then the end block, or parking and all off.
void writeEnd(Nozzle& nozzle, const GcodeJob& job, const Printer& printer, const PrintParams& params);

}  // namespace sillon
