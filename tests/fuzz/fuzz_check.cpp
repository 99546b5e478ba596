// Any bytes as G-code: findings, never a crash.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "sillon/gcode_reader/check.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto own = sillon::checkGcode(text);
  const auto given = sillon::checkGcode(text, sillon::Printer{});
  if (own.lines != given.lines || own.errors() < 0) std::abort();
  return 0;
}
