// Data that come with the library: profiles of printers and filaments, and presets of the toolpath
// (core/data/printers.json, filaments.json, presets.json).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/settings/project.hpp"

namespace sillon {

enum class ProfileKind { Printer, Filament };

/// A profile of a printer or a filament.
struct PrinterProfile {
  std::string id;   ///< name for `printer.profile` or `printer.filament` of a project
  Printer printer;  ///< the default printer with the profile's values
  /// Maker of a printer, as people call it; empty for generic ones and filaments
  std::string maker;
  std::vector<std::string> models;  ///< other names that slicers' files have for the machine
};

/// Returns all profiles by id, ascending. Sizes and limits are the makers' facts; start and end
/// blocks are ours, tried on no machine.
std::vector<PrinterProfile> profiles(ProfileKind kind);

/// Finds the profile of the machine that slicers call by this name (`printer_model`), whatever its
/// nozzle.
std::optional<PrinterProfile> profileOf(std::string_view model);

/// Lays a profile's values over a printer.
/// \return an error about an unknown id, with the ids near it.
[[nodiscard]] std::optional<Error> applyProfile(ProfileKind kind, const std::string& id,
                                                Printer& printer);

/// Returns the family that a type of filament belongs to: the letters with which its name begins,
/// as capitals. It is "PLA" for "PLA Silk", "PLA+" and "pla-cf", and "PA" for "PA6-GF".
std::string filamentFamily(std::string_view filamentType);

/// Returns the fan that filaments of this type usually get above the first layer [%]
/// (core/data/filaments.json, `families`).
double usualFan(std::string_view filamentType);

/// Sets pressure advance to the value that the maker's own slicer sets for this machine. It depends
/// on the family of filamentType and on the nozzle; it is off if the maker gives no value.
/// applyProfile does this for the filament and nozzle that it finds; after a change of either,
/// followAdvance does. An unknown profile changes nothing.
void applyAdvance(const std::string& profile, Printer& printer);

/// Updates pressure advance after a change of printer, filament or nozzle, unless it was a person's
/// own. Another printer gets its maker's value; the same printer keeps a value that is not its
/// maker's for the filament and nozzle of `before`.
void followAdvance(const Project& before, Project& changed);

/// Lists the ids of presets, which are sets of values for the toolpath, from "strict" to
/// "fewest-turns" (docs/reference/project.md).
std::vector<std::string> presets();

/// Lays a preset's values over those of a toolpath.
/// \return an error about an unknown id, as in applyProfile.
[[nodiscard]] std::optional<Error> applyPreset(const std::string& id, ToolpathParams& params);

/// Writes a project file with this printer only; readProject reads it back.
std::string writePrinter(const Printer& printer);

}  // namespace sillon
