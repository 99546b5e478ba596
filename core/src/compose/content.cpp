#include "compose/content.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "project/files.hpp"
#include "sillon/text/qr_code.hpp"
#include "sillon/text/text.hpp"

namespace sillon {
namespace {

constexpr double kShareOfPage = 0.6;  // of its shorter side: QR codes without a size
constexpr double kMostOfPage = 0.9;   // drawings that are larger than the page

/// The size that is asked for, of a content with these proportions.
/// \param usual  where none is asked for [mm]
Vec2 sizeOf(Vec2 asked, Vec2 proportions, Vec2 usual) {
  if (asked.x > 0 && asked.y > 0) return asked;
  if (asked.x > 0) return {asked.x, asked.x * proportions.y / proportions.x};
  if (asked.y > 0) return {asked.y * proportions.x / proportions.y, asked.y};
  return usual;
}

/// The largest size of these proportions within a box.
Vec2 within(Vec2 box, Vec2 proportions) {
  const double scale = std::min(box.x / proportions.x, box.y / proportions.y);
  return proportions * scale;
}

/// The part of a picture inside its crop.
Image cropped(const Image& image, const Layer& layer) {
  const auto place = [](double share, int count) {
    return std::clamp(static_cast<int>(std::lround(share * count)), 0, count);
  };
  int left = place(layer.cropMin.x, image.width), right = place(layer.cropMax.x, image.width);
  int top = place(1 - layer.cropMax.y, image.height), bottom = place(1 - layer.cropMin.y, image.height);
  left = std::min(left, image.width - 1);
  right = std::max(right, left + 1);
  top = std::min(top, image.height - 1);
  bottom = std::max(bottom, top + 1);
  Image out{right - left, bottom - top, image.channels, {}};
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      for (int c = 0; c < image.channels; ++c) out.samples.push_back(image.at(x, y, c));
    }
  }
  return out;
}

/// A drawing on a page as large as its ink.
Shape onItsInk(Shape shape) {
  const Bounds ink = bounds(shape);
  for (FilledPath& path : shape.paths) {
    for (Ring& ring : path.rings) {
      for (Vec2& point : ring) point = point - ink.min;
    }
  }
  shape.page = ink.size();
  return shape;
}

std::optional<Error> readText(const Layer& layer, const ReadInput& read, LayerContent& content) {
  Result<Shape> shape = textShape({layer.text, layer.font, layer.textSize, layer.circle, layer.align}, read);
  if (!shape) return shape.error();
  content.shape = std::move(shape).value();
  const Vec2 drawn = content.shape->page;
  // Letters on a circle have the size of their circle; stretched letters would be another font.
  const bool sized = layer.circle == 0 && (layer.size.x > 0 || layer.size.y > 0);
  const Vec2 box{layer.size.x > 0 ? layer.size.x : 1e9, layer.size.y > 0 ? layer.size.y : 1e9};
  content.size = sized ? within(box, drawn) : drawn;
  return std::nullopt;
}

std::optional<Error> readQr(const Layer& layer, Vec2 page, const ReadInput& read, LayerContent& content) {
  const Result<Image> modules = qrModules(layer.text, layer.correction, read);
  if (!modules) return modules.error();
  const Image& code = modules.value();
  const int side = code.width + 2 * kQuietZone;
  content.modules = Image{side, side, 1, {}};
  content.modules->samples.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 65535);
  for (int y = 0; y < code.height; ++y) {
    for (int x = 0; x < code.width; ++x) {
      const auto at = static_cast<std::size_t>(y + kQuietZone) * static_cast<std::size_t>(side) +
                      static_cast<std::size_t>(x + kQuietZone);
      content.modules->samples[at] = code.at(x, y, 0);
    }
  }
  const double usual = kShareOfPage * std::min(page.x, page.y);
  content.size = sizeOf(layer.size, {1, 1}, {usual, usual});
  return std::nullopt;
}

std::optional<Error> readPictureOf(const Layer& layer, Vec2 page, const ReadInput& read, LayerContent& content) {
  const bool map = layer.kind == LayerKind::Map;
  const Result<Image> image = readPicture(read, layer.file, map ? "direction picture" : "picture");
  if (!image) return image.error();
  const Image part = cropped(image.value(), layer);
  if (map) {
    Result<DirectionMap> directions = directionMap(part, layer.encoding);
    if (!directions) return directions.error();
    content.map = std::move(directions).value();
  } else {
    content.tones = tonesOf(part);
  }
  const Vec2 proportions{static_cast<double>(part.width), static_cast<double>(part.height)};
  content.size = sizeOf(layer.size, proportions, within(page, proportions));
  return std::nullopt;
}

std::optional<Error> readDrawingOf(const Layer& layer, Vec2 page, const ReadInput& read, LayerContent& content) {
  Result<Shape> shape = readDrawing(read, layer.file, "drawing");
  if (!shape) return shape.error();
  content.shape = onItsInk(std::move(shape).value());
  const Vec2 drawn = content.shape->page, room = page * kMostOfPage;
  const bool fits = drawn.x <= room.x && drawn.y <= room.y;
  content.size = sizeOf(layer.size, drawn, fits ? drawn : within(room, drawn));
  return std::nullopt;
}

std::optional<Error> readKind(const Layer& layer, Vec2 page, const ReadInput& read, LayerContent& content) {
  content.size = sizeOf(layer.size, page, page);
  switch (layer.kind) {
    case LayerKind::Text:
      return readText(layer, read, content);
    case LayerKind::Qr:
      return readQr(layer, page, read, content);
    case LayerKind::Map:
    case LayerKind::Picture:
      return readPictureOf(layer, page, read, content);
    case LayerKind::Drawing:
      return readDrawingOf(layer, page, read, content);
    case LayerKind::Pattern:
      if (layer.pattern != LayerPattern::Echo) return std::nullopt;
      return layer.file.empty() ? readText(layer, read, content) : readDrawingOf(layer, page, read, content);
    case LayerKind::Direction:
    case LayerKind::Border:
      break;
  }
  return std::nullopt;
}

}  // namespace

Result<LayerContent> readContent(const Layer& layer, Vec2 page, const ReadInput& read) {
  LayerContent content;
  if (auto error = readKind(layer, page, read, content)) return *std::move(error);
  if (layer.mask == LayerMask::Inside || layer.mask == LayerMask::Outside) {
    Result<Shape> mask = readDrawing(read, layer.maskFile, "mask");
    if (!mask) return mask.error();
    content.mask = std::move(mask).value();
  }
  return content;
}

}  // namespace sillon
