// Any bytes as a font give letters within their page, or an error with a message.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "sillon/text/text.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr double kEdge = 1e-5;  // [mm] clipping rounds
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const sillon::ReadInput read = [&](const std::string& /*name*/, const std::string& /*what*/) {
    return sillon::Result<sillon::InputFile>(bytes);
  };
  // A font that lacks one letter of a text is refused, so the texts go from one letter to many.
  sillon::Lettering letterings[]{
      {"A", "any.ttf", 10}, {"AV", "any.ttf", 10, 20}, {"fi", "any.ttf", 10, -20}, {"fi\nAV \xC3\x89", "any.ttf", 2}};
  letterings[3].align = sillon::TextAlign::Right;
  for (const sillon::Lettering& lettering : letterings) {
    const auto shape = sillon::textShape(lettering, read);
    if (!shape) {
      if (shape.error().message.empty()) std::abort();
      continue;
    }
    const sillon::Vec2 page = shape.value().page;
    if (!(page.x >= 0 && page.y >= 0 && std::isfinite(page.x) && std::isfinite(page.y))) std::abort();
    for (const sillon::FilledPath& path : shape.value().paths) {
      for (const sillon::Ring& ring : path.rings) {
        for (const sillon::Vec2 point : ring) {
          const bool inside =
              point.x >= -kEdge && point.x <= page.x + kEdge && point.y >= -kEdge && point.y <= page.y + kEdge;
          if (!inside) std::abort();
        }
      }
    }
  }
  return 0;
}
