// Zones of a project's layers, on a prism of its shape and on a body of one's own.
#include "sillon/job/plate.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "export/zones.hpp"
#include "sillon/export/export.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/text/text.hpp"

using namespace sillon;
using doctest::Approx;

namespace {

Result<InputFile> readFile(const std::string& name, const std::string& /*what*/) {
  if (name == "lines") return InputFile(Image{2, 1, 1, {10923, 54613}});  // -60 and 60 degrees
  if (name == "modes") return InputFile(Image{2, 1, 1, {65535, 0}});      // constrained, parallel
  if (name == "spaced.svg") {
    return InputFile(
        std::string(R"(<svg width="10mm" height="10mm" viewBox="0 0 10 10"><rect width="12" height="9"/></svg>)"));
  }
  return Error{ErrorCode::InvalidFile, "there is no " + name};
}

/// A plate of 40 x 20 mm with beads at 30 degrees, and a letter in its middle that lies across them.
Project lettered() {
  Project project;
  project.builtin = BuiltinShape::Rectangle;
  project.builtinSize = {40, 20};
  project.layers.emplace_back().as<LayerAngle>()->angle = 30;
  TextLayer text;
  text.text = "I";
  text.font = "Bebas Neue";
  text.textSize = 16;
  project.layers.emplace_back().contents = text;
  return project;
}

ZonesRequest requested() {
  ZonesRequest request;
  request.params.least = 1;
  return request;
}

Result<ZonesMade> made(const Project& project, const ZonesRequest& request = requested()) {
  return makeZones(project, request, readFile, RunContext(1));
}

double areaAt(const ZonesMade& zones, double degrees) {
  double area = 0;
  for (const DirectionZone& zone : zones.zones.zones) {
    if (std::abs(zone.degrees - degrees) < 0.5) area += zone.areaMm2;
  }
  return area;
}

/// An STL of a plate of 30 x 20 mm, 3 mm high, somewhere on the bed.
std::string body() {
  Mesh mesh = prismOf(makeRectangle({30, 20}).value(), 3).value();
  for (auto& point : mesh.points) {
    point[0] += 77;
    point[1] += 55;
  }
  return writeStl(mesh).value();
}

}  // namespace

TEST_CASE("letters above the lowest layer are a zone of their own, on a prism and on a body") {
  const Shape letter = textShape({"I", "Bebas Neue", 16}, readFile).value();
  const double ink = resolveOutline(letter).value().area;
  const Result<ZonesMade> prism = made(lettered());
  REQUIRE_MESSAGE(prism.ok(), (prism.ok() ? "" : prism.error().message));
  CHECK(areaAt(prism.value(), 120) == Approx(ink).epsilon(0.1));
  CHECK(areaAt(prism.value(), 30) == Approx(40 * 20 - ink).epsilon(0.15));  // with what lies beside the plate
  CHECK(prism.value().zones.zones.size() == 2);
  CHECK(prism.value().openEdges == 0);
  CHECK(prism.value().warnings.empty());

  ZonesRequest onBody = requested();
  onBody.body = body();
  const Result<ZonesMade> carried = made(lettered(), onBody);
  REQUIRE_MESSAGE(carried.ok(), (carried.ok() ? "" : carried.error().message));
  CHECK(areaAt(carried.value(), 120) == Approx(ink).epsilon(0.1));
  CHECK(carried.value().zones.zones.size() == 2);
  CHECK(carried.value().openEdges == 0);
  // The project's own shape does not count, nor what is told of it.
  Project shaped = lettered();
  shaped.builtin = BuiltinShape::None;
  shaped.shapeFile = "none.svg";
  CHECK(made(shaped, onBody).value().package == carried.value().package);
  CHECK_FALSE(made(shaped).ok());
}

