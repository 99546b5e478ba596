// What comes with the program, as text: printers, filaments, and the table of settings.
#pragma once

#include <string>

#include "sillon/settings/presets.hpp"

namespace cli {

/// One line per preset, with a head.
std::string presetTable(sillon::ProfileKind kind);

/// The same with all values, as an object with a list `printers` or `filaments`: `id`, `maker` where there is one, and
/// `printer`, that section of a project.
std::string presetsJson(sillon::ProfileKind kind);

/// A project file with this preset's printer; empty if there is none of that id.
std::string presetFile(sillon::ProfileKind kind, const std::string& id);

/// One line per setting: name, default, range with unit, option.
std::string settingsTable();

}  // namespace cli
