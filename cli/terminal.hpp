// Queries the terminal: its presence and its width.
#pragma once

namespace sillon::cli {

/// Tells whether stderr is a terminal.
bool stderrIsTerminal();

/// Returns the width of help [characters]: from COLUMNS or the terminal, limited to 40..100; 80 if neither tells.
int terminalWidth();

}  // namespace sillon::cli
