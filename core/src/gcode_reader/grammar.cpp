#include "gcode_reader/parser.hpp"

#include <bitset>

namespace sillon {
namespace {

constexpr std::size_t kLongestCommand = 95;  // characters; Marlin's buffer holds 96 with the final zero

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isUpper(char c) { return c >= 'A' && c <= 'Z'; }

// Tells whether a text is a NAME of the grammar: two or more of A-Z, 0-9 and _, beginning with a letter.
bool isName(std::string_view name) {
  if (name.size() < 2 || !isUpper(name[0])) return false;
  return std::all_of(name.begin(), name.end(), [](char c) { return isUpper(c) || isDigit(c) || c == '_'; });
}

// Cuts the next word off a text that is separated by single spaces.
std::string_view nextWord(std::string_view& text) {
  const std::size_t space = text.find(' ');
  const std::string_view word = text.substr(0, space);
  text.remove_prefix(space == std::string_view::npos ? text.size() : space + 1);
  return word;
}

}  // namespace

bool isPlainNumber(std::string_view text) {
  const bool negative = text.starts_with('-');
  std::size_t i = negative ? 1 : 0;
  if (i >= text.size() || !isDigit(text[i])) return false;
  if (text[i] == '0' && i + 1 < text.size() && isDigit(text[i + 1])) return false;
  while (i < text.size() && isDigit(text[i])) ++i;
  if (i < text.size()) {
    if (text[i] != '.' || i + 1 == text.size()) return false;
    for (++i; i < text.size(); ++i) {
      if (!isDigit(text[i])) return false;
    }
  }
  return !negative || text.find_first_of("123456789") != std::string_view::npos;
}

bool isPlainCommand(std::string_view text) {
  if (text.ends_with(' ')) return false;
  const std::string_view head = nextWord(text);
  if (head.size() >= 2 && (head[0] == 'G' || head[0] == 'M' || head[0] == 'T') && isDigit(head[1])) {
    if (!isPlainNumber(head.substr(1))) return false;
    std::bitset<26> seen;
    while (!text.empty()) {
      const std::string_view word = nextWord(text);
      if (word.empty() || !isUpper(word[0])) return false;
      const std::size_t letter = word[0] - 'A';
      if (seen[letter] || (word.size() > 1 && !isPlainNumber(word.substr(1)))) return false;
      seen.set(letter);
    }
    return true;
  }
  if (!isName(head)) return false;
  while (!text.empty()) {
    const std::string_view word = nextWord(text);
    const std::size_t equal = word.find('=');
    if (equal == std::string_view::npos || !isName(word.substr(0, equal))) return false;
    if (!isPlainNumber(word.substr(equal + 1)) && !isName(word.substr(equal + 1))) return false;
  }
  return true;
}

const char* lineFault(std::string_view line) {
  if (!std::all_of(line.begin(), line.end(), [](char c) { return c >= ' ' && c <= '~'; })) {
    return "no-ascii";
  }
  if (line.empty() || line[0] == ';') return nullptr;
  const std::string_view command = line.substr(0, line.find(" ;"));
  if (command.size() > kLongestCommand) return "long-line";
  return isPlainCommand(command) ? nullptr : "no-plain-line";
}

}  // namespace sillon
