// Any bytes as a file of spools: slopes that the appearance model takes, or an error with a message.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "sillon/look/appearance.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto spools = sillon::readSpools({reinterpret_cast<const char*>(data), size});
  if (!spools) {
    if (spools.error().message.empty()) std::abort();
    return 0;
  }
  for (const sillon::Spool& spool : spools.value()) {
    if (spool.key.empty()) std::abort();
  }
  return 0;
}
