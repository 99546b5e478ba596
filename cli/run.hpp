// The beginning and end of a command's run: threads, memory and signals; what goes to stdout, to stderr and to the
// disk.
#pragma once

#include <string>

#include "files.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"

namespace cli {

/// A run that signals cancel, with as much memory as the system can give. One at a time.
class Run {
 public:
  explicit Run(int threads);
  ~Run();
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  [[nodiscard]] sillon::RunContext& context() { return context_; }
  [[nodiscard]] const sillon::RunContext& context() const { return context_; }

 private:
  sillon::RunContext context_;
};

/// Says what is wrong. \return the exit code for it.
int fail(const sillon::Error& error);

/// Prints what a command was asked for: a full disk or a closed pipe that loses it is a failure.
int answer(const std::string& text, int code = 0);

/// The one place where files are written, after all that can fail. They are what was asked for, as JSON is: once they
/// are there, a summary that gets lost is no failure.
int commit(const sillon::Result<Outcome>& made, const Run& run);

/// Says that memory has run out, without taking any. \return the exit code.
int endWithoutMemory();

}  // namespace cli
