#include "sillon/project/project.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geometry/parts.hpp"
#include "input/map_defect.hpp"
#include "input/plate_size.hpp"
#include "input/svg.hpp"
#include "project/files.hpp"
#include "sillon/base/words.hpp"
#include "sillon/geometry/outline.hpp"
#include "sillon/input/image_io.hpp"
#include "sillon/settings/table.hpp"
#include "sillon/text/text.hpp"
#include "text/letters.hpp"

namespace sillon {
namespace {

// By its content; what is no XML and no picture either may be meant for one by its name.
bool looksLikeSvg(std::string_view bytes, std::string_view name) {
  if (bytes.substr(0, 3) == "\xEF\xBB\xBF") bytes.remove_prefix(3);
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos && bytes[first] == '<') return true;
  const bool text = bytes.find('\0') == std::string_view::npos;
  return text && !bytes.starts_with('\x1f') && (name.ends_with(".svg") || name.ends_with(".SVG"));
}

Result<Image> picture(InputFile file, const std::string& name) {
  if (auto* decoded = std::get_if<Image>(&file)) {
    if (const std::string defect = imageDefect(*decoded); !defect.empty()) {
      return Error{ErrorCode::InvalidArgument, inQuotes(name) + " is a " + defect};
    }
    return std::move(*decoded);
  }
  const std::string& bytes = std::get<std::string>(file);
  return decodeImage(std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()), name);
}

/// Why a drawing could not be read: it may be empty since no font has its letters.
Error withoutLetters(const Error& error, const std::vector<LackedLetter>& lacked) {
  const auto lost = std::find_if(lacked.begin(), lacked.end(), [](const auto& one) { return one.font.empty(); });
  return error.code == ErrorCode::EmptyShape && lost != lacked.end() ? missingLetter("", *lost) : error;
}

struct DrawingOptions {
  SvgOptions svg;
  double maskWidth = kDefaultWidth;  // [mm]
};

Result<Shape> drawingFrom(const ReadInput& read, const std::string& name, const std::string& what,
                          const DrawingOptions& options) {
  Result<InputFile> file = read(name, what);
  if (!file) return file.error();
  const auto* text = std::get_if<std::string>(&file.value());
  if (text != nullptr && looksLikeSvg(*text, name)) {
    SvgOptions svg = options.svg;
    svg.letters.choose = fontOfDrawing;
    std::vector<LackedLetter> lacked;
    svg.letters.shape = [&](const DrawingFont& font, const std::string& line) {
      Result<ShapedLine> shaped = shapeLineOfDrawing(read, font, line);
      if (shaped) {
        for (const LackedLetter& letter : shaped.value().lacked) addLacked(lacked, letter);
      }
      return shaped;
    };
    Result<Shape> shape = readSvg(*text, svg);
    if (shape) shape.value().drawing.lacked = std::move(lacked);
    return shape ? std::move(shape) : withoutLetters(shape.error(), lacked);
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

// The stages know no files; whoever has many needs to know which one is meant.
Error named(const char* what, const std::string& file, const Error& error) {
  const bool known = file.empty() || error.message.find(file) != std::string::npos;
  Error out = error;
  if (!known) out.message = what + (" \"" + file + "\": ") + error.message;
  return out;
}

/// Letters as wide as the size, or as fit into it. They are drawn once for their proportions, and again at their size.
Result<Shape> textOf(const Project& project, const ReadInput& read, Vec2 size) {
  Lettering lettering{project.shapeText, project.shapeFont};
  const Result<Shape> first = textShape(lettering, read);
  if (!first) return first.error();
  const Vec2 drawn = first.value().page;
  lettering.capHeight *= size.y == 0 ? size.x / drawn.x : std::min(size.x / drawn.x, size.y / drawn.y);
  Result<Shape> shape = textShape(lettering, read);
  if (!shape || size.y == 0) return shape;
  // The page is as large as asked; letters of other proportions stand in its middle.
  const Vec2 free = (size - shape.value().page) * 0.5;
  for (FilledPath& path : shape.value().paths) {
    for (Ring& ring : path.rings) {
      for (Vec2& point : ring) point = point + free;
    }
  }
  shape.value().page = size;
  return shape;
}

/// \param lines  picture of the directions, if there is one: it lends its proportions where no height is given.
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
  return Error{ErrorCode::InvalidArgument,
               "there is no shape; give a shape file, a built-in shape (" + names + ") or a direction picture"};
}

}  // namespace

