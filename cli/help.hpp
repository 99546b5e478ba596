// Help as text: what a command takes, in lines that fit the terminal.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace cli {

/// A value that an option takes, and its meaning.
using ValueHelp = std::pair<std::string, std::string>;

/// One option, or one file without an option in front.
struct HelpRow {
  std::string group;  ///< heading; empty: no heading, above all others
  std::string names;  ///< "-o,--output F"
  std::string text;   ///< begins with a small letter, as a sentence without a full stop
  std::vector<ValueHelp> values;
  bool common = true;  ///< shown to newcomers too
};

struct HelpPage {
  std::string title;               ///< "sillon check: read any G-code ..."
  std::string usage;               ///< "sillon check FILE.gcode [options]"
  std::vector<HelpRow> rows;       ///< in the order of the page, group by group
  std::vector<std::string> notes;  ///< paragraphs at the end; lines that begin with a space stay as they are
  std::string all;                 ///< command for the complete help; empty: this is it
};

/// \param all  every row, else the common ones. \param width  of a line, in characters.
std::string helpText(const HelpPage& page, bool all, int width);

/// The text with a small letter first, unless its first word is an abbreviation.
std::string sentenceCase(std::string text);

}  // namespace cli
