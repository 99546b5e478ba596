// Neighbour delay against closed forms, and against a reading of whole files that compares each piece with all others.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "gcode_reader/coverage.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "sillon/job/plate.hpp"
#include "support/gcode_check.hpp"

using namespace sillon;
using namespace sillon::test;

namespace {

/// An oriented bead 10 mm long and 0.4 mm wide.
LaidBead beadAt(float y, float begin, int layer = 0) {
  return {{0, y}, {10, y}, 0.4f, false, layer, 0.2f * static_cast<float>(layer + 1), begin, 1};
}

struct Piece {
  Vec2 at;
  Vec2 along;
  double length;
  double time;
};

// The delay as metrics.md defines it for beads of one width, without any grid. Reads the file's moves by itself.
NeighbourDelay bruteForce(const std::string& text, double width) {
  std::vector<Piece> pieces;
  double clock = 0;
  double x = 0;
  double y = 0;
  double feed = 0;
  bool oriented = false;
  int layer = 0;
  int last = 0;
  for (const std::string_view raw : split(text, '\n')) {
    const std::string line(raw);
    if (line == ";LAYER_CHANGE") ++layer;
    if (line.starts_with(";TYPE:")) oriented = line == ";TYPE:Top solid infill";
    if (!line.starts_with("G1 ") && !line.starts_with("G0 ")) continue;
    const auto word = [&](char letter, double otherwise) {
      const std::size_t at = line.find(std::string(" ") + letter);
      return at == std::string::npos ? otherwise : std::stod(line.substr(at + 2));
    };
    feed = word('F', feed);
    const Vec2 from{x, y};
    const Vec2 to{word('X', x), word('Y', y)};
    x = to.x;
    y = to.y;
    const double size = length(to - from);
    if (!(size > 0)) continue;
    const double seconds = size / (feed / 60);
    if (oriented && word('E', 0) > 0) {
      if (layer != last) pieces.clear();
      last = layer;
      const int count = std::max(1, static_cast<int>(size / width));
      for (int k = 0; k < count; ++k) {
        const double share = (k + 0.5) / count;
        pieces.push_back({from + share * (to - from), (1 / size) * (to - from), size / count, clock + share * seconds});
      }
    }
    clock += seconds;
  }
  NeighbourDelay delay;
  double all = 0;
  for (const Piece& piece : pieces) {
    double sides[2] = {-1, -1};
    bool before[2] = {false, false};
    for (const Piece& other : pieces) {
      const Vec2 to = other.at - piece.at;
      const double across = cross(piece.along, to);
      if (std::abs(dot(piece.along, to)) > 0.6 * width) continue;
      if (std::abs(across) < 0.6 * width || std::abs(across) > 1.4 * width) continue;
      const int side = across > 0 ? 1 : 0;
      const double wait = std::abs(other.time - piece.time);
      if (sides[side] >= 0 && sides[side] <= wait) continue;
      sides[side] = wait;
      before[side] = other.time < piece.time;
    }
    const double wait = std::max(sides[0], sides[1]);
    if (wait < 0) continue;
    all += piece.length;
    if (wait > 30) delay.over30 += piece.length;
    if (wait > 120) delay.over120 += piece.length;
    if (before[0] && before[1]) delay.squeezed += piece.length;
  }
  delay.over30 /= all;
  delay.over120 /= all;
  delay.squeezed /= all;
  return delay;
}

}  // namespace

TEST_CASE("a bead waits for the later of its two neighbours") {
  // Laid at 0, 41 and 201 s: the first waits 41 s, the others 160 s.
  const std::optional<NeighbourDelay> delay = neighbourDelay({beadAt(0, 0), beadAt(0.4f, 41), beadAt(0.8f, 201)});
  REQUIRE(delay);
  CHECK(delay->over30 == doctest::Approx(1));
  CHECK(delay->over120 == doctest::Approx(2.0 / 3));
  CHECK(delay->most == doctest::Approx(160));
  CHECK(delay->squeezed == 0);
}

TEST_CASE("a bead is squeezed where both of its neighbours were laid before it") {
  CHECK(neighbourDelay({beadAt(0, 0), beadAt(0.8f, 10), beadAt(0.4f, 20)})->squeezed == doctest::Approx(1.0 / 3));
  // Laid later on both sides; and beside one bead only.
  CHECK(neighbourDelay({beadAt(0.4f, 0), beadAt(0, 10), beadAt(0.8f, 20)})->squeezed == 0);
  // The nearest in time on a side tells, and a bead over two others on one side leans on the later of them.
  CHECK(neighbourDelay({beadAt(0, 0), beadAt(0.8f, 10), beadAt(0.4f, 20), beadAt(0.8f, 21)})->squeezed == 0);
}

