#include "sillon/project/project.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/refused.hpp"
#include "geometry/parts.hpp"
#include "geometry/shape_points.hpp"
#include "input/gzip.hpp"
#include "input/map_defect.hpp"
#include "input/plate_size.hpp"
#include "input/shaped_line.hpp"
#include "input/svg.hpp"
#include "project/files.hpp"
#include "sillon/base/words.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/input/image_io.hpp"
#include "sillon/settings/table.hpp"
#include "sillon/text/text.hpp"
#include "text/letters.hpp"

namespace sillon {
namespace {

constexpr int kPaintedSide = 1024;  // longer side of a drawing in its colours [pixels]

// Tells whether a file is an SVG: by its content if it is XML or packed by gzip, as no picture is; otherwise by its
// name, if it is text.
bool looksLikeSvg(std::string_view bytes, std::string_view name) {
  if (bytes.substr(0, 3) == "\xEF\xBB\xBF") bytes.remove_prefix(3);
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  if (isGzip(bytes) || (first != std::string_view::npos && bytes[first] == '<')) return true;
  const bool text = bytes.find('\0') == std::string_view::npos;
  return text && (name.ends_with(".svg") || name.ends_with(".SVG"));
}

// Decodes a picture, or checks one that is decoded already.
Result<Image> picture(InputFile file, const std::string& name) {
  if (auto* decoded = std::get_if<Image>(&file)) {
    if (std::optional<Error> defect = imageDefect(*decoded, inQuotes(name))) return *std::move(defect);
    return std::move(*decoded);
  }
  const std::string& bytes = std::get<std::string>(file);
  return decodeImage(std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()), name);
}

/// Error of a drawing that could not be read. If it is empty because no font has its letters, the error says so.
Error withoutLetters(const Error& error, const std::vector<LackedLetter>& lacked) {
  const auto lost = std::find_if(lacked.begin(), lacked.end(), [](const auto& one) { return one.font.empty(); });
  return error.code == ErrorCode::EmptyShape && lost != lacked.end() ? missingLetter("", *lost) : error;
}

/// Reads an SVG and draws its text; letters that fonts lack are listed in its facts.
Result<SvgPainting> paintingFrom(const ReadInput& read, std::string_view text, SvgOptions svg) {
  svg.letters.choose = fontOfDrawing;
  std::vector<LackedLetter> lacked;
  svg.letters.shape = [&](const DrawingFont& font, const std::string& line) {
    Result<ShapedLine> shaped = shapeLineOfDrawing(read, font, line);
    if (shaped) {
      for (const LackedLetter& letter : shaped.value().lacked) addLacked(lacked, letter);
    }
    return shaped;
  };
  Result<SvgPainting> painting = readSvgPainting(text, svg);
  if (!painting) return withoutLetters(painting.error(), lacked);
  painting.value().shape.drawing.lacked = std::move(lacked);
  return painting;
}

struct DrawingOptions {
  SvgOptions svg;
  double maskWidth = kDefaultWidth;  // width of a mask picture [mm]
};

/// Reads a drawing, or the shape of a mask picture.
Result<Shape> drawingFrom(const ReadInput& read, const std::string& name, const std::string& what,
                          const DrawingOptions& options) {
  Result<InputFile> file = read(name, what);
  if (!file) return file.error();
  const auto* text = std::get_if<std::string>(&file.value());
  if (text != nullptr && looksLikeSvg(*text, name)) {
    Result<SvgPainting> painting = paintingFrom(read, *text, options.svg);
    if (!painting) return painting.error();
    return std::move(painting).value().shape;
  }
  const Result<Image> mask = picture(std::move(file).value(), name);
  if (!mask) return mask.error();
  return shapeFromMask(mask.value(), options.maskWidth);
}

Result<Shape> shapeFromFile(const Project& project, const ReadInput& read) {
  DrawingOptions options;
  options.svg.unitlessIsMm = project.unitlessIsMm;
  options.svg.ignorePaint = project.ignorePaint;
  options.svg.width = project.pageWidth;
  if (project.pageWidth != 0) options.maskWidth = project.pageWidth;
  return drawingFrom(read, project.shapeFile, "shape", options);
}

// Names the file in an error. The stages know no files, but a user with many must learn which one is meant.
Error named(const char* what, const std::string& file, const Error& error) {
  const bool known = file.empty() || error.message.find(file) != std::string::npos;
  Error out = error;
  if (!known) out.message = what + (" \"" + file + "\": ") + error.message;
  return out;
}

/// Draws letters as wide as the size, or as large as fits into it: once for their proportions, then at their size.
Result<Shape> textOf(const Project& project, const ReadInput& read, Vec2 size) {
  Lettering lettering{project.shapeText, project.shapeFont};
  lettering.weight = project.shapeWeight;
  const Result<Shape> first = textShape(lettering, read);
  if (!first) return first.error();
  const Vec2 drawn = first.value().page;
  lettering.capHeight *= size.y == 0 ? size.x / drawn.x : std::min(size.x / drawn.x, size.y / drawn.y);
  Result<Shape> shape = textShape(lettering, read);
  if (!shape || size.y == 0) return shape;
  // The page has the size asked for; letters of other proportions stand in its middle.
  const Vec2 free = (size - shape.value().page) * 0.5;
  movePoints(shape.value(), [free](Vec2 point) { return point + free; });
  shape.value().page = size;
  return shape;
}

/// \param lines  picture of the directions, if there is one; the shape takes its proportions if no height is given.
Result<Shape> builtinShape(const Project& project, const ReadInput& read, const std::optional<Image>& lines) {
  Vec2 size = project.builtinSize;
  if (size.x == 0) size.x = kDefaultWidth;
  if (size.y == 0 && lines) size.y = size.x * lines->height / lines->width;
  const Vec2 square{size.x, size.y == 0 ? size.x : size.y};
  const Corners corners{project.builtinRadius, project.corners == CornerStyle::Chamfer};
  switch (project.builtin) {
    case BuiltinShape::Disc:
      return makeDisc(size.x);
    case BuiltinShape::Ring:
      return makeRing(size.x, project.builtinInner);
    case BuiltinShape::RoundedRectangle:
      return makeRoundedRectangle(square, corners.radius, corners.chamfered);
    case BuiltinShape::Rectangle:
      return makeRectangle(square);
    case BuiltinShape::Hexagon:
      return makeHexagon(size, corners);
    case BuiltinShape::Star:
      return makeStar(project.starPoints, size, corners);
    case BuiltinShape::Heart:
      return makeHeart(size);
    case BuiltinShape::Shield:
      return makeShield(size, corners);
    case BuiltinShape::Tag:
      return makeTag(size, project.builtinInner, corners);
    case BuiltinShape::Text:
      return textOf(project, read, size);
    case BuiltinShape::None:
      break;
  }
  if (lines) return makeRectangle(square);
  std::string names;
  for (const std::string& name : splitWords(findSetting(Section::Shape, "builtin")->choices)) {
    if (name != "none") names += (names.empty() ? "" : ", ") + name;
  }
  return refusedArgument("NoShape", {{"names", names}});
}

// Tells whether a picture has an alpha channel and at least a hundredth of it is transparent.
bool isCutOut(const Image& image) {
  if (image.channels % 2 != 0) return false;
  std::size_t clear = 0;
  const std::size_t step = image.channels;
  for (std::size_t k = step - 1; k < image.samples.size(); k += step) clear += image.samples[k] < 0x8000 ? 1 : 0;
  return 100 * clear >= image.samples.size() / step;
}

/// Directions and modes of the lowest layer.
struct LowestField {
  DirectionMap directions;
  ModeMap modes;
};

/// \param lines  receives the direction picture of the lowest layer, if it has one.
Result<LowestField> fieldOf(const Project& project, const ReadInput& read, std::optional<Image>& lines) {
  const Layer* const ground = groundOf(project.layers);
  if (ground == nullptr) return LowestField{uniformDirection(0).value(), uniformMode(DirectionMode::Constrained)};
  auto directions = uniformDirection(ground->kind() == LayerKind::Direction ? ground->as<LayerAngle>()->angle : 0);
  if (const MapLayer* const map = ground->as<MapLayer>()) {
    Result<Image> decoded = readPicture(read, map->file, "direction picture");
    if (!decoded) return decoded.error();
    lines = cropped(std::move(decoded).value(), *map);
    directions = directionMap(*lines, map->encoding);
    if (!directions) return named("direction picture", map->file, directions.error());
  }
  Result<ModeMap> modes = readModes(*ground, read);
  if (!modes) return modes.error();
  return LowestField{std::move(directions).value(), std::move(modes).value()};
}

/// Keeps thin places of a shape. This takes as much memory as the plate, so its size is checked first.
Result<Shape> withThinPlaces(Shape shape, double spacing, const RunContext& run) {
  if (auto error = plateTooLarge(bounds(shape).size(), spacing, run.memory())) return *error;
  return keepThinPlaces(std::move(shape), spacing, run);
}

/// Applies the offset, thin places and holes of a project to a shape. Holes come last, so that nothing else changes
/// them.
Result<Shape> finished(Result<Shape> shape, const Project& project, const RunContext& run) {
  if (shape && project.outlineOffset != 0) shape = offsetShape(std::move(shape).value(), project.outlineOffset, run);
  if (shape && project.keepThin) shape = withThinPlaces(std::move(shape).value(), project.toolpath.spacing, run);
  if (shape && !project.holes.empty()) shape = withHoles(std::move(shape).value(), project.holes);
  return shape;
}

}  // namespace

