#include "sillon/settings/presets.hpp"

#include <string_view>
#include <utility>

#include "base/json.hpp"
#include "base/words.hpp"
#include "settings/json_in.hpp"
#include "settings/json_out.hpp"
#include "settings/preset_data.hpp"
#include "sillon/settings/table.hpp"

namespace sillon {
namespace {

/// JSON built into the library, and what one row of it is called.
struct BuiltIn {
  const char* key;
  const char* noun;
  std::string_view json;
};
constexpr BuiltIn kPrinters{"printers", "printer profile", kPrintersJson};
constexpr BuiltIn kFilaments{"filaments", "filament profile", kFilamentsJson};
constexpr BuiltIn kPresets{"presets", "preset", kPresetsJson};

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

/// A row without what is told of the machine itself.
Json settingsOf(Json row) {
  for (const char* fact : {"maker", "models", "source"}) row.erase(fact);
  return row;
}

std::string apply(const BuiltIn& builtIn, const std::string& id, Section section, const SettingsView& view) {
  const Json rows = Json::parse(builtIn.json)[builtIn.key];
  const auto found = rows.find(id);
  if (found != rows.end()) return readSection(settingsOf(*found), section, view);
  return inQuotes(id) + " is not a " + builtIn.noun + "; " + suggestion(id, ids(rows));
}

}  // namespace

std::vector<PrinterProfile> profiles(ProfileKind kind) {
  const Json rows = Json::parse(builtIn(kind).json)[builtIn(kind).key];
  std::vector<PrinterProfile> result;
  for (const auto& item : rows.items()) {
    PrinterProfile profile;
    profile.id = item.key();
    profile.maker = item.value().value("maker", "");
    if (item.value().contains("models")) profile.models = item.value()["models"].get<std::vector<std::string>>();
    readSection(settingsOf(item.value()), Section::Printer, viewOf(profile.printer));
    result.push_back(std::move(profile));
  }
  return result;
}

std::string applyProfile(ProfileKind kind, const std::string& id, Printer& printer) {
  return apply(builtIn(kind), id, Section::Printer, viewOf(printer));
}

std::vector<std::string> presets() { return ids(Json::parse(kPresets.json)[kPresets.key]); }

std::string applyPreset(const std::string& id, ToolpathParams& params) {
  SettingsView view;
  view.toolpath = &params;
  return apply(kPresets, id, Section::Toolpath, view);
}

std::string writePrinter(const Printer& printer) { return projectText(viewOf(const_cast<Printer&>(printer))); }

}  // namespace sillon
