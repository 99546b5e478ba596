#include "sillon/pictures/pictures.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "look/rasters.hpp"
#include "pictures/parts.hpp"
#include "report/told.hpp"
#include "sillon/input/image_io.hpp"
#include "sillon/quality/metrics.hpp"
#include "sillon/report/warning.hpp"
#include "support/measure_pictures.hpp"

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

Image negative(Image image) {
  for (std::uint16_t& sample : image.samples) sample = static_cast<std::uint16_t>(65535 - sample);
  return image;
}

Result<InputFile> readBall(const std::string& name, const std::string& what) {
  CHECK(what == "picture");
  if (name == "none.png") return Error{ErrorCode::InvalidFile, "there is no none.png"};
  if (name == "negative.png") return InputFile(negative(ball()));
  return InputFile(name == "stripes.png" ? stripes() : ball());
}

Project projectOf(std::vector<LampPicture> files) {
  Project project;
  project.layers.emplace_back().contents.emplace<PictureLayer>().pictures = std::move(files);
  project.builtinSize.x = 20;
  project.toolpath.perimeterMode = PerimeterMode::Soft;
  return project;
}

PictureLayer& pictureLayer(Project& project) { return *project.layers[0].as<PictureLayer>(); }

struct Solved {
  PlatePictures pictures;
  PlateInput input;
};

Solved solved(const Project& project) {
  auto input = readPlateInput(project, readBall);
  REQUIRE(input.ok());
  Solved out{{}, std::move(input).value()};
  auto pictures = solvePictures(project, readBall, out.input, RunContext(1));
  REQUIRE(pictures.ok());
  out.pictures = std::move(pictures).value();
  return out;
}

}  // namespace

TEST_CASE("a picture alone makes a rectangle of its proportions") {
  const Solved plate = solved(projectOf({{"ball.png", Vec2{60, 45}}}));
  CHECK(plate.input.shape.page == Vec2{20, 20});
  CHECK(plate.pictures.shown[0].file == "ball.png");
  CHECK(plate.pictures.shown[0].lamp == Lamp{60, 45, 0.1});
  CHECK_FALSE(plate.pictures.chosen[0]);
}

TEST_CASE("pictures that leave one of them unseen are told, with how much of it is shown") {
  // Under one lamp a direction has one tone: of a picture and its negative, each is shown by half at most.
  const Vec2 lamp{60, 45};
  const Solved contrary = solved(projectOf({{"ball.png", lamp}, {"negative.png", lamp}}));
  const std::vector<Warning> told = pictureWarnings(pictureFacts(contrary.pictures, {}));
  REQUIRE(told.size() == 1);
  CHECK(told[0].code == WarningCode::PicturesCrowded);
  CHECK(told[0].value("n")->number == 2);
  const double r = told[0].value("r")->number;
  CHECK(r < 0.7);
  const auto picture = static_cast<std::size_t>(told[0].value("picture")->number);
  REQUIRE((picture == 1 || picture == 2));
  CHECK(std::abs(contrary.pictures.fieldR[picture - 1] - r) <= 0.005 + 1e-9);
  CHECK(contrary.pictures.fieldR[2 - picture] >= contrary.pictures.fieldR[picture - 1]);

  const Solved alike = solved(projectOf({{"ball.png", lamp}, {"ball.png", lamp}}));
  CHECK(alike.pictures.fieldR[0] > 0.98);
  CHECK(pictureWarnings(pictureFacts(alike.pictures, {})).empty());
  CHECK(pictureWarnings(pictureFacts(solved(projectOf({{"ball.png", lamp}})).pictures, {})).empty());
}

TEST_CASE("of pictures the one that is shown least is told, and those with one tone") {
  const auto told = [](const std::vector<PictureFacts>& facts) {
    std::string out;
    for (const Warning& warning : pictureWarnings(facts)) {
      out += std::string(warningName(warning.code)) + " " + std::to_string(int(warning.value("picture")->number)) + " ";
    }
    return out;
  };
  CHECK(told({}).empty());
  CHECK(told({{false, 1, 0.7}}).empty());
  CHECK(told({{false, 1, 0.69}}) == "PictureLost 1 ");
  CHECK(told({{false, 0.9, 0.6}, {false, 0.8, 0.5}, {false, 0.9, 0.8}}) == "PictureLost 2 ");
  CHECK(told({{false, 0.6, 0.2}, {false, 0.5, 0.5}}) == "PicturesCrowded 2 ");
  CHECK(told({{true, 0, 0}, {false, 0.9, 0.9}, {true, 0, 0}}) == "PictureOneTone 1 PictureOneTone 3 ");
}

