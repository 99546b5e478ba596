// The filament's diameter, where a file does not tell it, by the plastic that its own beads take.
#pragma once

#include <optional>
#include <string_view>

#include "sillon/settings/printer.hpp"

namespace sillon {

inline constexpr double kThinFilament = 1.75;  ///< [mm], of most printers
inline constexpr double kWideFilament = 2.85;  ///< [mm], as in Cura's ultimaker2.def.json and its extruders

/// Filament that a file pushes for each mm of its beads, over the height of their layer [1/mm]: the median of their
/// length. Times a filament's cross-section it is how wide they are. Nothing where less than 100 mm can be judged.
std::optional<double> filamentPerFace(std::string_view gcode, GcodeFlavor flavor);

}  // namespace sillon
