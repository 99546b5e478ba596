// A printer out of the user's own files: what their slicer already knows need not be typed again.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/sentence.hpp"
#include "sillon/settings/printer.hpp"

namespace sillon {

/// What could not be taken over, or needs a look.
struct ImportNote {
  std::string code;                                         ///< one of importNoteSentences()
  std::vector<std::pair<std::string, std::string>> values;  ///< by name, what the message says
  std::string message;                                      ///< one sentence in English
};

struct ImportedPrinter {
  Printer printer;                  ///< values that the file does not tell are the profile's, else the defaults
  std::string profile;              ///< of the same machine, whose values lie under the file's; empty: none is known
  std::string source;               ///< "donor G-code", "PrusaSlicer settings", "Orca settings", "project"
  std::vector<std::string> read;    ///< names of the settings taken, ascending
  std::vector<ImportNote> notRead;  ///< each once
};

/// The sentence of each code.
std::span<const Sentence> importNoteSentences();

/// Tells the kind of file by its content:
/// - G-code that the user's slicer made for their printer: its start and end blocks, proven there, and its settings;
/// - PrusaSlicer or SuperSlicer settings (.ini), flat or a bundle with `inherits`;
/// - an Orca or Bambu Studio preset (.json, .orca_printer), whose `inherits` lies in another file and is listed, or a
///   project (.3mf) that has all settings;
/// - a project of our own, of which the printer is taken.
/// \param bytes  at most 256 MiB. \param name  printer of a bundle; empty: the active one, else the last.
/// \return InvalidFile, TooLarge, or InvalidArgument where a bundle has no printer of that name.
Result<ImportedPrinter> importPrinter(std::string_view bytes, std::string_view name = {});

}  // namespace sillon
