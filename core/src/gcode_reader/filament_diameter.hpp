// The filament's diameter, where a file does not tell it, by what its own beads show.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sillon/settings/printer.hpp"

namespace sillon {

inline constexpr double kThinFilament = 1.75;  ///< [mm], of most printers
inline constexpr double kWideFilament = 2.85;  ///< [mm], as in Cura's ultimaker2.def.json and its extruders

/// How far a file's beads tell its filament.
enum class FilamentEvidence {
  None,     ///< too few beads can be judged: the usual diameter
  Fits,     ///< beads are as beads of the diameter are, and not as those of the other
  Counted,  ///< the header's volume over the filament that is pushed
  Odd,      ///< beads fit no diameter with the nozzle; it is the one by which neighbours touch, else the usual one
  Open,     ///< beads of both diameters are possible: nobody should guess
};

struct WeighedFilament {
  double diameter = kThinFilament;  ///< [mm]
  FilamentEvidence evidence = FilamentEvidence::None;
  double perFace = 0;  ///< filament for each mm of bead and mm of layer height [1/mm]: the median

  /// How wide the beads would be [mm].
  [[nodiscard]] double widthWith(double filamentDiameter) const;
};

/// Weighs, in this order: a volume in the header against the filament that is pushed; how close neighbouring beads lie,
/// which touch where a print is solid; how wide beads would be for the nozzle and for the height of their layer.
/// \param nozzle  [mm], if the file or its printer tells one.
WeighedFilament weighFilament(std::string_view gcode, GcodeFlavor flavor, std::optional<double> nozzle);

/// The sentence that asks for the diameter where the evidence is Open.
std::string askForFilament(const WeighedFilament& weighed);

}  // namespace sillon
