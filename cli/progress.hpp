// Progress bar on the terminal.
#pragma once

#include <chrono>
#include <cstddef>
#include <string_view>

namespace sillon::cli {

/// Draws a line on stderr if that is a terminal. The destructor removes the line.
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
  std::size_t length_ = 0;  ///< length of the stage's name on the screen
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace sillon::cli
