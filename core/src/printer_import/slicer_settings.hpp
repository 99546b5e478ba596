// A slicer's settings to a printer: which key is which field, in the words of PrusaSlicer, Orca and Cura.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "sillon/base/result.hpp"
#include "sillon/printer_import/printer_import.hpp"

namespace sillon {

using SlicerSettings = std::map<std::string, std::string, std::less<>>;  ///< resolved values by the slicer's names

/// Lays what is known of the settings over out.printer, and lists what was read and what could not be.
void takeSettings(const SlicerSettings& settings, ImportedPrinter& out);

/// Of lists with a value for each filament, as "PLA;PETG", keeps that of one tool.
void chooseTool(SlicerSettings& settings, std::size_t tool);

/// Notes placeholders of the blocks that an export would refuse.
void judgeBlocks(ImportedPrinter& out);

/// takeSettings and judgeBlocks on a file of settings alone. \return InvalidFile where nothing in it is known.
Result<ImportedPrinter> printerOfSettings(const SlicerSettings& settings, ImportedPrinter out);

/// Klipper, where the start block has commands that are words with an underline, which no other firmware knows: slicers
/// say "marlin" of it, too.
void recogniseKlipper(ImportedPrinter& out);

}  // namespace sillon
