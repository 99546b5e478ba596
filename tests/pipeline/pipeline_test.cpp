// The whole way from shape to toolpath: truths, promises on every scene, goldens.
#include "sillon/pipeline/pipeline.hpp"
#include "input/plate_size.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <fstream>
#include <map>
#include <sstream>
#include <thread>

#include "sillon/quality/metrics.hpp"
#include "support/about.hpp"
#include "support/scenes.hpp"
#include "support/told_reason.hpp"

using namespace sillon;

namespace {

const RunContext kRun(2);

ToolpathResult buildResult(const PlateInput& input, const ToolpathParams& params = {}, const RunContext& run = kRun) {
  auto plate = generateToolpath(input, params, run);
  REQUIRE_MESSAGE(plate.ok(), (plate.ok() ? "" : plate.error().message));
  return std::move(plate).value();
}

Measures measuresOf(const ToolpathResult& plate, const PlateInput& input, const ToolpathParams& params = {}) {
  return measureToolpath(plate.toolpath, input, params, kRun).value();
}

std::map<std::string, std::string> goldens() {
  std::map<std::string, std::string> digests;
  std::ifstream file(SILLON_SOURCE_DIR "/tests/golden/digests.txt");
  std::string line;
  while (std::getline(file, line)) {
    const std::size_t space = line.rfind(' ');
    if (space != std::string::npos && line[0] != '#') digests[line.substr(0, space)] = line.substr(space + 1);
  }
  return digests;
}

}  // namespace

TEST_CASE("the spacing and the size that a refusal names are the first that memory holds, in closed form") {
  // Four cells for each square of one spacing, three more of these each way.
  CHECK(cellsOf({100, 40}, 0.5) == 4 * 203 * 83);
  const Vec2 size{100, 40};
  for (const double freeBytes : {2e6, 5e6, 7e6}) {
    CAPTURE(freeBytes);
    CHECK(!plateTooLarge(size, 0.5, kBytesPerCell * cellsOf(size, 0.5)).has_value());
    const auto error = plateTooLarge(size, 0.5, freeBytes);
    REQUIRE(error.has_value());
    CHECK(error->code == ErrorCode::OutOfMemory);
    CHECK(error->message.find("needs 0.1 million cells at spacing 0.5 mm; at most 0 million are possible in 0 GB") !=
          std::string::npos);
    const auto after = [&](const std::string& words) {
      return std::stod(error->message.substr(error->message.find(words) + words.size()));
    };
    const double spacing = after("use a spacing of at least ");
    CHECK(!plateTooLarge(size, spacing, freeBytes).has_value());
    CHECK(plateTooLarge(size, spacing - 0.001, freeBytes).has_value());
    const double share = after("or a size of at most ") / 100;
    CHECK(toldReason(*error) ==
          "PlateTooLarge spacing=0.5 leastSpacing=" + decimal(spacing, 4) + " percent=" + decimal(100 * share, 4));
    CHECK(!plateTooLarge(size * share, 0.5, freeBytes).has_value());
    CHECK(plateTooLarge(size * (share + 0.01), 0.5, freeBytes).has_value());
  }
  CHECK(plateTooLarge(size, 0.5, 0)->message.find("use a") == std::string::npos);  // nothing would do
  RunContext little;
  little.limitMemory(7e6);
  const PlateInput plate = scenes::plate(scenes::shapeOf({scenes::rectangle({0, 0}, size)}, size), scenes::waves());
  ToolpathParams params;
  params.spacing = 0.5;
  const auto refused = generateToolpath(plate, params, little);
  REQUIRE(!refused.ok());
  CHECK(refused.error().message == plateTooLarge(size, 0.5, 7e6)->message);
}

