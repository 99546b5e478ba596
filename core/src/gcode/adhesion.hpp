// What primes the nozzle and holds the plate on the bed: skirt, purge line, brim.
#pragma once

#include <optional>

#include "gcode/hatch.hpp"
#include "gcode/job.hpp"
#include "sillon/base/result.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

/// Closed rectangles around a box, the innermost 5 mm off, printed from the outside in.
std::vector<Polyline> skirtLoops(const Bounds& box, double lineWidth, int loops);

/// A skirt around all plates, where it fits. \param box  around all beads [mm].
void addSkirt(GcodeJob& job, const Bounds& box, const Printer& printer, int loops);

/// Fills the nozzle off the plate: 10 mm of filament, and what the last print's end drew back. A skirt that takes the
/// last room for it goes. \param box  around all beads [mm].
void addPurge(GcodeJob& job, const Bounds& box, const Printer& printer, const PrintParams& params);

/// Loops around the outside of the plate, the outermost first; holes stay free.
std::optional<Error> addBrim(GcodeJob& job, const Shape& shape, PointUm offset, const Printer& printer,
                             const PrintParams& params);

}  // namespace sillon
