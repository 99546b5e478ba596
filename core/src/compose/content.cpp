#include "compose/content.hpp"

#include <algorithm>
#include <utility>

#include "geometry/shape_points.hpp"
#include "look/rasters.hpp"
#include "project/files.hpp"
#include "sillon/text/text.hpp"
#include "text/qr_code.hpp"

namespace sillon {
namespace {

constexpr double kShareOfPage = 0.6;  // share of the page's shorter side for QR codes without a size
constexpr double kMostOfPage = 0.9;   // share of the page that larger drawings are fitted into

/// Returns the size of a content with these proportions.
/// \param asked  size from the project; 0 in a coordinate leaves it open
/// \param usual  size if both are open [mm]
Vec2 sizeOf(Vec2 asked, Vec2 proportions, Vec2 usual) {
  if (asked.x > 0 && asked.y > 0) return asked;
  if (asked.x > 0) return {asked.x, asked.x * proportions.y / proportions.x};
  if (asked.y > 0) return {asked.y * proportions.x / proportions.y, asked.y};
  return usual;
}

/// Returns the largest size of these proportions within a box.
Vec2 within(Vec2 box, Vec2 proportions) {
  const double scale = std::min(box.x / proportions.x, box.y / proportions.y);
  return proportions * scale;
}

/// Crops a drawing's page to its ink.
Shape onItsInk(Shape shape) {
  const Bounds ink = bounds(shape);
  movePoints(shape, [&](Vec2 point) { return point - ink.min; });
  shape.page = ink.size();
  return shape;
}

/// Reads the letters of a layer and sets their size.
std::optional<Error> readText(const Layer& layer, const ReadInput& read, LayerContent& content) {
  const LayerLetters& letters = *layer.as<LayerLetters>();
  Result<Shape> shape = textShape(
      {layer.as<LayerWords>()->text, letters.font, letters.textSize, letters.circle, letters.align, letters.weight},
      read);
  if (!shape) return shape.error();
  content.shape = std::move(shape).value();
  const Vec2 drawn = content.shape->page;
  // Letters on a circle have the size of their circle. Letters are not stretched, because that would change their font.
  const bool sized = letters.circle == 0 && (layer.size.x > 0 || layer.size.y > 0);
  const Vec2 box{layer.size.x > 0 ? layer.size.x : 1e9, layer.size.y > 0 ? layer.size.y : 1e9};
  content.size = sized ? within(box, drawn) : drawn;
  return std::nullopt;
}

/// Makes a QR code with its quiet zone.
std::optional<Error> readCode(const Layer& layer, Vec2 page, const ReadInput& read, LayerContent& content) {
  const Result<Image> modules = qrModules(layer.as<LayerWords>()->text, layer.as<CodeLayer>()->correction, read);
  if (!modules) return modules.error();
  const Image& code = modules.value();
  const int side = code.width + 2 * kQuietZone;
  content.modules = Image{side, side, 1, {}};
  content.modules->samples.assign(cellCount(side, side), 65535);
  for (int y = 0; y < code.height; ++y) {
    for (int x = 0; x < code.width; ++x) {
      const auto at = indexOf(x + kQuietZone, y + kQuietZone, side);
      content.modules->samples[at] = code.at(x, y, 0);
    }
  }
  const double usual = kShareOfPage * std::min(page.x, page.y);
  content.size = sizeOf(layer.size, {1, 1}, {usual, usual});
  return std::nullopt;
}

/// Returns the size of a picture's box.
/// \param fills  if true, a picture without a size fills the page; otherwise it gets the largest box of its proportions
/// on it.
Vec2 boxOf(const Layer& layer, const Image& image, Vec2 page, bool fills) {
  const Vec2 proportions{static_cast<double>(image.width), static_cast<double>(image.height)};
  return sizeOf(layer.size, proportions, fills ? page : within(page, proportions));
}

/// Reads a picture of directions.
std::optional<Error> readMap(const Layer& layer, Vec2 page, bool lowest, const ReadInput& read, LayerContent& content) {
  const MapLayer& map = *layer.as<MapLayer>();
  Result<Image> image = readPicture(read, map.file, "direction picture");
  if (!image) return image.error();
  const Image part = cropped(std::move(image).value(), map);
  Result<DirectionMap> directions = directionMap(part, map.encoding);
  if (!directions) return directions.error();
  content.map = std::move(directions).value();
  content.size = boxOf(layer, part, page, lowest);
  return std::nullopt;
}

/// Reads the pictures of a layer as tones; the first one gives the size.
std::optional<Error> readPictures(const Layer& layer, Vec2 page, bool lowest, const ReadInput& read,
                                  LayerContent& content) {
  const PictureLayer& pictures = *layer.as<PictureLayer>();
  for (const LampPicture& one : pictures.pictures) {
    Result<Image> image = readPicture(read, one.file, "picture");
    if (!image) return image.error();
    const Image part = cropped(std::move(image).value(), pictures);
    if (content.tones.empty()) content.size = boxOf(layer, part, page, lowest);
    content.tones.push_back(tonesOf(part));
  }
  return std::nullopt;
}

/// Reads a picture whose tones give directions.
std::optional<Error> readTones(const Layer& layer, Vec2 page, bool lowest, const ReadInput& read,
                               LayerContent& content) {
  const TonesLayer& tones = *layer.as<TonesLayer>();
  Result<PaintedFile> painted = readPainted(read, tones.file, "picture");
  if (!painted) return painted.error();
  content.picture = cropped(std::move(painted.value().picture), tones);
  content.painted = std::move(painted.value().drawing);
  content.size = boxOf(layer, *content.picture, page, lowest);
  content.fills = lowest && layer.size == Vec2{};
  return std::nullopt;
}

/// Reads a drawing, cropped to its ink; one that is larger than the page is made smaller.
std::optional<Error> readDrawingOf(const Layer& layer, Vec2 page, const ReadInput& read, LayerContent& content) {
  Result<Shape> shape = readDrawing(read, layer.as<LayerFile>()->file, "drawing");
  if (!shape) return shape.error();
  content.shape = onItsInk(std::move(shape).value());
  const Vec2 drawn = content.shape->page, room = page * kMostOfPage;
  const bool fits = drawn.x <= room.x && drawn.y <= room.y;
  content.size = sizeOf(layer.size, drawn, fits ? drawn : within(room, drawn));
  return std::nullopt;
}

/// Reads the content of a layer by its kind.
std::optional<Error> readKind(const Layer& layer, Vec2 page, bool lowest, const ReadInput& read,
                              LayerContent& content) {
  content.size = sizeOf(layer.size, page, page);
  switch (layer.kind()) {
    case LayerKind::Text:
      return readText(layer, read, content);
    case LayerKind::Code:
      return readCode(layer, page, read, content);
    case LayerKind::Map:
      return readMap(layer, page, lowest, read, content);
    case LayerKind::Picture:
      return readPictures(layer, page, lowest, read, content);
    case LayerKind::Tones:
      return readTones(layer, page, lowest, read, content);
    case LayerKind::Drawing:
      return readDrawingOf(layer, page, read, content);
    case LayerKind::Pattern:
      if (layer.as<PatternLayer>()->pattern != LayerPattern::Echo) return std::nullopt;
      return layer.as<LayerFile>()->file.empty() ? readText(layer, read, content)
                                                 : readDrawingOf(layer, page, read, content);
    case LayerKind::Direction:
    case LayerKind::Border:
    case LayerKind::Strokes:
      break;
  }
  return std::nullopt;
}

}  // namespace

Result<LayerContent> readContent(const Layer& layer, Vec2 page, bool lowest, const ReadInput& read) {
  LayerContent content;
  if (auto error = readKind(layer, page, lowest, read, content)) return *std::move(error);
  Result<ModeMap> modes = readModes(layer, read);
  if (!modes) return modes.error();
  content.modes = std::move(modes).value();
  if (layer.mask == LayerMask::Inside || layer.mask == LayerMask::Outside) {
    Result<Shape> mask = readDrawing(read, layer.maskFile, "mask");
    if (!mask) return mask.error();
    content.mask = std::move(mask).value();
  }
  return content;
}

}  // namespace sillon
