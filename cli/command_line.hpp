// Parses the command line.
#pragma once

namespace sillon::cli {

/// Parses the command line and runs the command. \return the exit code.
int runCommandLine(int argc, const char* const* argv);

}  // namespace sillon::cli
