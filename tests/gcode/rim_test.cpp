// The raised border, read back from its file.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "geometry/signed_distance.hpp"
#include "sillon/geometry/shape.hpp"
#include "support/about.hpp"
#include "support/gcode_job.hpp"

using namespace sillon;
using namespace sillon::test;

namespace {

constexpr const char* kRim = "Perimeter";

/// A comb on a plate with a hole: what the cycle covers does not matter to the rim.
Job frame() {
  Job job = plate();
  job.shape.paths[0].rings.push_back({{10, 5}, {10, 15}, {20, 15}, {20, 5}});
  job.params.place = Vec2{50, 60};
  job.params.rim = 3;
  job.params.rimWidth = 1.2;
  return job;
}

}  // namespace

TEST_CASE("a rim stands on the oriented layers, with its beads inside of the shape") {
  const Job job = frame();
  const ReadFile file = checkFile(job, job.write());
  const Outline border = resolveOutline(job.shape).value();
  const RunContext run(1);
  Grid grid{{-1, -1}, 0.2, 160, 110};
  const BorderIndex index = buildBorderIndex(border, grid, run).value();
  const int below = job.params.base + job.params.layers;
  std::set<int> layers;
  std::set<int> depths;  // [nozzle / 2]
  double filament = 0;
  for (const ReadPath& path : file.paths) {
    if (path.layer > below) CHECK(path.role == kRim);
    if (path.role != kRim) continue;
    layers.insert(path.layer);
    filament += path.filament();
    CHECK(path.closed());
    for (const ReadMove& move : path.moves) {
      CHECK(move.z == std::llround(1000 * path.layer * job.params.layerHeight));
      for (int k = 0; k < 4; ++k) {
        const double share = k / 4.0;
        const Vec2 p{(double(move.x0) + share * double(move.x1 - move.x0)) / 1000 - 50,
                     (double(move.y0) + share * double(move.y1 - move.y0)) / 1000 - 60};
        CHECK_FALSE(index.outside(p));
        const double depth = std::abs(index.nearest(p).distance);
        CHECK(depth >= 0.2 - 1e-3);  // half a line wide
        if (k == 0) depths.insert(static_cast<int>(std::lround(depth / 0.2)));
      }
    }
  }
  CHECK(layers == std::set<int>{below + 1, below + 2, below + 3});
  CHECK(*depths.begin() == 1);
  CHECK(*depths.rbegin() == 5);  // three lines, but for corners that are cut
  // A frame around the plate and one around its hole, of 1.2 mm each.
  CHECK(filament == about(3 * 0.2 * (30 * 20 - 27.6 * 17.6 + 12.4 * 12.4 - 100) / kArea, 0.03));
}

TEST_CASE("a rim is counted in times, filament and heights") {
  Job job = frame();
  const Written with = job.write();
  job.params.rim = 0;
  const Written without = job.write();
  CHECK(with.result.value().seconds > without.result.value().seconds + 20);
  CHECK(with.result.value().filamentMm > without.result.value().filamentMm + 20);
  CHECK(valueOf(with.text, "; max_z_height: ") == fixed(0.2 * (job.params.base + job.params.layers + 3), 2));
  CHECK(with.text.find(", rim layers = 3") != std::string::npos);
  CHECK(without.text.find("rim layers") == std::string::npos);
  // The layers below the rim are laid as without it.
  const std::size_t layer = without.text.find(";TYPE:Top solid infill");
  const std::size_t end = without.text.find(";LAYER_CHANGE", layer);
  const auto moves = [](const std::string& text) {
    const std::size_t from = text.find(";TYPE:Top solid infill");
    std::vector<std::string> lines;
    for (const std::string_view line : split(std::string_view(text).substr(from, 20000), '\n')) {
      if (line.starts_with("G1 X") && line.find(" E") != std::string_view::npos) lines.emplace_back(line);
    }
    lines.resize(std::min<std::size_t>(lines.size(), 50));
    return lines;
  };
  CHECK(layer < end);
  CHECK(moves(with.text) == moves(without.text));
}

TEST_CASE("a rim turns with its plate, and copies are passed above it") {
  Job job = frame();
  job.params.rotate = 90;
  job.params.copies = {2, 1};
  job.params.place.reset();
  const Written written = job.write();
  REQUIRE_MESSAGE(written.result.ok(), written.result.error().message);
  CHECK(checkGcode(written.text, job.printer).errors() == 0);
  const ReadFile file = readGcode(written.text);
  CHECK_MESSAGE(file.faults.empty(), file.faults.front());
  CHECK(std::count_if(file.paths.begin(), file.paths.end(), [](const ReadPath& path) { return path.role == kRim; }) ==
        2 * 3 * 6);
  // The way to the second copy leads over the rim of the first.
  const std::int64_t top = std::llround(200 * (job.params.base + job.params.layers + 3));
  const auto farthest = std::max_element(file.travels.begin(), file.travels.end(),
                                         [](const ReadMove& a, const ReadMove& b) { return a.length() < b.length(); });
  REQUIRE(farthest != file.travels.end());
  CHECK(farthest->z > top);
}

