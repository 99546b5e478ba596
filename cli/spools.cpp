#include "spools.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

namespace cli {
namespace {

using Json = nlohmann::ordered_json;
using sillon::Roughness;
using sillon::Spool;

constexpr double kNozzle = 0.4;  // [mm], in the table
constexpr int kSteps = 36;       // directions in the JSON

std::array<std::pair<const char*, double>, 3> lampSizes() {
  return {{{"bulb", sillon::bulbSlope()}, {"softbox", sillon::softboxSlope()}, {"window", sillon::windowSlope()}}};
}

Json rounded(double value) { return std::round(value * 1e6) / 1e6; }

Json sidesJson(const sillon::SideRoughness& sides) {
  const auto pair = [](const Roughness& r) { return Json::array({r.along, r.across}); };
  return {{"nozzleSide", pair(sides.nozzleSide)}, {"bedSide", pair(sides.bedSide)}};
}

}  // namespace

std::string spoolTable(const std::vector<Spool>& spools) {
  std::string out = "spool        colour     white to black under a bulb, softbox, window at 60,45; nozzle 0.4\n";
  for (const Spool& spool : spools) {
    char line[160];
    std::snprintf(line, sizeof line, "%-12s #%02x%02x%02x   ", spool.key.c_str(), spool.colour[0], spool.colour[1],
                  spool.colour[2]);
    out += line;
    for (const auto& [name, slope] : lampSizes()) {
      std::snprintf(line, sizeof line, " %5.1f",
                    sillon::contrastOf(sillon::lobeOf({60, 45, slope}, sillon::roughnessOf(spool, kNozzle, false))));
      out += line;
    }
    out += "\n";
  }
  return out;
}

std::string spoolJson(const std::vector<Spool>& spools) {
  const sillon::Lobe any = sillon::lobeOf({}, {});
  Json root{{"version", 1},
            {"profileSlope", rounded(static_cast<double>(any.profile))},
            {"diffuse", rounded(static_cast<double>(any.diffuse))}};
  for (const auto& [name, slope] : lampSizes()) root[name] = slope;
  root["spools"] = Json::array();
  for (const Spool& spool : spools) {
    Json light = Json::object();
    for (const auto& [name, slope] : lampSizes()) {
      Json table = Json::array();
      for (const float value : sillon::lightTable(sillon::lobeOf({60, 45, slope}, spool.fine.nozzleSide), kSteps)) {
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

}  // namespace cli
