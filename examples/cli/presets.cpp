#include "presets.hpp"

#include <algorithm>
#include <cstdio>

namespace cli {
namespace {

using sillon::GcodeFlavor;
using sillon::Preset;
using sillon::PresetKind;
using sillon::Printer;

const char* flavorName(GcodeFlavor flavor) {
  switch (flavor) {
    case GcodeFlavor::Klipper:
      return "klipper";
    case GcodeFlavor::RepRap:
      return "reprap";
    case GcodeFlavor::PrusaBuddy:
      return "prusa";
    case GcodeFlavor::Bambu:
      return "bambu";
    case GcodeFlavor::Marlin:
      break;
  }
  return "marlin";
}

std::string printerLine(const Preset& preset) {
  const Printer& p = preset.printer;
  const sillon::Vec2 size = p.bedMax - p.bedMin;
  const bool centred = p.bedMin.x < 0;
  char bed[64];
  std::snprintf(bed, sizeof bed, "%gx%gx%g%s%s", size.x, size.y, p.maxZ, p.roundBed ? " round" : "",
                centred ? " centred" : "");
  char line[256];
  const char* start = !p.startGcode.empty() ? "own" : p.flavor == GcodeFlavor::Bambu ? "yours is needed" : "plain";
  std::snprintf(line, sizeof line, "%-28s %-8s %-26s %g    %s\n", preset.id.c_str(), flavorName(p.flavor), bed,
                p.nozzle, start);
  return line;
}

std::string filamentLine(const Preset& preset) {
  const Printer& p = preset.printer;
  char line[256];
  std::snprintf(line, sizeof line, "%-12s %-6s %4g then %4g  %4g   %g\n", preset.id.c_str(), p.filamentType.c_str(),
                p.firstLayerNozzleTemperature, p.nozzleTemperature, p.bedTemperature, p.filamentDensity);
  return line;
}

}  // namespace

std::string presetTable(PresetKind kind) {
  const bool printers = kind == PresetKind::Printer;
  std::string out = printers ? "id                           dialect  bed [mm]                   nozzle start block\n"
                             : "id           type   nozzle [C]      bed [C]  g/cm3\n";
  for (const Preset& preset : sillon::presets(kind)) out += printers ? printerLine(preset) : filamentLine(preset);
  return out;
}

std::string presetFile(PresetKind kind, const std::string& id) {
  for (const Preset& preset : sillon::presets(kind)) {
    if (preset.id == id) return sillon::writePrinter(preset.printer);
  }
  return "";
}

}  // namespace cli
