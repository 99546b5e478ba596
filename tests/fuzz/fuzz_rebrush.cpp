// Any bytes as a sliced file: refused, or another file of the same layers; never a crash. Making a path takes a hundred
// times as long as reading, so only one input in eight gets that far.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "sillon/rebrush/rebrush.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  unsigned sum = 0;
  for (const char c : text) sum += static_cast<std::uint8_t>(c);
  if (sum % 8 != 0) {
    const auto file = sillon::readSlicedFile(text);
    if (!file && file.error().message.empty()) std::abort();
    for (std::size_t k = 0; file && k < file.value().surfaces.size(); ++k) {
      const sillon::SlicedSurface& surface = file.value().surfaces[k];
      if (surface.begin >= surface.end || surface.end > size || surface.layer > file.value().layers) std::abort();
    }
    const auto relief = sillon::printRelief(text, 64);
    if (!relief && relief.error().message.empty()) std::abort();
    return 0;
  }
  sillon::RebrushOptions options;
  options.project.layers.emplace_back().as<sillon::LayerAngle>()->angle = 30;
  options.bottoms = true;
  const sillon::RunContext run(1);
  const auto done = sillon::rebrush(text, options, run);
  if (!done) return 0;
  const auto again = sillon::readSlicedFile(sillon::withEdits(text, done.value().edits));
  if (!again || again.value().layers != done.value().file.layers) std::abort();
  return 0;
}
