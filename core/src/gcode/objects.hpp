// Marks by which hosts leave out one of several plates.
#pragma once

#include "gcode/chunked_output.hpp"
#include "gcode/job.hpp"

namespace sillon {

/// Klipper's list of the plates and where they stand; nothing for one plate, and for other dialects.
void defineObjects(ChunkedOutput& out, const GcodeJob& job, GcodeFlavor flavor);

/// Around the moves of one of several plates; nothing where there is one.
void beginObject(ChunkedOutput& out, const GcodeJob& job, GcodeFlavor flavor, int copy);
void endObject(ChunkedOutput& out, const GcodeJob& job, GcodeFlavor flavor, int copy);

}  // namespace sillon
