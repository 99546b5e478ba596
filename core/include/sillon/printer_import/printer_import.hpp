// Imports a printer from the user's own files: what their slicer already knows need not be typed
// again.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// A note on something that could not be taken over, or needs a look.
struct ImportNote {
  std::string code;  ///< one of importNoteSentences() or of reasonSentences()
  /// Values that the message says, by name
  std::vector<std::pair<std::string, std::string>> values;
  std::string message;  ///< one sentence in English
};

/// An imported printer, and the sources of its values.
struct ImportedPrinter {
  Printer printer;  ///< values that the file does not tell are the profile's, else the defaults
  /// Profile of the same machine, whose values hold where the file has none; empty: none is known
  std::string profile;
  /// Kind of the file: "donor G-code", "PrusaSlicer settings", "Orca settings", "project"
  std::string source;
  std::vector<std::string> read;    ///< names of the settings taken, ascending
  std::vector<ImportNote> notRead;  ///< notes, each once
};

/// Returns the sentence of each code.
std::span<const Sentence> importNoteSentences();

/// Takes a printer from a file, whose kind it tells by the content:
/// - G-code of the user's slicer: its start and end blocks, proven there, and its settings;
/// - PrusaSlicer or SuperSlicer settings (.ini), flat or a bundle with `inherits`;
/// - an Orca or Bambu Studio preset (.json, .orca_printer), whose `inherits` is listed as missing;
/// - a project of Orca or Bambu Studio (.3mf), which has all settings;
/// - a project of our own, of which the printer is taken.
///
/// \param bytes  at most 256 MiB.
/// \param name  printer of a bundle; empty: the active one, else the last.
/// \return InvalidFile, TooLarge, or InvalidArgument where a bundle has no printer of that name.
Result<ImportedPrinter> importPrinter(std::string_view bytes, std::string_view name = {});

}  // namespace sillon
