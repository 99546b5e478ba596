// Looks at a start or end block line by line, before it is trusted with a machine.
#pragma once

#include <string_view>
#include <vector>

#include "sillon/gcode_reader/finding.hpp"
#include "sillon/settings/printer.hpp"

namespace sillon {

/// What each line of a block by somebody else would do that its reader should know: heat beyond 300 degrees Celsius
/// (bed 120), moves below the bed, commands that outlive the print, reach files or the network, move or heat in ways
/// that nobody can follow, or have no place in a print; and commands that are not in the list of known ones, and
/// macros, whose meaning is not in the block. One finding per line and code, in the order of the lines; count is 1.
/// \param block   up to any size; a template's {names} are read as numbers.
/// \param flavor  only tells which commands are unknown: what is an error is one for every machine.
std::vector<GcodeFinding> examineBlock(std::string_view block, GcodeFlavor flavor);

}  // namespace sillon
