// A session that keeps fields gives what a run from nothing gives, whatever was edited in between.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "sillon/measure.hpp"
#include "sillon/session.hpp"
#include "support/scenes.hpp"

using namespace sillon;

namespace {

PlateInput fan(double side, double bend) {
  return scenes::plate(scenes::shapeOf({scenes::rectangle({0, 0}, {side, side})}, {side, side}),
                       scenes::mapOf(64, [=](double x, double y) { return bend * std::sin(3 * x) + y; }),
                       DirectionMode::Constrained);
}

bool did(const Plate& plate, const std::string& stage) {
  return std::any_of(plate.time.begin(), plate.time.end(), [&](const StageTime& t) { return t.stage == stage; });
}

}  // namespace

TEST_CASE("after any edit a session's toolpath is that of a run from nothing") {
  struct Edit {
    const char* what;
    std::function<void(PlateInput&, ToolpathParams&)> change;
  };
  // One for every parameter and every part of the input.
  const std::vector<Edit> edits = {
      {"nothing", [](PlateInput&, ToolpathParams&) {}},
      {"directions", [](PlateInput& i, ToolpathParams&) { i.directions = fan(14, 0.9).directions; }},
      {"a few directions", [](PlateInput& i, ToolpathParams&) { i.directions.angle[700] += 9000; }},
      {"modes", [](PlateInput& i, ToolpathParams&) { i.modes = uniformMode(DirectionMode::Smoothest); }},
      {"page", [](PlateInput& i, ToolpathParams&) { i.shape.page.x = 15; }},
      {"shape",
       [](PlateInput& i, ToolpathParams&) {
         i.shape.paths[0].rings[0][0] = {1, 2};
       }},
      {"rule", [](PlateInput& i, ToolpathParams&) { i.shape.paths[0].fillRule = FillRule::NonZero; }},
      {"spacing", [](PlateInput&, ToolpathParams& p) { p.spacing = 0.5; }},
      {"perimeters", [](PlateInput&, ToolpathParams& p) { p.perimeters = 2; }},
      {"perimeterMode", [](PlateInput&, ToolpathParams& p) { p.perimeterMode = PerimeterMode::Soft; }},
      {"borderPull", [](PlateInput&, ToolpathParams& p) { p.borderPull = 4; }},
      {"bridge", [](PlateInput&, ToolpathParams& p) { p.bridge = 1; }},
      {"mapFilter", [](PlateInput&, ToolpathParams& p) { p.mapFilter = MapFilter::Nearest; }},
      {"seed", [](PlateInput&, ToolpathParams& p) { p.seed = 3; }},
      {"jitter", [](PlateInput&, ToolpathParams& p) { p.jitter = 0.2; }},
      {"phaseTransport", [](PlateInput&, ToolpathParams& p) { p.phaseTransport = PhaseTransport::Neighbour; }},
      {"sweepsPerLevel", [](PlateInput&, ToolpathParams& p) { p.sweepsPerLevel = 3; }},
      {"spacingBend", [](PlateInput&, ToolpathParams& p) { p.spacingBend = 0.1; }},
      {"lineGive", [](PlateInput&, ToolpathParams& p) { p.lineGive = 5; }},
      {"waveReach", [](PlateInput&, ToolpathParams& p) { p.waveReach = 0.7; }},
      {"stitchAlignment", [](PlateInput&, ToolpathParams& p) { p.stitchAlignment = 0; }},
      {"relaxationRounds", [](PlateInput&, ToolpathParams& p) { p.relaxationRounds = 1; }},
      {"relaxationStrength", [](PlateInput&, ToolpathParams& p) { p.relaxationStrength = 0.3; }},
      {"relaxationSmoothing", [](PlateInput&, ToolpathParams& p) { p.relaxationSmoothing = 0.4; }},
      {"widthBalance", [](PlateInput&, ToolpathParams& p) { p.widthBalance = 0.2; }},
      {"beadOverlap", [](PlateInput&, ToolpathParams& p) { p.beadOverlap = 0.1; }},
      {"minWidth", [](PlateInput&, ToolpathParams& p) { p.minWidth = 0.8; }},
      {"maxWidth", [](PlateInput&, ToolpathParams& p) { p.maxWidth = 1.1; }},
      {"simplifyTolerance", [](PlateInput&, ToolpathParams& p) { p.simplifyTolerance = 0.03; }},
  };
  const RunContext run(2);
  PlateInput input = fan(14, 0.5);
  ToolpathParams params;
  Session session;
  for (const Edit& edit : edits) {
    CAPTURE(edit.what);
    edit.change(input, params);
    const auto kept = session.generateToolpath(input, params, run);
    const auto fresh = generateToolpath(input, params, run);
    REQUIRE(kept.ok());
    REQUIRE(fresh.ok());
    CHECK(digestOf(kept.value().toolpath) == digestOf(fresh.value().toolpath));
    CHECK(kept.value().parts == fresh.value().parts);
    CHECK(kept.value().contourCycles == fresh.value().contourCycles);
  }
}

