// Formats help texts in lines that fit the terminal.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace sillon::cli {

/// A value of an option, and its meaning.
using ValueHelp = std::pair<std::string, std::string>;

/// A row of the help: an option, or a file without an option.
struct HelpRow {
  std::string group;  ///< heading; empty for none, above all others
  std::string names;  ///< "-o,--output F"
  std::string text;   ///< begins with a small letter, as a sentence without a full stop
  std::vector<ValueHelp> values;
  bool common = true;  ///< also in the short help
};

struct HelpPage {
  std::string title;                ///< "sillon check: read any G-code ..."
  std::string usage;                ///< "sillon check FILE.gcode [options]"
  std::vector<HelpRow> rows;        ///< rows in the order of the page, group by group
  std::vector<std::string> notes;   ///< paragraphs at the end; lines that begin with a space are not wrapped
  std::string completeHelpCommand;  ///< empty if this is the complete help
};

/// Formats a page of help.
/// \param all  true for every row, false for the common ones.
/// \param width  width of a line [characters].
std::string helpText(const HelpPage& page, bool all, int width);

/// Puts the first letter in lower case, unless the first word is an abbreviation.
std::string withSmallInitial(std::string text);

}  // namespace sillon::cli
