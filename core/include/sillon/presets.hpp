// The printers, filaments and recipes that come with the library: core/data/printers.json, filaments.json,
// recipes.json.
#pragma once

#include <string>
#include <vector>

#include "sillon/gcode.hpp"
#include "sillon/params.hpp"

namespace sillon {

enum class PresetKind { Printer, Filament };

struct Preset {
  std::string id;   ///< what `printer.preset` or `printer.filament` of a project names
  Printer printer;  ///< the default printer with the preset's values
};

/// By id, ascending. Sizes and limits are the makers' facts; start and end blocks are ours, tried on no machine.
std::vector<Preset> presets(PresetKind kind);

/// Lays a preset's values over a printer. \return what is wrong: an unknown id, with those near it. Empty: nothing.
std::string applyPreset(PresetKind kind, const std::string& id, Printer& printer);

/// Names of the ways to make a toolpath, from "strict" to "fewest-turns"; docs/project.md says what they change.
std::vector<std::string> recipes();

/// Lays a recipe's values over those of a toolpath. \return what is wrong, as applyPreset.
std::string applyRecipe(const std::string& id, ToolpathParams& params);

/// A project file with this printer only; readProject reads it back.
std::string writePrinter(const Printer& printer);

}  // namespace sillon
