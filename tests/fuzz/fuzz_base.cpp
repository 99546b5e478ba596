// Any bytes as a shape: a closed body of its outline's area, or an error with a message.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <utility>
#include <vector>

#include "sillon/export/export.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sillon;
  if (size < 1 || size > 4096) return 0;
  // Bit 0: the fill rule; the rest: steps of so many µm between possible coordinates, so that points meet.
  Shape shape{{FilledPath{{}, data[0] % 2 == 0 ? FillRule::EvenOdd : FillRule::NonZero}}, {10, 10}};
  const double step = 0.0005 * (1 + data[0] / 2);
  std::vector<Ring>& rings = shape.paths[0].rings;
  rings.emplace_back();
  for (std::size_t k = 1; k + 1 < size; k += 2) {
    if (data[k] == 255) {
      rings.emplace_back();
    } else {
      rings.back().push_back({step * data[k], step * data[k + 1]});
    }
  }
  const auto mesh = baseBody(shape, Printer{}, PrintParams{});
  if (!mesh) {
    if (mesh.error().message.empty()) std::abort();
    return 0;
  }
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sum;  // of an edge forth, less back
  for (const auto& t : mesh.value().triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k];
      const std::uint32_t b = t[(k + 1) % 3];
      sum[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  for (const auto& [edge, times] : sum) {
    if (times != 0) std::abort();
  }
  if (writeStl(mesh.value()).value().size() != 84 + 50 * mesh.value().triangles.size()) std::abort();
  if (write3mf(mesh.value()).value().empty()) std::abort();
  return 0;
}
