#include "printer_import/slicer_files.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "base/numbers.hpp"
#include "base/refused.hpp"
#include "gcode_reader/file_settings.hpp"
#include "gcode_reader/parser.hpp"
#include "printer_import/notes.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "sillon/look/preview.hpp"
#include "sillon/settings/presets.hpp"

namespace sillon {
namespace {

using Keys = std::initializer_list<std::string_view>;  // keys of one setting; the first that is there counts

constexpr double kFastBoard = 1000;     // [moves/s], rate of a computer or a board of 32 bits
constexpr double kAcceleration = 1500;  // [mm/s²], greatest for beads: U-turns show what is above it

// Reads a slicer's settings into a printer.
class SettingsReader {
 public:
  SettingsReader(const SlicerSettings& settings, ImportedPrinter& out)
      : settings_(settings), out_(out), p_(out.printer) {}

  void all() {
    profile();
    names();
    bed();
    numbers();
    filamentFlow();
    flavor();  // needs the name
    cornerSpeed();
    block({"start_gcode", "machine_start_gcode"}, p_.startGcode);
    block({"end_gcode", "machine_end_gcode"}, p_.endGcode);
    recogniseKlipper(out_);
    applyAdvance(out_.profile, p_);  // needs the filament and the nozzle
  }

 private:
  const std::string* find(Keys keys);
  void noteTaken() { out_.read.push_back(key_); }
  void noteFailed(const char* code, const std::string& value) {
    addNote(out_.notRead, importNote(code, {{"key", key_}, {"value", shown(value)}}));
  }
  void number(Keys keys, double low, double high, double& out);
  double positive(Keys keys, double high);

  void profile();
  void names();
  void bed();
  void numbers();
  void flavor();
  void cornerSpeed();
  void filamentFlow();
  void block(Keys keys, std::string& out);

