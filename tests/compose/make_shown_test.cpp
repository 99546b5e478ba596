// The loop that looks at a path and asks for what its pictures lack, wherever they lie.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sillon/compose/compose.hpp"
#include "sillon/input/image_io.hpp"
#include "sillon/project/project.hpp"

using namespace sillon;

namespace {

/// A soft ball before a gradient, as 60 x 60 grey pixels.
Image ball() {
  Image image{60, 60, 1, {}};
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      const double d = std::hypot(x - 32, y - 27) / 18;
      const double tone = d < 1 ? 0.9 - 0.6 * d * d : 0.2 + 0.4 * x / 60;
      image.samples.push_back(static_cast<std::uint16_t>(65535 * tone));
    }
  }
  return image;
}

/// Soft stripes from the lower left to the upper right.
Image stripes() {
  Image image{60, 60, 1, {}};
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      image.samples.push_back(static_cast<std::uint16_t>(65535 * (0.5 + 0.4 * std::sin((x + y) * 0.15))));
    }
  }
  return image;
}

Result<InputFile> readBall(const std::string& name, const std::string& what) {
  CHECK(what == "picture");
  return InputFile(name == "stripes.png" ? stripes() : ball());
}

Project projectOf(std::vector<LampPicture> files) {
  Project project;
  project.layers.emplace_back().contents.emplace<PictureLayer>().pictures = std::move(files);
  project.builtinSize.x = 32;
  project.toolpath.perimeterMode = PerimeterMode::Soft;
  return project;
}

struct Made {
  ToolpathResult plate;
  Composition composition;
  int times = 0;
};

Made made(const Project& project) {
  Made out;
  const RunContext run(1);
  auto ground = readPlateInput(project, readBall);
  REQUIRE(ground.ok());
  auto composed = compose(project, std::move(ground).value(), {readBall}, run);
  REQUIRE_MESSAGE(composed.ok(), (composed.ok() ? "" : composed.error().message));
  out.composition = std::move(composed).value();
  const auto make = [&](const PlateInput& tried) {
    ++out.times;
    return generateToolpath(tried, project.toolpath, run);
  };
  auto plate = makeShown(project, out.composition, readBall, make, run);
  REQUIRE(plate.ok());
  out.plate = std::move(plate).value();
  return out;
}

std::vector<JudgedPicture> judged(const Made& plate) {
  auto pictures = judgePictures(plate.composition, plate.plate.toolpath, RunContext(1));
  REQUIRE(pictures.ok());
  return std::move(pictures).value();
}

double rOf(const Made& plate, std::size_t picture = 0) { return judged(plate).at(picture).measures.r; }

/// The path of the directions that are told to be its own.
bool isItsOwn(const Made& plate, const Project& project) {
  const auto again = generateToolpath(plate.composition.laid(), project.toolpath, RunContext(1));
  REQUIRE(again.ok());
  return digestOf(again.value().toolpath) == digestOf(plate.plate.toolpath);
}

}  // namespace

TEST_CASE("corrections bring the plate nearer to its picture, and the directions stay those of the plate") {
  Project project = projectOf({{"ball.png", Vec2{60, 45}}});
  project.pictures.corrections = 0;
  const Made once = made(project);
  project.pictures.corrections = 3;
  const Made thrice = made(project);
  CHECK(once.times == 1);
  CHECK(thrice.times == 4);
  CHECK(rOf(thrice) > rOf(once) + 0.001);
  CHECK(isItsOwn(thrice, project));
}

TEST_CASE("beads of a plate with pictures keep to their directions, which shows more of the picture") {
  Project project = projectOf({{"ball.png", Vec2{60, 45}}});
  project.pictures.corrections = 0;
  Made plate = made(project);
  PlateInput input = plate.composition.laid();
  CHECK(input.showsPictures);
  const double kept = rOf(plate);
  input.showsPictures = false;
  plate.plate = generateToolpath(input, project.toolpath, RunContext(1)).value();
  CHECK(kept > rOf(plate) + 0.001);
}

TEST_CASE("corrections bring a plate of two pictures nearer to both") {
  Project project = projectOf({{"ball.png", std::nullopt}, {"stripes.png", std::nullopt}});
  project.pictures.corrections = 0;
  const Made once = made(project);
  project.pictures.corrections = 3;
  const Made thrice = made(project);
  CHECK(once.times == 1);
  CHECK(thrice.times == 4);
  CHECK(rOf(thrice, 0) + rOf(thrice, 1) > rOf(once, 0) + rOf(once, 1) + 0.001);
  CHECK(thrice.composition.pictures.chosen == std::vector<bool>{true, true});
  CHECK(thrice.composition.pictures.shown[1].lamp.azimuth > thrice.composition.pictures.shown[0].lamp.azimuth + 20);
}

TEST_CASE("pictures with other tones than their own are made once") {
  Project project = projectOf({{"ball.png", Vec2{60, 45}}});
  project.pictures.localContrast = 0.5;
  CHECK(made(project).times == 1);
  CHECK(pathsFor(project) == 1);
}

TEST_CASE("a picture takes one path and one for each correction, at the bottom and above") {
  Project lowest = projectOf({{"ball.png", Vec2{60, 45}}});
  lowest.builtin = BuiltinShape::Rectangle;
  lowest.builtinSize = {20, 20};
  Project upper = lowest;
  upper.layers.insert(upper.layers.begin(), Layer());
  for (const int corrections : {0, 2}) {
    lowest.pictures.corrections = upper.pictures.corrections = corrections;
    CHECK(pathsFor(lowest) == 1 + corrections);
    CHECK(pathsFor(upper) == 1 + corrections);
    CHECK(made(lowest).times == 1 + corrections);
    CHECK(made(upper).times == 1 + corrections);
  }
  // Beside the page it cannot be corrected.
  Project beside = upper;
  beside.layers[1].at = Vec2{-50, 10};
  beside.layers[1].size = {10, 10};
  CHECK(made(beside).times == 1);
  CHECK(judged(made(beside)).empty());
  beside.layers[1].visible = false;
  CHECK(pathsFor(beside) == 1);
  CHECK(pathsFor(Project()) == 1);
}

TEST_CASE("pictures at the bottom and above are corrected in the same loop, each where it is on top") {
  Project project = projectOf({{"ball.png", Vec2{60, 45}}});
  project.builtinSize.x = 50;
  Layer& above = project.layers.emplace_back();
  above.contents.emplace<PictureLayer>().pictures = {{"stripes.png", Vec2{60, 45}}};
  above.size = {25, 25};
  project.pictures.corrections = 0;
  const Made once = made(project);
  project.pictures.corrections = 3;
  const Made thrice = made(project);
  CHECK(once.times == 1);
  CHECK(thrice.times == 4);
  const std::vector<JudgedPicture> told = judged(thrice);
  REQUIRE(told.size() == 2);
  CHECK(told[0].layer == 1);
  CHECK(told[0].file == "ball.png");
  CHECK(told[1].layer == 2);
  CHECK(told[1].file == "stripes.png");
  for (const JudgedPicture& picture : told) CHECK(picture.lamp == Lamp{60, 45, 0.1});
  for (const std::size_t picture : {0U, 1U}) CHECK(rOf(thrice, picture) > rOf(once, picture) + 0.003);
  CHECK(isItsOwn(thrice, project));
  // Both were asked for anew.
  CHECK(thrice.composition.pictures.solved[0] != thrice.composition.pictures.shown[0].tones);
  const LayerPictures& upper = thrice.composition.layers.pictures.at(1);
  CHECK(upper.solved[0] != upper.shown[0].tones);
}
