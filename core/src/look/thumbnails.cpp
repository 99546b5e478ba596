#include "sillon/look/thumbnails.hpp"

#include <algorithm>
#include <utility>

#include "look/qoi.hpp"
#include "sillon/input/image_io.hpp"

namespace sillon {
namespace {

// A picture of the same proportions, by the mean over each of its pixels.
RgbImage reduced(const RgbImage& large, int width, int height) {
  RgbImage small{width, height, {}};
  small.rgb.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  // Pixels of one picture in units of the other's: where they begin, and how much of each lies within one of the other.
  const auto common = [](int in, int of, int out, int by) {
    return std::min((in + 1) * by, (out + 1) * of) - std::max(in * by, out * of);
  };
  const std::uint32_t all = static_cast<std::uint32_t>(large.width) * static_cast<std::uint32_t>(large.height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      std::uint32_t sum[3] = {all / 2, all / 2, all / 2};
      for (int v = y * large.height / height; v * height < (y + 1) * large.height; ++v) {
        const int rows = common(v, large.height, y, height);
        const std::uint8_t* const row =
            &large.rgb[static_cast<std::size_t>(v) * static_cast<std::size_t>(large.width) * 3];
        for (int u = x * large.width / width; u * width < (x + 1) * large.width; ++u) {
          const auto share = static_cast<std::uint32_t>(rows * common(u, large.width, x, width));
          for (int c = 0; c < 3; ++c) sum[c] += share * row[3 * u + c];
        }
      }
      for (const std::uint32_t s : sum) small.rgb.push_back(static_cast<std::uint8_t>(s / all));
    }
  }
  return small;
}

}  // namespace

Result<std::vector<Thumbnail>> lookThumbnails(const Toolpath& toolpath, Vec2 page, std::string_view screenSizes,
                                              const LookParams& look, const RunContext& run) {
  const auto sizes = readThumbnailSizes(screenSizes);
  if (!sizes) return sizes.error();
  std::vector<Thumbnail> thumbnails;
  RgbImage drawn;
  for (const ThumbnailSize& size : sizes.value()) {
    // The largest picture of the same proportions is drawn, the others are made from it: a plate of 50 m of beads takes
    // 20 ms to draw at any size.
    ThumbnailSize largest = size;
    for (const ThumbnailSize& other : sizes.value()) {
      if (other.width * size.height == other.height * size.width && other.width >= 2 * largest.width) largest = other;
    }
    if (drawn.width != largest.width || drawn.height != largest.height) {
      Result<RgbImage> picture = renderLook(toolpath, page, largest.width, largest.height, look, run);
      if (!picture) return picture.error();
      drawn = std::move(picture).value();
    }
    const bool whole = largest.width == size.width;
    const RgbImage picture = whole ? drawn : reduced(drawn, size.width, size.height);
    const std::vector<std::uint8_t>& rgb = picture.rgb;
    Thumbnail thumbnail{size.width, size.height, {}, size.format};
    thumbnail.bytes = size.format == ThumbnailFormat::Qoi ? encodeQoi(size.width, size.height, rgb)
                                                          : encodePng(size.width, size.height, rgb, {}, true);
    if (thumbnail.bytes.empty()) return Error{ErrorCode::TooLarge, "a thumbnail needs more memory than there is"};
    thumbnails.push_back(std::move(thumbnail));
  }
  return thumbnails;
}

}  // namespace sillon
