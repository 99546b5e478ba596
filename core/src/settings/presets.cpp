#include "sillon/settings/presets.hpp"

#include <algorithm>
#include <utility>

#include "base/json.hpp"
#include "base/numbers.hpp"
#include "settings/json.hpp"
#include "settings/preset_data.hpp"
#include "sillon/base/words.hpp"
#include "sillon/settings/table.hpp"

namespace sillon {
namespace {

/// JSON built into the library, and the name of one row of it.
struct BuiltIn {
  const char* key;
  const char* setting;
  std::string_view json;
};
constexpr BuiltIn kPrinters{"printers", "printer.profile", kPrintersJson};
constexpr BuiltIn kFilaments{"filaments", "printer.filament", kFilamentsJson};
constexpr BuiltIn kPresets{"presets", "toolpath.preset", kPresetsJson};

/// Parses built-in JSON once, because files of many printers, and tests, ask for it again and again.
const Json& rowsOf(const BuiltIn& builtIn) {
  static const Json printers = parseJson(kPrinters.json)[kPrinters.key];
  static const Json filaments = parseJson(kFilaments.json)[kFilaments.key];
  static const Json presets = parseJson(kPresets.json)[kPresets.key];
  return &builtIn == &kPrinters ? printers : &builtIn == &kFilaments ? filaments : presets;
}

const BuiltIn& builtIn(ProfileKind kind) { return kind == ProfileKind::Printer ? kPrinters : kFilaments; }

SettingsView viewOf(Printer& printer) {
  SettingsView view;
  view.printer = &printer;
  return view;
}

std::vector<std::string> ids(const Json& rows) {
  std::vector<std::string> all;
  for (const auto& item : rows.items()) all.push_back(item.key());
  return all;
}

/// Returns a row without the facts about the machine itself, which are no settings.
Json settingsOf(Json row) {
  for (const char* fact : {"maker", "models", "source", "advance"}) row.erase(fact);
  return row;
}

/// Applies a built-in row to settings.
Fault apply(const BuiltIn& builtIn, const std::string& id, Section section, const SettingsView& view) {
  const Json& rows = rowsOf(builtIn);
  const auto found = rows.find(id);
  if (found != rows.end()) return readSection(settingsOf(*found), section, view);
  return unknownName("NameLike", "NameUnknown", builtIn.setting, id, ids(rows));
}

// Reduces a name to lower-case letters and digits without the nozzle: "Bambu Lab A1 0.4 nozzle" becomes "bambulaba1".
std::string plainName(std::string_view text) {
  if (text.ends_with("nozzle")) text = text.substr(0, text.rfind(" 0."));
  std::string out;
  for (const char c : text.substr(0, 100)) {
    if (c >= 'A' && c <= 'Z') out += static_cast<char>(c - 'A' + 'a');
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '+') out += c;
  }
  return out;
}

}  // namespace

std::vector<PrinterProfile> profiles(ProfileKind kind) {
  const Json& rows = rowsOf(builtIn(kind));
  std::vector<PrinterProfile> result;
  for (const auto& item : rows.items()) {
    PrinterProfile profile;
    profile.id = item.key();
    profile.maker = item.value().value("maker", "");
    if (item.value().contains("models")) profile.models = item.value()["models"].get<std::vector<std::string>>();
    readSection(settingsOf(item.value()), Section::Printer, viewOf(profile.printer));
    if (kind == ProfileKind::Printer) applyAdvance(profile.id, profile.printer);
    result.push_back(std::move(profile));
  }
  return result;
}

std::optional<PrinterProfile> profileOf(std::string_view model) {
  const std::string wanted = plainName(model);
  if (wanted.empty()) return std::nullopt;
  static const std::vector<PrinterProfile> all = profiles(ProfileKind::Printer);
  for (const PrinterProfile& profile : all) {
    std::vector<std::string> names = profile.models;
    names.insert(names.end(), {profile.printer.name, profile.maker + profile.printer.name});
    const auto same = [&](const std::string& name) { return plainName(name) == wanted; };
    if (!profile.maker.empty() && std::any_of(names.begin(), names.end(), same)) return profile;
  }
  return std::nullopt;
}

std::optional<Error> applyProfile(ProfileKind kind, const std::string& id, Printer& printer) {
  Fault wrong = apply(builtIn(kind), id, Section::Printer, viewOf(printer));
  if (!wrong && kind == ProfileKind::Printer) applyAdvance(id, printer);
  return wrong;
}

std::string filamentFamily(std::string_view filamentType) {
  std::string family;
  for (const char c : filamentType) {
    const bool small = c >= 'a' && c <= 'z';
    if (!small && !(c >= 'A' && c <= 'Z')) break;
    family += small ? static_cast<char>(c - 'a' + 'A') : c;
  }
  return family;
}

double usualFan(std::string_view filamentType) {
  static const Json families = parseJson(kFilamentsJson)["families"];
  return families["fan"].value(filamentFamily(filamentType), families["otherFan"].get<double>());
}

void applyAdvance(const std::string& profile, Printer& printer) {
  const Json& rows = rowsOf(kPrinters);
  const auto row = rows.find(profile);
  if (row == rows.end()) return;
  const Json byFilament = row->value("advance", Json::object());
  const Json byNozzle = byFilament.value(filamentFamily(printer.filamentType), Json::object());
  const auto found = byNozzle.find(decimal(printer.nozzle, 3));
  printer.setPressureAdvance = found != byNozzle.end();
  printer.pressureAdvance = printer.setPressureAdvance ? found->get<double>() : Printer().pressureAdvance;
}

void followAdvance(const Project& before, Project& changed) {
  Printer makers = before.printer;
  applyAdvance(before.printerProfile, makers);
  const bool own = makers.pressureAdvance != before.printer.pressureAdvance ||
                   makers.setPressureAdvance != before.printer.setPressureAdvance;
  if (!own || before.printerProfile != changed.printerProfile) applyAdvance(changed.printerProfile, changed.printer);
}

std::vector<std::string> presets() { return ids(rowsOf(kPresets)); }

std::optional<Error> applyPreset(const std::string& id, ToolpathParams& params) {
  SettingsView view;
  view.toolpath = &params;
  return apply(kPresets, id, Section::Toolpath, view);
}

std::string writePrinter(const Printer& printer) { return projectText(viewOf(const_cast<Printer&>(printer))); }

}  // namespace sillon
