// Begins and ends a command's run: threads, memory and signals, and output to stdout, stderr and the disk.
#pragma once

#include <string>

#include "files.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"

namespace sillon::cli {

/// A run that signals cancel, limited to the memory that the system can give. Only one may exist at a time.
class Run {
 public:
  explicit Run(int threads);
  ~Run();
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  [[nodiscard]] RunContext& context() { return context_; }
  [[nodiscard]] const RunContext& context() const { return context_; }

 private:
  RunContext context_;
};

/// Prints an error. \return its exit code.
int fail(const Error& error);

/// Prints the result of a command; losing it to a full disk or a closed pipe is a failure.
int answer(const std::string& text, int code = 0);

/// Writes the files of a command, the only place that does, after all that can fail. The files, or JSON on stdout, are
/// the result: once they are there, losing the summary is no failure.
int commit(const Result<Outcome>& made, const Run& run);

/// Reports that memory has run out, without taking any. \return the exit code.
int endWithoutMemory();

}  // namespace sillon::cli
