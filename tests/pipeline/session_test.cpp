// A session that keeps fields gives what a run from nothing gives, whatever was edited in between.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "sillon/pipeline/pipeline.hpp"
#include "sillon/quality/metrics.hpp"
#include "support/scenes.hpp"
#include "support/told_reason.hpp"

using namespace sillon;

namespace {

PlateInput fan(double side, double bend) {
  return scenes::plate(scenes::shapeOf({scenes::rectangle({0, 0}, {side, side})}, {side, side}),
                       scenes::mapOf(64, [=](double x, double y) { return bend * std::sin(3 * x) + y; }),
                       DirectionMode::Constrained);
}

bool did(const ToolpathResult& plate, const std::string& stage) {
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
      {"borderWeight", [](PlateInput&, ToolpathParams& p) { p.borderWeight = 4; }},
      {"bridge", [](PlateInput&, ToolpathParams& p) { p.bridge = 1; }},
      {"mapFilter", [](PlateInput&, ToolpathParams& p) { p.mapFilter = MapFilter::Nearest; }},
      {"seed", [](PlateInput&, ToolpathParams& p) { p.seed = 3; }},
      {"jitter", [](PlateInput&, ToolpathParams& p) { p.jitter = 0.2; }},
      {"phaseTransport", [](PlateInput&, ToolpathParams& p) { p.phaseTransport = PhaseTransport::Neighbour; }},
      {"sweepsPerLevel", [](PlateInput&, ToolpathParams& p) { p.sweepsPerLevel = 3; }},
      {"spacingVariation", [](PlateInput&, ToolpathParams& p) { p.spacingVariation = 0.1; }},
      {"directionTolerance", [](PlateInput&, ToolpathParams& p) { p.directionTolerance = 5; }},
      {"kernelRadius", [](PlateInput&, ToolpathParams& p) { p.kernelRadius = 0.7; }},
      {"stitchAlignment", [](PlateInput&, ToolpathParams& p) { p.stitchAlignment = 0; }},
      {"relaxationRounds", [](PlateInput&, ToolpathParams& p) { p.relaxationRounds = 1; }},
      {"order", [](PlateInput&, ToolpathParams& p) { p.order = BeadOrder::Plain; }},
      {"repulsionRounds", [](PlateInput&, ToolpathParams& p) { p.repulsionRounds = 4; }},
      {"relaxationStrength", [](PlateInput&, ToolpathParams& p) { p.relaxationStrength = 0.3; }},
      {"relaxationSmoothing", [](PlateInput&, ToolpathParams& p) { p.relaxationSmoothing = 0.4; }},
      {"showsPictures", [](PlateInput& i, ToolpathParams&) { i.showsPictures = true; }},
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
    CHECK(kept.value().longestJointMm == fresh.value().longestJointMm);
    CHECK(kept.value().stitchWork == fresh.value().stitchWork);
    CHECK(kept.value().nx == fresh.value().nx);
    CHECK_FALSE(kept.value().dislocations.has_value());
  }
}

TEST_CASE("a session does again only what an edit asks for") {
  const RunContext run(1);
  PlateInput input = fan(10, 0.5);
  ToolpathParams params;
  Session session;
  const ToolpathResult first = session.generateToolpath(input, params, run).value();
  CHECK(did(first, "distance"));
  CHECK(did(first, "phases"));
  input.directions = fan(10, 0.2).directions;
  const ToolpathResult redirected = session.generateToolpath(input, params, run).value();
  CHECK_FALSE(did(redirected, "distance"));
  CHECK(did(redirected, "phases"));
  params.relaxationRounds = 3;
  const ToolpathResult relaxed = session.generateToolpath(input, params, run).value();
  CHECK_FALSE(did(relaxed, "distance"));
  CHECK(did(relaxed, "relaxation"));
  // What only widths and simplification read: nothing before them is done again, in whatever order the edits come.
  const std::vector<std::function<void(ToolpathParams&)>> ofWidths = {
      [](ToolpathParams& p) { p.widthBalance = 0.4; }, [](ToolpathParams& p) { p.beadOverlap = 0.2; },
      [](ToolpathParams& p) { p.minWidth = 0.7; }, [](ToolpathParams& p) { p.maxWidth = 1.2; },
      [](ToolpathParams& p) { p.simplifyTolerance = 0.02; }};
  for (const auto& edit : ofWidths) {
    edit(params);
    const ToolpathResult widened = session.generateToolpath(input, params, run).value();
    REQUIRE(widened.time.size() == 2);
    CHECK(did(widened, "width"));
    CHECK(did(widened, "simplify"));
  }
  params.stitchAlignment = 0.5;
  CHECK(did(session.generateToolpath(input, params, run).value(), "contour"));
  params.seed = 4;
  CHECK(did(session.generateToolpath(input, params, run).value(), "phases"));
}

TEST_CASE("a path that is kept is one of the same dislocations, whenever they are asked for") {
  const RunContext run(2);
  const PlateInput input = fan(14, 0.9);
  ToolpathParams params;
  Session session;
  CHECK_FALSE(session.generateToolpath(input, params, run).value().dislocations.has_value());
  for (const double overlap : {0.1, 0.2}) {
    params.beadOverlap = overlap;
    const ToolpathResult kept = session.generateToolpath(input, params, run, true).value();
    const ToolpathResult fresh = generateToolpath(input, params, run, true).value();
    REQUIRE(kept.dislocations.has_value());
    CHECK(kept.dislocations->count == fresh.dislocations->count);
    CHECK(kept.dislocations->bound == fresh.dislocations->bound);
    CHECK(digestOf(kept.toolpath) == digestOf(fresh.toolpath));
  }
  CHECK_FALSE(session.generateToolpath(input, params, run).value().dislocations.has_value());
}

TEST_CASE("an error or a cancelled run leaves a session fit for the next") {
  const PlateInput input = fan(10, 0.5);
  Session session;
  const RunContext run(1);
  const std::string digest = digestOf(session.generateToolpath(input, {}, run).value().toolpath);
  PlateInput tiny = fan(0.1, 0.5);
  CHECK(session.generateToolpath(tiny, {}, run).error().code == ErrorCode::EmptyShape);
  CHECK(toldReason(session.generateToolpath(tiny, {}, run).error()) == "NoBeadFits spacing=0.4");
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
  // Cancelled while the widths of a kept path were made.
  ToolpathParams wide;
  wide.maxWidth = 1.3;
  RunContext stopped(1);
  stopped.requestCancel();
  CHECK(session.generateToolpath(input, wide, stopped).error().code == ErrorCode::Cancelled);
  CHECK(session.generateToolpath(input, wide, stopped, true).error().code == ErrorCode::Cancelled);
  CHECK(session.generateToolpath(input, wide, run, true).value().dislocations->bound ==
        generateToolpath(input, wide, run, true).value().dislocations->bound);
  CHECK(digestOf(session.generateToolpath(input, wide, run).value().toolpath) ==
        digestOf(generateToolpath(input, wide, run).value().toolpath));
  CHECK(digestOf(session.generateToolpath(input, {}, run).value().toolpath) == digest);
}
