// What each command is good for, in each dialect, and what nobody should meet in a print.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gcode_reader/parser.hpp"
#include "sillon/gcode_reader/finding.hpp"
#include "sillon/settings/printer.hpp"

namespace sillon {

/// What a line of code does besides its moves, by the table of commands and by its values: heaters' targets, offsets,
/// limits, waits. Whether a finding is an error never depends on the flavour. \param hottestNozzle, hottestBed [degrees
/// Celsius] \param strict  also tells of macros and unknown commands.
std::vector<GcodeFinding> judgeCommand(std::string_view code, GcodeFlavor flavor, double hottestNozzle,
                                       double hottestBed, bool strict);

}  // namespace sillon
