#include "sillon/printer_import.hpp"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "gcode_template.hpp"
#include "sillon/gcode_archive.hpp"
#include "sillon/gcode_check.hpp"
#include "sillon/project.hpp"
#include "sillon/thumbnails.hpp"
#include "text.hpp"

namespace sillon {
namespace {

using Json = nlohmann::json;
using Settings = std::map<std::string, std::string, std::less<>>;  // by the names of PrusaSlicer, Orca or Cura

constexpr std::size_t kMaxBytes = std::size_t{256} << 20;
constexpr std::size_t kMaxSettingsBytes = std::size_t{16} << 20;
constexpr std::size_t kMaxBlockBytes = 65'536;
constexpr int kMaxInherited = 1000;  // sections of a bundle in one printer
constexpr int kDeepestInherited = 32;
constexpr double kAcceleration = 1500;  // [mm/s²], of beads; U-turns show what lies above

Error invalidFile(std::string message) { return Error{ErrorCode::InvalidFile, std::move(message)}; }

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

std::string_view nextLine(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::string shown(std::string_view text) {
  std::string out = "\"";
  for (const char c : text.substr(0, 60)) out += c < ' ' || c > '~' || c == '"' ? '?' : c;
  return out + (text.size() > 60 ? "...\"" : "\"");
}

/// The first number of "0.4", "0.4,0.4", "500;1250": settings of several tools begin with the first one's.
std::optional<double> firstNumber(std::string_view text) {
  double value = 0;
  text = trimmed(text);
  const auto read =
      fast_float::from_chars(text.data(), text.data() + text.size(), value, fast_float::chars_format::fixed);
  if (read.ec != std::errc{} || !(std::abs(value) < 1e9)) return std::nullopt;
  const std::string_view rest(read.ptr, static_cast<std::size_t>(text.data() + text.size() - read.ptr));
  const bool ends = rest.empty() || rest[0] == ',' || rest[0] == ';' || rest[0] == '%';
  return ends && !rest.starts_with('%') ? std::optional<double>(value) : std::nullopt;
}

/// "0x0,220x0,220x220,0x220"; empty if it is not that.
std::vector<Vec2> readCorners(std::string_view text) {
  std::vector<Vec2> corners;
  while (!text.empty()) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const std::string_view word = trimmed(text.substr(0, comma));
    text.remove_prefix(std::min(comma + 1, text.size()));
    const std::size_t middle = word.find('x');
    if (middle == std::string_view::npos || corners.size() == 1000) return {};
    const auto x = firstNumber(word.substr(0, middle));
    const auto y = firstNumber(word.substr(middle + 1));
    if (!x || !y) return {};
    corners.push_back({*x, *y});
  }
  return corners;
}

/// PrusaSlicer's and Cura's escapes in one-line texts.
std::string unescaped(std::string_view text) {
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  std::string out;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] != '\\' || k + 1 == text.size()) {
      out += text[k];
      continue;
    }
    ++k;
    out += text[k] == 'n' ? '\n' : text[k] == 't' ? ' ' : text[k] == 'r' ? ' ' : text[k];
  }
  return out;
}

/// "key = value", split at the first equal sign only: values hold them too.
bool splitSetting(std::string_view line, std::string_view& key, std::string_view& value) {
  const std::size_t equal = line.find('=');
  if (equal == std::string_view::npos) return false;
  key = trimmed(line.substr(0, equal));
  value = trimmed(line.substr(equal + 1));
  const auto isKey = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
  return !key.empty() && key.size() <= 80 && std::all_of(key.begin(), key.end(), isKey);
}

// ---- settings to a printer

class Taker {
 public:
  Taker(const Settings& settings, ImportedPrinter& out) : settings_(settings), out_(out) {}

  void all() {
    names();
    bed();
    if (find({"bed_shape", "printable_area"}) == nullptr) {
      out_.notRead.push_back("the file does not tell the bed; " + decimal(out_.printer.bedMax.x, 0) + " x " +
                             decimal(out_.printer.bedMax.y, 0) + " mm is taken");
    }
    numbers();
    flavor();  // after the name
    cornerSpeed();
    block({"start_gcode", "machine_start_gcode"}, out_.printer.startGcode);
    block({"end_gcode", "machine_end_gcode"}, out_.printer.endGcode);
  }

