#include "sillon/base/run_context.hpp"

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "base/parallel_for.hpp"
#include "base/refused.hpp"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace sillon {

namespace {

// Polls of an idle worker for the next loop before it sleeps. The sweeps of a hierarchy are hundreds of loops of some
// 100 us each, and waking a sleeper takes 50 us.
constexpr int kSpins = 4000;

constexpr int kMaxThreads = 256;

// Yields to the other thread of the core, and now and then to the other threads of the machine.
void pause(int spin) {
#if defined(__SSE2__)
  _mm_pause();
#endif
  if (spin % 64 == 63) std::this_thread::yield();
}

}  // namespace

// State of a pool. A loop is published as its number in the upper half of `next` and `limit`. A worker that draws a
// chunk compares both numbers: if it comes late for a loop, it can neither run the loop's chunks twice nor mistake them
// for the next loop's.
struct ThreadPool::State {
  std::mutex mutex;
  std::condition_variable wake;
  std::vector<std::thread> workers;
  const std::function<void(int)>* task = nullptr;
  std::atomic<std::uint64_t> next{0};
  std::atomic<std::uint64_t> limit{0};
  std::atomic<int> unfinished{0};
  std::atomic<int> sleepers{0};
  std::atomic<bool> stop{false};
  std::exception_ptr failure;  // exception of the first chunk that threw; guarded by `mutex`

  // Runs a chunk. An exception, such as out of memory, is rethrown by run() once no worker is busy with the loop any
  // more.
  void work(int chunk) {
#ifdef __cpp_exceptions
    try {
      (*task)(chunk);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
    }
#else
    (*task)(chunk);
#endif
  }

  // Runs chunks of the current loop until none is left.
  void drain() {
    for (;;) {
      const std::uint64_t drawn = next.fetch_add(1);
      const std::uint64_t bound = limit.load();
      if ((drawn >> 32) != (bound >> 32) || drawn >= bound) return;
      work(static_cast<int>(drawn & 0xffffffffu));
      unfinished.fetch_sub(1);
    }
  }

  [[nodiscard]] bool idle(std::uint64_t seen) const { return !stop.load() && (next.load() >> 32) == seen; }

  // Body of a worker's thread: spins for a while, then sleeps, and drains each new loop.
  void loop() {
    std::uint64_t seen = 0;
    for (;;) {
      for (int spin = 0; spin < kSpins && idle(seen); ++spin) pause(spin);
      if (idle(seen)) {
        std::unique_lock lock(mutex);
        sleepers.fetch_add(1);
        wake.wait(lock, [&] { return !idle(seen); });
        sleepers.fetch_sub(1);
      }
      if (stop.load()) return;
      seen = next.load() >> 32;
      drain();
    }
  }
};

ThreadPool::ThreadPool(int threads) : state_(std::make_unique<State>()), threads_(std::clamp(threads, 1, kMaxThreads)) {
  state_->workers.reserve(threads_);
  const auto start = [this] {
    for (int k = 1; k < threads_; ++k) state_->workers.emplace_back([this] { state_->loop(); });
  };
#ifdef __cpp_exceptions
  try {
    start();
  } catch (const std::system_error&) {  // the system refuses more threads; go on with those that exist
    threads_ = static_cast<int>(state_->workers.size()) + 1;
  }
#else
  start();
#endif
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(state_->mutex);
    state_->stop.store(true);
  }
  state_->wake.notify_all();
  for (std::thread& worker : state_->workers) worker.join();
}

void ThreadPool::run(int chunks, const std::function<void(int)>& task) {
  State& state = *state_;
  const std::uint64_t number = ((state.limit.load() >> 32) + 1) << 32;
  state.task = &task;
  state.unfinished.store(chunks);
  state.limit.store(number | static_cast<std::uint32_t>(chunks));
  state.next.store(number);
  if (state.sleepers.load() > 0) {
    { const std::lock_guard lock(state.mutex); }  // a worker about to sleep has seen the loop or is notified
    state.wake.notify_all();
  }
  state.drain();
  for (int spin = 0; state.unfinished.load() > 0; ++spin) pause(spin & 0xffff);
#ifdef __cpp_exceptions
  if (state.failure) std::rethrow_exception(std::exchange(state.failure, nullptr));
#endif
}

void forRanges(const RunContext& run, int count, int grain, const RangeBody& body) {
  if (count <= 0) return;
  grain = std::max(grain, 1);
  const int chunks = (count - 1) / grain + 1;
  const auto chunkBody = [&](int chunk) {
    if (run.cancelled()) return;
    const int begin = chunk * grain;
    body.call(body.body, begin, std::min(count - begin, grain) + begin);
  };
  if (chunks == 1 || run.threads() == 1) {
    for (int chunk = 0; chunk < chunks && !run.poll(); ++chunk) chunkBody(chunk);
  } else {
    run.pool().run(chunks, chunkBody);
  }
}

Error cancelledRun() { return refused(ErrorCode::Cancelled, "Cancelled"); }

RunContext::RunContext(int threads) : pool_(std::make_unique<ThreadPool>(threads)) {}
RunContext::~RunContext() = default;

int RunContext::threads() const { return pool_->threads(); }

bool RunContext::poll() const {
  if (poll_ && !cancelled() && poll_()) cancelled_.store(true, std::memory_order_relaxed);
  return cancelled();
}

void RunContext::beginJob() const {
  stage_ = {};
  stageBegin_ = 0;
  stageEnd_ = 1;
  if (shares_ == 0) reported_ = 0;
}

void RunContext::beginStage(std::string_view stage, double begin, double end) const {
  stage_ = stage;
  stageBegin_ = begin;
  stageEnd_ = end;
  report(0);
}

void RunContext::report(double fraction) const {
  const double ofJob = stageBegin_ + (stageEnd_ - stageBegin_) * std::clamp(fraction, 0.0, 1.0);
  const double total = shareBegin_ + (shareEnd_ - shareBegin_) * ofJob;
  reported_ = std::max(reported_, std::min(total, 1.0));
  if (progress_) progress_(stage_, reported_);
}

ProgressShare::ProgressShare(const RunContext& run, double begin, double end)
    : run_(run), begin_(run.shareBegin_), end_(run.shareEnd_) {
  if (run.shares_++ == 0) run.reported_ = 0;
  run.shareBegin_ = begin_ + (end_ - begin_) * begin;
  run.shareEnd_ = begin_ + (end_ - begin_) * end;
}

ProgressShare::~ProgressShare() {
  run_.shareBegin_ = begin_;
  run_.shareEnd_ = end_;
  --run_.shares_;
}

}  // namespace sillon
