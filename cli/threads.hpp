// How many threads there can be.
#pragma once

#include <algorithm>
#include <thread>

namespace cli {

constexpr int kMostThreads = 256;

/// What a run gets of the threads that were asked for: compiled for Node, the program has one.
inline int threadsHere([[maybe_unused]] int asked) {
#ifdef __EMSCRIPTEN__
  return 1;
#else
  return asked;
#endif
}

/// As many as the machine runs at once.
inline int threadsOfMachine() {
  return threadsHere(std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostThreads));
}

}  // namespace cli
