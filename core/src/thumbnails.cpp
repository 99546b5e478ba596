#include "sillon/thumbnails.hpp"

#include <utility>

#include "sillon/image_io.hpp"
#include "sillon/preview.hpp"

namespace sillon {

Result<std::vector<Thumbnail>> lookThumbnails(const Toolpath& toolpath, Vec2 page, const RunContext& run) {
  std::vector<Thumbnail> thumbnails;
  for (const int side : {32, 300}) {
    const Result<RgbImage> look = renderLook(toolpath, page, side, side, run);
    if (!look) return look.error();
    Thumbnail thumbnail{side, side, encodePng(side, side, look.value().rgb)};
    if (thumbnail.png.empty()) return Error{ErrorCode::TooLarge, "a thumbnail needs more memory than there is"};
    thumbnails.push_back(std::move(thumbnail));
  }
  return thumbnails;
}

}  // namespace sillon
