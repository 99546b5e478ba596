// The terminal: whether there is one, and its width.
#pragma once

namespace cli {

/// Tells whether somebody sees what goes to stderr.
bool stderrIsTerminal();

/// Characters in a line of help: as COLUMNS or the terminal says, 40 to 100; 80 where neither does.
int terminalWidth();

}  // namespace cli
