// The comments before and after the moves, from which hosts, viewers and people learn what the file is.
#pragma once

#include "gcode/chunked_output.hpp"
#include "gcode/job.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// Marks by which hosts leave out one of several plates.

/// Klipper's list of the plates and where they stand; nothing for one plate, and for other dialects.
void defineObjects(ChunkedOutput& out, const GcodeJob& job, GcodeFlavor flavor);

/// Around the moves of one of several plates; nothing where there is one.
void beginObject(ChunkedOutput& out, const GcodeJob& job, GcodeFlavor flavor, int copy);
void endObject(ChunkedOutput& out, const GcodeJob& job, GcodeFlavor flavor, int copy);

/// Pictures, measures and parameters. \param seconds  the whole print, as estimated.
void writeHeader(ChunkedOutput& out, const GcodeJob& job, const Printer& printer, const PrintParams& params,
                 double seconds);

/// What the moves that follow print, in the words that viewers know.
struct Role {
  const char* type;     ///< PrusaSlicer's word
  const char* feature;  ///< Orca's and Bambu Studio's
};
inline constexpr Role kSkirtRole{"Skirt/Brim", "Skirt"};
inline constexpr Role kBrimRole{"Skirt/Brim", "Brim"};
inline constexpr Role kBaseRole{"Solid infill", "Internal solid infill"};
inline constexpr Role kOrientedRole{"Top solid infill", "Top surface"};
inline constexpr Role kRimRole{"Perimeter", "Inner wall"};
inline constexpr Role kCustomRole{"Custom", "Custom"};
void writeRole(ChunkedOutput& out, const Role& role);

struct FileTotals {
  double filamentMm = 0;
  double seconds = 0;
};

/// Filament, time and settings as "; key = value".
void writeFooter(ChunkedOutput& out, const FileTotals& totals, const GcodeJob& job, const Printer& printer,
                 const PrintParams& params);

}  // namespace sillon
