#include "assemble.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "files.hpp"
#include "sillon/image_io.hpp"
#include "sillon/svg.hpp"

namespace cli {
namespace {

namespace fs = std::filesystem;
using sillon::BuiltinShape;
using sillon::Error;
using sillon::ErrorCode;
using sillon::Image;
using sillon::Project;
using sillon::Result;
using sillon::Shape;
using sillon::Vec2;

/// SVG by its first letter, whatever the file is called; a file called .svg must be one.
bool looksLikeSvg(std::string_view bytes, const std::string& path) {
  if (bytes.substr(0, 3) == "\xEF\xBB\xBF") bytes.remove_prefix(3);
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  const std::string extension = fs::path(path).extension().string();
  return (first != std::string_view::npos && bytes[first] == '<') || extension == ".svg" || extension == ".SVG";
}

Result<Image> decodePicture(const std::string& bytes, const std::string& path) {
  return sillon::decodeImage(std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()), path);
}

Result<Image> readPicture(const std::string& path, const std::string& what) {
  const Result<std::string> bytes = readFile(path, what, kMaxInputBytes);
  if (!bytes) return bytes.error();
  return decodePicture(bytes.value(), path);
}

Result<Shape> shapeFromFile(const Project& project) {
  const Result<std::string> bytes = readFile(project.shapeFile, "shape", kMaxInputBytes);
  if (!bytes) return bytes.error();
  if (looksLikeSvg(bytes.value(), project.shapeFile)) {
    sillon::SvgOptions options;
    options.unitlessIsMm = project.unitlessIsMm;
    Result<Shape> shape = sillon::readSvg(bytes.value(), options);
    if (!shape) return Error{shape.error().code, "shape \"" + project.shapeFile + "\": " + shape.error().message};
    if (project.pageWidth == 0) return shape;
    return sillon::scaledToWidth(shape.value(), project.pageWidth);
  }
  const Result<Image> mask = decodePicture(bytes.value(), project.shapeFile);
  if (!mask) return mask.error();
  return sillon::shapeFromMask(mask.value(), project.pageWidth == 0 ? sillon::kDefaultWidth : project.pageWidth);
}

/// \param picture  of the directions, if there is one: it lends its proportions where no height is given.
Result<Shape> builtinShape(const Project& project, const std::optional<Image>& picture) {
  Vec2 size = project.builtinSize;
  if (size.x == 0) size.x = sillon::kDefaultWidth;
  if (size.y == 0) size.y = picture ? size.x * picture->height / picture->width : size.x;
  switch (project.builtin) {
    case BuiltinShape::Disc:
      return sillon::makeDisc(size.x);
    case BuiltinShape::RoundedRectangle:
      return sillon::makeRoundedRectangle(size, project.builtinRadius);
    case BuiltinShape::Rectangle:
      return sillon::makeRectangle(size);
    case BuiltinShape::None:
      break;
  }
  if (picture) return sillon::makeRectangle(size);
  return Error{ErrorCode::InvalidArgument,
               "there is no shape; give a scene file, --shape F|rect|rounded|disc or --lines F"};
}

/// A name in the scene, seen from the working directory.
std::string fromFolder(const fs::path& folder, const std::string& name) {
  return name.empty() ? name : (folder / name).string();
}

/// A name on the command line, seen from a folder.
std::string seenFrom(const fs::path& folder, const std::string& name) {
  if (name.empty()) return name;
  std::error_code error;
  const fs::path relative = fs::proximate(name, folder, error);
  return error ? name : relative.generic_string();
}

}  // namespace

Result<Project> loadProject(const std::string& path) {
  const Result<std::string> text = readFile(path, "scene", kMaxProjectBytes);
  if (!text) return text.error();
  Result<Project> project = sillon::readProject(text.value());
  if (!project) return Error{project.error().code, "scene \"" + path + "\": " + project.error().message};
  const fs::path folder = fs::path(path).parent_path();
  Project& read = project.value();
  read.shapeFile = fromFolder(folder, read.shapeFile);
  read.directionFile = fromFolder(folder, read.directionFile);
  read.modeFile = fromFolder(folder, read.modeFile);
  return project;
}

Result<sillon::PlateInput> assemblePlate(const Project& project) {
  std::optional<Image> picture;
  if (!project.directionFile.empty()) {
    Result<Image> decoded = readPicture(project.directionFile, "direction picture");
    if (!decoded) return decoded.error();
    picture = std::move(decoded).value();
  }
  auto directions =
      picture ? sillon::directionMap(*picture, project.encoding) : sillon::uniformDirection(project.angle);
  if (!directions) return directions.error();

  sillon::ModeMap modes = sillon::uniformMode(project.mode);
  if (!project.modeFile.empty()) {
    const Result<Image> decoded = readPicture(project.modeFile, "mode picture");
    if (!decoded) return decoded.error();
    Result<sillon::ModeMap> map = sillon::modeMap(decoded.value());
    if (!map) return map.error();
    modes = std::move(map).value();
  }

  Result<Shape> shape = project.shapeFile.empty() ? builtinShape(project, picture) : shapeFromFile(project);
  if (!shape) return shape.error();
  return sillon::PlateInput{std::move(shape).value(), std::move(directions).value(), std::move(modes)};
}

std::vector<std::string> inputFiles(const Project& project) {
  std::vector<std::string> files;
  for (const std::string* name : {&project.shapeFile, &project.directionFile, &project.modeFile}) {
    if (!name->empty()) files.push_back(*name);
  }
  return files;
}

std::string projectFor(const Project& project, const std::string& path) {
  std::error_code error;
  const fs::path folder = fs::absolute(path, error).parent_path();
  Project written = project;
  written.shapeFile = seenFrom(folder, project.shapeFile);
  written.directionFile = seenFrom(folder, project.directionFile);
  written.modeFile = seenFrom(folder, project.modeFile);
  return sillon::writeProject(written);
}

}  // namespace cli
