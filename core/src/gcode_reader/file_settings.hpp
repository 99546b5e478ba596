// What the comments of any slicer say of the machine that a file is for.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "gcode_reader/filament_diameter.hpp"
#include "sillon/base/types.hpp"
#include "sillon/settings/printer.hpp"

namespace sillon {

struct FileSettings {
  std::optional<Printer> printer;     ///< bed and limits, if given by the caller
  Bounds bed;                         ///< else: the box of bed_shape
  bool roundBed = false;              ///< a delta's
  double maxZ = 0;                    ///< [mm], 0: unknown
  double nozzle = 0;                  ///< [mm], 0: unknown
  double zOffset = 0;                 ///< [mm] of all heights
  double filamentDiameter = 1.75;     ///< [mm]
  WeighedFilament weighed;            ///< where the diameter is not told: what the beads show
  double filamentFlow = 1;            ///< by which all plastic was multiplied, as our own files tell it
  std::vector<double> filamentFlows;  ///< [mm³/s] that each tool's filament may have, 0: unknown
  double printFlow = 0;               ///< the same of all of them
  GcodeFlavor flavor = GcodeFlavor::Marlin;
  bool ultimaker = false;   ///< the printer homes and heats before the file begins: UltiGCode, Griffin
  bool volumetric = false;  ///< UltiGCode's E is mm³
};

/// \param printer  if given, nothing is read but the flavour of Cura's files.
FileSettings readFileSettings(std::string_view text, const std::optional<Printer>& printer);

/// The flow that the file allows a tool [mm³/s], 0: unknown.
double mostFlowOf(const FileSettings& settings, int tool);

/// A number behind a key that the text begins with.
std::optional<double> numberAfter(std::string_view text, std::string_view key);

}  // namespace sillon
