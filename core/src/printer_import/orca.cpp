#include <algorithm>
#include <utility>

#include "base/json.hpp"
#include "base/numbers.hpp"
#include "base/refused.hpp"
#include "printer_import/notes.hpp"
#include "printer_import/slicer_files.hpp"
#include "sillon/project/project.hpp"

namespace sillon {
namespace {

// Reads a Cura definition of a machine, which lists the settings that differ from its parent's.
SlicerSettings settingsOfCura(const Json& root) {
  SlicerSettings settings;
  for (const auto& item : root["overrides"].items()) {
    const Json& told = item.value();
    if (!told.is_object()) continue;
    const Json* value = told.contains("value")           ? &told["value"]
                        : told.contains("default_value") ? &told["default_value"]
                                                         : nullptr;
    if (value == nullptr || value->is_structured() || value->is_null()) continue;
    std::string text = value->is_string() ? value->get<std::string>() : value->dump();
    settings.insert_or_assign(item.key(), std::move(text));
  }
  const auto width = settings.find("machine_width");
  const auto depth = settings.find("machine_depth");
  if (width == settings.end() || depth == settings.end()) return settings;
  const double x = firstNumber(width->second).value_or(0);
  const double y = firstNumber(depth->second).value_or(0);
  const bool centred = settings["machine_center_is_zero"] == "true";
  std::string area;
  for (const Vec2 corner : {Vec2{0, 0}, Vec2{x, 0}, Vec2{x, y}, Vec2{0, y}}) {
    const Vec2 place = centred ? corner - Vec2{x / 2, y / 2} : corner;
    area += (area.empty() ? "" : ",") + decimal(place.x, 3) + "x" + decimal(place.y, 3);
  }
  settings["printable_area"] = area;
  return settings;
}

}  // namespace

Result<ImportedPrinter> importJson(std::string_view text) {
  const Json root = parseJson(text);
  if (!root.is_object()) return refusedFile("UnknownContent");
  ImportedPrinter out;
  if (root.contains("sillon")) {
    Result<Project> project = readProject(text);
    if (!project) return project.error();
    out.printer = std::move(project.value().printer);
    out.profile = std::move(project.value().printerProfile);
    out.source = "project";
    if (root.contains("printer")) {
      for (const auto& item : root["printer"].items()) out.read.push_back(item.key());
      std::sort(out.read.begin(), out.read.end());
    }
    judgeBlocks(out);
    return out;
  }
  const auto kind = root.contains("type") && root["type"].is_string() ? root["type"].get<std::string>() : std::string();
  if (kind == "process" || kind == "filament") {
    return refusedFile("OtherPreset", {{"kind", kind}});
  }
  const bool cura = root.contains("overrides") && root["overrides"].is_object();
  out.source = cura ? "Cura definition" : "Orca settings";
  SlicerSettings settings = cura ? settingsOfCura(root) : SlicerSettings();
  for (const auto& item : root.items()) {
    const Json& value = item.value();
    const Json* first = value.is_array() && !value.empty() ? &value[0] : &value;
    if (!first->is_string()) continue;
    std::string joined = first->get_ref<const std::string&>();
    // Lists of corners are kept whole; from any other list the first tool's value counts.
    if (value.is_array() && item.key().ends_with("_area")) {
      for (std::size_t k = 1; k < value.size() && value[k].is_string(); ++k) {
        joined += "," + value[k].get_ref<const std::string&>();
      }
    }
    settings.insert_or_assign(item.key(), std::move(joined));
  }
  const auto parent = settings.find("inherits");
  const bool inherits = parent != settings.end() && !parent->second.empty();
  if (inherits) addNote(out.notRead, importNote("InheritedElsewhere", {{"name", shown(parent->second)}}));
  Result<ImportedPrinter> made = printerOfSettings(settings, std::move(out));
  // Cura states the shape of the bed apart from its size.
  if (made && cura) made.value().printer.roundBed = settings["machine_shape"] == "elliptic";
  // Otherwise the defaults, which are another machine's, would take the place of the inherited bed or block.
  const bool lacks = !settings.contains("printable_area") || !settings.contains("machine_start_gcode");
  if (made && inherits && lacks && made.value().profile.empty()) {
    return refusedFile("BedElsewhere", {{"name", shown(parent->second)}});
  }
  return made;
}

}  // namespace sillon
