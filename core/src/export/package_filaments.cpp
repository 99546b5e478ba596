#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/json.hpp"
#include "base/lines.hpp"
#include "base/refused.hpp"
#include "export/packing.hpp"
#include "gcode_reader/machine.hpp"

namespace sillon {
namespace {

/// A filament that a package lists.
struct Listed {
  int number = 0;  ///< number of the filament, from 0
  std::string_view type;
};

/// Reads the filaments of one plate from slice_info.config.
std::vector<Listed> listedIn(std::string_view plate) {
  std::vector<Listed> listed;
  for (std::size_t at = plate.find("<filament "); at != std::string_view::npos; at = plate.find("<filament ", at + 1)) {
    const std::string_view tag = plate.substr(at, plate.find('>', at) - at);
    const auto value = [tag](const char* name) {
      const TextRange place = attribute(tag, "<filament", name, 0, tag.size());
      return tag.substr(place.begin, place.end - place.begin);
    };
    const std::optional<double> id = plainNumber(value(" id"));  // the blank excludes group_id
    if (id && *id >= 1 && *id < 255) listed.push_back({static_cast<int>(*id) - 1, value(" type")});
  }
  return listed;
}

bool has(const std::vector<int>& numbers, int number) {
  return std::find(numbers.begin(), numbers.end(), number) != numbers.end();
}

/// Lists filaments for a message, such as "1, 3", counted from 1; "-" stands for none.
std::string named(const std::vector<int>& numbers) {
  std::string out;
  for (const int number : numbers) out += (out.empty() ? "" : ", ") + std::to_string(number + 1);
  return out.empty() ? "-" : out;
}

/// Family of a filament type, such as PLA for "PLA-CF" and "pla"; it decides how hot the filament may be fed.
std::string family(std::string_view type) {
  std::string out;
  for (const char c : type) {
    const char upper = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    if (upper < 'A' || upper > 'Z') break;
    out += upper;
  }
  return out;
}

Error disagree(const std::string& package, const std::string& gcode) {
  return refusedArgument("FilamentsDisagree", {{"package", package}, {"gcode", gcode}});
}

}  // namespace

TextRange attribute(std::string_view xml, std::string_view before, std::string_view name, std::size_t from,
                    std::size_t to) {
  std::size_t at = xml.find(before, from);
  if (at == std::string::npos || at >= to) return {};
  at = xml.find(std::string(name) + "=\"", at + before.size());
  if (at == std::string::npos || at >= to) return {};
  at += name.size() + 2;
  const std::size_t end = xml.find('"', at);
  if (end == std::string::npos || end >= to) return {};
  return {at, end};
}

std::vector<int> loadedFilaments(const std::vector<std::string_view>& gcode) {
  std::vector<int> loaded;
  for (std::string_view part : gcode) {
    while (!part.empty()) {
      const std::string_view line = nextLine(part);
      const std::size_t first = line.find_first_not_of(" \t");
      if (first == std::string_view::npos || (line[first] != 'T' && line[first] != 'M' && line[first] != 'N')) continue;
      const std::optional<int> filament = chosenFilament(partsOf(line).code);
      if (filament && !has(loaded, *filament)) loaded.push_back(*filament);
    }
  }
  std::sort(loaded.begin(), loaded.end());
  return loaded;
}

std::optional<Error> packageDisagrees(const PlateLists& lists, const FilamentsOfGcode& before,
                                      const FilamentsOfGcode& after) {
  const std::vector<Listed> entries = listedIn(lists.sliceInfo);
  std::vector<int> listed;
  for (const Listed& entry : entries) listed.push_back(entry.number);
  // If the new G-code loads fewer filaments than the old one, the printer would ask for spools in vain.
  const bool all = std::all_of(before.loaded.begin(), before.loaded.end(), [&](int n) { return has(after.loaded, n); });
  const bool known = std::all_of(after.loaded.begin(), after.loaded.end(), [&](int n) { return has(listed, n); });
  if (!all || !known) return disagree(named(listed), named(after.loaded));
  if (after.loaded.size() != 1) return std::nullopt;

  const int only = after.loaded.front();
  const nlohmann::json plate = nlohmann::json::parse(lists.plateInfo, nullptr, false);
  for (const char* key : {"first_extruder", "filament_ids"}) {
    if (!plate.is_object() || !plate.contains(key)) continue;
    std::vector<int> told;
    for (const nlohmann::json& number : plate[key]) {  // a single value counts as a list of one
      if (number.is_number_integer() && number >= 0 && number < 255) told.push_back(number.get<int>());
    }
    if (!told.empty() && !has(told, only)) return disagree(named(told), named(after.loaded));
  }
  const auto type = [only](const FilamentsOfGcode& gcode) {
    return toldValue(gcode.text, "filament_type", "\n", only);
  };
  const std::string was = family(type(before));
  const std::string is = family(type(after));
  for (const Listed& entry : entries) {
    if (entry.number != only || was.empty() || is.empty() || is == was || is == family(entry.type)) continue;
    return disagree(std::string(entry.type), type(after));
  }
  return std::nullopt;
}

}  // namespace sillon
