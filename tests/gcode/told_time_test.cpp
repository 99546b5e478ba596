// What a file tells of time, against a clock that reads its lines. Machines here need no time to change their speed.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/gcode/patches.hpp"
#include "support/about.hpp"
#include "support/gcode_job.hpp"

using namespace sillon;
using namespace sillon::test;

namespace {

struct Progress {
  int percent;
  int minutes;
  double at;  // [s]
};

struct Clock {
  double seconds = 0;
  double printed = 0;          // [s], when the last layer is done
  std::vector<double> layers;  // [s]
  std::vector<Progress> told;  // but for the last line of the file
  std::vector<double> beads;   // [s], when each ends
};

// Each move takes its length over its feedrate. The first way up is not known: nothing says where the nozzle stands.
Clock clockOf(std::string_view text) {
  Clock clock;
  double x = 0, y = 0, z = 0, e = 0, feedrate = 0, layerBegan = -1;
  bool lifted = false, absoluteE = false;
  const auto endLayer = [&] {
    if (layerBegan >= 0) clock.layers.push_back(clock.seconds - layerBegan);
    layerBegan = -1;
  };
  for (const std::string_view line : split(text, '\n')) {
    if (line == "M82" || line == "M83") absoluteE = line == "M82";
    if (line == "G92 E0") e = 0;
    if (line == ";LAYER_CHANGE") {
      endLayer();
      layerBegan = clock.seconds;
    }
    if (line == ";TYPE:Custom") {
      endLayer();
      clock.printed = clock.seconds;
    }
    if (line.starts_with("M73 P") && line != "M73 P100 R0") {
      const std::string words(line);
      clock.told.push_back(
          {std::atoi(words.c_str() + 5), std::atoi(words.c_str() + words.find('R') + 1), clock.seconds});
    }
    if (!line.starts_with("G1 ")) continue;
    double toX = x, toY = y, toZ = z, drawn = 0;
    bool up = false;
    for (const std::string_view word : split(line.substr(3), ' ')) {
      const double value = std::strtod(std::string(word.substr(1)).c_str(), nullptr);
      if (word[0] == 'X') toX = value;
      if (word[0] == 'Y') toY = value;
      if (word[0] == 'Z') toZ = value, up = true;
      if (word[0] == 'F') feedrate = value;
      if (word[0] == 'E') {
        drawn = absoluteE ? value - e : value;
        e = value;
      }
    }
    const double plane = std::hypot(toX - x, toY - y);
    const double way = plane > 0 ? plane : up ? (lifted ? std::abs(toZ - z) : 0) : std::abs(drawn);
    clock.seconds += way / (feedrate / 60);
    if (plane > 0 && drawn > 0) clock.beads.push_back(clock.seconds);
    lifted = lifted || up;
    x = toX;
    y = toY;
    z = toZ;
  }
  return clock;
}

Job atOnce(double width = 30, double height = 20) {
  Job job = plate(width, height);
  job.printer.acceleration = 100000;
  job.printer.cornerSpeed = 100;
  return job;
}

void checkTold(std::string_view text, const GcodeSummary& summary) {
  const Clock clock = clockOf(text);
  CHECK(summary.seconds == about(clock.seconds, 1e-4));
  REQUIRE(clock.told.size() > 2);
  CHECK(clock.told.front().percent == 0);
  CHECK(clock.told.front().at == 0);
  CHECK(clock.told.front().minutes == std::lround(clock.printed / 60));
  for (const Progress& told : clock.told) {
    // Layers of one kind are taken to last alike, though they begin elsewhere.
    CHECK(std::abs(told.percent - std::floor(100 * told.at / clock.printed)) < 1.01);
    CHECK(std::abs(told.minutes - (clock.printed - told.at) / 60) < 0.5 + 0.01 * clock.printed / 60);
  }
}

}  // namespace

TEST_CASE("the time told is the sum of the moves' lengths over their speeds, and progress tells its shares") {
  const std::vector<std::function<void(Job&)>> changes = {
      [](Job&) {},
      [](Job& j) { j.params.base = 0; },
      [](Job& j) { j.params.coast = 0.8; },
      [](Job& j) { j.params.scarf = 5; },
      [](Job& j) { j.printer.absoluteE = true; },
      [](Job& j) { j.printer.retractLength = j.printer.lift = 0; },
      [](Job& j) { j.printer.minLayerTime = 40; },
      [](Job& j) {
        j.params.skirt = 0;
        j.params.purgeLength = 0;
        j.params.layers = 5;
        j.params.basePattern = BasePattern::Same;
      },
      [](Job& j) {
        j.params.copies = {2, 2};
        j.params.brim = 2;
        j.params.showSide = ShowSide::Both;
        j.params.firstLayerHeight = 0.3;
        j.printer.flavor = GcodeFlavor::PrusaBuddy;
      },
      [](Job& j) {
        j.params.startHeight = 7;
        j.printer.baseSpeed = 33;
      },
  };
  for (std::size_t k = 0; k < changes.size(); ++k) {
    CAPTURE(k);
    Job job = atOnce();
    changes[k](job);
    const Written written = job.write();
    REQUIRE_MESSAGE(written.result.ok(), written.result.error().message);
    checkTold(written.text, written.result.value());
  }
}

