// How to run, apart from what to compute: threads, progress and cancelling.
#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <memory>
#include <string_view>

namespace sillon {

class ThreadPool;

/// Passed by const reference through every stage. One job at a time per context; the pool outlives
/// the jobs.
class RunContext {
 public:
  using Progress = std::function<void(std::string_view stage, double fraction)>;

  /// \param threads  worker count including the caller, clamped to 1..256. Where no thread can be
  /// started (WebAssembly without shared memory) it must be 1. Results never depend on it.
  explicit RunContext(int threads = 1);
  ~RunContext();
  RunContext(const RunContext&) = delete;
  RunContext& operator=(const RunContext&) = delete;

  [[nodiscard]] int threads() const;
  [[nodiscard]] ThreadPool& pool() const { return *pool_; }

  /// Called on the calling thread with a fraction in [0, 1] that never falls within a job.
  void onProgress(Progress callback) { progress_ = std::move(callback); }

  /// Asks the running job to stop; safe from any thread and from signal handlers.
  void requestCancel() { cancelled_.store(true, std::memory_order_relaxed); }
  [[nodiscard]] bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }
  /// For hosts whose requests cannot come in while a job runs on their only thread: asked between
  /// the pieces of loops, some thousand times a second; true is a request to cancel. Not asked
  /// where several threads work.
  void onPoll(std::function<bool()> callback) { poll_ = std::move(callback); }
  /// Asks; then as cancelled().
  [[nodiscard]] bool poll() const;
  /// The request itself, for hosts that reach this memory but not this code, and to take it back
  /// before the next job.
  [[nodiscard]] std::atomic<bool>& cancelFlag() { return cancelled_; }

  /// Plates that would take more are refused before work on them begins (plateTooLarge).
  /// \param bytes  > 0.
  void limitMemory(double bytes) { memory_ = bytes; }
  /// That a job may take [bytes]; infinite unless limited.
  [[nodiscard]] double memory() const { return memory_; }

  /// Starts a job: progress back to 0, or to where its share of a larger job begins. Does not clear
  /// a cancel request.
  void beginJob() const;
  /// Names the stage that runs now and the share [begin, end] of the whole job that it takes.
  void beginStage(std::string_view stage, double begin, double end) const;
  /// \param fraction  of the current stage, in [0, 1].
  void report(double fraction) const;

 private:
  friend class ProgressShare;

  std::unique_ptr<ThreadPool> pool_;
  Progress progress_;
  std::function<bool()> poll_;
  double memory_ = std::numeric_limits<double>::infinity();
  mutable std::atomic<bool> cancelled_{false};
  mutable std::string_view stage_;
  mutable double stageBegin_ = 0;
  mutable double stageEnd_ = 1;
  mutable double reported_ = 0;
  mutable double shareBegin_ = 0;
  mutable double shareEnd_ = 1;
  mutable int shares_ = 0;
};

/// While one lives, jobs tell their progress as a share of a larger job; a share may lie within
/// another.
class ProgressShare {
 public:
  /// \param begin,  end  the part of the larger job, in [0, 1].
  ProgressShare(const RunContext& run, double begin, double end);
  ~ProgressShare();
  ProgressShare(const ProgressShare&) = delete;
  ProgressShare& operator=(const ProgressShare&) = delete;

 private:
  const RunContext& run_;
  double begin_;  // of the share around this one
  double end_;
};

}  // namespace sillon
