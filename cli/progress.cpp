#include "progress.hpp"

#include <algorithm>
#include <cstdio>
#include <string>

#include "terminal.hpp"

namespace sillon::cli {
namespace {

constexpr int kCells = 30;
constexpr std::chrono::milliseconds kPause{50};  // 20 times a second is smooth enough and costs nothing

}  // namespace

ProgressBar::ProgressBar(bool wanted) : enabled_(wanted && stderrIsTerminal()) {}

void ProgressBar::show(std::string_view stage, double fraction) {
  if (!enabled_) return;
  const auto now = std::chrono::steady_clock::now();
  if (drawn_ && now - last_ < kPause) return;
  last_ = now;
  drawn_ = true;
  const int full = std::clamp(static_cast<int>(fraction * kCells), 0, kCells);
  const std::string bar = std::string(full, '#') + std::string(kCells - full, '.');
  // Blanks overwrite a longer text; escape codes would be shown literally by old consoles of Windows.
  const int blanks = static_cast<int>(std::max(length_, stage.size()) - stage.size());
  length_ = stage.size();
  std::fprintf(stderr, "\r[%s] %3d %% %.*s%*s", bar.c_str(), static_cast<int>(fraction * 100),
               static_cast<int>(stage.size()), stage.data(), blanks, "");
  std::fflush(stderr);
}

void ProgressBar::clear() {
  if (!drawn_) return;
  std::fprintf(stderr, "\r%*s\r", kCells + 9 + static_cast<int>(length_), "");
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace sillon::cli
