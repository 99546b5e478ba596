#include "presets.hpp"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "sillon/settings/table.hpp"

namespace cli {
namespace {

using sillon::GcodeFlavor;
using sillon::Printer;
using sillon::PrinterProfile;
using sillon::ProfileKind;

/// "0.05 to 20 mm", "none|soft|count"
std::string rangeText(const sillon::Setting& row) {
  using sillon::SettingType;
  if (row.type == SettingType::Choice) {
    std::string words = row.choices;
    std::replace(words.begin(), words.end(), ' ', '|');
    return words;
  }
  if (row.type == SettingType::Flag) return "true|false";
  if (row.type == SettingType::Text || row.type == SettingType::Block || row.type == SettingType::Name) return "text";
  if (row.type == SettingType::PictureList) return "up to 4 files";
  char range[96];
  std::snprintf(range, sizeof range, "%.6g to %.6g %s", row.low, row.high, row.unit);
  return range;
}

std::string flavor(const Printer& printer) {
  sillon::Project project;
  project.printer = printer;
  return sillon::settingText(*sillon::findSetting(sillon::Section::Printer, "flavor"), project);
}

std::string printerLine(const PrinterProfile& preset) {
  const Printer& p = preset.printer;
  const sillon::Vec2 size = p.bedMax - p.bedMin;
  const bool centred = p.bedMin.x < 0;
  char bed[64];
  std::snprintf(bed, sizeof bed, "%gx%gx%g%s%s", size.x, size.y, p.maxZ, p.roundBed ? " round" : "",
                centred ? " centred" : "");
  char heat[32];
  std::snprintf(heat, sizeof heat, "%g/%g", p.maxNozzleTemperature, p.maxBedTemperature);
  char line[256];
  const char* start = !p.startGcode.empty() ? "own" : p.flavor == GcodeFlavor::Bambu ? "yours is needed" : "plain";
  std::snprintf(line, sizeof line, "%-28s %-8s %-26s %g    %-9s %s\n", preset.id.c_str(), flavor(p).c_str(), bed,
                p.nozzle, heat, start);
  return line;
}

std::string filamentLine(const PrinterProfile& preset) {
  const Printer& p = preset.printer;
  char line[256];
  std::snprintf(line, sizeof line, "%-12s %-6s %4g then %4g  %4g   %g\n", preset.id.c_str(), p.filamentType.c_str(),
                p.firstLayerNozzleTemperature, p.nozzleTemperature, p.bedTemperature, p.filamentDensity);
  return line;
}

}  // namespace

std::string presetTable(ProfileKind kind) {
  const bool printers = kind == ProfileKind::Printer;
  std::string out =
      printers ? "id                           dialect  bed [mm]                   nozzle most [C]  start block\n"
               : "id           type   nozzle [C]      bed [C]  g/cm3\n";
  for (const PrinterProfile& preset : sillon::profiles(kind))
    out += printers ? printerLine(preset) : filamentLine(preset);
  return out;
}

std::string presetsJson(ProfileKind kind) {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  for (const PrinterProfile& preset : sillon::profiles(kind)) {
    Json& one = list.emplace_back(Json{{"id", preset.id}});
    if (!preset.maker.empty()) one["maker"] = preset.maker;
    one["printer"] = Json::parse(sillon::writePrinter(preset.printer))["printer"];
  }
  return Json{{kind == ProfileKind::Printer ? "printers" : "filaments", list}}.dump(2) + "\n";
}

std::string presetFile(ProfileKind kind, const std::string& id) {
  for (const PrinterProfile& preset : sillon::profiles(kind)) {
    if (preset.id == id) return sillon::writePrinter(preset.printer);
  }
  return "";
}

std::string settingsTable() {
  const sillon::Project defaults;
  std::string out = "setting                              default              range, unit; * for experts\n";
  for (const sillon::Setting& row : sillon::settings()) {
    const sillon::SettingWords words = sillon::wordsOf(row);
    char line[512];
    std::snprintf(line, sizeof line, "%-36s %-20s %s%s\n%36s %s%s%s%s\n", sillon::fullName(row).c_str(),
                  sillon::settingText(row, defaults).c_str(), rangeText(row).c_str(),
                  row.level == sillon::Level::Expert ? " *" : "", "", words.help, *words.option == '\0' ? "" : " (",
                  words.option, *words.option == '\0' ? "" : ")");
    out += line;
  }
  return out;
}

}  // namespace cli
