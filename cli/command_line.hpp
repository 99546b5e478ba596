// The words of the command line: which command they name, and what they ask of it.
#pragma once

namespace cli {

/// Reads the words and runs the command. \return the exit code.
int runCommandLine(int argc, const char* const* argv);

}  // namespace cli
