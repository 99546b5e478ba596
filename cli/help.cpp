#include "help.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <sstream>

#include "words.hpp"

namespace sillon::cli {
namespace {

constexpr std::size_t kColumn = 26;  // largest column at which texts begin; longer names get a line of their own

/// Wraps a text to lines of at most `width` characters, unless a word is longer.
/// \param indent  spaces before each line but the first
/// \param firstColumn  column at which the first line begins
std::string wrapped(const std::string& text, std::size_t indent, std::size_t firstColumn, std::size_t width) {
  std::istringstream words(text);
  std::string out;
  std::size_t column = firstColumn;
  for (std::string word; words >> word;) {
    if (column + 1 + word.size() > width && column > indent) {
      out += "\n" + std::string(indent, ' ') + word;
      column = indent + word.size();
      continue;
    }
    const bool first = out.empty();
    out += (first ? "" : " ") + word;
    column += word.size() + (first ? 0 : 1);
  }
  return out;
}

/// Formats a name with its text beside it or below it.
std::string row(const std::string& name, const std::string& text, std::size_t indent, std::size_t column,
                std::size_t width) {
  std::string out = std::string(indent, ' ') + name;
  if (out.size() + 2 > column) {
    out += "\n" + std::string(column, ' ');
  } else {
    out.resize(column, ' ');
  }
  return out + wrapped(text, column, column, width) + "\n";
}

std::string valueRows(const std::vector<ValueHelp>& values, std::size_t column, std::size_t width) {
  std::size_t longest = 0;
  for (const auto& [name, text] : values) longest = std::max(longest, name.size());
  std::string out;
  for (const auto& [name, text] : values) out += row(name, text, column + 2, column + 4 + longest, width);
  return out;
}

}  // namespace

std::string helpText(const HelpPage& page, bool all, int width) {
  const std::size_t lineWidth = width;
  std::string out = wrapped(page.title, 0, 0, lineWidth) + "\n\nusage: " + wrapped(page.usage, 7, 7, lineWidth) + "\n";
  std::vector<std::string> groups;
  std::size_t hidden = 0;
  std::size_t column = 0;
  for (const HelpRow& one : page.rows) {
    if (!all && !one.common) {
      ++hidden;
      continue;
    }
    if (one.names.size() + 4 <= kColumn) column = std::max(column, one.names.size() + 4);
    if (std::find(groups.begin(), groups.end(), one.group) == groups.end()) {
      groups.push_back(one.group);
    }
  }
  for (const std::string& group : groups) {
    out += "\n" + (group.empty() ? "" : group + ":\n");
    for (const HelpRow& one : page.rows) {
      if (one.group != group || (!all && !one.common)) continue;
      out += row(one.names, one.text, 2, column, lineWidth) + valueRows(one.values, column, lineWidth);
    }
  }
  for (const std::string& note : page.notes) {
    out += "\n";
    std::istringstream lines(note);
    for (std::string line; std::getline(lines, line);) {
      out += (line.rfind(' ', 0) == 0 ? line : wrapped(line, 0, 0, lineWidth)) + "\n";
    }
  }
  if (hidden > 0)
    out += "\n" + wrapped(page.completeHelpCommand + " shows " + plural(hidden, "more option") + ".", 0, 0, lineWidth) +
           "\n";
  return out;
}

std::string withSmallInitial(std::string text) {
  const auto letter = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  if (text.size() < 2 || std::isupper(letter(0)) == 0) return text;
  const bool article = text[0] == 'A' && text[1] == ' ';
  if (article || std::islower(letter(1)) != 0) text[0] = static_cast<char>(std::tolower(letter(0)));
  return text;
}

}  // namespace sillon::cli