TEST_CASE("a purge in the air is no layer that is seen") {
  // Marked as no oriented bead, or in the start block, which may end 50 mm above the bed.
  Project project;
  project.builtin = BuiltinShape::Disc;
  project.builtinSize = {10, 0};
  project.printer.startGcode = "G28\nM190 S60\nM109 S220\nG1 Z50 F600\nG1 X20 Y20 F3000\nG1 X60 E9 F300\n";
  const auto read = [&] {
    const RunContext run(1);
    const auto noFiles = [](const std::string& name, const std::string&) -> Result<InputFile> {
      return Error{ErrorCode::InvalidFile, "there is no " + name};
    };
    std::string text;
    const auto sink = [&](std::string_view piece) {
      text += piece;
      return true;
    };
    Result<Plate> plate = makePlate(project, noFiles, {}, run);
    REQUIRE_MESSAGE(plate.ok(), plate.error().message);
    REQUIRE_FALSE(writePlateGcode(plate.value(), {}, sink, run));
    return *checkGcode(text, project.printer).delay;
  };
  const NeighbourDelay purged = read();
  project.printer.startGcode = "G28\nM190 S60\nM109 S220\n";
  CHECK(purged.most == doctest::Approx(read().most).epsilon(0.01));
}

TEST_CASE("beads side by side that are laid at once wait for nothing, and single ones have no neighbour") {
  const std::optional<NeighbourDelay> delay = neighbourDelay({beadAt(0, 0), beadAt(0.4f, 1), beadAt(0.8f, 2)});
  REQUIRE(delay);
  CHECK(delay->over30 == 0);
  CHECK(delay->most <= 2);
  CHECK_FALSE(neighbourDelay({beadAt(0, 0), beadAt(1.2f, 100)}));
  CHECK_FALSE(neighbourDelay({}));
}

TEST_CASE("only the lowest and the highest layer of a stack are seen") {
  std::vector<LaidBead> beads = {beadAt(0, 0, 0), beadAt(0.4f, 1, 0)};
  for (const LaidBead& hidden : {beadAt(0, 10, 1), beadAt(0.4f, 500, 1)}) beads.push_back(hidden);
  for (const LaidBead& top : {beadAt(0, 600, 2), beadAt(0.4f, 601, 2)}) beads.push_back(top);
  CHECK(neighbourDelay(beads)->over30 == 0);
  beads.back().begin = 700;
  CHECK(neighbourDelay(beads)->over30 == doctest::Approx(0.5));
  for (LaidBead& bead : beads) bead.base = bead.layer < 2;
  CHECK(neighbourDelay(beads)->over30 == doctest::Approx(1));
}

TEST_CASE("the delay of a file is what a comparison of all pieces with all others finds") {
  for (const double angle : {0.0, 35.0}) {
    CAPTURE(angle);
    Project project;
    project.builtin = BuiltinShape::Disc;
    project.builtinSize = {16, 0};
    project.layers.emplace_back().as<LayerAngle>()->angle = angle;
    project.toolpath.spacing = 0.4;
    project.toolpath.order = BeadOrder::Plain;  // so that there are long delays
    project.toolpath.spacingVariation = 0;
    project.printer.showSpeed = 4;  // slow, so that a small plate has long delays
    const RunContext run(1);
    const auto noFiles = [](const std::string& name, const std::string&) -> Result<InputFile> {
      return Error{ErrorCode::InvalidFile, "there is no " + name};
    };
    Result<Plate> plate = makePlate(project, noFiles, {}, run);
    REQUIRE_MESSAGE(plate.ok(), plate.error().message);
    std::string text;
    const auto sink = [&](std::string_view piece) {
      text += piece;
      return true;
    };
    REQUIRE_FALSE(writePlateGcode(plate.value(), {}, sink, run));
    const std::optional<NeighbourDelay> read = checkGcode(text, plate.value().project.printer).delay;
    REQUIRE(read);
    const NeighbourDelay all = bruteForce(text, 0.4);
    CHECK(all.over30 > 0.1);
    // Widths of single beads differ from the spacing, and with them which pieces count as beside one another.
    CHECK(std::abs(read->over30 - all.over30) < 0.03);
    CHECK(std::abs(read->over120 - all.over120) < 0.03);
    CHECK(all.squeezed > 0.05);
    CHECK(std::abs(read->squeezed - all.squeezed) < 0.03);
  }
}
