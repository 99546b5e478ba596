// Any bytes as a project: read, written, read again, or an error with a message.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "sillon/project/project.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto project = sillon::readProject({reinterpret_cast<const char*>(data), size});
  if (!project) {
    if (project.error().message.empty()) std::abort();
    return 0;
  }
  const std::string text = sillon::writeProject(project.value());
  const auto again = sillon::readProject(text);
  if (!again || sillon::writeProject(again.value()) != text) std::abort();
  return 0;
}