Result<Image> readPicture(const ReadInput& read, const std::string& name, const std::string& what) {
  Result<InputFile> file = read(name, what);
  if (!file) return file.error();
  return picture(std::move(file).value(), name);
}

Result<Shape> readDrawing(const ReadInput& read, const std::string& name, const std::string& what) {
  Result<Shape> shape = drawingFrom(read, name, what, {});
  return shape ? std::move(shape) : Result<Shape>(named(what.c_str(), name, shape.error()));
}

namespace {

/// \param lines  receives the picture of the directions, if there is one.
Result<PlateField> fieldOf(const Project& project, const ReadInput& read, std::optional<Image>& lines) {
  if (!project.directionFile.empty()) {
    Result<Image> decoded = readPicture(read, project.directionFile, "direction picture");
    if (!decoded) return decoded.error();
    lines = std::move(decoded).value();
  }
  auto directions = lines ? directionMap(*lines, project.encoding) : uniformDirection(project.angle);
  if (!directions) return named("direction picture", project.directionFile, directions.error());

  ModeMap modes = uniformMode(project.mode);
  if (!project.modeFile.empty()) {
    const Result<Image> decoded = readPicture(read, project.modeFile, "mode picture");
    if (!decoded) return decoded.error();
    Result<ModeMap> map = modeMap(decoded.value());
    if (!map) return named("mode picture", project.modeFile, map.error());
    modes = std::move(map).value();
  }
  return PlateField{std::move(directions).value(), std::move(modes)};
}

/// Takes as much memory as the plate.
Result<Shape> withThinPlaces(Shape shape, double spacing, const RunContext& run) {
  if (auto error = plateTooLarge(bounds(shape).size(), spacing, run.memory())) return *error;
  return keepThinPlaces(std::move(shape), spacing, run);
}

/// Does to any shape what the project asks for. Holes come last, so that nothing else changes them.
Result<Shape> finished(Result<Shape> shape, const Project& project, const RunContext& run) {
  if (shape && project.outlineOffset != 0) shape = offsetShape(std::move(shape).value(), project.outlineOffset, run);
  if (shape && project.keepThin) shape = withThinPlaces(std::move(shape).value(), project.toolpath.spacing, run);
  if (shape && !project.holes.empty()) shape = withHoles(std::move(shape).value(), project.holes);
  return shape;
}

}  // namespace

Result<PlateField> readPlateField(const Project& project, const ReadInput& read) {
  std::optional<Image> lines;
  return fieldOf(project, read, lines);
}

Result<PlateInput> readPlateInput(const Project& project, const ReadInput& read, const RunContext& run) {
  std::optional<Image> lines;
  Result<PlateField> field = fieldOf(project, read, lines);
  if (!field) return field.error();
  // Its directions are solved for later; here it lends its proportions.
  const bool proportions = project.shapeFile.empty() && !lines && !project.pictures.files.empty();
  if (proportions && (project.builtin == BuiltinShape::None || project.builtinSize.y == 0)) {
    Result<Image> decoded = readPicture(read, project.pictures.files[0].file, "picture");
    if (!decoded) return decoded.error();
    lines = std::move(decoded).value();
  }
  Result<Shape> shape = project.shapeFile.empty() ? builtinShape(project, read, lines) : shapeFromFile(project, read);
  shape = finished(std::move(shape), project, run);
  if (!shape) return named("shape", project.shapeFile, shape.error());
  return PlateInput{std::move(shape).value(), std::move(field.value().directions), std::move(field.value().modes)};
}

}  // namespace sillon