TEST_CASE("a half plane of one direction gives straight beads one spacing apart") {
  // A large square, beads along x: in its middle every bead is a straight row, tau from the next.
  const PlateInput input = scenes::plate(scenes::shapeOf({scenes::rectangle({0, 0}, {20, 20})}, {20, 20}),
                                         scenes::mapOf(1, [](double, double) { return 0.0; }));
  const ToolpathResult plate = buildResult(input);
  std::vector<float> rows;
  for (const Cycle& cycle : plate.toolpath.cycles) {
    for (std::size_t k = 0; k < cycle.points.size(); ++k) {
      const Vec2f a = cycle.points[k];
      const Vec2f b = cycle.points[(k + 1) % cycle.points.size()];
      if ((a.x < 10) == (b.x < 10)) continue;
      const float y = a.y + (b.y - a.y) * (10 - a.x) / (b.x - a.x);
      if (y < 3 || y > 17) continue;
      CHECK(std::abs(b.y - a.y) < 0.02f * std::abs(b.x - a.x) + 0.002f);
      rows.push_back(y);
    }
  }
  std::sort(rows.begin(), rows.end());
  REQUIRE(rows.size() >= 34);
  for (std::size_t k = 1; k < rows.size(); ++k) CHECK(rows[k] - rows[k - 1] == about(0.4, 0.03));
}

TEST_CASE("the path across runs at right angles to the plate's own, wherever directions come from") {
  // The direction of the bead nearest to a point, as an angle of no sign.
  const auto angleAt = [](const Toolpath& path, Vec2f p) {
    float nearest = 1e9f;
    double angle = 0;
    for (const Cycle& cycle : path.cycles) {
      for (std::size_t k = 0; k < cycle.points.size(); ++k) {
        const Vec2f a = cycle.points[k];
        const Vec2f d = cycle.points[(k + 1) % cycle.points.size()] - a;
        const float along = std::clamp(dot(p - a, d) / std::max(dot(d, d), 1e-12f), 0.0f, 1.0f);
        const float away = length(p - (a + d * along));
        if (away >= nearest) continue;
        nearest = away;
        angle = std::atan2(double(d.y), double(d.x));
      }
    }
    return angle;
  };
  const auto square = scenes::shapeOf({scenes::rectangle({0, 0}, {20, 20})}, {20, 20});
  const auto disc = scenes::shapeOf({scenes::circle({10, 10}, 10)}, {20, 20});
  const auto level = scenes::mapOf(1, [](double, double) { return 0.0; });
  const struct {
    const char* name;
    PlateInput input;
    double half;  // of the places are nearer to a right angle than this [degrees]
    double most;  // nine in ten
  } plates[] = {{"stripes", scenes::plate(square, level), 2, 3},
                {"swirl", scenes::plate(square, scenes::swirl()), 6, 25},
                {"parallel", scenes::plate(disc, level, DirectionMode::Parallel), 4, 15},
                {"orthogonal", scenes::plate(disc, level, DirectionMode::Orthogonal), 4, 15},
                {"smoothest", scenes::plate(square, level, DirectionMode::Smoothest), 4, 15}};
  for (const auto& plate : plates) {
    CAPTURE(plate.name);
    const Toolpath shown = buildResult(plate.input).toolpath;
    const Result<ToolpathResult> across = generateAcross(plate.input, ToolpathParams{}, RunContext(2));
    REQUIRE(across.ok());
    CHECK(across.value().toolpath.cycles.size() == 1);
    std::vector<double> off;  // by how much the two are not at right angles [degrees]
    for (double y = 3.1; y < 17; y += 0.7) {
      for (double x = 3.1; x < 17; x += 0.7) {
        if (std::hypot(x - 10, y - 10) < 1.5 || std::hypot(x - 10, y - 10) > 7) continue;  // the eye of a swirl
        const Vec2f p{static_cast<float>(x), static_cast<float>(y)};
        const double between = angleAt(shown, p) - angleAt(across.value().toolpath, p);
        off.push_back(std::asin(std::min(1.0, std::abs(std::cos(between)))) * 180 / std::numbers::pi);
      }
    }
    std::sort(off.begin(), off.end());
    REQUIRE(off.size() > 200);
    // Two paths that know nothing of each other turn in places of their own; straight ones turn at the border only.
    CHECK(off[off.size() / 2] < plate.half);
    CHECK(off[off.size() * 9 / 10] < plate.most);
  }
}

