#include "findings.hpp"

#include <cstdio>
#include <utility>

namespace sillon::cli {

nlohmann::ordered_json findingsJson(const std::vector<GcodeFinding>& findings) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const GcodeFinding& finding : findings) {
    nlohmann::ordered_json values = nlohmann::ordered_json::object();
    for (const auto& [name, value] : finding.values) values[name] = value;
    list.push_back({{"code", finding.code},
                    {"rule", finding.rule},
                    {"error", finding.error},
                    {"line", finding.line},
                    {"count", finding.count},
                    {"values", std::move(values)},
                    {"message", finding.message}});
  }
  return list;
}

std::string delayLine(const NeighbourDelay& delay) {
  char line[200];
  std::snprintf(
      line, sizeof line,
      "order      %.1f %% of the visible length waits over 30 s for its neighbour, %.1f %% over 120 s; %.1f %% is "
      "squeezed between earlier beads\n",
      100 * delay.over30, 100 * delay.over120, 100 * delay.squeezed);
  return line;
}

}  // namespace sillon::cli
