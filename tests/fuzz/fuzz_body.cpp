// Any bytes as an STL: a body, and its outline from above on a page of its size, or an error with a message.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "export/zones.hpp"
#include "sillon/export/export.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto body = sillon::readStl({reinterpret_cast<const char*>(data), size});
  if (!body) {
    if (body.error().message.empty()) std::abort();
    return 0;
  }
  for (const auto& point : body.value().points) {
    for (const double v : point) {
      if (!std::isfinite(v)) std::abort();
    }
  }
  for (const auto& triangle : body.value().triangles) {
    for (const std::uint32_t corner : triangle) {
      if (corner >= body.value().points.size()) std::abort();
    }
  }
  sillon::Bounds box;
  for (const auto& point : body.value().points) box.add({point[0], point[1]});
  constexpr double kMost = 400;  // [mm²] a larger one takes as long as a hundred such
  if (box.size().x * box.size().y > kMost) return 0;
  sillon::Vec2 corner;
  const auto outline = sillon::silhouetteOf(body.value(), corner);
  if (!outline) {
    if (outline.error().message.empty()) std::abort();
    return 0;
  }
  const sillon::Vec2 page = outline.value().page;
  if (!(page.x > 0 && page.y > 0) || !std::isfinite(page.x) || !std::isfinite(page.y)) std::abort();
  if (!std::isfinite(corner.x) || !std::isfinite(corner.y)) std::abort();
  return 0;
}
