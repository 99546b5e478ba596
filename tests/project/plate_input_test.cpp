// From a project and its files to shape, directions and modes.
#include "sillon/project/project.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/parts.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/input/image_io.hpp"
#include "sillon/report/warning.hpp"

using namespace sillon;

namespace {

Image grey(int width, int height, std::uint16_t value) {
  return {width, height, 1, std::vector<std::uint16_t>(static_cast<std::size_t>(width * height), value)};
}

/// The lowest layer as a map; it is made one.
MapLayer& mapOf(Project& project) {
  if (project.layers.empty()) project.layers.emplace_back().contents = MapLayer();
  return *project.layers[0].as<MapLayer>();
}

/// Files by name; `asked` keeps what was asked for.
struct Files {
  std::map<std::string, InputFile> byName;
  std::vector<std::string> asked;

  ReadInput reader() {
    return [this](const std::string& name, const std::string& what) -> Result<InputFile> {
      asked.push_back(what + " " + name);
      const auto found = byName.find(name);
      if (found == byName.end()) return Error{ErrorCode::InvalidFile, "no " + name};
      return found->second;
    };
  }
};

}  // namespace

TEST_CASE("a shape file is an SVG by how it begins, and by its name") {
  const std::string svg = "\xEF\xBB\xBF \n<svg width='10mm' height='20mm'><rect width='10mm' height='20mm'/></svg>";
  Files files;
  files.byName = {{"picture.png", svg}, {"broken.svg", std::string("no tag")}, {"mask.png", grey(4, 2, 65535)}};
  Project project;
  project.shapeFile = "picture.png";
  const auto drawn = readPlateInput(project, files.reader());
  REQUIRE(drawn.ok());
  CHECK(drawn.value().shape.page.x == doctest::Approx(10));
  CHECK(drawn.value().shape.page.y == doctest::Approx(20));
  CHECK(files.asked == std::vector<std::string>{"shape picture.png"});

  project.pageWidth = 30;
  CHECK(readPlateInput(project, files.reader()).value().shape.page == Vec2{30, 60});
  // Outlines are made at that width: a disc of 1 px, printed at 100 mm, has more than the 8 corners it has at its own.
  files.byName["picture.png"] = std::string("<svg viewBox='0 0 1 1'><circle cx='.5' cy='.5' r='.5'/></svg>");
  project.pageWidth = 100;
  CHECK(readPlateInput(project, files.reader()).value().shape.paths.at(0).rings.at(0).size() > 100);

  const std::vector<std::uint8_t> png = encodePng(1, 1, std::vector<std::uint8_t>{255, 255, 255});
  files.byName["mask.svg"] = std::string(png.begin(), png.end());
  project.shapeFile = "mask.svg";
  CHECK(readPlateInput(project, files.reader()).value().shape.page == Vec2{100, 100});

  project.shapeFile = "broken.svg";
  const auto broken = readPlateInput(project, files.reader());
  REQUIRE(!broken.ok());
  CHECK(broken.error().code == ErrorCode::InvalidFile);
  CHECK(broken.error().message.find("shape \"broken.svg\": ") == 0);

  project.shapeFile = "mask.png";
  project.pageWidth = 0;
  CHECK(readPlateInput(project, files.reader()).value().shape.page == Vec2{kDefaultWidth, kDefaultWidth / 2});
}

TEST_CASE("thin places are widened where the project says so, if the memory holds it") {
  Files files;
  files.byName = {
      {"bar.svg", std::string("<svg width='20mm' height='9mm' viewBox='0 0 20 9'>"
                              "<rect width='9' height='9'/><rect x='12' y='3' width='7' height='.3'/></svg>")}};
  Project project;
  project.shapeFile = "bar.svg";
  const Shape drawn = readPlateInput(project, files.reader()).value().shape;
  project.keepThin = true;
  RunContext run;
  const auto widened = readPlateInput(project, files.reader(), run);
  REQUIRE(widened.ok());
  CHECK(widened.value().shape == keepThinPlaces(drawn, project.toolpath.spacing, run).value());
  CHECK(widened.value().shape.kept.size() == 1);
  run.limitMemory(1000);
  CHECK(readPlateInput(project, files.reader(), run).error().code == ErrorCode::OutOfMemory);
  project.keepThin = false;
  CHECK(readPlateInput(project, files.reader(), run).value().shape == drawn);
}

