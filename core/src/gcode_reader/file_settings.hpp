// Settings that a file states about itself.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// The filament's diameter, estimated from a file's beads if the file does not state it.

inline constexpr double kThinFilament = 1.75;  ///< [mm], diameter in most printers
inline constexpr double kWideFilament = 2.85;  ///< [mm], diameter in Cura's ultimaker2.def.json and its extruders

/// Evidence for the diameter of a file's filament.
enum class FilamentEvidence {
  None,     ///< too few beads can be judged; the usual diameter is taken
  Fits,     ///< the beads suit this diameter and not the other
  Counted,  ///< the header states a volume, which is divided by the filament that is pushed
  Odd,      ///< no diameter suits beads and nozzle; the one by which neighbours touch is used, else the usual one
  Open,     ///< both diameters are possible; the user has to be asked
};

/// A diameter, and the evidence for it.
struct WeighedFilament {
  double diameter = kThinFilament;  ///< [mm]
  FilamentEvidence evidence = FilamentEvidence::None;
  double perFace = 0;  ///< median of the filament per mm of bead and mm of layer height [1/mm]

  /// Median width of the beads if the filament has this diameter [mm].
  [[nodiscard]] double widthWith(double filamentDiameter) const;
};

/// Estimates the diameter of a file's filament. Evidence, in this order: a volume in the header, against the filament
/// that is pushed; the distances of neighbouring beads, which touch where a print is solid; the widths that beads would
/// have, against the nozzle and the height of their layer.
/// \param nozzle  diameter [mm], if the file or its printer states one.
WeighedFilament weighFilament(std::string_view gcode, GcodeFlavor flavor, std::optional<double> nozzle);

/// Makes the error (InvalidFile) that asks for the diameter if the evidence is Open.
Error askForFilament(const WeighedFilament& weighed);

// Facts about the machine that a file is for, from any slicer's comments.

inline constexpr double kHottestNozzle = 300;  ///< [degrees Celsius], limit unless a lower one is known
inline constexpr double kHottestBed = 120;     ///< [degrees Celsius], limit unless a lower one is known

/// Settings of a file and limits of its machine.
struct FileSettings {
  std::optional<Printer> printer;         ///< the caller's printer, whose bed and limits then count
  Bounds bed;                             ///< box of bed_shape, if there is no `printer`; empty: unknown
  bool roundBed = false;                  ///< the bed is a circle, as deltas have
  double maxZ = 0;                        ///< height of the build volume [mm], 0: unknown
  double nozzle = 0;                      ///< diameter [mm], 0: unknown
  double zOffset = 0;                     ///< shift of all heights [mm]
  double hottestNozzle = kHottestNozzle;  ///< hottest target that is allowed [degrees Celsius]
  double hottestBed = kHottestBed;        ///< hottest target that is allowed [degrees Celsius]
  double filamentDiameter = 1.75;         ///< [mm]
  WeighedFilament weighed;                ///< estimate from the beads, if no diameter is stated
  double filamentFlow = 1;                ///< factor of all plastic, stated by our own files as extrusion_multiplier
  std::vector<double> filamentFlows;      ///< greatest flow of each tool's filament [mm³/s], 0: unknown
  double printFlow = 0;                   ///< greatest flow of the whole print [mm³/s], 0: unknown
  GcodeFlavor flavor = GcodeFlavor::Marlin;
  std::string_view model;    ///< printer_model, a view into the file
  bool homesItself = false;  ///< the printer homes and heats before the file begins
  bool volumetric = false;   ///< E is in mm³, as in UltiGCode
};

/// Reads the settings in a file's comments. \param printer  if given, its values count, and from the file come only
/// z_offset, extrusion_multiplier, printer_model, and the marks of files whose printers home by themselves.
FileSettings readFileSettings(std::string_view text, const std::optional<Printer>& printer);

/// Greatest flow that the file allows a tool [mm³/s], 0: unknown.
double mostFlowOf(const FileSettings& settings, int tool);

/// Number behind a key; nothing if the text does not begin with that key and a number.
std::optional<double> numberAfter(std::string_view text, std::string_view key);

}  // namespace sillon
