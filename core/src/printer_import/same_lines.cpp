#include "printer_import/slicer_files.hpp"

#include <algorithm>
#include <cmath>

#include "gcode_reader/parser.hpp"

namespace sillon {
namespace {

// A line of a block that has code, and its place in the block [bytes].
struct BlockLine {
  std::string_view code;
  std::size_t begin = 0;
  std::size_t end = 0;
};

// Lines that have code and do not concern the old print alone; empty if there are too many to compare.
std::vector<BlockLine> linesOf(std::string_view block) {
  constexpr std::size_t kMost = 2000;
  std::vector<BlockLine> lines;
  for (std::string_view rest = block; !rest.empty();) {
    const std::size_t begin = block.size() - rest.size();
    const std::string_view code = codeOf(nextLine(rest));
    if (code.empty() || isOfOldPrint(code)) continue;
    if (lines.size() == kMost) return {};
    lines.push_back({code, begin, block.size() - rest.size()});
  }
  return lines;
}

// Tells whether two lines have the same command, with about the same numbers. They may differ by the distance of a
// plate's edge from its outer beads.
bool saysTheSame(std::string_view a, std::string_view b) {
  constexpr double kEdge = 2;  // [mm], or in the unit of any other number
  const auto isTool = [](std::string_view code) {
    return code.size() > 1 && code[0] == 'T' && code[1] >= '0' && code[1] <= '9';
  };
  if (firstWord(a) != firstWord(b) && !(isTool(a) && isTool(b))) return false;
  const auto next = [](std::string_view& rest) -> std::optional<double> {
    while (!rest.empty()) {
      double value = 0;
      const std::size_t size = readNumber(rest, value);
      rest.remove_prefix(std::max<std::size_t>(size, 1));
      if (size > 0) return value;
    }
    return std::nullopt;
  };
  for (;;) {
    const std::optional<double> one = next(a);
    const std::optional<double> other = next(b);
    if (one.has_value() != other.has_value()) return false;
    if (!one) return true;
    if (std::abs(*one - *other) > std::max(kEdge, 0.05 * std::abs(*other))) return false;
  }
}

}  // namespace

bool isCommand(std::string_view line, std::string_view word) {
  return line.starts_with(word) && (line.size() == word.size() || line[word.size()] == ' ');
}

bool isOfOldPrint(std::string_view line) {
  return isCommand(line, "M73") || isCommand(line, "M486") || line.starts_with("EXCLUDE_OBJECT") ||
         line.starts_with("SET_PRINT_STATS_INFO");
}

std::string_view firstWord(std::string_view text) { return text.substr(0, text.find(' ')); }

TextRange whereSaid(std::string_view done, std::string_view told) {
  const std::vector<BlockLine> all = linesOf(done);
  const std::vector<BlockLine> wanted = linesOf(told);
  if (wanted.empty()) return {};
  const auto found = std::search(all.begin(), all.end(), wanted.begin(), wanted.end(),
                                 [](const BlockLine& a, const BlockLine& b) { return saysTheSame(a.code, b.code); });
  if (found == all.end()) return {};
  return {found->begin, (found + static_cast<std::ptrdiff_t>(wanted.size()) - 1)->end};
}

}  // namespace sillon
