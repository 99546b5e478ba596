// One way to a plate: what it makes is what the rooms make one by one, and all of it is told.
#include "sillon/job/plate.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gcode/read_back.hpp"
#include "look/rasters.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "support/measure_pictures.hpp"

using namespace sillon;

namespace {

/// A soft ball before a gradient.
Image ball() {
  Image image{60, 60, 1, {}};
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      const double d = std::hypot(x - 32, y - 27) / 18;
      image.samples.push_back(static_cast<std::uint16_t>(65535 * (d < 1 ? 0.9 - 0.6 * d * d : 0.2 + 0.4 * x / 60)));
    }
  }
  return image;
}

Result<InputFile> readFile(const std::string& name, const std::string& /*what*/) {
  if (name == "ball.png") return InputFile(ball());
  if (name == "text.svg") {
    return InputFile(std::string(
        R"(<svg viewBox="0 0 60 60"><rect width="60" height="60"/><text y="30" font-family="Arial">a</text>)"
        R"(<flowRoot>b</flowRoot></svg>)"));
  }
  if (name == "lacking.svg") {
    return InputFile(std::string(R"(<svg width="10mm" height="10mm" viewBox="0 0 10 10"><text y="8" font-size="8">)"
                                 "A\u6f22</text></svg>"));
  }
  if (name == "spaced.svg") {
    return InputFile(
        std::string(R"(<svg width="10mm" height="10mm" viewBox="0 0 10 10"><rect width="12" height="9" fill="red"/>)"
                    R"(<circle r="3"/><text y="8" writing-mode="tb">a</text></svg>)"));
  }
  return Error{ErrorCode::InvalidFile, "there is no " + name};
}

Project disc() {
  Project project;
  project.builtin = BuiltinShape::Disc;
  project.builtinSize = {20, 0};
  project.layers.emplace_back().as<LayerAngle>()->angle = 30;
  project.toolpath.spacing = 0.8;
  project.printer.nozzle = 0.8;
  return project;
}

Project pictured() {
  Project project = disc();
  project.layers[0].contents.emplace<PictureLayer>().pictures = {{"ball.png", std::nullopt}};
  project.pictures.corrections = 1;
  return project;
}

Plate made(const Project& project, const PlateOptions& options = {}) {
  auto plate = makePlate(project, readFile, options, RunContext(1));
  REQUIRE_MESSAGE(plate.ok(), plate.error().message);
  return std::move(plate).value();
}

