// How long moves take.
#pragma once

#include <string_view>

#include "gcode_reader/machine.hpp"

namespace sillon {

/// By the rule of Klipper's planner: trapezoids, corners by their square corner velocity. \param acceleration  where
/// the text begins [mm/s²]; M204 and SET_VELOCITY_LIMIT change it. \return [s].
double secondsOfMoves(std::string_view text, const MachineState& before, double acceleration);

/// What an acceleration command sets for beads [mm/s²]; 0: it is none.
double accelerationOf(std::string_view code);

}  // namespace sillon
