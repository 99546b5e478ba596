// What comes with the library: profiles of printers and filaments, presets of the toolpath (core/data/printers.json,
// filaments.json, presets.json).
#pragma once

#include <string>
#include <vector>

#include "sillon/settings/printer.hpp"
#include "sillon/settings/toolpath_params.hpp"

namespace sillon {

enum class ProfileKind { Printer, Filament };

struct PrinterProfile {
  std::string id;                   ///< what `printer.profile` or `printer.filament` of a project names
  Printer printer;                  ///< the default printer with the profile's values
  std::string maker;                ///< of a printer, as people call it; empty for generic ones and filaments
  std::vector<std::string> models;  ///< other names of the machine in slicers' files
};

/// By id, ascending. Sizes and limits are the makers' facts; start and end blocks are ours, tried on no machine.
std::vector<PrinterProfile> profiles(ProfileKind kind);

/// Lays a profile's values over a printer. \return what is wrong: an unknown id, with those near it. Empty: nothing.
std::string applyProfile(ProfileKind kind, const std::string& id, Printer& printer);

/// Named sets of values for the toolpath, from "strict" to "fewest-turns": docs/reference/project.md.
std::vector<std::string> presets();

/// Lays a preset's values over those of a toolpath. \return what is wrong, as applyProfile.
std::string applyPreset(const std::string& id, ToolpathParams& params);

/// A project file with this printer only; readProject reads it back.
std::string writePrinter(const Printer& printer);

}  // namespace sillon
