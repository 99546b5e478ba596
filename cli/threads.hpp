// Number of threads.
#pragma once

#include <algorithm>
#include <thread>

namespace sillon::cli {

constexpr int kMostThreads = 256;

/// Returns the number of threads that a run gets: as many as asked for, but one if compiled for Node.
inline int threadsHere([[maybe_unused]] int asked) {
#ifdef __EMSCRIPTEN__
  return 1;
#else
  return asked;
#endif
}

/// Returns the number of threads that the machine runs at once.
inline int threadsOfMachine() {
  return threadsHere(std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostThreads));
}

}  // namespace sillon::cli
