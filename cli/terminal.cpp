#include "terminal.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#if defined(__EMSCRIPTEN__)
#include <emscripten.h>
// Emscripten's isatty() is always true.
EM_JS(int, nodeStderrIsTerminal, (), { return process.stderr.isTTY ? 1 : 0; });
EM_JS(int, nodeColumns, (), { return process.stdout.isTTY ? process.stdout.columns : 0; });
#elif defined(__unix__) || defined(__APPLE__)
#include <sys/ioctl.h>
#include <unistd.h>
#elif defined(_WIN32)
#include <io.h>
#endif

namespace sillon::cli {
namespace {

/// Returns the width of the terminal; 0 if stdout is none.
int columnsOfTerminal() {
#if defined(__EMSCRIPTEN__)
  return nodeColumns();
#elif defined(__unix__) || defined(__APPLE__)
  winsize size{};
  return ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
#else
  return 0;
#endif
}

}  // namespace

bool stderrIsTerminal() {
#if defined(__EMSCRIPTEN__)
  return nodeStderrIsTerminal() != 0;
#elif defined(__unix__) || defined(__APPLE__)
  return ::isatty(STDERR_FILENO) != 0;
#elif defined(_WIN32)
  return _isatty(_fileno(stderr)) != 0;
#else
  return false;
#endif
}

int terminalWidth() {
  const char* given = std::getenv("COLUMNS");
  int columns = given == nullptr ? 0 : std::atoi(given);
  if (columns <= 0) columns = columnsOfTerminal();
  return columns <= 0 ? 80 : std::clamp(columns, 40, 100);
}

}  // namespace sillon::cli
