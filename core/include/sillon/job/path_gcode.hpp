// Writes the G-code of a path, with or without the plate that it came from.
#pragma once

#include <string>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/gcode/writer.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/look/preview.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// A path to write, with the notes and the look that its file shows.
struct PathToWrite {
  const Toolpath& seen;
  const Shape& shape;
  const Toolpath* below = nullptr;  ///< path of the layer below, where needsAcross
  LookParams look;                  ///< look of the thumbnails
  std::vector<std::string> notes;   ///< lines of the header, instead of the print's own
  std::string date = PrintParams().date;
};

/// Writes the G-code of a path, with its notes and with the thumbnails that the printer's screen
/// takes. The writing ends where the run is cancelled.
/// \return the errors of lookThumbnails and writeGcode.
Result<GcodeSummary> writePathGcode(const PathToWrite& path, const Printer& printer,
                                    const PrintParams& print, const GcodeSink& sink,
                                    const RunContext& run);

}  // namespace sillon