TEST_CASE("every scene gives one simple closed toolpath per part that covers the shape and does not spill") {
  for (const auto& scene : scenes::all()) {
    for (const PerimeterMode mode : scenes::kPerimeterModes) {
      CAPTURE(scene.name);
      CAPTURE(static_cast<int>(mode));
      ToolpathParams params;
      params.perimeterMode = mode;
      const ToolpathResult plate = buildResult(scene.input, params);
      CHECK(plate.parts == scene.parts);
      CHECK(plate.toolpath.cycles.size() == static_cast<std::size_t>(scene.parts));
      const Measures m = measuresOf(plate, scene.input, params);
      CHECK(m.crossings == 0);
      CHECK(m.spill <= 0.05);
      CHECK(m.overlap < 0.5);
      // Slivers hold few beads. White noise is U-turns everywhere, and beads do not overlap to hide it.
      const bool sliver = scene.name == "sliver" || scene.name == "two beads";
      const bool noise = scene.name == "noise";
      CHECK(m.coverage > (sliver ? 60 : noise ? 90 : 92.5));
      CHECK(m.fillRatio > (sliver ? 0.6 : noise ? 0.88 : 0.9));
      CHECK(m.fillRatio < 1.05);
      for (const Cycle& cycle : plate.toolpath.cycles) {
        CHECK(cycle.points.size() >= 3);
        CHECK(cycle.points.size() == cycle.widths.size());
        for (const float width : cycle.widths) CHECK((width > 0 && width <= 0.8f));
      }
    }
  }
}

TEST_CASE("the toolpath follows the map, far better than chance") {
  const auto scene = scenes::all()[0];
  const Measures m = measuresOf(buildResult(scene.input), scene.input);
  CHECK(m.alignmentInterior < -0.95);
}

TEST_CASE("the same plate comes out for 1, 2, 3 and 8 threads, and it is the one on record") {
  const auto records = goldens();
  const char* write = std::getenv("SILLON_WRITE_GOLDENS");  // a file to write them anew, after a wanted change
  std::ofstream out;
  if (write != nullptr) out.open(write);
  for (const auto& scene : scenes::all()) {
    for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{7}}) {
      ToolpathParams params;
      params.seed = seed;
      const std::string name = scene.name + (seed == 0 ? "" : ", seed 7");
      CAPTURE(name);
      const std::string digest = digestOf(buildResult(scene.input, params, RunContext(1)).toolpath);
      for (const int threads : {2, 3, 8})
        CHECK(digestOf(buildResult(scene.input, params, RunContext(threads)).toolpath) == digest);
      if (write != nullptr) {
        out << name << ' ' << digest << '\n';
        continue;
      }
      REQUIRE(records.count(name) == 1);
      CHECK(records.at(name) == digest);
    }
  }
}

TEST_CASE("another seed is another plate") {
  const auto scene = scenes::all()[0];
  ToolpathParams params;
  params.seed = 1;
  CHECK(digestOf(buildResult(scene.input, params).toolpath) != digestOf(buildResult(scene.input).toolpath));
}

