// The printers and filaments that come with the program, as text.
#pragma once

#include <string>

#include "sillon/presets.hpp"

namespace cli {

/// One line per preset, with a head.
std::string presetTable(sillon::PresetKind kind);

/// A project file with this preset's printer; empty if there is none of that id.
std::string presetFile(sillon::PresetKind kind, const std::string& id);

}  // namespace cli
