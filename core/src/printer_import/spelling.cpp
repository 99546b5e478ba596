#include "printer_import/slicer_files.hpp"

#include <algorithm>

namespace sillon {
namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isSmall(char c) { return c >= 'a' && c <= 'z'; }
bool isLetter(char c) { return isSmall(c) || (c >= 'A' && c <= 'Z'); }
char capital(char c) { return isSmall(c) ? static_cast<char>(c - 'a' + 'A') : c; }

// Tells whether a line is a command with plain words: G, T, and M of modes, heaters and fans. Other commands may take
// texts, lists and numbers with signs of their own (M117, M620 S1A).
bool isCode(std::string_view line) {
  if (line.size() < 2 || !isDigit(line[1])) return false;
  const char letter = capital(line[0]);
  if (letter != 'M') return letter == 'G' || letter == 'T';
  const std::string_view number = line.substr(1, std::min(line.find_first_not_of("0123456789", 1), line.size()) - 1);
  for (const std::string_view known :
       {"82", "83", "84", "104", "106", "107", "109", "140", "141", "190", "191", "204"}) {
    if (number == known) return true;
  }
  return false;
}

std::string_view codePart(std::string_view line) { return line.substr(0, line.find(';')); }

// Tells whether a text is nothing but words: letters with numbers or alone.
bool isWords(std::string_view rest) {
  return std::all_of(rest.begin(), rest.end(), [before = ' '](char c) mutable {
    const bool word = !isLetter(c) || !isLetter(before);
    before = c;
    return word && (isLetter(c) || isDigit(c) || c == ' ' || c == '\t' || c == '.' || c == '-' || c == '+');
  });
}

}  // namespace

bool isSpelled(std::string_view line) {
  if (!isCode(line)) return true;
  const std::string_view code = codePart(line);
  if (isSmall(code[0]) || (code[1] == '0' && code.size() > 2 && isDigit(code[2]))) return false;
  std::size_t at = 1;
  while (at < code.size() && (isDigit(code[at]) || code[at] == '.')) ++at;
  char before = at < code.size() && code[at] != ' ' ? '0' : ' ';
  for (; at < code.size(); ++at) {
    const char c = code[at];
    if (c == '\t' || isSmall(c) || (isLetter(c) && before != ' ') ||
        (c == ' ' && at + 1 < code.size() && code[at + 1] == ' '))
      return !isWords(code.substr(std::min<std::size_t>(code.size(), 2)));
    before = c;
  }
  return true;
}

std::string spelled(std::string_view line) {
  if (isSpelled(line)) return std::string(line);
  const std::string_view code = codePart(line);
  std::size_t at = 1;
  while (at + 1 < code.size() && code[at] == '0' && isDigit(code[at + 1])) ++at;
  std::string out(1, capital(code[0]));
  while (at < code.size() && (isDigit(code[at]) || code[at] == '.')) out += code[at++];
  const std::string_view rest = code.substr(at);
  if (!isWords(rest)) return std::string(line);
  for (const char c : rest) {
    if (isLetter(c)) out.append(" ").append(1, capital(c));
    if (!isLetter(c) && c != ' ' && c != '\t') out += c;
  }
  if (code.size() < line.size()) out.append(" ").append(line.substr(code.size()));
  return out;
}

}  // namespace sillon
