// One line on the terminal that shows how far the work is.
#pragma once

#include <chrono>
#include <cstddef>
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
  std::size_t length_ = 0;  ///< of the stage's name that is shown
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace cli
