// Entry point of the command line. Each command reads and computes first, then writes all of its files at once.
// Exit codes: 0 done, 1 internal error, 2 bad input, 3 cancelled.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

#if defined(_WIN32)
#define NOMINMAX
#include <fcntl.h>
#include <io.h>
#include <windows.h>
#endif

#include "command_line.hpp"
#include "memory.hpp"
#include "run.hpp"

namespace {

/// Ends the program if memory runs out in code that may not throw: destructors, and some of the libraries.
[[noreturn]] void onTerminate() {
  try {
    if (const std::exception_ptr problem = std::current_exception()) std::rethrow_exception(problem);
  } catch (const std::bad_alloc&) {
    std::_Exit(sillon::cli::endWithoutMemory());
  } catch (...) {  // continue as without this handler
  }
  std::abort();
}

#if defined(_WIN32)
UINT pageBefore = 0;

/// Switches the console to UTF-8, so that names show correctly, and stdout to binary, so that redirected bytes are the
/// same as elsewhere. The console's code page is restored at exit.
void prepareConsole() {
  pageBefore = ::GetConsoleOutputCP();
  if (pageBefore != 0 && ::SetConsoleOutputCP(CP_UTF8) != 0) std::atexit([] { ::SetConsoleOutputCP(pageBefore); });
  ::_setmode(::_fileno(stdout), _O_BINARY);
}
#endif

}  // namespace

int main(int argc, char** argv) {
  sillon::cli::keepFreedMemory();
  std::set_terminate(onTerminate);
#if defined(_WIN32)
  prepareConsole();
#endif
#ifdef SIGPIPE
  std::signal(SIGPIPE, SIG_IGN);  // if the reader of stdout goes away, files are written all the same
#endif
#ifdef SIGXFSZ
  std::signal(SIGXFSZ, SIG_IGN);  // a file larger than the shell allows becomes an error of writing
#endif
  try {
    return sillon::cli::runCommandLine(argc, argv);
  } catch (const std::bad_alloc&) {
    return sillon::cli::endWithoutMemory();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sillon: internal error: %s; please report it\n", error.what());
    return 1;
  }
}
