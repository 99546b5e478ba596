// sillon settings: prints the table of settings, for people or for programs.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "commands/commands.hpp"
#include "run.hpp"
#include "sillon/calibrate/calibrate.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "sillon/settings/project.hpp"
#include "sillon/settings/table.hpp"
#include "sillon/text/text.hpp"

namespace sillon::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Describes the range of a setting: "0.05 to 20 mm", "none|soft|count".
std::string rangeText(const Setting& row) {
  if (row.type == SettingType::Choice) {
    std::string words = row.choices;
    std::replace(words.begin(), words.end(), ' ', '|');
    return words;
  }
  if (row.type == SettingType::Flag) return "true|false";
  if (row.type == SettingType::Text || row.type == SettingType::Block || row.type == SettingType::Name) return "text";
  const std::string most = std::to_string(static_cast<int>(row.high));
  if (row.type == SettingType::PictureList) return "up to " + most + " files";
  if (row.type == SettingType::HoleList) return "up to " + most + " holes";
  char range[96];
  std::snprintf(range, sizeof range, "%.6g to %.6g %s", row.low, row.high, row.unit);
  return range;
}

/// Returns a table of the settings: name, default, range with unit, option.
std::string settingsTable() {
  const Project defaults;
  std::string out = "setting                              default              range, unit; * for experts\n";
  for (const Setting& row : sillon::settings()) {
    const SettingWords words = wordsOf(row);
    char line[512];
    std::snprintf(line, sizeof line, "%-36s %-20s %s%s\n%36s %s%s%s%s\n", fullName(row).c_str(),
                  settingText(row, defaults).c_str(), rangeText(row).c_str(), row.level == Level::Expert ? " *" : "",
                  "", words.help, *words.option == '\0' ? "" : " (", words.option, *words.option == '\0' ? "" : ")");
    out += line;
  }
  return out;
}

/// Returns the settings as JSON, with numbers and names that the package and the studio share with core.
std::string settingsJson() {
  const Json facts{
      {"evenSpeed", kEvenSpeed},
      {"mostLayers", kMostLayers},
      {"neighbours", {{"nearest", kNearestNeighbour}, {"farthest", kFarthestNeighbour}, {"along", kNeighbourAlong}}},
      {"letters",
       {{"usualCapHeight", kUsualCapHeight}, {"mostPathBytes", kMostPathBytes}, {"mostLackedTold", kMostLackedTold}}},
      {"calibrationKinds", calibrationKinds()}};
  std::string out = sillon::settingsJson();
  return out.insert(out.rfind("\n}"), ",\n  \"facts\": " + facts.dump());
}

Action add(Options& options) {
  const auto json = std::make_shared<bool>(false);
  options.group("Options");
  options.flag("--json", "print JSON instead of text", *json);
  return [json] { return answer(*json ? settingsJson() : settingsTable()); };
}

}  // namespace

const Command settingsCommand{
    "settings", "list the settings of project files, with ranges and defaults", "", "--json", "", add};

}  // namespace sillon::cli
