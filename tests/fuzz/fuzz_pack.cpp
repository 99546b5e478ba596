// Any bytes as G-code to pack and as .gcode.3mf or .bgcode to unpack: what was packed comes back, what is damaged is an
// error.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "sillon/export/export.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sillon;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::string bambu = "; HEADER_BLOCK_START\n" + std::string(bytes);
  const auto packed = packGcode(bambu);
  if (!packed && packed.error().message.empty()) std::abort();
  const auto back = packed ? unpackGcode(packed.value()) : bambu;
  if (!back || back.value() != bambu) std::abort();
  if (!readGcodeContainer(packBinaryGcode(bytes).value())) std::abort();
  const auto container = readGcodeContainer(std::string(bytes));
  if (!container && container.error().message.empty()) std::abort();
  if (container && container.value().kind != GcodeContainerKind::Text) {
    const auto written = writeGcodeContainer(container.value(), "G28\n");
    if (!written && written.error().message.empty()) std::abort();
  }
  return 0;
}
