#include "previews.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "sillon/input/image_io.hpp"
#include "sillon/look/preview.hpp"
#include "webp.hpp"

namespace sillon::cli {
namespace {

constexpr int kUsualWidth = 1600;    // default width of a panel [pixels]
constexpr int kMostLoopSide = 1024;  // limit of renderLook() [pixels]

bool moves(const std::string& path) { return endsWith(path, ".webp"); }

Result<std::string> previewPng(const Toolpath& toolpath, Vec2 page, const LookParams& look, int width,
                               const RunContext& run) {
  const auto picture = renderPreview(toolpath, page, {width, look}, run);
  if (!picture) return picture.error();
  return pngFile(picture.value());
}

/// Encodes the look under moving light. \param side  longer side [pixels].
Result<std::string> loopFile(const Toolpath& toolpath, Vec2 page, const std::vector<LookParams>& looks, int side,
                             const RunContext& run) {
  const auto pixels = [&](double length) {
    return std::max(16, static_cast<int>(std::lround(side * length / std::max(page.x, page.y))));
  };
  std::vector<Lamp> lamps;
  for (const LookParams& look : looks) lamps.push_back(look.lamp);
  std::vector<WebpFrame> frames;
  for (const LoopFrame& frame : loopFrames(lamps)) {
    LookParams look = looks.front();
    look.lamp = frame.lamp;
    Result<RgbImage> picture = renderLook(toolpath, page, pixels(page.x), pixels(page.y), look, run);
    if (!picture) return picture.error();
    frames.push_back({std::move(picture).value(), frame.milliseconds});
  }
  // A quality applies to the whole loop, because frames of different quality would flicker.
  for (const int quality : loopQualities()) {
    Result<std::string> bytes = encodeWebp(frames, quality, run);
    if (!bytes || bytes.value().size() <= sillon::toSize(loopBytes())) return bytes;
  }
  return Error{ErrorCode::TooLarge, "a moving picture " + std::to_string(side) + " pixels large takes more than " +
                                        std::to_string(loopBytes()) + " bytes; choose a smaller --preview-width"};
}

}  // namespace

std::string previewName(const std::string& path, std::size_t picture) {
  if (picture == 0) return path;
  const std::size_t slash = path.find_last_of('/'), dot = path.find_last_of('.');
  const bool ends = dot != std::string::npos && (slash == std::string::npos || dot > slash);
  const std::size_t at = ends ? dot : path.size();
  return path.substr(0, at) + "-" + std::to_string(picture + 1) + path.substr(at);
}

std::vector<std::string> previewNames(const std::string& path, std::size_t lights) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < (moves(path) ? 1 : lights) && !path.empty(); ++k) names.push_back(previewName(path, k));
  return names;
}

std::optional<Error> previewProblem(const std::string& path, int width) {
  if (!moves(path)) return std::nullopt;
  if (!writesWebp()) {
    return Error{ErrorCode::InvalidArgument,
                 "--preview is \"" + path + "\"; this build has no libwebp, so it must be a .png"};
  }
  if (width <= kMostLoopSide) return std::nullopt;
  return Error{ErrorCode::InvalidArgument, "--preview-width is " + std::to_string(width) +
                                               "; for a moving picture it must be 16 to " +
                                               std::to_string(kMostLoopSide)};
}

Result<std::vector<OutputFile>> previewFiles(const std::string& path, const Toolpath& toolpath, Vec2 page,
                                             const std::vector<LookParams>& looks, int width, const RunContext& run) {
  std::vector<OutputFile> files;
  if (moves(path)) {
    Result<std::string> loop = loopFile(toolpath, page, looks, width > 0 ? width : loopSide(), run);
    if (!loop) return loop.error();
    files.push_back({path, std::move(loop).value()});
    return files;
  }
  for (std::size_t k = 0; k < looks.size(); ++k) {
    Result<std::string> png = previewPng(toolpath, page, looks[k], width > 0 ? width : kUsualWidth, run);
    if (!png) return png.error();
    files.push_back({previewName(path, k), std::move(png).value()});
  }
  return files;
}

Result<std::string> pngFile(const RgbImage& image) {
  const std::vector<std::uint8_t> png = encodePng(image.width, image.height, image.rgb);
  if (png.empty()) return Error{ErrorCode::TooLarge, "a picture needs more memory than there is"};
  return std::string(png.begin(), png.end());
}

}  // namespace sillon::cli
