#include "printer_import/slicer_files.hpp"

#include <algorithm>
#include <utility>

#include "base/refused.hpp"
#include "printer_import/notes.hpp"

namespace sillon {
namespace {

constexpr std::size_t kMostNames = 4000;  // bytes of names that an error lists, at most
constexpr int kMaxInherited = 1000;       // sections that one printer may consist of
constexpr int kDeepestInherited = 32;     // levels of sections that inherit from each other

// Sections of a file of settings.
struct Bundle {
  std::map<std::string, SlicerSettings, std::less<>>
      sections;                       // "printer:NAME", "filament:NAME", "presets"; "" if flat
  std::vector<std::string> printers;  // names of printers, without those in asterisks, which are only inherited from
};

// Reads sections, keys and values.
Bundle readBundle(std::string_view text) {
  Bundle bundle;
  std::string section;
  while (!text.empty()) {
    const std::string_view line = trimmed(nextLine(text));
    if (line.empty() || line[0] == '#' || line[0] == ';') continue;
    if (line.front() == '[' && line.back() == ']') {
      section = std::string(trimmed(line.substr(1, line.size() - 2)));
      if (section.starts_with("printer:") && !section.starts_with("printer:*")) {
        bundle.printers.push_back(section.substr(8));
      }
      continue;
    }
    std::string_view key;
    std::string_view value;
    if (splitSetting(line, key, value)) bundle.sections[section].insert_or_assign(std::string(key), std::string(value));
  }
  return bundle;
}

/// Reads a section after all that it inherits, so that its own values count. \param budget  sections that may still be
/// read.
void inherit(const Bundle& bundle, const std::string& kind, const std::string& name, int depth, int& budget,
             SlicerSettings& out, std::vector<ImportNote>& notes) {
  const auto found = bundle.sections.find(kind + name);
  if (found == bundle.sections.end()) {
    addNote(notes, importNote("SectionMissing", {{"section", kind + name}}));
    return;
  }
  if (budget == 0 || depth > kDeepestInherited) {
    addNote(notes, importNote("InheritedTooDeep"));
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

}  // namespace

Result<ImportedPrinter> importIni(std::string_view text, std::string_view name) {
  const Bundle bundle = readBundle(text);
  ImportedPrinter out;
  out.source = "PrusaSlicer settings";
  SlicerSettings settings;
  if (const auto flat = bundle.sections.find(""); flat != bundle.sections.end() && bundle.printers.empty()) {
    settings = flat->second;
    if (const auto parents = settings.find("inherits"); parents != settings.end() && !parents->second.empty()) {
      addNote(out.notRead, importNote("InheritedElsewhere", {{"name", shown(parents->second)}}));
    }
  } else {
    const auto active = bundle.sections.find("presets");
    const auto chosen = [&](const char* kind) {
      if (active == bundle.sections.end()) return std::string();
      const auto found = active->second.find(kind);
      return found == active->second.end() ? std::string() : found->second;
    };
    std::string printer = name.empty() ? chosen("printer") : std::string(name);
    if (bundle.sections.empty()) return refusedFile("UnknownContent");
    if (bundle.printers.empty()) return refusedFile("NoPrinterSettings");
    if (printer.empty() && bundle.printers.size() == 1) printer = bundle.printers.front();
    if (!bundle.sections.contains("printer:" + printer)) {
      std::string known;
      for (const std::string& other : bundle.printers) {
        if (known.size() > kMostNames) continue;
        known += (known.empty() ? "" : ", ") + shown(other);
      }
      if (!printer.empty()) {
        return refusedArgument("NoSuchPrinter", {{"printer", shown(printer)}, {"names", known}});
      }
      return refusedArgument("WhichPrinter", {{"count", bundle.printers.size()}, {"names", known}});
    }
    int budget = kMaxInherited;
    inherit(bundle, "printer:", printer, 0, budget, settings, out.notRead);
    if (const auto kind = settings.find("printer_technology"); kind != settings.end() && kind->second == "SLA") {
      return refusedFile("ResinPrinter", {{"printer", shown(printer)}});
    }
    if (!settings.contains("printer_model")) settings["printer_model"] = printer;
    std::string filament = chosen("filament");
    if (filament.empty() && settings.contains("default_filament_profile")) {
      filament = itemOf(settings["default_filament_profile"], 0);
    }
    if (bundle.sections.contains("filament:" + filament)) {
      inherit(bundle, "filament:", filament, 0, budget, settings, out.notRead);
    }
  }
  for (const char* key : {"start_gcode", "end_gcode"}) {
    if (const auto found = settings.find(key); found != settings.end()) found->second = unescaped(found->second);
  }
  return printerOfSettings(settings, std::move(out));
}

}  // namespace sillon
