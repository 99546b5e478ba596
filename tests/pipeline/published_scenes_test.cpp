// The scenes published with the paper: promises on all, figures on those of its tables.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "assemble.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "sillon/quality/metrics.hpp"
#include "sillon/settings/presets.hpp"

using namespace sillon;
namespace fs = std::filesystem;

namespace {

struct Figures {
  double alignment;  ///< at most; 0: not judged
  double coverage;   ///< at least
  double overlap;    ///< at most
};

fs::path scenesFolder() { return fs::path(SILLON_SOURCE_DIR) / "examples" / "paper"; }

struct Made {
  ToolpathResult plate;
  Measures measures;
};

Made makeScene(const fs::path& path, const std::string& preset = "standard") {
  auto project = cli::loadProject(path.string());
  REQUIRE_MESSAGE(project.ok(), (project.ok() ? "" : project.error().message));
  const auto input = cli::assemblePlate(project.value());
  REQUIRE_MESSAGE(input.ok(), (input.ok() ? "" : input.error().message));
  ToolpathParams& params = project.value().toolpath;
  REQUIRE_FALSE(applyPreset(preset, params));
  const RunContext run(2);
  auto plate = generateToolpath(input.value(), params, run);
  REQUIRE(plate.ok());
  auto measures = measureToolpath(plate.value().toolpath, input.value(), params, run);
  REQUIRE(measures.ok());
  return {std::move(plate).value(), std::move(measures).value()};
}

}  // namespace

TEST_CASE("published scenes become one simple toolpath per part, without spill and with the figures of the README") {
  const fs::path folder = scenesFolder();
  const std::map<std::string, Figures> figures = {
      {"brain", {-0.938, 96.5, 0.6}}, {"wave", {-0.966, 97.8, 0.5}},   {"tiles_square", {-0.972, 98.4, 0.6}},
      {"teaser", {0, 98.0, 0.6}},     {"people", {-0.936, 97.3, 0.6}}, {"ani_to_iso", {-0.957, 97.8, 0.6}}};
  std::vector<fs::path> scenes;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".json") scenes.push_back(entry.path());
  }
  std::sort(scenes.begin(), scenes.end());
  CHECK(scenes.size() == 19);
  for (const fs::path& path : scenes) {
    const std::string name = path.stem().string();
    CAPTURE(name);
    const Made made = makeScene(path);
    const Measures& m = made.measures;
    CHECK(made.plate.parts == 1);
    CHECK(made.plate.toolpath.cycles.size() == 1);
    CHECK(m.crossings == 0);
    CHECK(m.spill <= 0.05);
    const auto wanted = figures.find(name);
    if (wanted == figures.end()) continue;
    if (wanted->second.alignment < 0) CHECK(m.alignment <= wanted->second.alignment);
    CHECK(m.coverage >= wanted->second.coverage);
    CHECK(m.overlap <= wanted->second.overlap);
  }
}

TEST_CASE("the preset of 2023 comes within 0.005 of the alignment that was published (Table 5)") {
  const std::map<std::string, double> published = {
      {"wave", -0.958}, {"brain", -0.930}, {"people", -0.924}, {"ani_to_iso", -0.946}};
  for (const auto& entry : published) {
    CAPTURE(entry.first);
    const Made made = makeScene(scenesFolder() / (entry.first + ".json"), "paper-2023");
    CHECK(std::abs(made.measures.alignment - entry.second) <= 0.005);
    CHECK(made.measures.crossings == 0);
  }
}