TEST_CASE("a session does again only what an edit asks for") {
  const RunContext run(1);
  PlateInput input = fan(10, 0.5);
  ToolpathParams params;
  Session session;
  const Plate first = session.generateToolpath(input, params, run).value();
  CHECK(did(first, "distance"));
  CHECK(did(first, "phases"));
  input.directions = fan(10, 0.2).directions;
  const Plate redirected = session.generateToolpath(input, params, run).value();
  CHECK_FALSE(did(redirected, "distance"));
  CHECK(did(redirected, "phases"));
  params.relaxationRounds = 3;
  const Plate relaxed = session.generateToolpath(input, params, run).value();
  CHECK_FALSE(did(relaxed, "phases"));
  CHECK(did(relaxed, "relaxation"));
}

TEST_CASE("an error or a cancelled run leaves a session fit for the next") {
  const PlateInput input = fan(10, 0.5);
  Session session;
  const RunContext run(1);
  const std::string digest = digestOf(session.generateToolpath(input, {}, run).value().toolpath);
  PlateInput tiny = fan(0.1, 0.5);
  CHECK(session.generateToolpath(tiny, {}, run).error().code == ErrorCode::EmptyShape);
  CHECK(digestOf(session.generateToolpath(input, {}, run).value().toolpath) == digest);
  for (const double when : {0.03, 0.1, 0.3}) {
    RunContext stopped(1);
    stopped.onProgress([&](std::string_view, double done) {
      if (done > when) stopped.requestCancel();
    });
    PlateInput other = fan(10, when);
    const auto plate = session.generateToolpath(other, {}, stopped);
    if (!plate) CHECK(plate.error().code == ErrorCode::Cancelled);
    CHECK(digestOf(session.generateToolpath(input, {}, run).value().toolpath) == digest);
  }
}

TEST_CASE("the preview is bright where beads lie, dark half-way between, and black outside") {
  const RunContext run(2);
  PlateInput input = fan(12, 0);
  input.directions = uniformDirection(0).value();
  ToolpathParams params;
  params.perimeterMode = PerimeterMode::None;
  Session session;
  const RgbImage image = session.previewWaves(input, params, 600, run).value();
  CHECK(image.width == 600);
  CHECK(image.height == 600);
  const auto grey = [&](double x, double y) {
    const std::size_t column = static_cast<std::size_t>(x * 50);
    const std::size_t row = static_cast<std::size_t>((12 - y) * 50);
    return static_cast<int>(image.rgb[3 * (row * 600 + column)]);
  };
  for (const double p : {2.0, 6.0, 10.0}) {
    for (const double edge : {0.02, 11.98}) CHECK(std::max(grey(edge, p), grey(p, edge)) == 0);
    for (const double near : {0.5, 11.5}) CHECK(std::min(grey(near, p), grey(p, near)) >= 40);
  }
  // Between hairpins the beads are straight, 0.4 mm apart.
  const Toolpath toolpath = session.generateToolpath(input, params, run).value().toolpath;
  double on = 0, between = 0, count = 0;
  for (const Vec2f p : toolpath.cycles[0].points) {
    if (p.x < 2 || p.x > 10 || p.y < 2 || p.y > 10) continue;
    on += grey(p.x, p.y);
    between += grey(p.x, static_cast<double>(p.y) + 0.2);
    ++count;
  }
  REQUIRE(count > 20);
  CHECK(on / count > 195);  // a pixel is a twentieth of a spacing, and beads were relaxed
  CHECK(between / count < 70);
  CHECK(session.previewWaves(input, params, 9000, run).error().message ==
        "width is 9000 pixels; it must be 16 to 8192 pixels");
}

TEST_CASE("the preview is the same picture whatever came before and however many threads draw it") {
  PlateInput input = fan(12, 0.5);
  ToolpathParams params;
  const auto preview = [&](Session& session, int threads) {
    return session.previewWaves(input, params, 333, RunContext(threads)).value().rgb;
  };
  Session used;
  (void)preview(used, 2);
  (void)used.generateToolpath(input, params, RunContext(2));
  input.directions.angle[700] += 9000;
  params.relaxationRounds = 1;
  Session fresh;
  const auto expected = preview(fresh, 1);
  CHECK(preview(used, 2) == expected);
  (void)used.generateToolpath(input, params, RunContext(2));
  CHECK(preview(used, 3) == expected);
}

TEST_CASE("a preview between two plates leaves the plate's waves as they were kept") {
  const RunContext run(1);
  PlateInput input = fan(10, 0.5);
  ToolpathParams params;
  Session session;
  (void)session.generateToolpath(input, params, run);
  (void)session.previewWaves(input, params, 200, run);
  params.relaxationRounds = 1;
  const Plate plate = session.generateToolpath(input, params, run).value();
  CHECK_FALSE(did(plate, "phases"));
  CHECK(digestOf(plate.toolpath) == digestOf(generateToolpath(input, params, run).value().toolpath));
}
