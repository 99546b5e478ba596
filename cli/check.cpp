#include "check.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "words.hpp"

namespace cli {
namespace {

nlohmann::ordered_json known(double value) {
  return value < 0 ? nlohmann::ordered_json() : nlohmann::ordered_json(value);
}

}  // namespace

std::string checkText(const sillon::GcodeCheck& check, const std::vector<std::string>& unchecked) {
  char line[512];
  std::string out = plural(check.lines, "line") + ", " + plural(check.moves, "move") + ", " +
                    plural(check.layers, "layer") + (check.printer.empty() ? "" : ", for " + check.printer) + "\n";
  if (!check.box.empty()) {
    std::snprintf(line, sizeof line, "beads      x %.3f to %.3f, y %.3f to %.3f, up to z %.3f mm\n", check.box.min.x,
                  check.box.max.x, check.box.min.y, check.box.max.y, check.top);
    out += line;
  }
  std::snprintf(line, sizeof line,
                "filament   %.2f mm on %.2f m of beads, %.2f m of travel, %lld retractions\n"
                "paths      %lld closed, %lld open\n"
                "most       %.1f mm/s, %.2f mm3/s, %.0f moves/s over any 8\n",
                check.filamentMm, check.pathMm / 1000, check.travelMm / 1000, static_cast<long long>(check.retractions),
                static_cast<long long>(check.closed), static_cast<long long>(check.open), check.fastest, check.mostFlow,
                check.mostMoves);
  out += line;
  if (check.slowedMm > 0) {
    std::snprintf(line, sizeof line, "slowed     %.2f m of oriented beads, below the fastest of their layer\n",
                  check.slowedMm / 1000);
    out += line;
  }
  if (check.noise >= 0) {
    std::snprintf(line, sizeof line, "noise      %.1f um in 99 %% of the oriented path\n", 1000 * check.noise);
    out += line;
  }
  const std::vector<double>& shares = check.coverage;
  if (const auto least = std::min_element(shares.begin(), shares.end()); least != shares.end() && *least >= 0) {
    std::snprintf(line, sizeof line, "coverage   %.1f %% of the base by %s\n", 100 * *least,
                  shares.size() == 1 ? "the oriented layer" : "the oriented layer that covers least");
    out += line;
  }
  for (const sillon::GcodeFinding& finding : check.findings) {
    out += (finding.error ? "error      " : "warning    ") + finding.rule + ": " + finding.message;
    if (finding.line > 0) out += " (line " + std::to_string(finding.line);
    if (finding.line > 0 && finding.count > 1) out += " and " + std::to_string(finding.count - 1) + " more";
    out += finding.line > 0 ? ")\n" : "\n";
  }
  if (!unchecked.empty()) {
    out += "unchecked  ";
    for (const std::string& what : unchecked) out += what + (what == unchecked.back() ? "" : ", ");
    out += ": the file does not tell the machine's limits; --printer does\n";
  }
  const std::int64_t errors = check.errors();
  return out + (errors == 0 ? "no errors\n" : plural(errors, "error") + "\n");
}

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

std::string checkJson(const sillon::GcodeCheck& check, const std::vector<std::string>& unchecked) {
  nlohmann::ordered_json out = {{"errors", check.errors()},
                                {"findings", findingsJson(check.findings)},
                                {"unchecked", unchecked},
                                {"lines", check.lines},
                                {"moves", check.moves},
                                {"layers", check.layers},
                                {"filamentMm", check.filamentMm},
                                {"pathMm", check.pathMm},
                                {"travelMm", check.travelMm},
                                {"closed", check.closed},
                                {"open", check.open},
                                {"retractions", check.retractions},
                                {"fastest", check.fastest},
                                {"slowedMm", check.slowedMm},
                                {"mostFlow", check.mostFlow},
                                {"mostMoves", check.mostMoves},
                                {"printer", check.printer},
                                {"box", nullptr},
                                {"top", check.top},
                                {"noise", known(check.noise)},
                                {"coverage", nlohmann::ordered_json::array()}};
  for (const double share : check.coverage) out["coverage"].push_back(known(share));
  if (!check.box.empty()) {
    out["box"] = {{"min", {check.box.min.x, check.box.min.y}}, {"max", {check.box.max.x, check.box.max.y}}};
  }
  return out.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace cli
