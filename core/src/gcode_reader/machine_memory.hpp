// What a printer puts aside and takes up again: states by name or on a stack, and the filament that each tool holds
// back.
#pragma once

#include <optional>

#include "gcode_reader/machine.hpp"

namespace sillon {

/// \param tool  from 0; others change nothing.
void changeTool(MachineState& state, int tool);

/// M120 and M121 of RepRapFirmware.
void pushModes(MachineState& state);
void popModes(MachineState& state);

/// SAVE_GCODE_STATE and RESTORE_GCODE_STATE of Klipper: modes, origin and what E is written as. \return the way back,
/// where MOVE=1 asks for it.
std::optional<MachineMove> runMemory(MachineState& state, const GcodeCommand& command);

}  // namespace sillon
