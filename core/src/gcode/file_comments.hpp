// Comments before and after the moves, from which hosts, viewers and people learn what the file is.
#pragma once

#include "gcode/chunked_output.hpp"
#include "gcode/job.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// Marks that let hosts leave out one of several plates.

/// Writes Klipper's list of the plates and their places; nothing for one plate or another dialect.
void defineObjects(ChunkedOutput& out, const GcodeJob& job, GcodeFlavor flavor);

/// Write the marks before and after the moves of one of several plates; nothing if there is only one.
void beginObject(ChunkedOutput& out, const GcodeJob& job, GcodeFlavor flavor, int copy);
void endObject(ChunkedOutput& out, const GcodeJob& job, GcodeFlavor flavor, int copy);

/// Writes pictures, measures and parameters. \param seconds  estimated time of the whole print.
void writeHeader(ChunkedOutput& out, const GcodeJob& job, const Printer& printer, const PrintParams& params,
                 double seconds);

/// Role of the moves that follow, in the words that viewers know.
struct Role {
  const char* type;     ///< name in PrusaSlicer
  const char* feature;  ///< name in Orca and Bambu Studio
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

/// Writes filament, time and settings as "; key = value".
void writeFooter(ChunkedOutput& out, const FileTotals& totals, const GcodeJob& job, const Printer& printer,
                 const PrintParams& params);

}  // namespace sillon