TEST_CASE("pictures keep their proportions: what sticks out of the page is cut off, unless they shall be stretched") {
  // Twice as wide as high: a gradient in the middle, black and white beside it.
  const auto wide = [](const std::string&, const std::string&) -> Result<InputFile> {
    Image image{80, 40, 1, {}};
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 80; ++x) {
        const double tone = x < 20 ? 0 : x >= 60 ? 1 : 0.3 + 0.01 * (x - 20);
        image.samples.push_back(static_cast<std::uint16_t>(65535 * tone));
      }
    }
    return InputFile(image);
  };
  Project project = projectOf({{"wide.png", Vec2{60, 45}}});
  project.builtin = BuiltinShape::Rectangle;
  project.builtinSize = {20, 20};
  const auto solve = [&] {
    PlateInput input = readPlateInput(project, wide).value();
    return solvePictures(project, wide, input, RunContext(1)).value();
  };
  const PlatePictures kept = solve();
  CHECK(kept.leftOut[0] == doctest::Approx(0.5));
  const Tones& middle = kept.shown[0].tones;
  for (int x = 0; x < middle.width; ++x) {  // all of the gradient, from black to white
    const double share = (x + 0.5) / middle.width;
    CHECK(std::abs(static_cast<double>(middle.at(x, 5)) - share) < 0.04);
  }
  project.pictures.proportions = PictureProportions::Stretch;
  const PlatePictures stretched = solve();
  CHECK(stretched.leftOut[0] == 0);
  const Tones& all = stretched.shown[0].tones;
  CHECK(all.at(all.width / 8, 5) == 0);
  CHECK(all.at(all.width * 7 / 8, 5) == 1);
  // On a page of their own proportions nothing is cut off.
  project.pictures.proportions = PictureProportions::Keep;
  project.builtinSize = {20, 10};
  CHECK(solve().leftOut[0] == 0);
}

TEST_CASE("levels are those of what is printed") {
  // A ball of few tones in a disc; its corners are black and white.
  const auto corners = [](const std::string&, const std::string&) -> Result<InputFile> {
    Image image = ball();
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 60; ++x) {
        std::uint16_t& sample = image.samples[60 * y + x];
        const bool outside = std::hypot(x - 29.5, y - 29.5) > 31;
        sample = outside ? (x < 30 ? 0 : 65535) : static_cast<std::uint16_t>(20000 + sample / 4);
      }
    }
    return InputFile(image);
  };
  Project project = projectOf({{"corners.png", Vec2{60, 45}}});
  project.builtin = BuiltinShape::Disc;
  project.builtinSize = {30, 30};
  PlateInput input = readPlateInput(project, corners).value();
  const PlatePictures pictures = solvePictures(project, corners, input, RunContext(1)).value();
  const Tones& shown = pictures.shown[0].tones;
  float low = 1, high = 0;
  for (int y = 0; y < shown.height; ++y) {
    for (int x = 0; x < shown.width; ++x) {
      if (std::hypot(x + 0.5 - shown.width / 2.0, y + 0.5 - shown.height / 2.0) > 0.45 * shown.width) continue;
      low = std::min(low, shown.at(x, y));
      high = std::max(high, shown.at(x, y));
    }
  }
  CHECK(low < 0.1f);
  CHECK(high > 0.9f);
}

TEST_CASE("a lamp that nobody chose is the one of three whose plate shows the picture best") {
  Project project = projectOf({{"ball.png", std::nullopt}});
  project.builtinSize.x = 32;
  const RunContext run(1);
  int trials = 0;
  PlateInput input = readPlateInput(project, readBall).value();
  const auto count = [&](int trial, int all) {
    CHECK(trial == trials++);
    CHECK(all == 3);
  };
  const PlatePictures chosen = solvePictures(project, readBall, input, run, nullptr, count).value();
  CHECK(trials == 3);
  constexpr double kSpacing = 32.0 / 100;  // as all plates that are made to choose
  const auto worth = [&](double azimuth) {
    Project other = project;
    other.toolpath = {};
    other.toolpath.spacing = kSpacing;
    pictureLayer(other).pictures[0].lamp = Vec2{azimuth, 45};
    PlateInput tried = readPlateInput(other, readBall).value();
    const PlatePictures pictures = solvePictures(other, readBall, tried, run).value();
    const auto plate = generateToolpath(tried, other.toolpath, run).value();
    const auto seen =
        measurePictures(plate.toolpath, tried.shape.page, pictures.shown, pictures.roughness, run).value();
    return seen[0].r + seen[0].ssim;
  };
  std::vector<LitPicture> lit = unlit(pictureLayer(project).pictures, project.pictures.lampSize);
  REQUIRE(lit.size() == 1);
  CHECK(lit[0].chooseAzimuth);
  lit[0].tones = tonesOf(ball());
  const auto first =
      solveDirections(lit, chosen.roughness, {input.shape.page, kSpacing}, inversionOf(project.pictures), run).value();
  REQUIRE(first.azimuths.size() == 2);
  const double best = worth(chosen.shown[0].lamp.azimuth);
  for (const double azimuth : {first.lamps[0].azimuth, first.azimuths[0], first.azimuths[1]}) {
    CHECK(best >= worth(azimuth));
  }
  // Toolpath settings leave it where it is, whether pictures are kept or not; where they are, nothing is tried again.
  std::optional<KeptPictures> kept;
  REQUIRE(solvePictures(project, readBall, input, run, &kept).ok());
  for (const double spacing : {0.4, 0.5}) {
    project.toolpath.maxWidth = 1.5;
    project.toolpath.spacing = spacing;
    PlateInput again = input, anew = input;
    const auto got = solvePictures(project, readBall, again, run, &kept, count).value();
    CHECK(got.shown[0].lamp == chosen.shown[0].lamp);
    CHECK(solvePictures(project, readBall, anew, run).value().shown[0].lamp == chosen.shown[0].lamp);
    CHECK(again.directions == anew.directions);
  }
  CHECK(trials == 3);
}

