// A printer out of the user's own files: what their slicer already knows need not be typed again.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sillon/gcode.hpp"
#include "sillon/result.hpp"

namespace sillon {

struct ImportedPrinter {
  Printer printer;                   ///< values that the file does not tell are the defaults
  std::string source;                ///< "donor G-code", "PrusaSlicer settings", "Orca settings", "project"
  std::vector<std::string> read;     ///< names of the settings taken, ascending
  std::vector<std::string> notRead;  ///< what could not be taken over or needs a look, one sentence each
};

/// Tells the kind of file by its content:
/// - G-code that the user's slicer made for their printer: its start and end blocks, proven there, and its settings;
/// - PrusaSlicer or SuperSlicer settings (.ini), flat or a bundle with `inherits`;
/// - an Orca or Bambu Studio preset (.json), whose `inherits` lies in another file and is listed;
/// - a project of our own, of which the printer is taken.
/// \param bytes  at most 256 MiB. \param name  printer of a bundle; empty: the active one, else the last.
/// \return InvalidFile, TooLarge, or InvalidArgument where a bundle has no printer of that name.
Result<ImportedPrinter> importPrinter(std::string_view bytes, std::string_view name = {});

}  // namespace sillon