TEST_CASE("a face of a body carries the project's own shape, at its place and for itself alone") {
  ZonesRequest request = requested();
  request.body = body();
  const std::string onAll = made(lettered(), request).value().package;
  request.face = BodyFace{{80, 60}, 3};
  Project small = lettered();
  small.builtinSize = {20, 10};
  small.layers.pop_back();
  const Result<ZonesMade> zones = made(small, request);
  REQUIRE_MESSAGE(zones.ok(), (zones.ok() ? "" : zones.error().message));
  CHECK(areaAt(zones.value(), 30) == Approx(20 * 10).epsilon(0.02));
  CHECK(zones.value().package != onAll);
  // Warnings about the shape's drawing are passed on, as the face carries that shape.
  Project drawn = small;
  drawn.builtin = BuiltinShape::None;
  drawn.shapeFile = "spaced.svg";
  CHECK_FALSE(made(drawn, request).value().warnings.empty());
  // Without a body there is no face.
  ZonesRequest alone = requested();
  const std::string prism = made(small, alone).value().package;
  alone.face = request.face;
  CHECK(made(small, alone).value().package == prism);
  request.face->z = HUGE_VAL;
  CHECK(made(small, request).error().message == "face is infinite mm; it must be -10000 to 10000 mm");
}

TEST_CASE("a lowest map is stretched over the top of a body") {
  Project project;
  MapLayer map;
  map.file = "lines";
  project.layers.emplace_back().contents = map;
  project.toolpath.mapFilter = MapFilter::Nearest;
  ZonesRequest request = requested();
  request.body = body();
  const Result<ZonesMade> zones = made(project, request);
  REQUIRE_MESSAGE(zones.ok(), (zones.ok() ? "" : zones.error().message));
  REQUIRE(zones.value().zones.zones.size() == 2);
  for (const DirectionZone& zone : zones.value().zones.zones) {
    CHECK(zone.areaMm2 == Approx(300).epsilon(0.2));
    CHECK(std::min(std::abs(zone.degrees - 60), std::abs(zone.degrees - 120)) < 0.5);
  }
}

TEST_CASE("layers whose mode is not constrained are refused, whatever says so") {
  const auto refused = [](const Project& project) {
    for (const std::optional<std::string>& stl : {std::optional<std::string>(), std::optional(body())}) {
      ZonesRequest request = requested();
      request.body = stl;
      const Result<ZonesMade> zones = made(project, request);
      REQUIRE_FALSE(zones.ok());
      CHECK(zones.error().code == ErrorCode::InvalidArgument);
      CHECK(zones.error().message.find("the mode must be constrained") != std::string::npos);
    }
  };
  Project project = lettered();
  project.layers[1].mode = DirectionMode::Smoothest;
  refused(project);
  project = lettered();
  project.layers[0].mode = DirectionMode::Parallel;
  refused(project);
  project = lettered();
  project.layers[0].modeFile = "modes";
  refused(project);
  // Hidden, or beside the body, it asks for nothing.
  project = lettered();
  project.layers[1].mode = DirectionMode::Smoothest;
  project.layers[1].visible = false;
  CHECK(made(project).ok());
  project.layers[1].visible = true;
  project.layers[1].at = Vec2{-100, -100};
  CHECK(made(project).ok());
}

TEST_CASE("what is told of layers and of the shape is told of zones, too, and errors name what is wrong") {
  Project project = lettered();
  project.layers[1].at = Vec2{0, 10};
  const ZonesMade beside = made(project).value();
  REQUIRE(beside.warnings.size() == 1);
  CHECK(beside.warnings[0].code == WarningCode::LayerBeside);
  CHECK(beside.warnings[0].value("layer")->number == 2);
  project = lettered();
  project.builtin = BuiltinShape::None;
  project.shapeFile = "spaced.svg";
  project.layers.resize(1);
  REQUIRE(made(project).value().warnings.size() == 1);
  CHECK(made(project).value().warnings[0].message.find("lie off its page") != std::string::npos);

  ZonesRequest request = requested();
  request.body = "no STL";
  CHECK(made(lettered(), request).error().message.find("the STL ") == 0);
  request = requested();
  request.params.most = 1;
  CHECK(made(lettered(), request).error().message.find("zones is 1") != std::string::npos);
  project = lettered();
  project.layers[1].as<LayerWords>()->text = "A\n\u5b57";
  CHECK(made(project).value().warnings.at(0).code == WarningCode::LayerLeftOut);
  // Settings that no project file may have.
  project.layers[1].contents = PictureLayer();
  CHECK(made(project).error().message == "layers[1].pictures is empty; it must have at least one picture");
  project = lettered();
  project.toolpath.spacing = 0;
  CHECK(made(project).error().message.find("toolpath.spacing is 0 mm") == 0);
}
