// Settings that a file tells about itself.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// The filament's diameter, where a file does not tell it, by what its own beads show.

inline constexpr double kThinFilament = 1.75;  ///< [mm], of most printers
inline constexpr double kWideFilament = 2.85;  ///< [mm], as in Cura's ultimaker2.def.json and its extruders

/// The degree to which a file's beads tell its filament.
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

  /// Width that the beads would have [mm].
  [[nodiscard]] double widthWith(double filamentDiameter) const;
};

/// Weighs, in this order: a volume in the header against the filament that is pushed; how close neighbouring beads lie,
/// which touch where a print is solid; how wide beads would be for the nozzle and for the height of their layer.
/// \param nozzle  [mm], if the file or its printer tells one.
WeighedFilament weighFilament(std::string_view gcode, GcodeFlavor flavor, std::optional<double> nozzle);

/// Asks for the diameter where the evidence is Open: InvalidFile.
Error askForFilament(const WeighedFilament& weighed);

// Facts in any slicer's comments about the machine that a file is for.

inline constexpr double kHottestNozzle = 300;  ///< [degrees Celsius] where nobody tells less
inline constexpr double kHottestBed = 120;

struct FileSettings {
  std::optional<Printer> printer;         ///< bed and limits, if given by the caller
  Bounds bed;                             ///< else: the box of bed_shape
  bool roundBed = false;                  ///< a delta's
  double maxZ = 0;                        ///< [mm], 0: unknown
  double nozzle = 0;                      ///< [mm], 0: unknown
  double zOffset = 0;                     ///< [mm] of all heights
  double hottestNozzle = kHottestNozzle;  ///< [degrees Celsius] that may be asked for
  double hottestBed = kHottestBed;
  double filamentDiameter = 1.75;     ///< [mm]
  WeighedFilament weighed;            ///< where the diameter is not told: what the beads show
  double filamentFlow = 1;            ///< by which all plastic was multiplied, as our own files tell it
  std::vector<double> filamentFlows;  ///< [mm³/s] that each tool's filament may have, 0: unknown
  double printFlow = 0;               ///< the same of all of them
  GcodeFlavor flavor = GcodeFlavor::Marlin;
  std::string_view model;    ///< printer_model, a view into the file
  bool homesItself = false;  ///< the printer homes and heats before the file begins
  bool volumetric = false;   ///< UltiGCode's E is mm³
};

/// \param printer  if given, nothing is read but the flavour of Cura's files.
FileSettings readFileSettings(std::string_view text, const std::optional<Printer>& printer);

/// The flow that the file allows a tool [mm³/s], 0: unknown.
double mostFlowOf(const FileSettings& settings, int tool);

/// A number behind a key that the text begins with.
std::optional<double> numberAfter(std::string_view text, std::string_view key);

}  // namespace sillon
