#include <algorithm>
#include <utility>

#include "base/json.hpp"
#include "printer_import/notes.hpp"
#include "printer_import/slicer_files.hpp"
#include "sillon/project/project.hpp"

namespace sillon {

Result<ImportedPrinter> importJson(std::string_view text) {
  const Json root = parseJson(text);
  if (!root.is_object()) {
    return Error{ErrorCode::InvalidFile, "the file begins like JSON, but is not a JSON object"};
  }
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
  out.source = "Orca settings";
  SlicerSettings settings;
  for (const auto& item : root.items()) {
    const Json& value = item.value();
    const Json* first = value.is_array() && !value.empty() ? &value[0] : &value;
    if (!first->is_string()) continue;
    std::string joined = first->get_ref<const std::string&>();
    // Corners are lists; of anything else the first tool's value counts.
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
  // Ours would take their place, which are of another machine.
  const bool lacks = !settings.contains("printable_area") || !settings.contains("machine_start_gcode");
  if (made && inherits && lacks && made.value().profile.empty()) {
    return Error{ErrorCode::InvalidFile,
                 "the preset inherits its bed or its start block from " + shown(parent->second) +
                     ", which lies in another file; open G-code that was sliced for this printer"};
  }
  return made;
}

}  // namespace sillon
