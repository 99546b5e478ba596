#include "sillon/look/thumbnails.hpp"

#include <utility>

#include "look/qoi.hpp"
#include "sillon/input/image_io.hpp"

namespace sillon {

Result<std::vector<Thumbnail>> lookThumbnails(const Toolpath& toolpath, Vec2 page, std::string_view screenSizes,
                                              const LookParams& look, const RunContext& run) {
  const auto sizes = readThumbnailSizes(screenSizes);
  if (!sizes) return sizes.error();
  std::vector<Thumbnail> thumbnails;
  for (const ThumbnailSize& size : sizes.value()) {
    const Result<RgbImage> picture = renderLook(toolpath, page, size.width, size.height, look, run);
    if (!picture) return picture.error();
    const std::vector<std::uint8_t>& rgb = picture.value().rgb;
    Thumbnail thumbnail{size.width, size.height, {}, size.format};
    thumbnail.bytes = size.format == ThumbnailFormat::Qoi ? encodeQoi(size.width, size.height, rgb)
                                                          : encodePng(size.width, size.height, rgb);
    if (thumbnail.bytes.empty()) return Error{ErrorCode::TooLarge, "a thumbnail needs more memory than there is"};
    thumbnails.push_back(std::move(thumbnail));
  }
  return thumbnails;
}

}  // namespace sillon
