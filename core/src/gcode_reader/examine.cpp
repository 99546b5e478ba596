#include "sillon/gcode_reader/check.hpp"

#include <string>

#include "base/numbers.hpp"
#include "gcode_reader/machine.hpp"
#include "gcode_reader/parser.hpp"
#include "gcode_reader/rules.hpp"

namespace sillon {
namespace {

// {first_layer_temperature} and [bed_temperature] become a number that is right for a nozzle and for a bed; of {if} and
// its kin both ways count.
std::string filledIn(std::string_view line) {
  std::string out;
  while (!line.empty()) {
    const std::size_t open = line.find_first_of("{[");
    out += line.substr(0, open);
    if (open == std::string_view::npos) break;
    const std::size_t close = line.find(line[open] == '{' ? '}' : ']', open);
    if (close == std::string_view::npos) {
      out += line.substr(open);
      break;
    }
    const std::string_view inside = trimmed(line.substr(open + 1, close - open - 1));
    const bool branches = inside.starts_with("if ") || inside.starts_with("if(") || inside.starts_with("elsif") ||
                          inside == "else" || inside == "endif";
    out += branches ? " " : "60";
    line.remove_prefix(close + 1);
  }
  return out;
}

}  // namespace

std::vector<GcodeFinding> examineBlock(std::string_view block, GcodeFlavor flavor) {
  std::vector<GcodeFinding> findings;
  MachineState machine(flavor);
  forEachLine(block, [&](const GcodeLine& line) {
    const std::string text = filledIn(line.text);
    const auto add = [&](GcodeFinding finding) {
      finding.line = line.number;
      finding.count = 1;
      findings.push_back(std::move(finding));
    };
    if (line.end == "\r") add(makeFinding("cr", false));
    const GcodeParts parts = partsOf(text);
    if (parts.code.empty()) return;
    for (GcodeFinding& finding : judgeCommand(parts.code, flavor, kHottestNozzle, kHottestBed, true)) {
      add(std::move(finding));
    }
    const GcodeCommand command = commandOf(parts.code);
    const GcodeWords words = readsWords(command) ? wordsOf(command.rest) : GcodeWords{};
    const std::optional<MachineMove> move = runCommand(machine, command, words);
    if (volumetricBy(command, words).value_or(false)) add(makeFinding("volumetric", true));
    if (!move || move->z >= move->zFrom) return;
    if (tooDeep(*move, {})) add(makeFinding("below-bed", true, {{"mm", decimal(move->z, 3)}}));
  });
  return findings;
}

}  // namespace sillon
