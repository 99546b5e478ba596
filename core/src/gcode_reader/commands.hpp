// What each command is good for, in each dialect, and what nobody should meet in a print.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gcode_reader/parser.hpp"
#include "sillon/gcode_reader/finding.hpp"
#include "sillon/settings/printer.hpp"

namespace sillon {

enum class CommandKind {
  Safe,        ///< ends with the print, or is followed by the reader
  Outlives,    ///< still holds when the print is over
  Runs,        ///< runs commands that stand somewhere else
  Unfollowed,  ///< moves, heats or switches in a way that is not followed here
  Files,       ///< files, network, other programs
  Never,       ///< has no place in a print
  Macro,       ///< a name that the printer's owner gave
  Unknown,     ///< a letter with a number that is in no list
};

/// \param command  of a line. \param flavor  where one code means two things.
CommandKind commandKind(const GcodeCommand& command, GcodeFlavor flavor);

/// What a line of code does besides its moves, by the table of commands and by its values: heaters' targets, offsets,
/// limits, waits. Whether a finding is an error never depends on the flavour. \param hottestNozzle, hottestBed [degrees
/// Celsius] \param strict  also tells of macros and unknown commands.
std::vector<GcodeFinding> judgeCommand(std::string_view code, GcodeFlavor flavor, double hottestNozzle,
                                       double hottestBed, bool strict);

}  // namespace sillon
