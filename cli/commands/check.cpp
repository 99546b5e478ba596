// sillon check: reads any G-code as a printer would.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands/commands.hpp"
#include "files.hpp"
#include "findings.hpp"
#include "run.hpp"
#include "sillon/export/export.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "sillon/settings/presets.hpp"
#include "words.hpp"

namespace sillon::cli {
namespace {

struct Arguments {
  std::string file;
  std::optional<Printer> printer;
  bool json = false;
};

nlohmann::ordered_json known(double value) {
  return value < 0 ? nlohmann::ordered_json() : nlohmann::ordered_json(value);
}

/// Formats a check for the terminal.
std::string checkText(const GcodeCheck& check, const std::vector<std::string>& unchecked) {
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
  const std::vector<double>& shares = check.coverage;
  if (const auto least = std::min_element(shares.begin(), shares.end()); least != shares.end() && *least >= 0) {
    std::snprintf(line, sizeof line, "coverage   %.1f %% of the base by %s\n", 100 * *least,
                  shares.size() == 1 ? "the oriented layer" : "the oriented layer that covers least");
    out += line;
  }
  if (check.delay) out += delayLine(*check.delay);
  for (const GcodeFinding& finding : check.findings) {
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

/// Formats a check as JSON.
std::string checkJson(const GcodeCheck& check, const std::vector<std::string>& unchecked) {
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
                                {"coverage", nlohmann::ordered_json::array()}};
  for (const double share : check.coverage) out["coverage"].push_back(known(share));
  out["neighbourDelay"] = nullptr;
  if (check.delay) {
    out["neighbourDelay"] = {{"over30", check.delay->over30},
                             {"over120", check.delay->over120},
                             {"most", check.delay->most},
                             {"squeezed", check.delay->squeezed}};
  }
  if (!check.box.empty()) {
    out["box"] = {{"min", {check.box.min.x, check.box.min.y}}, {"max", {check.box.max.x, check.box.max.y}}};
  }
  return out.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

int run(const Arguments& arguments) {
  Result<std::string> file = readFile(arguments.file, "G-code", kMaxGcodeBytes);
  if (!file) return fail(file.error());
  const Result<GcodeContainer> container = readGcodeContainer(std::move(file).value());
  if (!container) return fail(container.error());
  if (container.value().plates > 1) return fail(severalPlates(arguments.file, container.value().plates));
  const std::string& text = container.value().gcode;
  const auto [result, unchecked] = checkPrint(text, arguments.printer);
  return answer(arguments.json ? checkJson(result, unchecked) : checkText(result, unchecked),
                result.errors() == 0 ? 0 : 2);
}

Action add(Options& options) {
  const auto arguments = std::make_shared<Arguments>();
  options.file("FILE.gcode", "the file, which may be packed (.gcode.3mf, .bgcode, .gz)", arguments->file, true);
  options.group("Options");
  options.take("--printer", "ID", "printer whose bed and limits apply [those in the file]",
               [arguments](const std::string& id) {
                 const auto wrong = applyProfile(ProfileKind::Printer, id, arguments->printer.emplace());
                 if (wrong) refuse("--printer: " + wrong->message);
               });
  options.flag("--json", "print JSON instead of text", arguments->json);
  return [arguments] { return run(*arguments); };
}

}  // namespace

const Command checkCommand{"check",
                           "read any G-code as a printer would, and tell what would go wrong",
                           "FILE.gcode",
                           "--printer --json",
                           "Examples:\n"
                           "  sillon check part.gcode --printer prusa-mk4s\n\n"
                           "Exit codes: 0 no errors, 2 errors or a file that cannot be read.",
                           add};

}  // namespace sillon::cli
