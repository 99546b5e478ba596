#include "gcode_reader/file_settings.hpp"

#include <algorithm>
#include <cstddef>

#include "base/lines.hpp"
#include "gcode_reader/parser.hpp"
#include "sillon/settings/presets.hpp"

namespace sillon {
namespace {

// Cuts a number off a text. Outlines of round beds have coordinates such as 1.2e-14, which stand for 0.
bool takeNumber(std::string_view& text, double& value) {
  const std::size_t size = readNumber(text, value);
  text.remove_prefix(size);
  if (size == 0 || !text.starts_with("e-")) return size > 0;
  value = 0;
  text.remove_prefix(std::min(text.find_first_not_of("0123456789", 2), text.size()));
  return true;
}

// Reads the outline of a bed, such as "0x0,220x0,220x220,0x220".
void readBed(std::string_view text, FileSettings& settings) {
  constexpr int kRound = 16;  // corners, from which on an outline is a circle
  Bounds box;
  int corners = 0;
  settings.bed = {};
  for (; !text.empty(); ++corners) {
    Vec2 corner;
    if (!takeNumber(text, corner.x) || !text.starts_with('x')) return;
    text.remove_prefix(1);
    if (!takeNumber(text, corner.y)) return;
    if (text.starts_with(',')) text.remove_prefix(1);
    box.add(corner);
  }
  settings.bed = box;
  settings.roundBed = corners >= kRound;
}

// Reads the flows of all tools [mm³/s], such as "15,8"; values that no tool can have become 0, which is unknown.
std::vector<double> readFlows(std::string_view text) {
  constexpr std::size_t kMostTools = 64;
  std::vector<double> flows;
  for (bool more = true; more && flows.size() < kMostTools;) {
    const std::size_t comma = text.find(',');
    double flow = 0;
    if (readNumber(trimmed(text.substr(0, comma)), flow) == 0 || flow < 0.1 || flow > 1000) flow = 0;
    flows.push_back(flow);
    more = comma != std::string_view::npos;
    text.remove_prefix(more ? comma + 1 : text.size());
  }
  return flows;
}

// Reads one of the machine's settings from a comment, if the comment is one.
void readSetting(FileSettings& settings, std::string_view comment) {
  const auto number = [&](std::string_view key, double low, double high, double& out) {
    const auto value = numberAfter(comment, key);
    if (value && *value >= low && *value <= high) out = *value;
  };
  number("nozzle_diameter =", 0.05, 2, settings.nozzle);
  number("EXTRUDER_TRAIN.0.NOZZLE.DIAMETER:", 0.05, 2, settings.nozzle);
  number("filament_diameter =", 0.5, 5, settings.filamentDiameter);
  constexpr std::string_view kFlows = "filament_max_volumetric_speed =";
  if (comment.starts_with(kFlows)) settings.filamentFlows = readFlows(comment.substr(kFlows.size()));
  number("max_volumetric_speed =", 0.1, 1000, settings.printFlow);
  number("max_print_height =", 1, 5000, settings.maxZ);
  number("printable_height =", 1, 5000, settings.maxZ);
  number("max_nozzle_temperature =", 1, kHottestNozzle, settings.hottestNozzle);
  number("max_bed_temperature =", 1, kHottestBed, settings.hottestBed);
  for (const std::string_view key : {"bed_shape = ", "printable_area = "}) {
    if (comment.starts_with(key)) readBed(comment.substr(key.size()), settings);
  }
  if (comment.starts_with("gcode_flavor = klipper")) settings.flavor = GcodeFlavor::Klipper;
  if (comment.starts_with("gcode_flavor = reprapfirmware")) settings.flavor = GcodeFlavor::RepRap;
  if (comment.starts_with("BambuStudio")) settings.flavor = GcodeFlavor::Bambu;
}

}  // namespace

double mostFlowOf(const FileSettings& settings, int tool) {
  const std::size_t index = std::max(tool, 0);
  const std::vector<double>& flows = settings.filamentFlows;
  const double own = index < flows.size() ? flows[index] : flows.size() == 1 ? flows[0] : 0;
  return own > 0 && settings.printFlow > 0 ? std::min(own, settings.printFlow) : std::max(own, settings.printFlow);
}

std::optional<double> numberAfter(std::string_view text, std::string_view key) {
  if (!text.starts_with(key)) return std::nullopt;
  double value = 0;
  const std::string_view rest = trimmed(text.substr(key.size()));
  return readNumber(rest, value) > 0 ? std::optional<double>(value) : std::nullopt;
}

FileSettings readFileSettings(std::string_view text, const std::optional<Printer>& printer) {
  const std::string_view gcode = text;
  constexpr double kUntold = 0;
  FileSettings settings;
  settings.filamentDiameter = kUntold;
  settings.printer = printer;
  if (printer) {
    settings.maxZ = printer->maxZ;
    settings.roundBed = printer->roundBed;
    settings.nozzle = printer->nozzle;
    settings.filamentDiameter = printer->filamentDiameter;
    settings.flavor = printer->flavor;
    if (!printer->generalHeatLimits) {
      settings.hottestNozzle = printer->maxNozzleTemperature;
      settings.hottestBed = printer->maxBedTemperature;
    }
  }
  // Most files have their settings behind the moves, so that all lines must be looked at.
  while (!text.empty()) {
    const std::string_view line = nextLine(text);
    if (!line.starts_with(';')) continue;
    const std::string_view comment = trimmed(line.substr(1));
    if (comment.starts_with("FLAVOR:UltiGCode")) settings.homesItself = settings.volumetric = true;
    // Ultimaker's printers home by themselves, and so do Flashforge's, whose own slicer is FlashPrint.
    if (comment.starts_with("FLAVOR:Griffin") || comment.starts_with("generated by FlashPrint")) {
      settings.homesItself = true;
    }
    if (const auto offset = numberAfter(comment, "z_offset =")) settings.zOffset = std::clamp(*offset, -5.0, 5.0);
    if (const auto flow = numberAfter(comment, "extrusion_multiplier =")) {
      settings.filamentFlow = std::clamp(*flow, 0.1, 2.0);
    }
    if (!printer) readSetting(settings, comment);
    constexpr std::string_view kModel = "printer_model = ";
    if (comment.starts_with(kModel)) settings.model = comment.substr(kModel.size());
  }
  if (settings.model.starts_with("Flash")) settings.homesItself = true;
  // Slicers call the dialects of Prusa's and Bambu's printers Marlin, too.
  if (!printer && settings.flavor == GcodeFlavor::Marlin) {
    const std::optional<PrinterProfile> known = profileOf(settings.model);
    const GcodeFlavor own = known ? known->printer.flavor : GcodeFlavor::Marlin;
    if (own == GcodeFlavor::PrusaBuddy || own == GcodeFlavor::Bambu) settings.flavor = own;
  }
  if (settings.filamentDiameter != kUntold) return settings;
  if (!settings.volumetric) {
    const bool told = settings.nozzle > 0;
    settings.weighed = weighFilament(gcode, settings.flavor, told ? std::optional(settings.nozzle) : std::nullopt);
  }
  settings.filamentDiameter = settings.weighed.diameter;
  return settings;
}

}  // namespace sillon