Result<Image> readPicture(const ReadInput& read, const std::string& name, const std::string& what) {
  Result<InputFile> file = read(name, what);
  if (!file) return file.error();
  return picture(std::move(file).value(), name);
}

Image cropped(Image image, const LayerCrop& crop) {
  if (crop == LayerCrop()) return image;
  const auto place = [](double share, int count) {
    return std::clamp(static_cast<int>(std::lround(share * count)), 0, count);
  };
  int left = place(crop.cropMin.x, image.width), right = place(crop.cropMax.x, image.width);
  int top = place(1 - crop.cropMax.y, image.height), bottom = place(1 - crop.cropMin.y, image.height);
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

Result<ModeMap> readModes(const Layer& layer, const ReadInput& read) {
  if (layer.modeFile.empty()) return uniformMode(layer.mode);
  const Result<Image> decoded = readPicture(read, layer.modeFile, "mode picture");
  if (!decoded) return decoded.error();
  const LayerCrop* const crop = layer.as<LayerCrop>();
  Result<ModeMap> map = modeMap(crop == nullptr ? decoded.value() : cropped(decoded.value(), *crop));
  return map ? std::move(map) : Result<ModeMap>(named("mode picture", layer.modeFile, map.error()));
}

Result<Shape> readDrawing(const ReadInput& read, const std::string& name, const std::string& what) {
  Result<Shape> shape = drawingFrom(read, name, what, {});
  return shape ? std::move(shape) : Result<Shape>(named(what.c_str(), name, shape.error()));
}

Result<PaintedFile> readPainted(const ReadInput& read, const std::string& name, const std::string& what) {
  Result<InputFile> file = read(name, what);
  if (!file) return file.error();
  const auto* text = std::get_if<std::string>(&file.value());
  if (text == nullptr || !looksLikeSvg(*text, name)) {
    Result<Image> decoded = picture(std::move(file).value(), name);
    if (!decoded) return decoded.error();
    return PaintedFile{std::move(decoded).value(), {}};
  }
  Result<SvgPainting> painting = paintingFrom(read, *text, {});
  if (!painting) return named(what.c_str(), name, painting.error());
  return PaintedFile{paintedPicture(painting.value(), kPaintedSide), std::move(painting.value().shape.drawing)};
}

Result<PlateInput> readPlateInput(const Project& project, Shape shape, const ReadInput& read) {
  std::optional<Image> lines;
  Result<LowestField> field = fieldOf(project, read, lines);
  if (!field) return field.error();
  return PlateInput{std::move(shape), std::move(field.value().directions), std::move(field.value().modes)};
}

Result<PlateInput> readPlateInput(const Project& project, const ReadInput& read, const RunContext& run) {
  std::optional<Image> lines;
  Result<LowestField> field = fieldOf(project, read, lines);
  if (!field) return field.error();
  // Pictures are solved later; here only the proportions of the first one matter.
  const Layer* const ground = groundOf(project.layers);
  const PictureLayer* const lit = ground == nullptr ? nullptr : ground->as<PictureLayer>();
  const bool open = project.builtin == BuiltinShape::None || project.builtinSize.y == 0;
  bool cutOut = false;
  if (lit != nullptr && open && project.shapeFile.empty()) {
    Result<Image> decoded = readPicture(read, lit->pictures.at(0).file, "picture");
    if (!decoded) return decoded.error();
    lines = cropped(std::move(decoded).value(), *lit);
    cutOut = isCutOut(*lines);
  }
  Result<Shape> shape = project.shapeFile.empty() ? builtinShape(project, read, lines) : shapeFromFile(project, read);
  shape = finished(std::move(shape), project, run);
  if (!shape) return named("shape", project.shapeFile, shape.error());
  shape.value().drawing.cutOut = cutOut;
  return PlateInput{std::move(shape).value(), std::move(field.value().directions), std::move(field.value().modes)};
}

}  // namespace sillon
