// What each kind of file gives; importPrinter tells them apart.
#pragma once

#include <cstddef>
#include <string_view>

#include "sillon/printer_import/printer_import.hpp"

namespace sillon {

inline constexpr std::size_t kMaxSettingsBytes = std::size_t{16} << 20;
inline constexpr std::size_t kMaxBlockBytes = 65'536;  ///< of a start or end block

/// PrusaSlicer's and SuperSlicer's settings, flat or a bundle. \param name  printer of a bundle, as importPrinter.
Result<ImportedPrinter> importIni(std::string_view text, std::string_view name);

/// A JSON file: a preset of Orca or Bambu Studio, or a project of our own.
Result<ImportedPrinter> importJson(std::string_view text);

/// G-code that a slicer made for the printer.
Result<ImportedPrinter> importDonor(std::string_view text);

/// Whether a line, trimmed, is where slicers begin a layer.
bool isLayerMark(std::string_view line);

}  // namespace sillon
