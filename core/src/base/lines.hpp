// Lines of a text in memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace sillon {

/// Removes spaces, tabs and CR from both ends.
inline std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

/// Returns a line of G-code without its comment, trimmed.
inline std::string_view codeOf(std::string_view line) { return trimmed(line.substr(0, line.find(';'))); }

/// Takes the first line off the text. \return the line without its line feed; a CR before it stays.
inline std::string_view nextLine(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

}  // namespace sillon
