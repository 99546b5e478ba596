// sillon spools: prints the look of filaments, for people or for programs.
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "commands/commands.hpp"
#include "pictures.hpp"
#include "run.hpp"
#include "sillon/look/appearance.hpp"

namespace sillon::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  PictureOptions own;  ///< only its file of spools is used
  bool json = false;
};

constexpr int kSteps = 36;  // number of directions in the JSON

Json rounded(double value) { return std::round(value * 1e6) / 1e6; }

Json sidesJson(const SideRoughness& sides) {
  const auto pair = [](const Roughness& r) { return Json::array({r.along, r.across}); };
  return {{"nozzleSide", pair(sides.nozzleSide)}, {"bedSide", pair(sides.bedSide)}};
}

/// Returns a table of the spools: how many times brighter white is than black under each lamp.
std::string spoolTable(const std::vector<Spool>& spools) {
  std::string out = "spool        colour     white to black under a bulb, softbox, window at 60,45; nozzle 0.4\n";
  for (const Spool& spool : spools) {
    char line[160];
    std::snprintf(line, sizeof line, "%-12s #%02x%02x%02x   ", spool.key.c_str(), spool.colour[0], spool.colour[1],
                  spool.colour[2]);
    out += line;
    for (const auto& [name, slope] : lampSizes()) {
      std::snprintf(line, sizeof line, " %5.1f",
                    contrastOf(lobeOf({60, 45, slope}, sillon::roughnessOf(spool, kFineNozzle, false))));
      out += line;
    }
    out += "\n";
  }
  return out;
}

/// Returns the constants of the appearance model and all spools, each with the light by direction under each lamp.
/// Views on web pages are made from it and tested against it.
std::string spoolJson(const std::vector<Spool>& spools) {
  const Lobe any = lobeOf({}, {});
  Json root{{"version", 1},
            {"profileSlope", rounded(static_cast<double>(any.profile))},
            {"diffuse", rounded(static_cast<double>(any.diffuse))},
            {"weakContrast", kWeakContrast},
            {"fineNozzle", kFineNozzle},
            {"wideNozzle", kWideNozzle}};
  for (const auto& [name, slope] : lampSizes()) root[name] = slope;
  root["spools"] = Json::array();
  for (const Spool& spool : spools) {
    Json light = Json::object();
    for (const auto& [name, slope] : lampSizes()) {
      Json table = Json::array();
      for (const float value : lightTable(lobeOf({60, 45, slope}, spool.fine.nozzleSide), kSteps)) {
        table.push_back(rounded(static_cast<double>(value)));
      }
      light[name] = std::move(table);
    }
    root["spools"].push_back({{"key", spool.key},
                              {"colour", spool.colour},
                              {"fine", sidesJson(spool.fine)},
                              {"wide", sidesJson(spool.wide)},
                              {"light", std::move(light)}});
  }
  return root.dump(1) + "\n";
}

int run(Arguments& arguments) {
  if (const auto problem = readOwnSpools(arguments.own)) return fail(*problem);
  std::vector<Spool> all = sillon::spools();
  all.insert(all.end(), arguments.own.ownSpools.begin(), arguments.own.ownSpools.end());
  return answer(arguments.json ? spoolJson(all) : spoolTable(all));
}

Action add(Options& options) {
  const auto arguments = std::make_shared<Arguments>();
  options.group("Options");
  options.flag("--json", "print slopes, and light by direction, as JSON", arguments->json);
  options.text("--spools", "F.json", "file of your own spools, listed after the others", arguments->own.spoolsFile);
  return [arguments] { return run(*arguments); };
}

}  // namespace

const Command spoolsCommand{
    "spools", "list the measured spools, and what they show under lamps", "", "--json --spools", "", add};

}  // namespace sillon::cli
