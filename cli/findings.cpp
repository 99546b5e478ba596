#include "findings.hpp"

#include <utility>

namespace cli {

nlohmann::ordered_json findingsJson(const std::vector<sillon::GcodeFinding>& findings) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const sillon::GcodeFinding& finding : findings) {
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

}  // namespace cli
