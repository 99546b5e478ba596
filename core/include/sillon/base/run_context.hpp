// Conditions of a run, apart from what it computes: threads, memory, progress and cancelling.
#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <memory>
#include <string_view>

namespace sillon {

class ThreadPool;

/// Conditions under which jobs run, passed by const reference through every stage. A context runs
/// one job at a time; its thread pool outlives the jobs.
class RunContext {
 public:
  using Progress = std::function<void(std::string_view stage, double fraction)>;

  /// Creates a context and its thread pool.
  /// \param threads  number of workers, the caller included, clamped to 1..256. Where no thread can
  /// be started (WebAssembly without shared memory) it must be 1. Results never depend on it.
  explicit RunContext(int threads = 1);
  ~RunContext();
  RunContext(const RunContext&) = delete;
  RunContext& operator=(const RunContext&) = delete;

  [[nodiscard]] int threads() const;
  [[nodiscard]] ThreadPool& pool() const { return *pool_; }

  /// Sets the callback for progress. It is called on the calling thread with a fraction in [0, 1]
  /// that never falls within a job.
  void onProgress(Progress callback) { progress_ = std::move(callback); }

  /// Asks the running job to stop; safe from any thread and from signal handlers.
  void requestCancel() { cancelled_.store(true, std::memory_order_relaxed); }
  [[nodiscard]] bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }
  /// Sets a callback that may cancel the job, for hosts whose requests cannot come in while a job
  /// runs on their only thread. Loops call it between their pieces, some thousand times a second;
  /// if it returns true, the job is cancelled. It is not called where several threads work.
  void onPoll(std::function<bool()> callback) { poll_ = std::move(callback); }
  /// Calls the callback of onPoll, if there is one, and returns cancelled().
  [[nodiscard]] bool poll() const;
  /// Returns the flag of the request itself, for hosts that reach this memory but not this code,
  /// and for taking a request back before the next job.
  [[nodiscard]] std::atomic<bool>& cancelFlag() { return cancelled_; }

  /// Limits the memory of jobs. Plates that would take more are refused before work on them begins
  /// (plateTooLarge).
  /// \param bytes  limit, > 0.
  void limitMemory(double bytes) { memory_ = bytes; }
  /// Returns the memory that a job may take [bytes]; infinite unless limited.
  [[nodiscard]] double memory() const { return memory_; }

  /// Starts a job: its progress goes back to 0, or to the beginning of its share of a larger job. A
  /// cancel request is not cleared.
  void beginJob() const;
  /// Names the stage that runs now and the share [begin, end] of the whole job that it takes.
  void beginStage(std::string_view stage, double begin, double end) const;
  /// Reports the progress of the current stage.
  /// \param fraction  part of the stage that is done, in [0, 1].
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

/// Makes jobs report their progress as a share of a larger job for as long as it lives. Shares may
/// be nested.
class ProgressShare {
 public:
  /// Begins the share.
  /// \param begin,  end  the part of the larger job, in [0, 1].
  ProgressShare(const RunContext& run, double begin, double end);
  ~ProgressShare();
  ProgressShare(const ProgressShare&) = delete;
  ProgressShare& operator=(const ProgressShare&) = delete;

 private:
  const RunContext& run_;
  double begin_;  // share around this one, restored at the end
  double end_;
};

}  // namespace sillon
