#include "sillon/look/preview.hpp"

#include <utility>

#include "base/refused.hpp"
#include "look/preview_parts.hpp"
#include "sillon/input/image_io.hpp"

namespace sillon {
namespace {

// Makes a smaller picture of the same proportions; each pixel is the mean of those that lie in it.
RgbImage reduced(const RgbImage& large, int width, int height) {
  RgbImage small{width, height, {}};
  for (int k = 0; k < width * height; ++k) {
    const int x = k % width;
    const int y = k / width;
    std::array<unsigned, 3> sum{};
    unsigned count = 0;
    for (int v = y * large.height / height; v < (y + 1) * large.height / height; ++v) {
      for (int u = x * large.width / width; u < (x + 1) * large.width / width; ++u, ++count) {
        for (std::size_t c = 0; c < 3; ++c) sum[c] += large.rgb[indexOf(u, v, large.width) * 3 + c];
      }
    }
    for (const unsigned s : sum) small.rgb.push_back(static_cast<std::uint8_t>((s + count / 2) / count));
  }
  return small;
}

}  // namespace

Result<std::vector<Thumbnail>> lookThumbnails(const Toolpath& toolpath, Vec2 page, std::string_view screenSizes,
                                              const LookParams& look, const RunContext& run) {
  // Sizes and formats as the printer's profile lists them.
  const auto sizes = readThumbnailSizes(screenSizes);
  if (!sizes) return sizes.error();
  std::vector<Thumbnail> thumbnails;
  RgbImage drawn;
  for (const ThumbnailSize& size : sizes.value()) {
    // Draw the largest picture of the same proportions and make the others from it, as drawing takes 20 ms for 50 m of
    // beads at any size.
    ThumbnailSize largest = size;
    for (const ThumbnailSize& other : sizes.value()) {
      if (other.width * size.height == other.height * size.width && other.width >= 2 * largest.width) largest = other;
    }
    // Thumbnails of the same proportions share one drawing.
    if (drawn.width != largest.width || drawn.height != largest.height) {
      Result<RgbImage> picture = renderLook(toolpath, page, largest.width, largest.height, look, run);
      if (!picture) return picture.error();
      drawn = std::move(picture).value();
    }
    const bool whole = largest.width == size.width;
    const RgbImage picture = whole ? drawn : reduced(drawn, size.width, size.height);
    const std::vector<std::uint8_t>& rgb = picture.rgb;
    Thumbnail thumbnail{size.width, size.height, {}, size.format};
    // QOI or PNG, as the printer's screen asks for.
    thumbnail.bytes = size.format == ThumbnailFormat::Qoi ? encodeQoi(size.width, size.height, rgb)
                                                          : encodePng(size.width, size.height, rgb, {}, true);
    if (thumbnail.bytes.empty()) return needsMoreMemory();
    thumbnails.push_back(std::move(thumbnail));
  }
  return thumbnails;
}

}  // namespace sillon
