#include "memory.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#if defined(__unix__) || defined(__APPLE__)
#include <sys/resource.h>
#include <unistd.h>
#elif defined(_WIN32)
#define NOMINMAX
#include <windows.h>
#endif

namespace sillon::cli {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

#if defined(__unix__) || defined(__APPLE__)
/// Reads the number after a word in a table of the kernel, or the only number if the word is empty; negative if there
/// is none.
double numberIn(const char* path, const std::string& word) {
  std::ifstream file(path);
  for (std::string read; file && !word.empty() && read != word;) file >> read;
  double number = -1;
  return file >> number ? number : -1;
}

/// Returns the free memory of a group of processes, such as a container [bytes].
double freeInGroup(const char* limit, const char* used) {
  const double most = numberIn(limit, "");
  return most < 0 ? kUnlimited : most - std::max(0.0, numberIn(used, ""));
}
#endif

}  // namespace

double freeMemory() {
  double least = kUnlimited;
#if defined(__unix__) || defined(__APPLE__)
  const double available = 1024 * numberIn("/proc/meminfo", "MemAvailable:");
  const double pages = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  least = available >= 0 ? available : pages > 0 ? pages : kUnlimited;
  least = std::min(least, freeInGroup("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory.current"));
  least = std::min(
      least, freeInGroup("/sys/fs/cgroup/memory/memory.limit_in_bytes", "/sys/fs/cgroup/memory/memory.usage_in_bytes"));
  rlimit space{};
  if (::getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY) {
    const double taken = static_cast<double>(::sysconf(_SC_PAGESIZE)) * std::max(0.0, numberIn("/proc/self/statm", ""));
    least = std::min(least, static_cast<double>(space.rlim_cur) - taken);
  }
#elif defined(_WIN32)
  MEMORYSTATUSEX status{};
  status.dwLength = sizeof status;
  if (::GlobalMemoryStatusEx(&status) != 0) least = static_cast<double>(status.ullAvailPhys);
#endif
  return std::max(0.0, least);
}

}  // namespace sillon::cli
