// Loops over bands of rows. Results must not depend on how the rows are divided among threads.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"

namespace sillon {

// Result of a job that was asked to stop.

/// Returns the error ErrorCode::Cancelled.
Error cancelledRun();

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

/// Body of a loop without its type: all loops share one function that hands out ranges, and no body is compiled twice,
/// which saves 3 % of the npm module.
struct RangeBody {
  const void* body;
  void (*call)(const void* body, int begin, int end);
};
void forRanges(const RunContext& run, int count, int grain, const RangeBody& body);

/// Calls body(begin, end) over disjoint ranges that cover [0, count), none longer than `grain`. When the run is
/// cancelled, ranges that have not begun are skipped, and so are all later loops: check run.cancelled() before serial
/// code uses results of a loop as indices or sizes.
template <class Body>
void parallelFor(const RunContext& run, int count, int grain, const Body& body) {
  forRanges(run, count, grain,
            {&body, [](const void* own, int begin, int end) { (*static_cast<const Body*>(own))(begin, end); }});
}

/// Calls body(k) for each k in [0, count), in ranges of parallelFor.
template <class Body>
void parallelForEach(const RunContext& run, int count, int grain, const Body& body) {
  parallelFor(run, count, grain, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) body(k);
  });
}

/// Returns the number of rows per chunk for loops over `rows` rows of `rowCost` nanoseconds: about 50 µs of work, but
/// at most 1/8 of a worker's share.
inline int rowGrain(const RunContext& run, int rows, double rowCost) {
  const int share = std::max(1, rows / (8 * run.threads()));
  return std::clamp(static_cast<int>(50e3 / std::max(rowCost, 1.0)), 1, share);
}

}  // namespace sillon