 private:
  using Keys = std::initializer_list<std::string_view>;

  /// The first of the keys that is there.
  const std::string* find(Keys keys) {
    for (const std::string_view key : keys) {
      const auto found = settings_.find(key);
      if (found == settings_.end() || found->second.empty() || found->second == "nil") continue;
      key_ = key;
      return &found->second;
    }
    return nullptr;
  }
  void took() { out_.read.push_back(key_); }
  void failed(const std::string& value, const std::string& why) {
    out_.notRead.push_back(key_ + " is " + shown(value) + "; " + why);
  }

  void number(Keys keys, double low, double high, double& out) {
    const std::string* text = find(keys);
    if (text == nullptr) return;
    const auto value = firstNumber(*text);
    if (!value) return failed(*text, "it must be a number");
    if (*value < low || *value > high) return failed(*text, "taken are " + decimal(low, 3) + " to " + decimal(high, 3));
    out = *value;
    took();
  }

  void names() {
    Printer& p = out_.printer;
    if (const std::string* text = find({"printer_model", "printer_settings_id", "name"})) {
      p.name = text->substr(0, 100);
      took();
    }
    if (const std::string* text = find({"filament_type", "material_type"})) {
      p.filamentType = text->substr(0, std::min({text->find(';'), text->find(','), std::size_t{100}}));
      took();
    }
    if (const std::string* text = find({"thumbnails"})) {
      std::string sizes = *text;
      std::replace(sizes.begin(), sizes.end(), ';', ',');
      if (readThumbnailSizes(sizes)) {
        p.screenSizes = sizes;
        took();
      } else {
        failed(*text, "taken are at most 8 sizes as PNG or QOI");
      }
    }
  }

  void bed() {
    Printer& p = out_.printer;
    if (const std::string* text = find({"bed_shape", "printable_area"})) {
      const std::vector<Vec2> corners = readCorners(*text);
      Bounds box;
      for (const Vec2 corner : corners) box.add(corner);
      const Vec2 size = box.size();
      if (corners.size() < 3 || !(size.x >= 10 && size.y >= 10 && size.x <= 5000 && size.y <= 5000)) {
        failed(*text, "it must be corners such as \"0x0,220x0,220x220,0x220\"");
      } else {
        p.bedMin = box.min;
        p.bedMax = box.max;
        took();
        const Vec2 centre = 0.5 * (box.min + box.max);
        const double radius = size.x / 2;
        const auto onCircle = [&](Vec2 corner) { return std::abs(length(corner - centre) - radius) < 0.01 * radius; };
        if (corners.size() > 8 && std::all_of(corners.begin(), corners.end(), onCircle)) {
          p.roundBed = true;
          p.bedMin = centre - Vec2{radius, radius};
          p.bedMax = centre + Vec2{radius, radius};
        } else if (corners.size() != 4) {
          out_.notRead.push_back("the bed has " + std::to_string(corners.size()) +
                                 " corners; the box around them is taken");
        }
      }
    }
    if (const std::string* text = find({"bed_exclude_area"})) {
      const std::vector<Vec2> corners = readCorners(*text);
      Bounds box;
      for (const Vec2 corner : corners) box.add(corner);
      const bool usable =
          corners.size() >= 3 && box.min.x >= -5000 && box.min.y >= -5000 && box.max.x <= 5000 && box.max.y <= 5000;
      if (usable) {
        p.excludedMin = box.min;
        p.excludedMax = box.max;
        took();
      } else if (*text != "0x0") {  // Orca's way to say none
        failed(*text, "it must be one box of corners");
      }
    }
  }

