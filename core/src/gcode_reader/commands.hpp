// What each command is good for, in each dialect, and what nobody should meet in a print.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gcode_reader/parser.hpp"
#include "sillon/gcode_reader/finding.hpp"
#include "sillon/settings/printer.hpp"

namespace sillon {

inline constexpr double kMostLowered = 0.5;  ///< [mm] that offsets may lower a nozzle: more than any first layer
inline constexpr double kMostOffset = 10;    ///< [mm], to any other side

/// What a line of code does besides its moves, by the table of commands and by its values: heaters' targets, offsets,
/// limits, waits. Whether a finding is an error never depends on the flavour. \param hottestNozzle, hottestBed [degrees
/// Celsius] \param strict  also tells of macros and unknown commands.
std::vector<GcodeFinding> judgeCommand(std::string_view code, GcodeFlavor flavor, double hottestNozzle,
                                       double hottestBed, bool strict);

/// Whether it levels or measures the bed, and so touches it here and there.
bool probesBed(const GcodeCommand& command);

/// Whether it is a G28 that homes Z, alone or with others.
bool homesZ(const GcodeCommand& command);

}  // namespace sillon
