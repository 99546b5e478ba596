// Any bytes as a drawing: a shape within its page that can be painted, or an error with a message.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "input/shaped_line.hpp"
#include "input/svg.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr double kEdge = 1e-5;  // [mm] clipping rounds
  for (const bool ignorePaint : {false, true}) {
    sillon::SvgOptions options;
    options.ignorePaint = ignorePaint;
    options.tolerance = 0.1;  // as many points as need be, and more drawings in the same time
    options.letters.choose = [](std::string_view families) {
      return sillon::DrawingFont{std::string(families.substr(0, 1)), families.empty()};
    };
    options.letters.shape = [](const sillon::DrawingFont&,
                               const std::string& line) -> sillon::Result<sillon::ShapedLine> {
      if (line.find('?') != std::string::npos) return sillon::Error{sillon::ErrorCode::InvalidArgument, "no letter"};
      sillon::ShapedLine shaped;
      shaped.xHeight = shaped.ascent = 500;
      shaped.outlines = {"M0 0H500V700H0Z"};
      shaped.letters.assign(line.size(), {0, {}, 600});
      return shaped;
    };
    const auto painting = sillon::readSvgPainting({reinterpret_cast<const char*>(data), size}, options);
    if (!painting) {
      if (painting.error().message.empty()) std::abort();
      continue;
    }
    if (sillon::paintedPicture(painting.value(), 64).samples.empty()) std::abort();
    const sillon::Shape& shape = painting.value().shape;
    const sillon::Vec2 page = shape.page;
    if (!(page.x > 0 && page.y > 0 && page.x <= 100'000 && page.y <= 100'000)) std::abort();
    for (const sillon::FilledPath& path : shape.paths) {
      for (const sillon::Ring& ring : path.rings) {
        for (const sillon::Vec2 point : ring) {
          if (!std::isfinite(point.x) || !std::isfinite(point.y)) std::abort();
          const bool inside =
              point.x >= -kEdge && point.x <= page.x + kEdge && point.y >= -kEdge && point.y <= page.y + kEdge;
          const bool painted = !ignorePaint && !shape.drawing.unpainted;
          if (painted && !inside) std::abort();
        }
      }
    }
  }
  return 0;
}