  const SlicerSettings& settings_;
  ImportedPrinter& out_;
  Printer& p_;
  std::string key_;  // key that was found last
};

// Text of a setting by the first of its keys that has a value; null: none.
const std::string* SettingsReader::find(Keys keys) {
  for (const std::string_view key : keys) {
    const auto found = settings_.find(key);
    if (found == settings_.end() || found->second.empty() || found->second == "nil") continue;
    key_ = key;
    return &found->second;
  }
  return nullptr;
}

// Reads a number, and notes one that is not within its limits.
void SettingsReader::number(Keys keys, double low, double high, double& out) {
  const std::string* text = find(keys);
  if (text == nullptr) return;
  const auto value = firstNumber(*text);
  if (!value) return noteFailed("NotANumber", *text);
  if (*value < low || *value > high) {
    addNote(out_.notRead,
            importNote("OutOfRange",
                       {{"key", key_}, {"value", shown(*text)}, {"low", decimal(low, 3)}, {"high", decimal(high, 3)}}));
    return;
  }
  out = *value;
  noteTaken();
}

/// Reads a number that slicers set to 0 for no limit. \param high  greatest value that is taken. \return 0: no limit,
/// or no value.
double SettingsReader::positive(Keys keys, double high) {
  double value = 0;
  number(keys, 0, high, value);
  return value;
}

// Begins with the profile of the same machine, for what its maker publishes and files do not state, as the board's
// rate.
void SettingsReader::profile() {
  for (const std::string_view key : {"printer_model", "inherits", "printer_settings_id", "name"}) {
    const auto found = settings_.find(key);
    std::optional<PrinterProfile> match = found == settings_.end() ? std::nullopt : profileOf(found->second);
    if (!match) continue;
    p_ = std::move(match->printer);
    out_.profile = match->id;
    return;
  }
}

// Reads the printer's name, the type of filament, and the sizes of thumbnails.
void SettingsReader::names() {
  if (const std::string* text = find({"printer_model", "printer_settings_id", "name"})) {
    p_.name = text->substr(0, 100);
    noteTaken();
  }
  if (const std::string* text = find({"filament_type", "material_type"})) {
    p_.filamentType = text->substr(0, std::min({text->find(';'), text->find(','), std::size_t{100}}));
    noteTaken();
  }
  if (const std::string* text = find({"thumbnails"})) {
    std::string sizes = *text;
    std::replace(sizes.begin(), sizes.end(), ';', ',');
    if (readThumbnailSizes(sizes)) {
      p_.screenSizes = sizes;
      noteTaken();
    } else {
      noteFailed("Thumbnails", *text);
    }
  }
}

// Reads the shape of the bed, and the parts of it that cannot be used.
void SettingsReader::bed() {
  if (const std::string* text = find({"bed_shape", "printable_area"})) {
    const std::vector<Vec2> corners = readCorners(*text);
    Bounds box;
    for (const Vec2 corner : corners) box.add(corner);
    const Vec2 size = box.size();
    if (corners.size() < 3 || !(size.x >= 10 && size.y >= 10 && size.x <= 5000 && size.y <= 5000)) {
      noteFailed("BedShape", *text);
    } else {
      p_.bedMin = box.min;
      p_.bedMax = box.max;
      noteTaken();
      const Vec2 centre = 0.5 * (box.min + box.max);
      const double radius = size.x / 2;
      const auto onCircle = [&](Vec2 corner) { return std::abs(length(corner - centre) - radius) < 0.01 * radius; };
      p_.roundBed = corners.size() > 8 && std::all_of(corners.begin(), corners.end(), onCircle);
      if (p_.roundBed) {
        p_.bedMin = centre - Vec2{radius, radius};
        p_.bedMax = centre + Vec2{radius, radius};
      } else if (corners.size() != 4) {
        addNote(out_.notRead, importNote("BedCorners", {{"count", std::to_string(corners.size())}}));
      }
    }
  } else if (out_.profile.empty()) {
    addNote(out_.notRead, bedUnknown(p_));
  }
  BedArea area{{p_.bedMin, p_.bedMax}, {}};
  if (const std::string* text = find({"extruder_printable_area"}); text != nullptr && reachByAll(*text, area))
    noteTaken();
  if (const std::string* text = find({"bed_exclude_area"});
      text != nullptr && *text != "0x0") {  // Orca writes 0x0 for none
    exclude(*text, area) ? noteTaken() : noteFailed("ExcludedArea", *text);
  }
  p_.bedMin = area.bed.min;
  p_.bedMax = area.bed.max;
  if (!area.excluded.empty()) {
    p_.excludedMin = area.excluded.min;
    p_.excludedMax = area.excluded.max;
  }
}

// Reads sizes, filament, temperatures, retraction and limits.
void SettingsReader::numbers() {
  number({"max_print_height", "printable_height", "machine_height"}, 1, 5000, p_.maxZ);
  number({"z_offset", "adhesion_z_offset"}, -2, 2, p_.zOffset);  // the second key is from Cura's Z offset plugin
  number({"nozzle_diameter", "machine_nozzle_size"}, 0.05, 2, p_.nozzle);
  number({"filament_diameter", "material_diameter"}, 0.5, 5, p_.filamentDiameter);
  number({"filament_density", "material_density"}, 0.1, 25, p_.filamentDensity);
  const double hottest = p_.maxNozzleTemperature;
  number({"temperature", "nozzle_temperature", "material_print_temperature"}, 170, hottest, p_.nozzleTemperature);
  p_.firstLayerNozzleTemperature = std::clamp(p_.nozzleTemperature + 5, 170.0, hottest);
  number({"first_layer_temperature", "nozzle_temperature_initial_layer", "material_print_temperature_layer_0"}, 170,
         hottest, p_.firstLayerNozzleTemperature);
  number({"first_layer_bed_temperature", "hot_plate_temp_initial_layer", "bed_temperature_initial_layer_single",
          "bed_temperature", "hot_plate_temp", "material_bed_temperature_layer_0", "material_bed_temperature"},
         0, p_.maxBedTemperature, p_.bedTemperature);
  number({"retract_length", "retraction_length", "retraction_amount"}, 0, 20, p_.retractLength);
  number({"retract_speed", "retraction_speed"}, 1, 200, p_.retractSpeed);
  number({"travel_speed", "speed_travel"}, 5, 1000, p_.travelSpeed);
  const double flow = positive({"filament_max_volumetric_speed"}, 1000);
  if (flow > 0.1) p_.maxFlow = flow;
  const double lift = positive({"retract_lift", "z_hop"}, 20);
  if (lift > 0) p_.lift = lift;  // without a lift, travels would cross the finished top
  const double acceleration = positive({"machine_max_acceleration_extruding"}, 100'000);
  if (acceleration >= 1) {
    p_.machineAcceleration = acceleration;
    p_.acceleration = std::min(kAcceleration, acceleration);
  }
  const double speed = positive({"machine_max_feedrate_x", "machine_max_speed_x"}, 1000);
  if (speed >= 5) p_.machineSpeed = speed;
  const double jerk = positive({"machine_max_jerk_x"}, 200);
  if (jerk > 0) p_.cornerSpeed = std::clamp(jerk / 2, 0.1, 100.0);
}

// Reads the flow that the owner measured for the filament, times OrcaSlicer's factor for the whole print.
void SettingsReader::filamentFlow() {
  constexpr double kLeast = 0.1, kMost = 2;  // limits of the setting
  double percent = 100;                      // Cura's factor
  double print = 1;
  number({"extrusion_multiplier", "filament_flow_ratio"}, kLeast, kMost, p_.filamentFlow);
  number({"material_flow"}, 100 * kLeast, 100 * kMost, percent);
  number({"print_flow_ratio"}, kLeast, kMost, print);
  p_.filamentFlow = std::clamp(p_.filamentFlow * (percent / 100 * print), kLeast, kMost);
  if (p_.filamentFlow == 1) return;
  addNote(out_.notRead, importNote("FlowTaken", {{"value", decimal(p_.filamentFlow, 3)}}));
}

// Takes the file's jerk as the printer's, since slicers write it into each file. Klipper has another measure, and
// RepRapFirmware its own file.
void SettingsReader::cornerSpeed() {
  if (find({"machine_max_jerk_x"}) == nullptr) return;
  if (p_.flavor == GcodeFlavor::Klipper || p_.flavor == GcodeFlavor::RepRap) return;
  p_.machineCornerSpeed = p_.cornerSpeed;
  p_.cornerSpeed = std::min(p_.cornerSpeed, Printer{}.cornerSpeed);
}

// Reads the firmware, and knows Prusa's and Bambu's machines by their names.
void SettingsReader::flavor() {
  if (const std::string* text = find({"gcode_flavor", "machine_gcode_flavor"})) {
    std::string word = *text;
    for (char& c : word) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    if (word.find("marlin") != std::string::npos) {               // Cura writes RepRap (Marlin/Sprinter)
      if (out_.profile.empty()) p_.flavor = GcodeFlavor::Marlin;  // slicers also write it for lack of a better word
    } else if (word == "klipper") {
      p_.flavor = GcodeFlavor::Klipper;
    } else if (word.starts_with("reprap")) {
      p_.flavor = GcodeFlavor::RepRap;
    } else {
      // UltiGCode is for the Ultimaker 2 and its kin, with filament of 2.85 mm that files do not state. In files
      // without that header, as ours, they count E in mm.
      if (word == "ultigcode" && p_.filamentDiameter == Printer().filamentDiameter) p_.filamentDiameter = kWideFilament;
      return noteFailed("Flavor", *text);
    }
    noteTaken();
  }
  constexpr std::string_view kBuddy[] = {"MK4", "MK3.5", "MK3.9", "MINI", "XL", "COREONE"};
  const auto buddy = [&](std::string_view model) { return p_.name.starts_with(model); };
  if (p_.flavor == GcodeFlavor::Marlin && std::any_of(std::begin(kBuddy), std::end(kBuddy), buddy)) {
    p_.flavor = GcodeFlavor::PrusaBuddy;
  }
  if (p_.name.starts_with("Bambu Lab")) p_.flavor = GcodeFlavor::Bambu;
  // Klipper runs on a computer, and the others except Marlin on boards of 32 bits.
  if (out_.profile.empty() && p_.flavor != GcodeFlavor::Marlin) p_.maxSegmentsPerSecond = kFastBoard;
}

// Reads a block, and fills in the settings that it asks for.
void SettingsReader::block(Keys keys, std::string& out) {
  const std::string* text = find(keys);
  if (text == nullptr) return;
  if (text->size() > kMaxBlockBytes) return noteFailed("BlockTooLong", *text);
  std::string lines;
  for (std::string_view rest = *text; !rest.empty();) {
    const std::string_view line = nextLine(rest);
    const std::string_view plain = trimmed(line);
    // Marks of layers and the slicer's name are left out: the new file is not that slicer's.
    const bool foreign = isLayerMark(plain) || (plain.starts_with(';') && plain.find("enerated by") != plain.npos);
    if (!foreign) lines.append(line).append("\n");
  }
  if (!text->ends_with('\n') && !lines.empty()) lines.pop_back();
  out = withSettings(lines, settings_, templateValues(p_, {}, {}));
  if (out.size() > kMaxBlockBytes) {
    out.clear();
    return noteFailed("BlockTooLong", *text);
  }
  noteTaken();
}

// A plate in the middle of the bed, for blocks that compute something from the plate.
Bounds somePlate(const Printer& printer) {
  const Vec2 middle = 0.5 * (printer.bedMin + printer.bedMax);
  const Vec2 quarter = 0.25 * (printer.bedMax - printer.bedMin);
  return {middle - quarter, middle + quarter};
}

// Adds the heating that a start block lacks, as its slicer does by itself.
void addHeating(Printer& printer) {
  std::string& block = printer.startGcode;
  if (block.empty()) return;
  const auto expanded = expandTemplate(block, templateValues(printer, {}, somePlate(printer)), "");
  if (!expanded) return;  // judgeBlocks notes the reason
  const GcodeCheck check = checkGcode(expanded.value(), printer);
  if (!check.heatsNozzle) {
    if (!block.ends_with('\n')) block += '\n';
    block = "M104 S{first_layer_temperature}\n" + block + "M109 S{first_layer_temperature}\n";
  }
  if (!check.heatsBed) block = "M190 S{first_layer_bed_temperature}\n" + block;
}

}  // namespace

ImportNote bedUnknown(const Printer& printer) {
  const Vec2 size = printer.bedMax - printer.bedMin;
  return importNote("BedUnknown", {{"width", decimal(size.x, 0)}, {"depth", decimal(size.y, 0)}});
}

void takeSettings(const SlicerSettings& settings, ImportedPrinter& out) { SettingsReader(settings, out).all(); }

void chooseTool(SlicerSettings& settings, std::size_t tool) {
  const auto types = settings.find("filament_type");
  const std::size_t count = types == settings.end() ? 0 : itemsOf(types->second);
  if (tool >= count) return;
  for (auto& [key, value] : settings) {
    const bool other = key.starts_with("machine_") || key.ends_with("_area") || key.ends_with("_shape") ||
                       key.ends_with("gcode") || key == "thumbnails";
    if (!other && itemsOf(value) == count) value = itemOf(value, tool);
  }
}

void judgeBlocks(ImportedPrinter& out) {
  const std::vector<TemplateValue> values = templateValues(out.printer, {}, somePlate(out.printer));
  for (const auto& [name, text] :
       {std::pair{"printer.startGcode", &out.printer.startGcode}, {"printer.endGcode", &out.printer.endGcode}}) {
    if (const auto expanded = expandTemplate(*text, values, name); !expanded) {
      addNote(out.notRead, importNote(expanded.error()));
    }
  }
}

Result<ImportedPrinter> printerOfSettings(const SlicerSettings& settings, ImportedPrinter out) {
  takeSettings(settings, out);
  if (out.read.empty()) return refusedFile("NoPrinterSettings");
  addHeating(out.printer);
  judgeBlocks(out);
  std::sort(out.read.begin(), out.read.end());
  return out;
}

void recogniseKlipper(ImportedPrinter& out) {
  Printer& printer = out.printer;
  if (printer.flavor != GcodeFlavor::Marlin) return;
  for (std::string_view rest = printer.startGcode; !rest.empty();) {
    const GcodeCommand command = commandOf(partsOf(nextLine(rest)).code);
    if (command.letter != 0 || command.name.find('_') == std::string_view::npos) continue;
    printer.flavor = GcodeFlavor::Klipper;
    printer.maxSegmentsPerSecond = kFastBoard;
    return;
  }
}

}  // namespace sillon