  void numbers() {
    Printer& p = out_.printer;
    number({"max_print_height", "printable_height"}, 1, 5000, p.maxZ);
    number({"nozzle_diameter", "machine_nozzle_size"}, 0.05, 2, p.nozzle);
    number({"filament_diameter", "material_diameter"}, 0.5, 5, p.filamentDiameter);
    number({"filament_density", "material_density"}, 0.1, 25, p.filamentDensity);
    number({"temperature", "nozzle_temperature", "material_print_temperature"}, 170, 300, p.nozzleTemperature);
    p.firstLayerNozzleTemperature = std::clamp(p.nozzleTemperature + 5, 170.0, 300.0);
    number({"first_layer_temperature", "nozzle_temperature_initial_layer", "material_print_temperature_layer_0"}, 170,
           300, p.firstLayerNozzleTemperature);
    number({"first_layer_bed_temperature", "hot_plate_temp_initial_layer", "bed_temperature_initial_layer_single",
            "bed_temperature", "hot_plate_temp", "material_bed_temperature_layer_0", "material_bed_temperature"},
           0, 120, p.bedTemperature);
    number({"retract_length", "retraction_length", "retraction_amount"}, 0, 20, p.retractLength);
    number({"retract_speed", "retraction_speed"}, 1, 200, p.retractSpeed);
    number({"travel_speed", "speed_travel"}, 5, 1000, p.travelSpeed);
    double value = 0;
    number({"filament_max_volumetric_speed"}, 0, 1000, value);
    if (value > 0.1) p.maxFlow = value;  // 0 means no limit there
    value = 0;
    number({"retract_lift", "z_hop"}, 0, 20, value);
    if (value > 0) p.lift = value;  // without any, travels would cross the finished top
    value = 0;
    number({"machine_max_acceleration_extruding"}, 1, 100'000, value);
    if (value > 0) {
      p.machineAcceleration = value;
      p.acceleration = std::min(kAcceleration, value);
    }
    value = 0;
    number({"machine_max_feedrate_x", "machine_max_speed_x"}, 5, 1000, value);
    if (value > 0) p.machineSpeed = value;
    value = 0;
    number({"machine_max_jerk_x"}, 0.1, 200, value);
    if (value > 0) p.cornerSpeed = std::clamp(value / 2, 0.1, 100.0);
  }

  // Slicers write these firmwares' jerk into each file, so that it is known what the printer has; Klipper has another
  // measure and RepRapFirmware its own file.
  void cornerSpeed() {
    Printer& p = out_.printer;
    if (find({"machine_max_jerk_x"}) == nullptr) return;
    if (p.flavor == GcodeFlavor::Klipper || p.flavor == GcodeFlavor::RepRap) return;
    p.machineCornerSpeed = p.cornerSpeed;
    p.cornerSpeed = std::min(p.cornerSpeed, Printer{}.cornerSpeed);
  }

  void flavor() {
    Printer& p = out_.printer;
    const std::string* text = find({"gcode_flavor", "machine_gcode_flavor"});
    if (text != nullptr) {
      std::string word = *text;
      for (char& c : word) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
      if (word.starts_with("marlin")) {
        p.flavor = GcodeFlavor::Marlin;
      } else if (word == "klipper") {
        p.flavor = GcodeFlavor::Klipper;
      } else if (word.starts_with("reprap")) {
        p.flavor = GcodeFlavor::RepRap;
      } else {
        return failed(*text, "known are Marlin, Klipper and RepRapFirmware; Marlin is taken");
      }
      took();
    }
    constexpr std::string_view kBuddy[] = {"MK4", "MK3.5", "MK3.9", "MINI", "XL", "COREONE"};
    const auto buddy = [&](std::string_view model) { return p.name.starts_with(model); };
    if (p.flavor == GcodeFlavor::Marlin && std::any_of(std::begin(kBuddy), std::end(kBuddy), buddy)) {
      p.flavor = GcodeFlavor::PrusaBuddy;
    }
    if (p.name.starts_with("Bambu Lab")) p.flavor = GcodeFlavor::Bambu;
  }

  void block(Keys keys, std::string& out) {
    const std::string* text = find(keys);
    if (text == nullptr) return;
    if (text->size() > kMaxBlockBytes) return failed(*text, "a block may have 65536 bytes");
    out = *text;
    took();
  }

  const Settings& settings_;
  ImportedPrinter& out_;
  std::string key_;
};

/// What would stop or spoil an export later, said now.
void judgeBlocks(ImportedPrinter& out) {
  Printer& p = out.printer;
  const std::vector<TemplateValue> values = templateValues(p, {}, {});  // only the names matter here
  for (const auto& [name, text] : {std::pair{"the start block", &p.startGcode}, {"the end block", &p.endGcode}}) {
    if (const auto expanded = expandTemplate(*text, values, name); !expanded) {
      out.notRead.push_back(expanded.error().message);
    }
  }
}

Result<ImportedPrinter> fromSettings(const Settings& settings, std::string source, std::vector<std::string> notes) {
  ImportedPrinter out;
  out.source = std::move(source);
  out.notRead = std::move(notes);
  Taker(settings, out).all();
  if (out.read.empty()) return invalidFile("the file has no setting of a printer that is known here");
  judgeBlocks(out);
  std::sort(out.read.begin(), out.read.end());
  return out;
}

// ---- .ini

struct Bundle {
  std::map<std::string, Settings, std::less<>> sections;  // "printer:NAME", "filament:NAME", "presets"; "" if flat
  std::string lastPrinter;
};

Bundle readBundle(std::string_view text) {
  Bundle bundle;
  std::string section;
  while (!text.empty()) {
    const std::string_view line = trimmed(nextLine(text));
    if (line.empty() || line[0] == '#' || line[0] == ';') continue;
    if (line.front() == '[' && line.back() == ']') {
      section = std::string(trimmed(line.substr(1, line.size() - 2)));
      if (section.starts_with("printer:") && !section.starts_with("printer:*")) bundle.lastPrinter = section.substr(8);
      continue;
    }
    std::string_view key;
    std::string_view value;
    if (splitSetting(line, key, value)) bundle.sections[section].insert_or_assign(std::string(key), std::string(value));
  }
  return bundle;
}

/// A section with all it inherits, its own values last. \param budget  sections that may still be read.
void inherit(const Bundle& bundle, const std::string& kind, const std::string& name, int depth, int& budget,
             Settings& out, std::vector<std::string>& notes) {
  const auto found = bundle.sections.find(kind + name);
  if (found == bundle.sections.end()) {
    notes.push_back(kind + name + " is inherited, but not in the file; its values are missing");
    return;
  }
  if (budget == 0 || depth > kDeepestInherited) {
    const char* note = "the file inherits in a circle, or from more than 1000 sections; the rest is missing";
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.emplace_back(note);
    budget = 0;
    return;
  }
  --budget;
  if (const auto parents = found->second.find("inherits"); parents != found->second.end()) {
    std::string_view list = parents->second;
    while (!list.empty() && budget > 0) {
      const std::size_t end = std::min(list.find(';'), list.size());
      const std::string_view parent = trimmed(list.substr(0, end));
      list.remove_prefix(std::min(end + 1, list.size()));
      if (!parent.empty()) inherit(bundle, kind, std::string(parent), depth + 1, budget, out, notes);
    }
  }
  for (const auto& [key, value] : found->second) out.insert_or_assign(key, value);
}

Result<ImportedPrinter> fromIni(std::string_view text, std::string_view name) {
  const Bundle bundle = readBundle(text);
  std::vector<std::string> notes;
  Settings settings;
  if (const auto flat = bundle.sections.find(""); flat != bundle.sections.end() && bundle.lastPrinter.empty()) {
    settings = flat->second;
    if (const auto parents = settings.find("inherits"); parents != settings.end() && !parents->second.empty()) {
      notes.push_back("the file inherits from " + shown(parents->second) +
                      ", which lies elsewhere; what it lacks is ours");
    }
  } else {
    const auto active = bundle.sections.find("presets");
    const auto chosen = [&](const char* kind) {
      if (active == bundle.sections.end()) return std::string();
      const auto found = active->second.find(kind);
      return found == active->second.end() ? std::string() : found->second;
    };
    std::string printer = name.empty() ? chosen("printer") : std::string(name);
    if (printer.empty()) printer = bundle.lastPrinter;
    if (!bundle.sections.contains("printer:" + printer)) {
      std::string known;
      for (const auto& [section, values] : bundle.sections) {
        if (!section.starts_with("printer:") || section.starts_with("printer:*") || known.size() > 300) continue;
        known += (known.empty() ? "" : ", ") + shown(section.substr(8));
      }
      if (known.empty()) return invalidFile("the file has no section of a printer");
      return Error{ErrorCode::InvalidArgument, "the file has no printer " + shown(printer) + "; it has " + known};
    }
    int budget = kMaxInherited;
    inherit(bundle, "printer:", printer, 0, budget, settings, notes);
    if (!settings.contains("printer_model")) settings["printer_model"] = printer;
    std::string filament = chosen("filament");
    if (filament.empty() && settings.contains("default_filament_profile")) {
      filament = unescaped(settings["default_filament_profile"]);
    }
    if (bundle.sections.contains("filament:" + filament)) {
      inherit(bundle, "filament:", filament, 0, budget, settings, notes);
    }
  }
  for (const char* key : {"start_gcode", "end_gcode"}) {
    if (const auto found = settings.find(key); found != settings.end()) found->second = unescaped(found->second);
  }
  return fromSettings(settings, "PrusaSlicer settings", std::move(notes));
}

// ---- .json

Result<ImportedPrinter> fromJson(std::string_view text) {
  const Json root = Json::parse(text, nullptr, false);
  if (!root.is_object()) return invalidFile("the file begins like JSON, but is no JSON object");
  if (root.contains("sillon")) {
    Result<Project> project = readProject(text);
    if (!project) return project.error();
    ImportedPrinter out;
    out.printer = std::move(project).value().printer;
    out.source = "project";
    judgeBlocks(out);
    return out;
  }
  Settings settings;
  std::vector<std::string> notes;
  for (const auto& item : root.items()) {
    const Json& value = item.value();
    const Json* first = value.is_array() && !value.empty() ? &value[0] : &value;
    if (!first->is_string()) continue;
    std::string joined = first->get_ref<const std::string&>();
    // Corners are lists; of anything else the first tool's value counts.
    if (value.is_array() && (item.key() == "printable_area" || item.key() == "bed_exclude_area")) {
      for (std::size_t k = 1; k < value.size() && value[k].is_string(); ++k) {
        joined += "," + value[k].get_ref<const std::string&>();
      }
    }
    settings.insert_or_assign(item.key(), std::move(joined));
  }
  if (const auto parent = settings.find("inherits"); parent != settings.end() && !parent->second.empty()) {
    notes.push_back("the preset inherits from " + shown(parent->second) +
                    ", which lies in another file; what it lacks is ours");
  }
  return fromSettings(settings, "Orca settings", std::move(notes));
}

// ---- donor G-code

bool isLayerMark(std::string_view line) {
  return line == ";LAYER_CHANGE" || line == "; CHANGE_LAYER" || line == ";LAYER:0";
}

bool isCommand(std::string_view line, std::string_view word) {
  return line.starts_with(word) && (line.size() == word.size() || line[word.size()] == ' ');
}

bool hasWord(std::string_view line, char letter) {
  return line.find(std::string{' ', letter}) != std::string_view::npos;
}

bool isMove(std::string_view line) {
  return isCommand(line, "G0") || isCommand(line, "G1") || isCommand(line, "G2") || isCommand(line, "G3");
}

bool isBead(std::string_view line) {
  const std::size_t e = line.find(" E");
  return isMove(line) && e != std::string_view::npos && (hasWord(line, 'X') || hasWord(line, 'Y')) &&
         !line.substr(e + 2).starts_with('-');
}

// Belongs to the print it was made for, and says nothing about ours.
bool isOfOldPrint(std::string_view line) {
  return isCommand(line, "M73") || isCommand(line, "M486") || line.starts_with("EXCLUDE_OBJECT") ||
         line.starts_with("SET_PRINT_STATS_INFO");
}

// The donor drew its filament back for the way to its first bead, and pushed it forward there; ours begins primed.
void dropRetraction(std::string& block) {
  while (!block.empty()) {
    const std::size_t line = block.rfind('\n', block.size() - 2) + 1;  // npos + 1 is 0
    const std::string_view last = std::string_view(block).substr(line, block.size() - line - 1);
    const bool still = !hasWord(last, 'X') && !hasWord(last, 'Y') && !hasWord(last, 'Z');
    if (!isMove(last) || !still || last.find(" E-") == std::string_view::npos) return;
    block.resize(line);
  }
}

std::string_view codeOf(std::string_view line) { return trimmed(line.substr(0, line.find(';'))); }

class Donor {
 public:
  explicit Donor(ImportedPrinter& out) : out_(out) {}

