// Loops over row bands. Results must not depend on how the rows are shared out.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>

#include "sillon/run_context.hpp"

namespace sillon {

/// Threads that wait for work between loops; the caller is worker 0.
class ThreadPool {
 public:
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  [[nodiscard]] int threads() const { return threads_; }
  /// Runs task(chunk) for chunk in [0, chunks), each once, in any order, on any worker; returns when all are done.
  void run(int chunks, const std::function<void(int)>& task);

 private:
  struct State;
  std::unique_ptr<State> state_;
  int threads_;
};

/// Calls body(begin, end) over disjoint ranges that cover [0, count), none longer than `grain`.
/// Ranges that have not begun when the run is cancelled are left out, and so are all later loops: before serial code
/// uses what a loop made as indices or sizes, check run.cancelled().
template <class Body>
void parallelFor(const RunContext& run, int count, int grain, const Body& body) {
  if (count <= 0) return;
  grain = std::max(grain, 1);
  const int chunks = (count - 1) / grain + 1;
  const auto chunkBody = [&](int chunk) {
    if (run.cancelled()) return;
    const int begin = chunk * grain;
    body(begin, std::min(count - begin, grain) + begin);
  };
  if (chunks == 1 || run.threads() == 1) {
    for (int chunk = 0; chunk < chunks && !run.poll(); ++chunk) chunkBody(chunk);
  } else {
    run.pool().run(chunks, chunkBody);
  }
}

/// Rows per chunk for loops over `rows` rows of `rowCost` nanoseconds: about 50 µs of work, at most 1/8 of a worker's
/// share.
inline int rowGrain(const RunContext& run, int rows, double rowCost) {
  const int share = std::max(1, rows / (8 * run.threads()));
  return std::clamp(static_cast<int>(50e3 / std::max(rowCost, 1.0)), 1, share);
}

}  // namespace sillon