TEST_CASE("a direction picture lends its proportions to a plate without shape") {
  Files files;
  files.byName = {{"lines", grey(3, 6, 65535)}};
  Project project;
  mapOf(project).file = "lines";
  const auto input = readPlateInput(project, files.reader());
  REQUIRE(input.ok());
  CHECK(input.value().shape.page == Vec2{80, 160});
  CHECK(input.value().directions.angle == std::vector<std::uint16_t>(18, 65535));
  project.builtinSize = {30, 0};
  CHECK(readPlateInput(project, files.reader()).value().shape.page == Vec2{30, 60});
  project.builtin = BuiltinShape::Disc;
  CHECK(readPlateInput(project, files.reader()).value().shape.page == Vec2{30, 30});
}

TEST_CASE("all built-in shapes are made, in heights of their own or the direction picture's") {
  Files files;
  files.byName = {{"lines", grey(4, 3, 65535)}};
  const auto pageOf = [&](BuiltinShape builtin, const std::string& lines) {
    Project project;
    project.builtin = builtin;
    project.builtinSize = {40, 0};
    if (!lines.empty()) mapOf(project).file = lines;
    const auto input = readPlateInput(project, files.reader());
    REQUIRE_MESSAGE(input.ok(), input.error().message);
    return input.value().shape.page;
  };
  CHECK(pageOf(BuiltinShape::Hexagon, "").y == doctest::Approx(20 * std::sqrt(3.0)));
  CHECK(pageOf(BuiltinShape::Tag, "").y == 16);
  CHECK(pageOf(BuiltinShape::RoundedRectangle, "").y == 40);
  CHECK(pageOf(BuiltinShape::Ring, "lines").y == 40);
  for (const BuiltinShape builtin :
       {BuiltinShape::Hexagon, BuiltinShape::Heart, BuiltinShape::Shield, BuiltinShape::Star, BuiltinShape::Tag}) {
    CHECK(pageOf(builtin, "lines").y == 30);
  }
}

TEST_CASE("a plate without shape has the proportions of the part that is used of the lowest picture") {
  Files files;
  files.byName = {{"wide", Image{8, 2, 1, std::vector<std::uint16_t>(16, 40000)}}};
  Project project;
  mapOf(project).file = "wide";
  mapOf(project).cropMin = {0.5, 0};
  CHECK(readPlateInput(project, files.reader()).value().shape.page == Vec2{80, 40});
  CHECK(readPlateInput(project, files.reader()).value().directions.width == 4);
  PictureLayer lit;
  lit.pictures = {{"wide", std::nullopt}};
  project.layers[0].contents = lit;
  CHECK(readPlateInput(project, files.reader()).value().shape.page == Vec2{80, 20});
  // One that lies somewhere, or that is hidden, is no ground.
  project.layers[0].size = {10, 10};
  CHECK(readPlateInput(project, files.reader()).error().message.find("there is no shape") == 0);
}

TEST_CASE("a picture with a transparent ground is told where it lends a plate its proportions") {
  const auto noted = [](std::uint16_t clear, const std::string& shape = "") {
    std::vector<std::uint16_t> samples(200, 65535);  // grey and alpha
    samples[1] = clear;
    Files files;
    files.byName = {{"badge", Image{10, 10, 2, samples}}};
    Project project;
    project.shapeFile = shape;
    PictureLayer lit;
    lit.pictures = {{"badge", std::nullopt}};
    project.layers.emplace_back().contents = lit;
    const auto read = readPlateInput(project, files.reader());
    REQUIRE_MESSAGE(read.ok(), read.error().message);
    const std::vector<InputNote> notes = inputNotes(project, read.value().shape.drawing);
    return std::any_of(notes.begin(), notes.end(), [](const InputNote& note) { return note.code == "CutOut"; });
  };
  CHECK(noted(0));
  CHECK_FALSE(noted(40000));
  CHECK_FALSE(noted(0, "badge"));
}

