#include "sillon/gcode/writer.hpp"

#include <algorithm>
#include <functional>

#include "gcode/job.hpp"
#include "support/about.hpp"
#include "support/gcode_job.hpp"

using namespace sillon;
using namespace sillon::test;

namespace {

struct PatchJob {
  PatchPlate plate{rectangle(30, 20), {{.layer = 1, .lines = {{{{5, 5}, {25, 5}}, {0.4, 0.4}}}}}};
  Printer printer;
  PrintParams params;

  PatchJob() { params.base = 1; }

  [[nodiscard]] Result<GcodeSummary> write(std::string& text) const {
    return writePatches(plate, printer, params, [&](std::string_view piece) {
      text += piece;
      return true;
    });
  }
};

std::string refused(const std::function<void(PatchJob&)>& change) {
  PatchJob job;
  change(job);
  std::string text;
  const Result<GcodeSummary> result = job.write(text);
  CHECK(text.empty());
  return result ? "written" : result.error().message;
}

}  // namespace

TEST_CASE("a line of a patch has the plastic of its cell times its flow, and its own speed") {
  PatchJob job;
  job.plate.patches[0].flow = 0.9;
  job.plate.patches[0].speed = 33;
  std::string text;
  const Result<GcodeSummary> result = job.write(text);
  REQUIRE_MESSAGE(result.ok(), result.error().message);
  const ReadFile file = readGcode(text);
  CHECK(file.faults.empty());
  const ReadPath& path = file.paths.back();
  CHECK(path.layer == 2);
  CHECK(path.filament() * kArea == doctest::Approx(0.9 * 20 * 0.4 * 0.2).epsilon(1e-4));
  CHECK(path.moves.front().feedrate == 33 * 60);
  CHECK(path.retractsAfter);
  CHECK(text.find("; test piece = 30.0x20.0 mm, layers = 1, base layers = 1\n") != std::string::npos);
  CHECK(checkGcode(text, job.printer).findings.empty());
}

TEST_CASE("patches that cannot be printed as they say are refused before a byte is written") {
  const auto first = [](PatchJob& job) -> Patch& { return job.plate.patches[0]; };
  CHECK(refused([&](PatchJob& job) { first(job).layer = 0; }).find("layer is 0; it must be 1 to 1") !=
        std::string::npos);
  CHECK(refused([&](PatchJob& job) { first(job).layer = 2; }).find("layer is 2") != std::string::npos);
  CHECK(refused([&](PatchJob& job) { first(job).flow = 3; }).find("flow is 3; it must be 0.01 to 2") !=
        std::string::npos);
  CHECK(refused([&](PatchJob& job) { first(job).flow = kNan; }).find("flow is not a number") != std::string::npos);
  CHECK(refused([&](PatchJob& job) { first(job).fan = 101; }).find("fan is 101 %") != std::string::npos);
  CHECK(refused([&](PatchJob& job) { first(job).fan = kNan; }).find("fan is not a number") != std::string::npos);
  CHECK(refused([&](PatchJob& job) { first(job).speed = 200; }).find("needs 16 mm3/s; printer.maxFlow is 10") !=
        std::string::npos);
  CHECK(refused([&](PatchJob& job) {
          first(job).speed = 100;
          job.printer.machineSpeed = 80;
        }).find("speed is 100 mm/s; it must be 0 to 80 mm/s") != std::string::npos);
  CHECK(refused([&](PatchJob& job) {
          first(job).constantFlow = true;
        }).find("patches[0].spacing is 0 mm; it must be ") != std::string::npos);
  CHECK(refused([&](PatchJob& job) { first(job).lines[0].widths[0] = 0.2; }).find("it must be 0.24 to 0.64 mm") !=
        std::string::npos);
  CHECK(refused([&](PatchJob& job) { first(job).lines[0].widths.pop_back(); }).find("2 points and 1 widths") !=
        std::string::npos);
  CHECK(refused([&](PatchJob& job) { first(job).lines[0].points[0].x = kInfinity; }).find("coordinates must be") !=
        std::string::npos);
  CHECK(refused([&](PatchJob& job) { first(job).lines[0].points[0].x = 31; }).find("outside the shape") !=
        std::string::npos);
  CHECK(refused([&](PatchJob& job) {
          first(job).lines[0].points[1] = {5, 5};
        }).find("a line of no length") != std::string::npos);
  CHECK(refused([&](PatchJob& job) { job.plate.patches.clear(); }).find("nothing to print") != std::string::npos);
  CHECK(refused([&](PatchJob& job) { job.params.rotate = 90; }).find("rotate 0") != std::string::npos);
  CHECK(refused([&](PatchJob& job) { job.params.showSide = ShowSide::Bed; }).find("showSide must be up") !=
        std::string::npos);
  CHECK(refused([&](PatchJob& job) { job.plate.shape = {}; }).find("no area") != std::string::npos);
  CHECK(refused([&](PatchJob& job) {
          job.printer.bedMax = {25, 25};
        }).find("over the edge of the bed") != std::string::npos);
}

TEST_CASE("the fan is told once where it changes between patches, and is off at the end") {
  PatchJob job;
  const Patch plain = job.plate.patches[0];
  const auto add = [&](int layer, double y) -> Patch& {
    Patch patch = plain;
    patch.layer = layer;
    for (Vec2& p : patch.lines[0].points) p.y = y;
    job.plate.patches.push_back(patch);
    return job.plate.patches.back();
  };
  job.params.layers = 2;
  job.plate.patches[0].fan = 0;
  add(1, 7).fan = 0.5;
  add(1, 9);
  add(2, 5);
  add(2, 7).fan = 100;
  std::string text;
  const Result<GcodeSummary> result = job.write(text);
  REQUIRE_MESSAGE(result.ok(), result.error().message);
  std::string said;
  bool begun = false;
  for (const std::string_view line : split(text, '\n')) {
    begun = begun || line == ";Z:0.4";
    if (begun && (line.starts_with("M10") || line.starts_with("M9") || line == ";LAYER_CHANGE")) {
      said += std::string(line) + "\n";
    }
  }
  std::vector<std::string> beads;  // by their height on the bed: the plate's corner lies at (95, 100)
  for (const ReadPath& path : readGcode(text).paths) {
    if (path.layer > 1) beads.push_back(fixed(static_cast<double>(path.moves[0].y1) / 1000, 3));
  }
  CHECK(beads == std::vector<std::string>{"105.000", "107.000", "109.000", "105.000", "107.000"});
  CHECK(said == "M106 S255\nM104 S215\nM106 S0\nM106 S1\nM106 S255\n;LAYER_CHANGE\nM104 S0\nM107\n");
}