TEST_CASE("parameters out of range are named with their value and range, and nothing is made") {
  struct Case {
    const char* field;
    std::function<void(ToolpathParams&)> spoil;
  };
  const double nan = std::nan("");
  const std::vector<Case> cases = {
      {"spacing", [](auto& p) { p.spacing = -0.4; }},
      {"spacing", [=](auto& p) { p.spacing = nan; }},
      {"spacing", [](auto& p) { p.spacing = 0; }},
      {"spacing", [](auto& p) { p.spacing = INFINITY; }},
      {"perimeters", [](auto& p) { p.perimeters = -1; }},
      {"bridge", [](auto& p) { p.bridge = -1; }},
      {"bridge", [=](auto& p) { p.bridge = nan; }},
      {"sweepsPerLevel", [](auto& p) { p.sweepsPerLevel = 0; }},
      {"spacingVariation", [](auto& p) { p.spacingVariation = 0.6; }},
      {"borderWeight", [](auto& p) { p.borderWeight = -1; }},
      {"stitchAlignment", [](auto& p) { p.stitchAlignment = 11; }},
      {"relaxationRounds", [](auto& p) { p.relaxationRounds = -1; }},
      {"repulsionRounds", [](auto& p) { p.repulsionRounds = 101; }},
      {"relaxationStrength", [](auto& p) { p.relaxationStrength = 0.6; }},
      {"relaxationSmoothing", [](auto& p) { p.relaxationSmoothing = 1.5; }},
      {"widthBalance", [](auto& p) { p.widthBalance = -0.1; }},
      {"beadOverlap", [](auto& p) { p.beadOverlap = -0.1; }},
      {"minWidth", [](auto& p) { p.minWidth = 0; }},
      {"maxWidth", [](auto& p) { p.maxWidth = 9; }},
      {"simplifyTolerance", [=](auto& p) { p.simplifyTolerance = nan; }},
  };
  const auto scene = scenes::all()[0];
  for (const Case& c : cases) {
    ToolpathParams params;
    c.spoil(params);
    const auto plate = generateToolpath(scene.input, params, kRun);
    CAPTURE(c.field);
    REQUIRE(!plate.ok());
    CHECK(plate.error().code == ErrorCode::InvalidArgument);
    CHECK(plate.error().message.find(std::string("toolpath.") + c.field) == 0);
    CHECK(plate.error().message.find("must be") != std::string::npos);
  }
}

TEST_CASE("maps whose sides and values do not fit each other are refused") {
  const PlateInput plate = scenes::plate(scenes::shapeOf({scenes::rectangle({0, 0}, {5, 5})}, {5, 5}), scenes::waves());
  const auto refusal = [](const PlateInput& input) {
    const auto made = generateToolpath(input, {}, kRun);
    return made ? std::string() : made.error().message;
  };
  CHECK(refusal(plate).empty());
  PlateInput wrong = plate;
  wrong.directions.height += 1;
  CHECK(refusal(wrong).find("the map of directions is ") == 0);
  wrong = plate;
  wrong.modes.width = -1;
  wrong.modes.height = -1;
  CHECK(refusal(wrong) ==
        "the map of modes is -1 x -1 pixels with 1 values; it must have a pixel at least, and one value for each");
}

TEST_CASE("odd shapes end in an error that says why") {
  const DirectionMap map = scenes::waves();
  std::string message;
  const auto codeOf = [&](const Shape& shape, double spacing) {
    ToolpathParams params;
    params.spacing = spacing;
    const auto plate = generateToolpath(scenes::plate(shape, map), params, kRun);
    REQUIRE(!plate.ok());
    CHECK(plate.error().message.size() > 20);
    message = plate.error().message;
    return plate.error().code;
  };
  const auto square = [](double side) {
    return scenes::shapeOf({scenes::rectangle({0, 0}, {side, side})}, {side, side});
  };
  CHECK(codeOf(square(0.3), 0.4) == ErrorCode::EmptyShape);     // spacing larger than the shape
  CHECK(codeOf({{}, {10, 10}}, 0.4) == ErrorCode::EmptyShape);  // nothing drawn
  CHECK(codeOf(square(9000), 0.05) == ErrorCode::TooLarge);     // 130 thousand million cells
  CHECK(codeOf(square(1999.04), 0.4) == ErrorCode::TooLarge);
  const std::string most = sizeof(void*) == 4 ? "20 million" : "100 million";  // in a browser's 32 bits
  CHECK(message.find("100.1 million cells at spacing 0.4 mm; at most " + most) != std::string::npos);
  CHECK(message.find(sizeof(void*) == 4
                         ? ": use a spacing of at least 0.896 mm, or a size of at most 44 %"
                         : ": use a spacing of at least 0.401 mm, or a size of at most 99 %") != std::string::npos);
  Shape noPage = square(5);
  noPage.page = {0, 5};
  CHECK(codeOf(noPage, 0.4) == ErrorCode::InvalidArgument);
  noPage.page = {std::nan(""), 5};
  CHECK(codeOf(noPage, 0.4) == ErrorCode::InvalidArgument);
}