TEST_CASE("another surface has the directions of the lowest layer, and no picture lends it anything") {
  Files files;
  files.byName = {{"lines", Image{2, 1, 1, {0, 65535}}}, {"modes", Image{2, 1, 1, {0, 21845}}}};
  Project project;
  mapOf(project).file = "lines";
  project.layers[0].modeFile = "modes";
  const Shape disc = makeDisc(30).value();
  const auto input = readPlateInput(project, disc, files.reader());
  REQUIRE(input.ok());
  CHECK(input.value().shape == disc);
  CHECK(input.value().directions == DirectionMap{2, 1, {0, 65535}});
  CHECK(input.value().modes.mode == std::vector<DirectionMode>{DirectionMode::Parallel, DirectionMode::Orthogonal});
  project.layers.clear();
  CHECK(readPlateInput(project, disc, files.reader()).value().directions == uniformDirection(0).value());
}

TEST_CASE("a project's offset comes before its holes, which are where the page says") {
  Files files;
  Project project;
  project.builtin = BuiltinShape::Rectangle;
  project.builtinSize = {30, 20};
  project.outlineOffset = 5;
  project.holes = {{{3, 15}, 4}};
  const auto areaOf = [&] {
    const auto input = readPlateInput(project, files.reader());
    REQUIRE_MESSAGE(input.ok(), input.error().message);
    CHECK(input.value().shape.page.x == doctest::Approx(40));
    CHECK(input.value().shape.page.y == doctest::Approx(30));
    return resolveOutline(input.value().shape).value().area;
  };
  const double grown = 600 + 100 * 5 + 3.14159265 * 25;
  CHECK(areaOf() == doctest::Approx(grown - 3.14159265 * 4).epsilon(1e-3));
  project.keepThin = true;
  CHECK(areaOf() == doctest::Approx(grown - 3.14159265 * 4).epsilon(1e-3));
  project.holes.push_back({{39.5, 29.5}, 0.5});
  const auto outside = readPlateInput(project, files.reader());
  REQUIRE(!outside.ok());
  CHECK(outside.error().message.find("hole 2 at 39.5, 29.5 mm") == 0);
}

TEST_CASE("an angle, a mode and a mode picture") {
  Files files;
  files.byName = {{"modes", Image{2, 1, 1, {0, 21845}}}};
  Project project;
  project.builtin = BuiltinShape::Rectangle;
  project.builtinSize = {10, 5};
  Layer& lowest = project.layers.emplace_back();
  lowest.as<LayerAngle>()->angle = 90;
  lowest.mode = DirectionMode::Smoothest;
  auto input = readPlateInput(project, files.reader());
  REQUIRE(input.ok());
  CHECK(input.value().directions.angle == uniformDirection(90).value().angle);
  CHECK(input.value().modes.mode == std::vector<DirectionMode>{DirectionMode::Smoothest});
  CHECK(files.asked.empty());
  lowest.modeFile = "modes";
  input = readPlateInput(project, files.reader());
  REQUIRE(input.ok());
  CHECK(input.value().modes.mode == std::vector<DirectionMode>{DirectionMode::Parallel, DirectionMode::Orthogonal});
}

TEST_CASE("what is missing or unreadable is named") {
  Files files;
  files.byName = {{"noise.png", std::string("GIF89a")}, {"grey", grey(2, 2, 0)}};
  Project project;
  auto input = readPlateInput(project, files.reader());
  REQUIRE(!input.ok());
  CHECK(input.error().code == ErrorCode::InvalidArgument);
  CHECK(input.error().message.find("there is no shape") == 0);
  mapOf(project).file = "noise.png";
  CHECK(readPlateInput(project, files.reader()).error().message.find("noise.png") == 0);
  mapOf(project).file = "grey";
  mapOf(project).encoding = DirectionEncoding::Tangent;
  CHECK(readPlateInput(project, files.reader()).error().code == ErrorCode::InvalidArgument);
  mapOf(project).encoding = DirectionEncoding::Angle;
  project.layers[0].modeFile = "absent";
  CHECK(readPlateInput(project, files.reader()).error().message == "no absent");
}