TEST_CASE("rims are refused where they cannot stand, with the values") {
  const auto problem = [](Job job) {
    const Written written = job.write();
    REQUIRE_FALSE(written.result.ok());
    CHECK(written.text.empty());
    return written.result.error().message;
  };
  Job job = frame();
  job.params.showSide = ShowSide::Bed;
  CHECK(problem(job) ==
        "print.rim is 3, but what shows lies on the bed; print.showSide must be up for a rim, or print.rim 0");
  job.params.showSide = ShowSide::Both;
  CHECK(problem(job).find("print.rim is 3, ") == 0);
  job = frame();
  job.params.rim = 51;
  CHECK(problem(job) == "print.rim is 51; it must be 0 to 50");
  job = frame();
  job.params.rimWidth = 0;
  CHECK(problem(job) == "print.rimWidth is 0 mm; it must be 0.1 to 100");
  job = frame();
  job.params.rim = 20;
  job.params.copies = {2, 1};
  CHECK(problem(job).find("3 mm") != std::string::npos);
  job = frame();
  job.params.rim = 50;
  job.printer.maxZ = 10;
  CHECK(problem(job).find("10 mm") != std::string::npos);
  job = frame();
  job.shape = rectangle(30, 0.35);
  job.params.base = 0;
  job.toolpath.cycles = {comb(30, 20, 0.4, 5)};
  CHECK(problem(job).find("too thin for lines of 0.4 mm") != std::string::npos);
}

TEST_CASE("a rim as wide as the plate fills it, and one thinner than a line is one line") {
  Job job = frame();
  job.params.rim = 1;
  job.params.rimWidth = 100;
  const auto linesOf = [](const Job& one) {
    const ReadFile file = checkFile(one, one.write());
    return std::count_if(file.paths.begin(), file.paths.end(), [](const ReadPath& path) { return path.role == kRim; });
  };
  CHECK(linesOf(job) > 12);
  job.params.rimWidth = 0.1;
  CHECK(linesOf(job) == 2);
}

TEST_CASE("between the loops of a rim the nozzle stays off the face, but for one short way to each hole") {
  Job job = frame();
  job.shape.paths[0].rings.push_back({{23, 5}, {23, 15}, {27, 15}, {27, 5}});
  job.params.rim = 5;
  const ReadFile file = checkFile(job, job.write());
  const Outline border = resolveOutline(job.shape).value();
  const BorderIndex index = buildBorderIndex(border, {{-1, -1}, 0.2, 160, 110}, RunContext(1)).value();
  const double face = job.params.layerHeight * (job.params.base + job.params.layers);
  std::map<std::int64_t, double> crossed;  // by height [mm]
  for (const ReadMove& travel : file.travels) {
    const double z = double(travel.z) / 1000 - job.printer.lift;
    if (z < face + 1.5 * job.params.layerHeight || z > face + 5.5 * job.params.layerHeight) continue;
    const int steps = static_cast<int>(travel.length() / 0.1) + 1;
    for (int k = 0; k < steps; ++k) {
      const double share = (k + 0.5) / steps;
      const Vec2 p{(double(travel.x0) + share * double(travel.x1 - travel.x0)) / 1000 - 50,
                   (double(travel.y0) + share * double(travel.y1 - travel.y0)) / 1000 - 60};
      const bool seen = !index.outside(p) && std::abs(index.nearest(p).distance) > job.params.rimWidth;
      crossed[travel.z] += seen ? travel.length() / steps : 0;
    }
  }
  REQUIRE(crossed.size() >= 4);
  // From the outline to a hole are 5 mm, and 3 mm to the next one, less the rims on both sides.
  for (const auto& layer : crossed) {
    CAPTURE(layer.first);
    CHECK(layer.second < 2.6 + 0.6 + 0.5);
  }
  // Neighbouring layers begin elsewhere, so that seams make no line.
  std::set<std::pair<std::int64_t, std::int64_t>> starts;
  int layer = 0;
  for (const ReadPath& path : file.paths) {
    if (path.role != kRim || path.layer == layer) continue;
    layer = path.layer;
    starts.insert({path.moves.front().x0, path.moves.front().y0});
  }
  CHECK(starts.size() == 5);
}
