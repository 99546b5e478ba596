// Data that come with the library: profiles of printers and filaments, presets of the toolpath
// (core/data/printers.json, filaments.json, presets.json).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/settings/project.hpp"

namespace sillon {

enum class ProfileKind { Printer, Filament };

struct PrinterProfile {
  std::string id;     ///< what `printer.profile` or `printer.filament` of a project names
  Printer printer;    ///< the default printer with the profile's values
  std::string maker;  ///< of a printer, as people call it; empty for generic ones and filaments
  std::vector<std::string> models;  ///< other names of the machine in slicers' files
};

/// By id, ascending. Sizes and limits are the makers' facts; start and end blocks are ours, tried
/// on no machine.
std::vector<PrinterProfile> profiles(ProfileKind kind);

/// Finds the profile of the machine that slicers call so (`printer_model`), whatever its nozzle.
std::optional<PrinterProfile> profileOf(std::string_view model);

/// Lays a profile's values over a printer.
/// \return what is wrong: an unknown id, with those near it. Empty: nothing.
[[nodiscard]] std::string applyProfile(ProfileKind kind, const std::string& id, Printer& printer);

/// The family that a type of filament belongs to, by the first letters of its name, in capitals:
/// "PLA" for "PLA Silk", "PLA+" and "pla-cf", "PA" for "PA6-GF".
std::string filamentFamily(std::string_view filamentType);

/// The fan that filaments of this type usually get above the first layer [%]:
/// core/data/filaments.json, `families`.
double usualFan(std::string_view filamentType);

/// Sets pressure advance to what the maker's own slicer sets for this machine. It depends on the
/// family of filamentType and on the nozzle; it is off where the maker tells none. applyProfile
/// does it for the filament and nozzle that it finds; after a change of either, followAdvance does.
/// An unknown profile changes nothing.
void applyAdvance(const std::string& profile, Printer& printer);

/// Pressure advance follows a change of printer, filament or nozzle, unless it was a person's own:
/// another printer gets its maker's, the same one keeps what is not its maker's for the filament
/// and nozzle of `before`.
void followAdvance(const Project& before, Project& changed);

/// Named sets of values for the toolpath, from "strict" to "fewest-turns":
/// docs/reference/project.md.
std::vector<std::string> presets();

/// Lays a preset's values over those of a toolpath.
/// \return what is wrong, as applyProfile.
[[nodiscard]] std::string applyPreset(const std::string& id, ToolpathParams& params);

/// A project file with this printer only; readProject reads it back.
std::string writePrinter(const Printer& printer);

}  // namespace sillon
