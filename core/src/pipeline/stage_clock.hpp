// Times stages and tells the run where in the job they lie.
#pragma once

#include <chrono>
#include <utility>
#include <vector>

#include "sillon/base/run_context.hpp"
#include "sillon/pipeline/pipeline.hpp"

namespace sillon {

class StageClock {
 public:
  explicit StageClock(const RunContext& run) : run_(run) { run.beginJob(); }

  /// \param end  share of the job done when this stage is; measured on plates of a million cells.
  void start(const char* stage, double end) {
    stop();
    run_.beginStage(stage, done_, end);
    done_ = end;
    stage_ = stage;
    begin_ = std::chrono::steady_clock::now();
  }
  void stop() {
    if (stage_ == nullptr) return;
    times_.push_back({stage_, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count()});
    stage_ = nullptr;
  }
  /// Of all stages until now, in order.
  std::vector<StageTime> takeTimes() {
    stop();
    return std::move(times_);
  }

 private:
  const RunContext& run_;
  std::vector<StageTime> times_;
  const char* stage_ = nullptr;
  double done_ = 0;
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace sillon
