// The comments before and after the moves, from which hosts, viewers and people learn what the file is.
#pragma once

#include "gcode/chunked_output.hpp"
#include "gcode/job.hpp"
#include "sillon/settings/printer.hpp"

namespace sillon {

/// Pictures, measures and parameters. \param seconds  the whole print, as estimated.
void writeHeader(ChunkedOutput& out, const GcodeJob& job, const Printer& printer, const PrintParams& params,
                 double seconds);

struct FileTotals {
  double filamentMm = 0;
  double seconds = 0;
};

/// Filament, time and settings as "; key = value".
void writeFooter(ChunkedOutput& out, const FileTotals& totals, const GcodeJob& job, const Printer& printer,
                 const PrintParams& params);

}  // namespace sillon
