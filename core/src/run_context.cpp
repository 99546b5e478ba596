#include "sillon/run_context.hpp"

#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include "parallel_for.hpp"

namespace sillon {

struct ThreadPool::State {
  std::mutex mutex;
  std::condition_variable wake;
  std::condition_variable done;
  std::vector<std::thread> workers;
  const std::function<void(int)>* task = nullptr;
  int chunks = 0;
  std::atomic<int> next{0};
  int working = 0;
  std::uint64_t generation = 0;
  bool stop = false;

  void drain() {
    for (int chunk = next.fetch_add(1); chunk < chunks; chunk = next.fetch_add(1)) (*task)(chunk);
  }

  void loop() {
    std::uint64_t seen = 0;
    std::unique_lock lock(mutex);
    for (;;) {
      wake.wait(lock, [&] { return stop || generation != seen; });
      if (stop) return;
      seen = generation;
      lock.unlock();
      drain();
      lock.lock();
      if (--working == 0) done.notify_one();
    }
  }
};

ThreadPool::ThreadPool(int threads) : state_(std::make_unique<State>()), threads_(std::clamp(threads, 1, 256)) {
  for (int k = 1; k < threads_; ++k) state_->workers.emplace_back([this] { state_->loop(); });
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(state_->mutex);
    state_->stop = true;
  }
  state_->wake.notify_all();
  for (std::thread& worker : state_->workers) worker.join();
}

void ThreadPool::run(int chunks, const std::function<void(int)>& task) {
  State& state = *state_;
  {
    const std::lock_guard lock(state.mutex);
    state.task = &task;
    state.chunks = chunks;
    state.next.store(0);
    state.working = static_cast<int>(state.workers.size());
    ++state.generation;
  }
  state.wake.notify_all();
  state.drain();
  std::unique_lock lock(state.mutex);
  state.done.wait(lock, [&] { return state.working == 0; });
}

RunContext::RunContext(int threads) : pool_(std::make_unique<ThreadPool>(threads)) {}
RunContext::~RunContext() = default;

int RunContext::threads() const { return pool_->threads(); }

void RunContext::beginJob() const {
  stage_ = {};
  stageBegin_ = 0;
  stageEnd_ = 1;
  reported_ = 0;
}

void RunContext::beginStage(std::string_view stage, double begin, double end) const {
  stage_ = stage;
  stageBegin_ = begin;
  stageEnd_ = end;
  report(0);
}

void RunContext::report(double fraction) const {
  const double total = stageBegin_ + (stageEnd_ - stageBegin_) * std::clamp(fraction, 0.0, 1.0);
  reported_ = std::max(reported_, std::min(total, 1.0));
  if (progress_) progress_(stage_, reported_);
}

}  // namespace sillon
