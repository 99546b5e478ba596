// Any bytes as donor G-code, .ini or .json: a printer whose project can be written, or an error with a message.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "sillon/printer_import/printer_import.hpp"
#include "sillon/settings/presets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto imported = sillon::importPrinter({reinterpret_cast<const char*>(data), size});
  if (!imported && imported.error().message.empty()) std::abort();
  if (imported && sillon::writePrinter(imported.value().printer).empty()) std::abort();
  return 0;
}
