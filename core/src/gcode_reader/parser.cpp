#include "gcode_reader/parser.hpp"

#include <fast_float/fast_float.h>
#include <cmath>

namespace sillon {
namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isBlank(char c) { return c == ' ' || c == '\t'; }
char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }
bool isLetter(char c) { return upper(c) >= 'A' && upper(c) <= 'Z'; }

}  // namespace

std::size_t readNumber(std::string_view text, double& value) {
  const std::size_t sign = text.starts_with('+') ? 1 : 0;
  std::size_t end = sign + (text.substr(sign).starts_with('-') ? 1 : 0);
  while (end < text.size() && (isDigit(text[end]) || text[end] == '.')) ++end;
  const auto read =
      fast_float::from_chars(text.data() + sign, text.data() + end, value, fast_float::chars_format::fixed);
  if (read.ec != std::errc{} || !(std::abs(value) < 1e9)) return 0;
  return read.ptr - text.data();
}

GcodeParts partsOf(std::string_view line) {
  GcodeParts parts;
  const std::size_t semicolon = line.find(';');
  parts.code = trimmed(line.substr(0, semicolon));
  if (semicolon != std::string_view::npos) parts.comment = trimmed(line.substr(semicolon + 1));
  // A line number may be N5, N-1 or N 5, with a command behind it. A name has letters behind its N.
  const std::size_t number =
      parts.code.empty() || upper(parts.code[0]) != 'N' ? 0 : parts.code.find_first_not_of(" \t+-.0123456789", 1);
  if (number > 1 && parts.code.find_first_of("0123456789") < number) {
    parts.numbered = true;
    parts.code = trimmed(parts.code.substr(std::min(number, parts.code.size())));
    parts.code = trimmed(parts.code.substr(0, parts.code.rfind('*')));
  }
  return parts;
}

GcodeCommand commandOf(std::string_view code) {
  GcodeCommand command;
  const std::size_t end = code.find_first_of(" \t");
  command.name = code.substr(0, end);
  command.rest = end == std::string_view::npos ? std::string_view{} : code.substr(end);
  if (code.empty()) return command;
  const char letter = upper(code[0]);
  if (letter != 'G' && letter != 'M' && letter != 'T') return command;
  // Marlin and Klipper skip blanks between the letter and its number.
  std::size_t at = 1;
  while (at < code.size() && isBlank(code[at])) ++at;
  if (at >= code.size() || !isDigit(code[at])) {
    if (letter == 'T' && code.size() > 1 && !isLetter(code[1])) command.letter = letter;  // T-1, T? and the like
    return command;
  }
  std::size_t digits = at;
  int number = 0;
  while (digits < code.size() && isDigit(code[digits])) {
    if (number <= 9999) number = 10 * number + (code[digits] - '0');
    ++digits;
  }
  // G1_NAME is a name, not G1.
  if (digits < code.size() && code[digits] == '_') return command;
  command.letter = letter;
  if (number <= 9999) command.code = number;
  if (digits + 1 < code.size() && code[digits] == '.' && isDigit(code[digits + 1])) {
    ++digits;
    for (; digits < code.size() && isDigit(code[digits]); ++digits) {
      if (command.sub <= 999) command.sub = 10 * command.sub + (code[digits] - '0');
    }
  }
  command.name = code.substr(0, digits);
  command.rest = code.substr(digits);
  return command;
}

GcodeWords wordsOf(std::string_view text) {
  GcodeWords words;
  const auto odd = [&words](GcodeWords::Fault fault, std::string_view where) {
    if (words.fault != GcodeWords::None) return;
    words.fault = fault;
    words.faultText = where;
  };
  bool spaced = true;
  for (std::size_t at = 0; at < text.size();) {
    if (isBlank(text[at])) {
      spaced = true;
      ++at;
      continue;
    }
    if (!isLetter(text[at])) {
      words.fault = GcodeWords::NotAWord;
      words.faultText = text.substr(at);
      return words;
    }
    const char letter = upper(text[at]);
    const std::size_t index = letter - 'A';
    const std::uint32_t bit = std::uint32_t{1} << index;
    if (letter != text[at]) words.lower = true;
    if (!spaced) words.crowded = true;
    if ((words.named & bit) != 0) odd(GcodeWords::Twice, text);
    words.named |= bit;
    spaced = false;
    ++at;
    // Firmwares also read a number that is separated from its letter by blanks.
    std::size_t number = at;
    while (number < text.size() && isBlank(text[number])) ++number;
    if (number > at && number < text.size() && (isDigit(text[number]) || text[number] == '-' || text[number] == '.')) {
      words.unusual = true;
      at = number;
    }
    // The next word begins at a blank or at a letter; E and other exponents belong to this one.
    std::size_t end = at;
    while (end < text.size() && !isBlank(text[end]) && !(text[end] >= 'A' && text[end] <= 'Z' && end > at)) ++end;
    double value = 0;
    const std::size_t read = readNumber(text.substr(at, end - at), value);
    const bool exponent =
        read > 0 && end + 1 < text.size() && text[end] == 'E' && (text[end + 1] == '-' || text[end + 1] == '+');
    if (exponent) end = std::min(text.find_first_of(" \t", end), text.size());
    if (read == 0) {
      words.fault = GcodeWords::NoNumber;  // replaces a fault that is only odd, since firmwares cannot read the line
      words.faultText = text;
    } else if (exponent || at + read < end) {
      odd(GcodeWords::NotPlain, text.substr(at - 1, end - at + 1));
    } else if (!isPlainNumber(text.substr(at, read))) {
      words.unusual = true;
    }
    at = end;
    if (read == 0) continue;
    words.values[index] = value;
    words.given |= bit;
  }
  return words;
}

bool readPlainMove(std::string_view line, GcodeWords& words) {
  // Both numbers of the quotient below are exact as doubles, so that it is rounded like the decimal number itself.
  static constexpr std::array<double, 16> kTens = {1,   1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                   1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  constexpr std::size_t kMostWhole = 9;
  constexpr std::size_t kMostDigits = 15;
  if (line.size() > 95 || line.size() < 4 || line[0] != 'G' || (line[1] != '0' && line[1] != '1')) return false;
  for (std::size_t at = 2; at < line.size();) {
    if (line[at] != ' ' || at + 2 >= line.size()) return false;
    const char letter = line[at + 1];
    if (letter < 'A' || letter > 'Z' || letter == 'G' || letter == 'M' || letter == 'R') return false;
    const std::size_t index = letter - 'A';
    const std::uint32_t bit = std::uint32_t{1} << index;
    if ((words.named & bit) != 0) return false;
    at += 2;
    const bool negative = line[at] == '-';
    if (negative) ++at;
    std::uint64_t number = 0;
    const auto readDigits = [&] {
      const std::size_t first = at;
      for (; at < line.size() && isDigit(line[at]) && at - first <= kMostDigits; ++at)
        number = 10 * number + static_cast<std::uint64_t>(line[at] - '0');
      return at - first;
    };
    const std::size_t begin = at;
    const std::size_t whole = readDigits();
    if (whole == 0 || whole > kMostWhole || (whole > 1 && line[begin] == '0')) return false;
    std::size_t decimals = 0;
    if (at < line.size() && line[at] == '.') {
      ++at;
      decimals = readDigits();
      if (decimals == 0 || whole + decimals > kMostDigits) return false;
    }
    if (negative && number == 0) return false;
    const double value = static_cast<double>(number) / kTens[decimals];
    words.values[index] = negative ? -value : value;
    words.named |= bit;
  }
  words.given = words.named;
  return true;
}

}  // namespace sillon
