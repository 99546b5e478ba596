// Start and end blocks: values put in, and what a printer would come to grief at.
#pragma once

#include <optional>
#include <string_view>

#include "gcode/job.hpp"
#include "sillon/base/result.hpp"
#include "sillon/settings/printer.hpp"

namespace sillon {

/// Whether the start block lays beads of its own: makers' and slicers' blocks fill the nozzle so.
bool primesItself(const Printer& printer, const PrintParams& params, const Bounds& beads);

/// Whether a start block has a macro that homes, heats and may fill the nozzle: PRINT_START and its kin.
bool runsStartMacro(std::string_view block);

/// Whether a start block sets pressure advance above 0 (M900 K, M572 S, SET_PRESSURE_ADVANCE).
bool setsPressureAdvance(std::string_view block);

/// Puts the values into the user's blocks and judges them.
/// \param beads  box around all plates; the skirt is added here. \param last  middle of the last plate.
/// \return InvalidArgument with the line and what is wrong there.
std::optional<Error> addBlocks(GcodeJob& job, Bounds beads, Vec2 last, const Printer& printer,
                               const PrintParams& params);

}  // namespace sillon