std::string gcodeOf(Plate& plate, const PlateGcodeOptions& options = {}) {
  std::string text;
  const auto keep = [&](std::string_view piece) {
    text += piece;
    return true;
  };
  const auto error = writePlateGcode(plate, options, keep, RunContext(1));
  REQUIRE_MESSAGE(!error, error->message);
  return text;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("a plate is what its rooms make one by one, measured or not") {
  const Project project = disc();
  const RunContext run(1);
  const PlateInput input = readPlateInput(project, readFile).value();
  const ToolpathResult path = generateToolpath(input, project.toolpath, run, true).value();
  PlateOptions options;
  options.countDislocations = true;
  const Plate plate = made(project, options);
  CHECK(digestOf(plate.toolpath()) == digestOf(path.toolpath));
  REQUIRE(plate.measures.has_value());
  CHECK(plate.measures->dislocations == path.dislocations->count);
  CHECK(plate.shown.empty());
  CHECK_FALSE(plate.below.has_value());
  options.measure = false;
  const Plate unmeasured = made(project, options);
  CHECK(digestOf(unmeasured.toolpath()) == digestOf(path.toolpath));
  CHECK_FALSE(unmeasured.measures.has_value());
  CHECK_FALSE(has(reportJson(unmeasured.report()), "\"alignment\""));
  CHECK(has(reportJson(unmeasured.report()), unmeasured.report().digest));
}

TEST_CASE("the path below is that of generateAcross, made alone or beside the path that is seen") {
  const Project project = disc();
  const PlateInput input = readPlateInput(project, readFile).value();
  const std::string across = digestOf(generateAcross(input, project.toolpath, RunContext(1)).value().toolpath);
  PlateOptions options;
  options.path = PlatePath::Below;
  const Plate alone = made(project, options);
  CHECK(digestOf(alone.toolpath()) == across);
  CHECK_FALSE(alone.measures.has_value());
  options.path = PlatePath::Both;
  const Plate both = made(project, options);
  CHECK(digestOf(both.toolpath()) == digestOf(made(project).toolpath()));
  REQUIRE(both.below.has_value());
  CHECK(digestOf(*both.below) == across);
}

TEST_CASE("the path below a picture lies across the directions that corrections have turned") {
  PlateOptions options;
  options.path = PlatePath::Both;
  const Plate both = made(pictured(), options);
  options.path = PlatePath::Below;
  CHECK(digestOf(made(pictured(), options).toolpath()) == digestOf(*both.below));
}

TEST_CASE("progress is one fraction that never falls, over trials, corrections, the path below and measuring") {
  RunContext run(1);
  std::vector<double> seen;
  run.onProgress([&](std::string_view /*stage*/, double fraction) { seen.push_back(fraction); });
  PlateOptions options;
  options.path = PlatePath::Both;
  REQUIRE(makePlate(pictured(), readFile, options, run).ok());
  REQUIRE(seen.size() > 20);
  CHECK(seen.front() < 0.1);
  CHECK(std::is_sorted(seen.begin(), seen.end()));
  CHECK(seen.back() == doctest::Approx(1));
  // No part takes all of it: half of the calls come before nine tenths.
  CHECK(seen[seen.size() / 2] < 0.9);
  seen.clear();
  REQUIRE(makePlate(disc(), readFile, {}, run).ok());
  CHECK(seen.front() < 0.1);
  CHECK(seen.back() == doctest::Approx(1));
}

TEST_CASE("shares of a job lie within each other, and the next job begins at 0") {
  RunContext run(1);
  double last = -1;
  run.onProgress([&](std::string_view /*stage*/, double fraction) { last = fraction; });
  {
    const ProgressShare half(run, 0.5, 1);
    const ProgressShare quarter(run, 0, 0.5);
    run.beginJob();
    run.beginStage("a", 0, 1);
    CHECK(last == 0.5);
    run.report(1);
    CHECK(last == 0.75);
    run.beginJob();
    run.report(0.5);
    CHECK(last == 0.75);  // never falls
  }
  run.beginJob();
  run.beginStage("b", 0, 1);
  CHECK(last == 0);
  run.report(1);
  CHECK(last == 1);
}

TEST_CASE("a plate that is too large for the bed is turned, or made smaller, only if it may be") {
  Project project = disc();
  project.builtin = BuiltinShape::Rectangle;
  project.builtinSize = {40, 10};
  project.printer.bedMax = {20, 50};
  PlateOptions options;
  options.measure = false;
  CHECK(made(project, options).project.print.rotate == 0);
  options.placing = Placing::Rotate;
  CHECK(made(project, options).project.print.rotate == 90);
  project.builtinSize = {60, 30};
  CHECK(made(project, options).project.builtinSize.x == 60);
  options.placing = Placing::Fit;
  Plate fitted = made(project, options);
  CHECK(fitted.project.builtinSize.x < 60);
  CHECK(fitted.input.shape.page.x == doctest::Approx(fitted.project.builtinSize.x));
  CHECK_FALSE(gcodeOf(fitted).empty());
}

TEST_CASE("a layer shows a picture as well as the whole plate does, and corrections help it as much") {
  Project whole = disc();
  whole.builtin = BuiltinShape::Rectangle;
  whole.builtinSize = {50, 50};
  whole.toolpath.perimeterMode = PerimeterMode::None;
  Project layered = whole;
  PictureLayer lit;
  lit.pictures = {{"ball.png", Vec2{60, 45}}};
  whole.layers[0].contents = lit;
  layered.layers.emplace_back().contents = lit;
  const auto shows = [](Project project, int corrections) {
    project.pictures.corrections = corrections;
    const Plate plate = made(project);
    const std::vector<ShownPicture> asked{{"ball.png", {60, 45, 0.1}, tonesOf(ball())}};
    return measurePictures(plate.toolpath(), plate.input.shape.page, asked, roughnessOf(project), RunContext(1))
        .value()[0]
        .r;
  };
  const double plain = shows(layered, 0);
  const double corrected = shows(layered, 3);
  CHECK(plain == doctest::Approx(shows(whole, 0)).epsilon(0.02));
  CHECK(corrected == doctest::Approx(shows(whole, 3)).epsilon(0.02));
  CHECK(corrected > plain);

  // The report tells the same of the picture, of cells of the layer's window instead of the page's.
  layered.pictures.corrections = 1;
  const Report report = made(layered).report();
  REQUIRE(report.pictures.size() == 1);
  const ReportedPicture& told = report.pictures[0];
  CHECK(told.layer == 2);
  CHECK(told.file == "ball.png");
  CHECK(told.lamp.azimuth == 60);
  CHECK(told.measures.r == doctest::Approx(shows(layered, 1)).epsilon(0.01));
  const std::string json = reportJson(report);
  const std::string pictures = json.substr(json.find("\"pictures\""));
  CHECK(has(pictures.substr(0, 100), "\"layer\": 2,"));
  CHECK_FALSE(has(json, "layerPictures"));
  PlateOptions unmeasured;
  unmeasured.measure = false;
  CHECK(made(layered, unmeasured).report().pictures.empty());

  // A layer on top of the picture is no fault of its beads.
  layered.layers.emplace_back().size = {20, 20};
  CHECK(shows(layered, 1) > 0);
}

TEST_CASE("a picture beside its plate changes nothing") {
  Project project = disc();
  Layer& layer = project.layers.emplace_back();
  layer.contents.emplace<PictureLayer>().pictures = {{"ball.png", std::nullopt}};
  layer.size = {10, 0};
  layer.at = Vec2{-50, -50};
  const Plate plate = made(project);
  CHECK(plate.report().pictures.empty());
  layer.visible = false;
  CHECK(digestOf(plate.toolpath()) == digestOf(made(project).toolpath()));
}

TEST_CASE("layers become smaller with their plate") {
  Project project = disc();
  project.builtinSize = {60, 0};
  project.printer.bedMax = {40, 40};
  Layer& layer = project.layers.emplace_back();
  layer.at = Vec2{40, 20};
  layer.size = {10, 20};
  PlateOptions options;
  options.measure = false;
  options.placing = Placing::Fit;
  const Plate fitted = made(project, options);
  const double scale = fitted.input.shape.page.x / 60;
  CHECK(scale < 0.7);
  CHECK(fitted.composition.layers.placed.at(1).at.x == doctest::Approx(40 * scale));
  CHECK(fitted.composition.layers.placed.at(1).size.y == doctest::Approx(20 * scale));
}

TEST_CASE("a plate with an offset and holes fits the bed with them") {
  Project project = disc();
  project.builtinSize = {60, 0};
  project.outlineOffset = 2;
  project.holes = {{{32, 32}, 5}};
  project.printer.bedMax = {40, 45};
  PlateOptions options;
  options.measure = false;
  options.placing = Placing::Fit;
  Plate fitted = made(project, options);
  CHECK(fitted.project.outlineOffset == 2);
  CHECK(fitted.project.holes[0].diameter == 5);
  CHECK(fitted.project.holes[0].centre.x == doctest::Approx(fitted.input.shape.page.x / 2).epsilon(0.01));
  CHECK(fitted.input.shape.page.x <= 40);
  CHECK(fitted.input.shape.page.x > 37);
  CHECK_FALSE(gcodeOf(fitted).empty());
}

TEST_CASE("what is kept from plate to plate changes nothing") {
  Session session;
  std::optional<KeptPictures> kept;
  PlateOptions options;
  options.session = &session;
  options.keptPictures = &kept;
  options.countDislocations = true;
  Project project = pictured();
  for (const double width : {1.6, 1.7}) {
    project.toolpath.maxWidth = width;
    const Plate again = made(project, options);
    PlateOptions anew;
    anew.countDislocations = true;
    const Plate fresh = made(project, anew);
    CHECK(digestOf(again.toolpath()) == digestOf(fresh.toolpath()));
    CHECK(again.shown.front().measures.r == fresh.shown.front().measures.r);
    CHECK(again.measures->dislocations == fresh.measures->dislocations);
    CHECK(kept.has_value());
  }
}

TEST_CASE("pictures are judged by the toolpath, and then by the G-code") {
  Plate plate = made(pictured());
  REQUIRE(plate.shown.size() == 1);
  CHECK_FALSE(plate.report().fromGcode);
  const std::string text = gcodeOf(plate, {"2026-01-02 at 00:00:00 UTC", std::nullopt});
  CHECK(has(text, "2026-01-02"));
  CHECK(has(text, "toolpath digest = " + plate.measures->digest));
  REQUIRE(plate.gcode.has_value());
  REQUIRE(!checkPlateGcode(plate, text, RunContext(1)));
  const Toolpath read =
      readBack(text, plate.input.shape, plate.project.printer, plate.project.print, plate.toolpath().spacing).value();
  const auto judged =
      measurePictures(read, plate.input.shape.page, plate.pictures().shown, plate.pictures().roughness, RunContext(1));
  CHECK(plate.shown.front().measures.r == judged.value().front().r);
  CHECK(plate.findings.size() == checkGcode(text, plate.project.printer).findings.size());
  const Report report = plate.report();
  CHECK(report.fromGcode);
  REQUIRE(report.print.has_value());
  CHECK(report.print->seconds == plate.gcode->seconds);
  CHECK(report.warnings.size() >= plate.gcode->warnings.size());
}

TEST_CASE("the G-code of a plate with a base of lines across has the path below, made before or now") {
  Project project = disc();
  project.print.basePattern = BasePattern::Across;
  PlateOptions options;
  options.path = PlatePath::Both;
  Plate before = made(project, options);
  Plate now = made(project);
  CHECK_FALSE(now.below.has_value());
  CHECK(gcodeOf(before) == gcodeOf(now));
  CHECK(now.below.has_value());
}

TEST_CASE("a cancelled run writes no G-code, and settings out of range make no plate") {
  Plate plate = made(disc());
  RunContext run(1);
  run.requestCancel();
  const auto error = writePlateGcode(
      plate, {}, [](std::string_view) { return true; }, run);
  REQUIRE(error.has_value());
  CHECK(error->code == ErrorCode::Cancelled);
  CHECK_FALSE(plate.gcode.has_value());
  Project wrong = disc();
  wrong.toolpath.spacing = -1;
  const auto refused = makePlate(wrong, readFile, {}, RunContext(1));
  REQUIRE_FALSE(refused.ok());
  CHECK(has(refused.error().message, "spacing"));
}

TEST_CASE("what was taken for granted of the input is told as a code, its values and a sentence") {
  Project project = disc();
  project.builtin = BuiltinShape::None;
  project.builtinSize = {};
  project.shapeFile = "text.svg";
  PlateOptions options;
  options.measure = false;
  const std::vector<InputNote> notes = made(project, options).notes();
  REQUIRE(notes.size() == 3);
  CHECK(std::string(notes[0].code) == "DrawingInPixels");
  CHECK(std::string(notes[1].code) == "TextLeftOut");
  REQUIRE(notes[1].values.size() == 1);
  CHECK(notes[1].values[0].number == 1);
  CHECK(has(notes[1].message, "text in the drawing is left out (1 <text>)"));
  CHECK(std::string(notes[2].code) == "TextInOtherFont");
  project.pageWidth = 20;
  CHECK(made(project, options).notes().size() == 2);
}

TEST_CASE("drawings and masks of visible layers tell what that of the shape would, with the layer's number") {
  Project project = disc();
  project.layers.resize(3);
  for (Layer& layer : project.layers) layer.contents.emplace<DrawingLayer>().file = "spaced.svg";
  project.layers[0].visible = false;
  project.layers[2].contents = DirectionLayer();
  project.layers[2].mask = LayerMask::Inside;
  project.layers[2].maskFile = "text.svg";
  PlateOptions options;
  options.measure = false;
  const Plate plate = made(project, options);
  std::string told;
  for (const InputNote& note : plate.notes()) told += std::string(note.code) + ": " + note.message + "\n";
  CHECK(
      told ==
      "SeveralColours: layer 2: the drawing has several colours, all printed as one solid; the studio gives each a "
      "direction of its own\n"
      "TextLeftOut: layer 3: text in the drawing is left out (1 <text>); convert it to paths in the program that made "
      "the drawing\n"
      "TextInOtherFont: layer 3: text in the drawing is set in a built-in font instead of its own; to keep its "
      "letters, "
      "convert it to paths in the program that made the drawing\n");
  std::vector<std::string> warned;
  for (const Warning& warning : plate.warnings()) {
    if (!has(warningName(warning.code), "Drawing")) continue;
    REQUIRE(warning.value("layer") != nullptr);
    CHECK(warning.value("layer")->number == 2);
    warned.push_back(warning.message);
  }
  REQUIRE(warned.size() == 2);
  CHECK(has(warned[0], "layer 2: "));
  CHECK(has(warned[0], "lie off its page"));
  CHECK(has(warned[1], "layer 2: these parts of the drawing are not read: writing-mode"));
  const std::string report = reportJson(plate.report());
  CHECK(
      has(report, R"("notes": [{"code":"SeveralColours","values":{"layer":2.0},"message":"layer 2: the drawing has)"));
  CHECK(has(report, R"({"code":"TextLeftOut","values":{"n":1.0,"layer":3.0},)"));
}

TEST_CASE("a letter that no font has is told once of the drawing of a layer") {
  Project project = disc();
  project.layers[0].contents.emplace<DrawingLayer>().file = "lacking.svg";
  PlateOptions options;
  options.measure = false;
  std::vector<std::string> told;
  for (const Warning& warning : made(project, options).warnings()) {
    if (has(warning.message, "U+6F22")) told.push_back(warningName(warning.code));
  }
  CHECK(told == std::vector<std::string>{"LayerLettersLost"});
}
