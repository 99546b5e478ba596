// The options of a plate: its shape and directions, its toolpath, its print, and the files it is written to. Those that
// need a syntax of their own; all others come from the table of settings.
#pragma once

#include "arguments.hpp"
#include "options.hpp"

namespace cli {

/// --shape, --size, --directions, --angle, --modes, --mode.
void addShape(Options& options);

/// --preset, --perimeters.
void addToolpath(Options& options);

/// The printer, its filament and its bed.
void addPrinter(Options& options);

/// --copies, --place, and the printer.
void addPrint(Options& options, Arguments& arguments);

/// Files, and the width of previews.
void addOutputs(Options& options, Arguments& arguments);

}  // namespace cli
