#include "sillon/gcode_reader/check.hpp"

#include "base/numbers.hpp"
#include "gcode_reader/machine.hpp"
#include "gcode_reader/parser.hpp"
#include "gcode_reader/rules.hpp"

namespace sillon {
namespace {

// Fills in a block's placeholders: {first_layer_temperature} and [bed_temperature] become 60, which no limit of a
// nozzle or a bed rejects; {if}, {else} and the like become a blank, so that the code of all branches is judged.
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
  Offsets offsets;
  forEachLine(block, [&](const GcodeLine& line) {
    const std::string text = filledIn(line.text);
    const std::size_t before = findings.size();
    const auto add = [&](const char* code, bool error, FindingValues values) {
      findings.push_back(makeFinding(code, error, std::move(values)));
    };
    if (line.end == "\r") add("cr", false, {});
    // Lines with placeholders are spared: quotes may belong to an expression, and words to either of its branches.
    const bool plain = text == line.text;
    const char* const odd = plain ? spellingFault(line.text) : nullptr;
    if (odd != nullptr) add(odd, true, {{"text", shownText(line.text)}});
    const GcodeParts parts = partsOf(text);
    const GcodeCommand command = commandOf(parts.code);
    for (GcodeFinding& finding : judgeCommand(parts.code, flavor, kHottestNozzle, kHottestBed, true)) {
      findings.push_back(std::move(finding));
    }
    const auto sum = offsets.run(command, flavor);
    if (FindingValues values = offsetFault(sum.value_or(Offsets::Axes{})); !values.empty()) {
      add("offset", true, std::move(values));
    }
    const GcodeWords words = readsWords(command) ? wordsOf(command.rest) : GcodeWords{};
    const bool letters = words.fault == GcodeWords::NoNumber && command.letter == 'M';  // M104 S140 A
    const char* const fault = plain && !letters ? wordFault(words) : nullptr;
    if (fault != nullptr) add(fault, true, {{"text", shownText(words.faultText)}});
    const std::optional<MachineMove> move = runCommand(machine, command, words);
    if (volumetricBy(command, words).value_or(false)) add("volumetric", true, {});
    if (move && move->z < move->zFrom && tooDeep(*move, {})) {
      add("below-bed", true, {{"mm", decimal(move->z, 3)}});
    }
    for (std::size_t k = before; k < findings.size(); ++k) findings[k].line = line.number;
  });
  return findings;
}

}  // namespace sillon