TEST_CASE("of a single layer the progress is exact: a line as soon as a bead completes the next percent") {
  for (const double side : {20.0, 60.0, 150.0}) {
    Job job = atOnce(side, side);
    job.params.base = 0;
    const Written written = job.write();
    const Clock clock = clockOf(written.text);
    REQUIRE(clock.told.size() > 60);
    for (const Progress& told : clock.told) {
      CHECK(std::abs(100 * told.at / clock.printed - 0.5 - told.percent) < 0.5 + 1e-3);
      CHECK(std::abs((clock.printed - told.at) / 60 - told.minutes) < 0.5 + 1e-3);
    }
    CHECK(clock.told.back().percent == 99);
    auto last = clock.told.begin();
    for (const double bead : clock.beads) {
      while (last + 1 != clock.told.end() && (last + 1)->at <= bead + 1e-9) ++last;
      CHECK(last->percent >= std::min(99.0, std::floor(100 * bead / clock.printed - 1e-3)));
    }
  }
}

TEST_CASE("patches take the time of their own speeds, and progress knows") {
  PatchPlate patches{rectangle(30, 20),
                     {{.layer = 1, .lines = {{{{5, 5}, {25, 5}}, {0.4, 0.4}}}, .speed = 10},
                      {.layer = 1, .lines = {{{{5, 8}, {25, 8}}, {0.4, 0.4}}}},
                      {.layer = 2, .lines = {{{{5, 5}, {25, 5}}, {0.4, 0.4}}}, .speed = 7}}};
  Job job = atOnce();
  job.params.base = 1;
  job.params.layers = 2;
  std::string text;
  const auto result = writePatches(patches, job.printer, job.params, [&](std::string_view piece) {
    text += piece;
    return true;
  });
  REQUIRE_MESSAGE(result.ok(), result.error().message);
  checkTold(text, result.value());
  const Clock clock = clockOf(text);
  REQUIRE(clock.layers.size() == 3);
  CHECK(clock.layers[1] > 20 / 10.0 + 20 / 50.0);
  CHECK(clock.layers[2] > 20 / 7.0);
}

TEST_CASE("each layer takes the time that plastic needs to set, of every kind and copy, and hardly more") {
  for (const ShowSide side : {ShowSide::Up, ShowSide::Bed, ShowSide::Both}) {
    CAPTURE(static_cast<int>(side));
    Job job = atOnce(20, 12);
    job.params.showSide = side;
    job.params.layers = 2;
    job.params.base = 3;
    job.params.copies = {2, 1};
    job.printer.flavor = GcodeFlavor::RepRap;
    job.printer.baseSpeed = 90;
    job.printer.showSpeed = 60;
    const auto times = [&](double least) {
      job.printer.minLayerTime = least;
      return clockOf(job.write().text).layers;
    };
    const std::vector<double> freely = times(0);
    const std::vector<double> held = times(50);
    const std::size_t count = side == ShowSide::Both ? 14 : 10;
    REQUIRE(freely.size() == count);
    REQUIRE(held.size() == count);
    for (std::size_t k = 0; k < count; ++k) {
      CAPTURE(k);
      CHECK(freely[k] < 45);
      // A layer that begins elsewhere than the one that was timed takes a little more or less; speeds are whole mm/s.
      CHECK(held[k] > 0.97 * 50);
      CHECK(held[k] < 1.1 * 50);
    }
  }
}

TEST_CASE("a layer with slow ways between its beads is slowed until it takes its time, too") {
  // Of 1 + 8 mm up and down at 1 mm/s nothing gets slower by slower beads.
  Job job = atOnce(20, 12);
  job.params.base = 0;
  job.params.skirt = 0;
  job.printer.firstLayerSpeed = 50;
  job.printer.retractLength = 4;
  job.printer.retractSpeed = 1;
  job.printer.minLayerTime = 0;
  const double freely = clockOf(job.write().text).layers.at(0);
  const double beads = 20 * 12 / 0.4 / 50;
  const double ways = freely - beads;
  CHECK(ways > 6);
  const double least = 2.2 * freely;
  job.printer.minLayerTime = least;
  const double held = clockOf(job.write().text).layers.at(0);
  CHECK(held >= 0.98 * least);
  CHECK(held < 1.1 * least);  // speeds are whole mm/s
}

TEST_CASE("layers slow down to 5 mm/s for the time they take, and no further") {
  Job job = atOnce(12, 12);
  job.printer.minLayerTime = 300;
  for (const ReadPath& path : readGcode(job.write().text).paths) {
    if (path.layer == 0) continue;
    for (const ReadMove& move : path.moves) CHECK(move.feedrate == 300);
  }
  job.printer.baseSpeed = 3;  // as asked for
  for (const ReadPath& path : readGcode(job.write().text).paths) {
    if (path.role != "Solid infill" || path.layer == 1) continue;
    for (const ReadMove& move : path.moves) CHECK(move.feedrate == 180);
  }
}
