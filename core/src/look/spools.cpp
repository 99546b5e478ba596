#include "sillon/look/appearance.hpp"

#include <algorithm>
#include <cstddef>

#include "base/json.hpp"
#include "look/appearance_data.hpp"

namespace sillon {
namespace {

Roughness roughness(const Json& pair) { return {pair[0].get<double>(), pair[1].get<double>()}; }

SideRoughness sides(const Json& json) { return {roughness(json["nozzleSide"]), roughness(json["bedSide"])}; }

double mix(double a, double b, double share) { return a * (1 - share) + b * share; }

}  // namespace

// Reads the table of core/data/spools.json, which is compiled in, on first use.
const std::vector<Spool>& spools() {
  static const std::vector<Spool> all = [] {
    std::vector<Spool> read;
    const Json table = parseJson(kSpoolsJson);
    for (const auto& [key, row] : table["spools"].items()) {
      Spool spool{key, {}, sides(row["fine"]), sides(row["wide"])};
      for (std::size_t k = 0; k < 3; ++k) spool.colour[k] = row["colour"][k].get<std::uint8_t>();
      read.push_back(std::move(spool));
    }
    return read;
  }();
  return all;
}

// There are few spools: a linear search will do.
const Spool* findSpool(std::string_view key) {
  for (const Spool& spool : spools()) {
    if (spool.key == key) return &spool;
  }
  return nullptr;
}

// SpoolName lists the spools in the table's order.
const Spool& spoolOf(SpoolName name) { return spools()[toSize(name)]; }

// Between the two nozzles that were measured, slopes are interpolated; beyond them the nearer one counts.
Roughness roughnessOf(const Spool& spool, double nozzle, bool bedSide) {
  const double share = std::clamp((nozzle - kFineNozzle) / (kWideNozzle - kFineNozzle), 0.0, 1.0);
  const Roughness& fine = bedSide ? spool.fine.bedSide : spool.fine.nozzleSide;
  const Roughness& wide = bedSide ? spool.wide.bedSide : spool.wide.nozzleSide;
  return {mix(fine.along, wide.along, share), mix(fine.across, wide.across, share)};
}

}  // namespace sillon
