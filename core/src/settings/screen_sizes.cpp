#include "sillon/settings/project.hpp"

#include <charconv>
#include <cstddef>

#include "base/refused.hpp"

namespace sillon {
namespace {

constexpr std::size_t kMostPictures = 8;

// Reads "WxH", "WxH/PNG" or "WxH/QOI". \return width 0 if the word is none of them.
ThumbnailSize sizeFrom(std::string_view word) {
  ThumbnailSize size;
  const char* end = word.data() + word.size();
  const auto width = std::from_chars(word.data(), end, size.width);
  if (width.ec != std::errc{} || width.ptr == end || *width.ptr != 'x') return {};
  const auto height = std::from_chars(width.ptr + 1, end, size.height);
  if (height.ec != std::errc{}) return {};
  const std::string_view format(height.ptr, end - height.ptr);
  if (format == "/QOI") {
    size.format = ThumbnailFormat::Qoi;
  } else if (!format.empty() && format != "/PNG") {
    return {};
  }
  const auto shown = [](int side) { return side >= 16 && side <= 1024; };
  return shown(size.width) && shown(size.height) ? size : ThumbnailSize{};
}

}  // namespace

Result<std::vector<ThumbnailSize>> readThumbnailSizes(std::string_view text) {
  std::vector<ThumbnailSize> sizes;
  while (!text.empty()) {
    const std::size_t comma = std::min(text.find(','), text.size());
    std::string_view word = text.substr(0, comma);
    text.remove_prefix(std::min(comma + 1, text.size()));
    while (!word.empty() && word.front() == ' ') word.remove_prefix(1);
    while (!word.empty() && word.back() == ' ') word.remove_suffix(1);
    const ThumbnailSize size = sizeFrom(word);
    if (size.width == 0 || sizes.size() == kMostPictures) {
      return refusedArgument("ScreenSizes");
    }
    sizes.push_back(size);
  }
  return sizes;
}

}  // namespace sillon
