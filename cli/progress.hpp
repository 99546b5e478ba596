// One line on the terminal that shows how far the work is.
#pragma once

#include <chrono>
#include <string_view>

namespace cli {

/// Draws on stderr, and only if that is a terminal. The line is gone when the bar is.
class ProgressBar {
 public:
  explicit ProgressBar(bool wanted);
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(std::string_view stage, double fraction);
  void clear();

 private:
  bool enabled_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace cli