  std::optional<Error> read(std::string_view text);

 private:
  void comment(std::string_view line);
  void startLine(std::string_view code);
  void endLine(std::string_view code);
  void note(const std::string& text) {
    if (std::find(out_.notRead.begin(), out_.notRead.end(), text) == out_.notRead.end()) out_.notRead.push_back(text);
  }

  ImportedPrinter& out_;
  Settings settings_;
  std::string cura_;  // its settings, escaped, over many comments
  bool relativeEnd_ = false;
};

void Donor::comment(std::string_view line) {
  constexpr std::string_view kCura = ";SETTING_3 ";
  if (line.starts_with(kCura) && cura_.size() < kMaxSettingsBytes) cura_ += line.substr(kCura.size());
  constexpr std::string_view kMachine = ";TARGET_MACHINE.NAME:";
  if (line.starts_with(kMachine)) settings_.insert_or_assign("printer_model", line.substr(kMachine.size()));
  if (line.starts_with(";FLAVOR:")) settings_.insert_or_assign("gcode_flavor", std::string(line.substr(8)));
  std::string_view key;
  std::string_view value;
  if (splitSetting(line.substr(1), key, value) && value.size() <= kMaxBlockBytes) {
    settings_.insert_or_assign(std::string(key), std::string(value));
  }
}

void Donor::startLine(std::string_view code) {
  if (isOfOldPrint(code)) return;
  std::string line(code);
  // Areas of the old plate become those of the new one.
  if (isCommand(code, "M555")) {
    line =
        "M555 X{first_layer_print_min[0]} Y{first_layer_print_min[1]} W{first_layer_print_size[0]} "
        "H{first_layer_print_size[1]}";
  } else if (code.starts_with("G29 A") && hasWord(code, 'X') && hasWord(code, 'I')) {
    line =
        "G29 A X{first_layer_print_min[0]} Y{first_layer_print_min[1]} I{first_layer_print_size[0]} "
        "J{first_layer_print_size[1]}";
  } else if (isCommand(code, "G29") && hasWord(code, 'X') && !hasWord(code, 'C') && !code.starts_with("G29 P9")) {
    note("the start block probes a fixed area (" + std::string(code.substr(0, 60)) +
         "); check that it is where the plate lies");
  } else if (code.find("MESH_MIN") != std::string_view::npos || code.find("PRINT_MIN") != std::string_view::npos) {
    note("the start block names a fixed area (" + std::string(code.substr(0, 60)) +
         "); check that it is where the plate lies");
  }
  out_.printer.startGcode += line + "\n";
}

void Donor::endLine(std::string_view code) {
  if (isOfOldPrint(code)) return;
  if (isCommand(code, "G90")) relativeEnd_ = false;
  if (isCommand(code, "G91")) relativeEnd_ = true;
  std::string line(code);
  // A height of the old print may lie inside the new plate. Ours has lifted the nozzle before the block begins.
  if (isMove(code) && !relativeEnd_ && hasWord(code, 'Z')) {
    const std::size_t z = line.find(" Z");
    line.erase(z, std::min(line.find(' ', z + 1), line.size()) - z);
    note("heights in the end block were left out; the nozzle is lifted by 10 mm before it");
    if (!hasWord(line, 'X') && !hasWord(line, 'Y') && !hasWord(line, 'E')) return;
  }
  out_.printer.endGcode += line + "\n";
}

std::optional<Error> Donor::read(std::string_view text) {
  // Where the end block begins is known only at the end, so this looks twice.
  std::string_view rest = text;
  std::size_t firstLayer = std::string_view::npos;
  std::size_t lastBead = 0;
  while (!rest.empty()) {
    const std::size_t at = text.size() - rest.size();
    const std::string_view line = trimmed(nextLine(rest));
    if (line.empty()) continue;
    if (line[0] == ';') {
      if (firstLayer == std::string_view::npos && isLayerMark(line)) firstLayer = at;
      comment(line);
    } else if (isBead(line)) {
      lastBead = text.size() - rest.size();
    }
  }
  if (firstLayer == std::string_view::npos) {
    return invalidFile(
        "the G-code marks no layer (;LAYER_CHANGE, ; CHANGE_LAYER or ;LAYER:0); its start block cannot be told");
  }
  if (lastBead <= firstLayer) return invalidFile("the G-code extrudes nothing after its first layer mark");

  // Resolved settings first; blocks in them are templates, the ones in the file are what was printed.
  for (const char* key : {"start_gcode", "machine_start_gcode", "end_gcode", "machine_end_gcode"}) settings_.erase(key);
  if (!cura_.empty()) {
    std::string_view lines = cura_;
    const std::string opened = unescaped(unescaped(lines));
    lines = opened;
    while (!lines.empty()) {
      std::string_view key;
      std::string_view value;
      if (!splitSetting(trimmed(nextLine(lines)), key, value) || key == "name")
        continue;  // of a quality, not a printer
      settings_.emplace(std::string(key), std::string(value));
    }
  }
  Taker(settings_, out_).all();

  rest = text.substr(0, firstLayer);
  while (!rest.empty()) {
    const std::string_view code = codeOf(nextLine(rest));
    if (!code.empty()) startLine(code);
    if (out_.printer.startGcode.size() > kMaxBlockBytes)
      return invalidFile("the start block is longer than 65536 bytes");
  }
  dropRetraction(out_.printer.startGcode);
  rest = text.substr(lastBead);
  bool begun =
      rest.find(";TYPE:Custom") == std::string_view::npos && rest.find("; FEATURE: Custom") == std::string_view::npos;
  bool wiping = begun;  // without a mark: moves that end the last bead come first
  while (!rest.empty()) {
    const std::string_view line = trimmed(nextLine(rest));
    if (line == ";TYPE:Custom" || line == "; FEATURE: Custom") begun = true;
    const std::string_view code = codeOf(line);
    if (!begun || code.empty()) continue;
    wiping = wiping && (isMove(code) || isCommand(code, "G92") || isOfOldPrint(code));
    if (!wiping) endLine(code);
    if (out_.printer.endGcode.size() > kMaxBlockBytes) return invalidFile("the end block is longer than 65536 bytes");
  }

  const GcodeCheck check = checkGcode(out_.printer.startGcode, out_.printer);
  if (!check.homes) note("the start block does not home");
  if (!check.heatsNozzle) note("the start block does not wait for a hot nozzle (M109)");
  if (!check.heatsBed) note("the start block does not wait for a hot bed (M190)");
  for (const GcodeFinding& finding : check.findings) {
    if (finding.rule == "bounds") note("the start block: " + finding.message);
  }
  // Temperatures are part of the block: what follows must fit them.
  if (check.nozzleTarget >= 170 && check.nozzleTarget <= 300) {
    out_.printer.firstLayerNozzleTemperature = check.nozzleTarget;
  }
  if (check.bedTarget > 0 && check.bedTarget <= 120) out_.printer.bedTemperature = check.bedTarget;
  return std::nullopt;
}

Result<ImportedPrinter> fromGcode(std::string_view text) {
  ImportedPrinter out;
  out.source = "donor G-code";
  if (auto error = Donor(out).read(text)) return *error;
  judgeBlocks(out);
  std::sort(out.read.begin(), out.read.end());
  return out;
}

// The first lines with a command or a setting tell the two apart.
bool looksLikeGcode(std::string_view text) {
  for (int k = 0; k < 5000 && !text.empty(); ++k) {
    const std::string_view line = trimmed(nextLine(text));
    if (line.size() >= 2 && (line[0] == 'G' || line[0] == 'M') && line[1] >= '0' && line[1] <= '9') return true;
    if (isLayerMark(line)) return true;
    std::string_view key;
    std::string_view value;
    if (!line.empty() && line[0] != ';' && line[0] != '#' && splitSetting(line, key, value)) return false;
  }
  return false;
}

}  // namespace

Result<ImportedPrinter> importPrinter(std::string_view bytes, std::string_view name) {
  if (bytes.starts_with("PK\x03\x04")) {
    const Result<std::string> gcode = unpackGcode(bytes);
    if (!gcode) return gcode.error();
    if (!looksLikeGcode(gcode.value())) return invalidFile("what the .gcode.3mf holds is no G-code");
    return fromGcode(gcode.value());
  }
  if (bytes.size() > kMaxBytes) {
    return Error{ErrorCode::TooLarge,
                 "the file is " + std::to_string(bytes.size() >> 20) + " MiB; it must be at most 256"};
  }
  std::string_view text = bytes;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  const bool json = begin != std::string_view::npos && text[begin] == '{';
  if (text.find('\0') != std::string_view::npos)
    return invalidFile("the file is no text; G-code, .ini and .json are read");
  if (!json && looksLikeGcode(text)) return fromGcode(text);
  if (text.size() > kMaxSettingsBytes) {
    return Error{ErrorCode::TooLarge,
                 "the settings are " + std::to_string(text.size() >> 20) + " MiB; they must be at most 16"};
  }
  return json ? fromJson(text) : fromIni(text, name);
}

}  // namespace sillon