TEST_CASE("without pictures directions stay as they were read") {
  Project project;
  project.builtin = BuiltinShape::Rectangle;
  project.builtinSize = {20, 20};
  project.layers.emplace_back().as<LayerAngle>()->angle = 30;
  const RunContext run(1);
  auto input = readPlateInput(project, readBall);
  REQUIRE(input.ok());
  PlateInput plate = std::move(input).value();
  const DirectionMap before = plate.directions;
  const auto pictures = solvePictures(project, readBall, plate, run);
  REQUIRE(pictures.ok());
  CHECK(pictures.value().shown.empty());
  CHECK(plate.directions == before);
  CHECK_FALSE(plate.showsPictures);
}

TEST_CASE("pictures that were solved for before are what they would be, whatever changed since") {
  const RunContext run(1);
  std::optional<KeptPictures> kept;
  Project project = projectOf({{"ball.png", Vec2{60, 45}}});
  const auto check = [&](bool again) {
    auto input = readPlateInput(project, readBall);
    REQUIRE(input.ok());
    PlateInput anew = input.value(), after = input.value();
    // What is kept can only be seen where it is made to differ.
    const float mark = 0.125f;
    if (kept) kept->pictures.shown[0].tones.value[0] = mark;
    const auto expected = solvePictures(project, readBall, anew, run);
    const auto got = solvePictures(project, readBall, after, run, &kept);
    REQUIRE(expected.ok());
    REQUIRE(got.ok());
    CHECK(after.directions == anew.directions);
    CHECK(after.showsPictures);
    CHECK(got.value().shown[0].file == expected.value().shown[0].file);
    CHECK(got.value().shown[0].lamp == expected.value().shown[0].lamp);
    CHECK(got.value().level == expected.value().level);
    CHECK((got.value().shown[0].tones.value[0] == mark) == again);
  };
  check(false);
  check(true);
  project.toolpath.maxWidth = 1.9;  // of beads, not of directions
  check(true);
  pictureLayer(project).pictures[0].lamp = Vec2{70, 45};
  check(false);
  project.pictures.smoothness *= 2;
  check(false);
  project.pictures.spool = SpoolName::GoldPla;
  check(false);
  project.toolpath.spacing *= 1.25;
  check(false);
  project.builtin = BuiltinShape::Rectangle;
  project.builtinSize = {24, 20};
  check(false);
  check(true);
}

TEST_CASE("large pictures are not kept, and nothing of those before") {
  const RunContext run(1);
  std::optional<KeptPictures> kept;
  const Project project = projectOf({{"ball.png", Vec2{60, 45}}});
  const auto solve = [&](int side) {
    Image image{side, side, 1, {}};
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) image.samples.push_back(static_cast<std::uint16_t>(65535LL * x / side));
    }
    const auto read = [&](const std::string&, const std::string&) { return Result<InputFile>(InputFile(image)); };
    auto input = readPlateInput(project, read);
    REQUIRE(input.ok());
    REQUIRE(solvePictures(project, read, input.value(), run, &kept).ok());
  };
  solve(2000);
  CHECK(kept.has_value());
  solve(2001);
  CHECK_FALSE(kept.has_value());
}

TEST_CASE("a spool of one's own counts, and the side that is seen") {
  Project project;
  const Roughness up = roughnessOf(project);
  CHECK(up == Roughness{2.36, 17.32});
  project.print.showSide = ShowSide::Bed;
  CHECK(roughnessOf(project) == Roughness{2.56, 13.54});
  project.pictures.slopes = Vec2{3, 12};
  CHECK(roughnessOf(project) == Roughness{3, 12});
}

TEST_CASE("a file that is not there is told") {
  const Project project = projectOf({{"ball.png", std::nullopt}, {"none.png", std::nullopt}});
  auto input = readPlateInput(project, readBall);
  REQUIRE(input.ok());
  PlateInput plate = std::move(input).value();
  const auto pictures = solvePictures(project, readBall, plate, RunContext(1));
  REQUIRE(!pictures.ok());
  CHECK(pictures.error().message == "there is no none.png");
}
