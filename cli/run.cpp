#include "run.hpp"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <optional>

#include "memory.hpp"
#include "threads.hpp"

namespace sillon::cli {
namespace {

constexpr const char* kCancelled = "cancelled; nothing was written";

std::atomic<RunContext*> running{nullptr};
static_assert(std::atomic<RunContext*>::is_always_lock_free, "used in a signal handler");

// Handles Ctrl-C: the first one asks the work to stop, the second one ends the program at once.
extern "C" void cancelRun(int signal) {
  if (RunContext* run = running.load()) run->requestCancel();
  std::signal(signal, SIG_DFL);
}

int exitCode(ErrorCode code) {
  if (code == ErrorCode::Cancelled) return 3;
  return code == ErrorCode::Internal ? 1 : 2;
}

}  // namespace

Run::Run(int threads) : context_(threadsHere(threads)) {
  context_.limitMemory(memoryForPlates());
  running.store(&context_);
#if defined(__unix__) || defined(__APPLE__)
  struct sigaction action {};
  action.sa_handler = cancelRun;  // without SA_RESTART, waiting for a pipe is interrupted
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  struct sigaction before {};
  ::sigaction(SIGHUP, nullptr, &before);
  if (before.sa_handler != SIG_IGN) ::sigaction(SIGHUP, &action, nullptr);  // nohup may have asked to ignore it
#else
  std::signal(SIGINT, cancelRun);
  std::signal(SIGTERM, cancelRun);
#endif
}

Run::~Run() { running.store(nullptr); }

int fail(const Error& error) {
  std::fprintf(stderr, "sillon: %s\n", error.message.c_str());
  return exitCode(error.code);
}

int answer(const std::string& text, int code) {
  const bool written = std::fputs(text.c_str(), stdout) >= 0 && std::fflush(stdout) == 0;
  if (written) return code;
  return fail({ErrorCode::InvalidFile, std::string("stdout cannot be written: ") + std::strerror(errno)});
}

int commit(const Result<Outcome>& made, const Run& run) {
  if (!run.context().cancelled() && !made) return fail(made.error());
  // From here on, finishing is faster than stopping.
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_IGN);
#ifdef SIGHUP
  std::signal(SIGHUP, SIG_IGN);
#endif
  if (run.context().cancelled()) return fail({ErrorCode::Cancelled, kCancelled});
  if (const std::optional<Error> problem = writeTogether(made.value().files)) return fail(*problem);
  if (made.value().files.empty() || made.value().textIsAsked) return answer(made.value().text);
  std::fputs(made.value().text.c_str(), stdout);
  return 0;
}

int endWithoutMemory() {
  // Prints without making a string, which would take memory.
  for (const auto& [code, text, unsaid] : errorHints()) {
    if (std::strcmp(code, "OutOfMemory") == 0) std::fprintf(stderr, "sillon: out of memory; %s\n", text);
  }
  return 2;
}

}  // namespace sillon::cli
