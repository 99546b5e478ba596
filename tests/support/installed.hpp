// Whether another program is there to compare with.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

namespace sillon::test {

/// \param what  is left untried without it: a line says so.
inline bool installed(const char* program, const char* what) {
  if (std::system(("command -v " + std::string(program) + " >/dev/null 2>&1").c_str()) == 0) return true;
  std::printf("skipped: %s; %s is not installed\n", what, program);
  return false;
}

}  // namespace sillon::test