TEST_CASE("a spur whose sides fall together gets no beads") {
  // The lattice's nodes on it lie inside, outside or on the border as rounding decides.
  for (const double end : {12.0, 12.492992891120309, 9.87}) {
    CAPTURE(end);
    const Shape shape = scenes::shapeOf(
        {{{end, 0}, {end, 3}, {3, 3}, {0, 0}, {end, end}, {0, 0}}, scenes::rectangle({4, 1}, {8, 2})}, {end, end});
    ToolpathParams params;
    params.perimeterMode = PerimeterMode::Soft;
    params.relaxationRounds = 0;
    const auto plate = generateToolpath(scenes::plate(shape, scenes::waves()), params, kRun);
    REQUIRE(plate.ok());
    CHECK(plate.value().toolpath.cycles.size() == 1);
    CHECK(plate.value().apart.empty());
  }
}

TEST_CASE("progress begins at 0, never falls and ends at 1") {
  RunContext run(2);
  std::vector<double> seen;
  std::vector<std::string> stages;
  run.onProgress([&](std::string_view stage, double fraction) {
    seen.push_back(fraction);
    if (stages.empty() || stages.back() != stage) stages.emplace_back(stage);
  });
  const auto scene = scenes::all()[0];
  (void)buildResult(scene.input, {}, run);
  REQUIRE(seen.size() > 5);
  CHECK(seen.front() == 0);
  CHECK(seen.back() == 1);
  CHECK(std::is_sorted(seen.begin(), seen.end()));
  CHECK(stages.size() == 9);
}

TEST_CASE("a cancelled run says so, whichever stage it is in") {
  const auto scene = scenes::all()[0];
  for (const char* stage :
       {"outline", "distance", "lines", "phases", "contour", "stitch", "relaxation", "width", "simplify"}) {
    RunContext run(2);
    run.onProgress([&](std::string_view now, double) {
      if (now == stage) run.requestCancel();
    });
    const auto plate = generateToolpath(scene.input, {}, run);
    CAPTURE(stage);
    REQUIRE(!plate.ok());
    CHECK(plate.error().code == ErrorCode::Cancelled);
  }
}

TEST_CASE("a poll that says yes cancels a run on one thread, and is asked often") {
  const PlateInput input =
      scenes::plate(scenes::shapeOf({scenes::rectangle({0, 0}, {40, 40})}, {40, 40}), scenes::waves());
  RunContext run(1);
  int asked = 0;
  run.onPoll([&] {
    ++asked;
    return false;
  });
  REQUIRE(generateToolpath(input, {}, run).ok());
  CHECK(asked > 200);
  const int half = asked / 2;
  asked = 0;
  run.onPoll([&] { return ++asked == half; });
  const auto plate = generateToolpath(input, {}, run);
  REQUIRE(!plate.ok());
  CHECK(plate.error().code == ErrorCode::Cancelled);
  CHECK(asked == half);  // not asked again once cancelled
}

TEST_CASE("a cancel from another thread ends a long run well before it would end by itself") {
  const PlateInput input =
      scenes::plate(scenes::shapeOf({scenes::rectangle({0, 0}, {120, 120})}, {120, 120}), scenes::waves());
  RunContext run(2);
  std::atomic<bool> phases{false};
  run.onProgress([&](std::string_view stage, double) { phases = phases || stage == "phases"; });
  std::thread canceller([&] {
    while (!phases) std::this_thread::yield();
    run.requestCancel();
  });
  const auto plate = generateToolpath(input, {}, run);
  canceller.join();
  REQUIRE(!plate.ok());
  CHECK(plate.error().code == ErrorCode::Cancelled);
}
