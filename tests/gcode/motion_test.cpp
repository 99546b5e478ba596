#include "gcode/motion.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/gcode_reader/check.hpp"
#include "support/about.hpp"
#include "support/gcode_job.hpp"

using namespace sillon;
using namespace sillon::test;
using doctest::Approx;

TEST_CASE("widths beyond 0.6 and 1.6 nozzle are held there and reported") {
  Job job = plate();
  job.params.base = 0;
  job.params.layers = 3;
  job.params.flow = 1;
  job.toolpath.cycles = {{{{1, 1}, {11, 1}, {11, 11}, {1, 11}}, {0.1f, 0.1f, 0.4f, 0.4f}}};
  const Written written = job.write();
  const ReadFile file = checkFile(job, written);
  CHECK(written.result.value().clampedLengthMm == Approx(60));  // one whole segment and two halves, three times
  CHECK(contains(written.result.value().warnings, "50 % of the path is printed with a width held at 0.24 or 0.64 mm"));
  CHECK(lastPath(file).filament() == about(extrusion(0.2, 0.24 + 0.32 + 0.4 + 0.32, 10), 1e-4));
  job.toolpath.cycles[0].widths = {0.24f, 0.24f, 0.64f, 0.64f};
  CHECK(job.write().result.value().clampedLengthMm == 0);
}

TEST_CASE("a thread across a gap stays a hair, and beads beside it keep their widths") {
  Job job = plate();
  job.params.base = 0;
  job.params.flow = 1;
  const float thread = 0.0008f;
  job.toolpath.cycles = {{{{1, 1}, {5, 1}, {5.1f, 1}, {7, 1}, {7.1f, 1}, {11, 1}, {11, 11}, {1, 11}},
                          {0.4f, 0.4f, thread, thread, 0.4f, 0.4f, 0.4f, 0.4f}}};
  const Written written = job.write();
  CHECK(written.result.value().clampedLengthMm == 0);
  CHECK_FALSE(contains(written.result.value().warnings, "no wider than the layer"));
  double hairs = 0;
  double beads = 0;
  const ReadFile file = readGcode(written.text);
  for (const ReadMove& move : lastPath(file).moves) {
    const double width = static_cast<double>(move.e) * 1e-5 * kArea / (0.2 * move.length());
    if (std::abs(width - 0.02 * 0.4) < 0.001) hairs += move.length();
    if (std::abs(width - 0.4) < 0.002) beads += move.length();
  }
  CHECK(hairs == about(1.9, 1e-6));
  CHECK(beads == about(37.9, 1e-6));
}

TEST_CASE("no move of a thread is a travel, however little filament its steps take") {
  Job job = plate();
  job.params.base = 0;
  Cycle cycle{{{1, 1}, {5, 1}}, {0.4f, 0.0008f}};
  for (int k = 1; k <= 50; ++k) {  // steps of 14 µm, each turning a little; a hair takes 0.9 of the last digit in one
    cycle.points.push_back({5 + 0.01f * static_cast<float>(k), 1 + 0.01f * static_cast<float>(k % 2)});
    cycle.widths.push_back(0.0008f);
  }
  for (const Vec2f p : {Vec2f{11, 1}, Vec2f{11, 11}, Vec2f{1, 11}}) {
    cycle.points.push_back(p);
    cycle.widths.push_back(0.4f);
  }
  job.toolpath.cycles = {cycle};
  const Written written = job.write();
  const ReadFile file = readGcode(written.text);
  std::int64_t steps = 0;
  for (const ReadMove& move : lastPath(file).moves) {
    CHECK(move.e > 0);
    if (move.length() < 0.02) steps += move.e;
  }
  CHECK(steps == 50);  // one digit each
  CHECK(checkGcode(written.text, job.printer).errors() == 0);
}

TEST_CASE("smooth widths stay bit for bit, and change in steps") {
  BeadPath path = pathOf({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, 0.4, true);
  path.widths = {0.4, 0.5, 0.45, 0.3};
  const Motion motion = planMotion(path, 0, someLimits());
  REQUIRE(motion.widths.size() == 1 + 5 + 3 + 8 + 5);
  for (const auto& [point, width] :
       std::vector<std::pair<std::size_t, double>>{{0, 0.4}, {5, 0.5}, {8, 0.45}, {16, 0.3}, {21, 0.4}})
    CHECK(motion.widths[point] == width);
  CHECK(motion.beads == motion.lengths.size());
  for (std::size_t i = 0; i < motion.lengths.size(); ++i) {
    CHECK(std::abs(motion.widths[i + 1] - motion.widths[i]) <= 0.02 + 1e-12);
  }
  CHECK(motion.points[1] == PointUm{2000, 0});
}

TEST_CASE("a short segment becomes as many moves as are 33 micrometres long") {
  MotionLimits limits = someLimits();
  limits.pressureAdvance = 0;
  for (const auto& [length, moves] : {std::pair{0.3, 9}, {0.1, 3}, {0.07, 2}, {0.06, 1}}) {
    BeadPath path = pathOf({{0, 0}, {length, 0}}, 0.3);
    path.widths[1] = 0.55;  // 13 steps of 0.02 mm, if there is room
    CHECK(planMotion(path, 0, limits).lengths.size() == static_cast<std::size_t>(moves));
  }
}

TEST_CASE("a coast begins on the path where its length is left, with the width that the path has there") {
  MotionLimits limits = someLimits();
  limits.pressureAdvance = 0;
  BeadPath path = pathOf({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, 0.4, true);
  path.widths[3] = 0.404;  // from here back to the beginning
  limits.coast = 2.5;
  const Motion within = planMotion(path, 0, limits);
  REQUIRE(within.lengths.size() == 5);
  CHECK(within.beads == 4);
  CHECK(within.points[4] == PointUm{0, 2500});
  CHECK(within.widths[4] == Approx(0.401));
  CHECK(within.lengths[3] == Approx(7.5));
  CHECK(within.lengths[4] == Approx(2.5));
  limits.coast = 10;  // all of the last segment
  const Motion whole = planMotion(path, 0, limits);
  CHECK(whole.lengths.size() == 4);
  CHECK(whole.beads == 3);
  limits.coast = 12.5;  // and some of the one before
  const Motion more = planMotion(path, 0, limits);
  REQUIRE(more.lengths.size() == 5);
  CHECK(more.beads == 3);
  CHECK(more.points[3] == PointUm{2500, 10000});
}

TEST_CASE("no move becomes shorter than 33 micrometres for its width, and plastic is kept") {
  std::mt19937 random(5);
  MotionLimits limits = someLimits();
  limits.pressureAdvance = 0;
  for (int round = 0; round < 30; ++round) {
    const Cycle cycle = roughCircle(random, 2 + round % 5, 30 + 40 * round, 0.2, 0.8);
    BeadPath path;
    path.closed = round % 2 == 0;
    for (std::size_t i = 0; i < cycle.points.size(); ++i) {
      path.points.push_back(
          {std::llround(double(cycle.points[i].x) * 1000), std::llround(double(cycle.points[i].y) * 1000)});
      path.widths.push_back(double(cycle.widths[i]));
    }
    double volume = 0;
    double shortest = 1e9;
    const std::size_t segments = path.points.size() - (path.closed ? 0 : 1);
    for (std::size_t i = 0; i < segments; ++i) {
      const std::size_t next = (i + 1) % path.points.size();
      const double length =
          std::hypot(double(path.points[next].x - path.points[i].x), double(path.points[next].y - path.points[i].y)) /
          1000;
      volume += length * (path.widths[i] + path.widths[next]) / 2;
      shortest = std::min(shortest, length);
    }
    const Motion motion = planMotion(path, 0, limits);
    CHECK(motion.points.size() > segments + 1);
    CHECK(volumeOf(motion.widths, motion.lengths) == Approx(volume).epsilon(1e-9));
    for (const double length : motion.lengths) CHECK(length >= std::min(shortest, 0.033) - 0.0015);  // rounded ends
    for (std::size_t i = 0; i + 1 < motion.points.size(); ++i) CHECK(motion.points[i] != motion.points[i + 1]);
  }
}

TEST_CASE("rough widths are held to the slope of pressure advance and keep the plastic, wherever the seam is") {
  std::mt19937 random(3);
  for (int round = 0; round < 40; ++round) {
    const Cycle cycle = roughCircle(random, 2 + round % 8, 20 + 23 * round, 0.25, 0.6);
    BeadPath path;
    path.closed = round % 4 != 3;
    for (std::size_t i = 0; i < cycle.points.size(); ++i) {
      path.points.push_back(
          {std::llround(double(cycle.points[i].x) * 1000), std::llround(double(cycle.points[i].y) * 1000)});
      path.widths.push_back(i % 50 < 20 ? double(cycle.widths[i]) : 0.4);
    }
    MotionLimits limits = someLimits();
    limits.maxSegmentsPerSecond = 300;
    const std::size_t start = path.closed ? random() % path.points.size() : 0;
    const Motion motion = planMotion(path, start, limits);
    limits.pressureAdvance = 0;
    const Motion raw = planMotion(path, start, limits);
    CHECK(volumeOf(motion.widths, motion.lengths) == Approx(volumeOf(raw.widths, raw.lengths)).epsilon(1e-9));
    double worst = 0;
    for (std::size_t i = 0; i < motion.lengths.size(); ++i) {
      const double slope = std::abs(motion.widths[i + 1] - motion.widths[i]) / motion.lengths[i];
      const double speed = motion.feedrates[i] / 60.0;
      worst = std::max(worst, slope * 0.04 * speed / (0.75 * std::min(motion.widths[i], motion.widths[i + 1])));
    }
    CHECK(worst <= 1 + 1e-9);
    CHECK(worst > 0.3);  // no smoother than needed
    if (path.closed) CHECK(motion.widths.front() == motion.widths.back());
    CHECK(*std::min_element(motion.widths.begin(), motion.widths.end()) >= 0.25 - 1e-6);
    CHECK(*std::max_element(motion.widths.begin(), motion.widths.end()) <= 0.6 + 1e-6);
  }
}

TEST_CASE("widths that jump at one end only are held to the slope as well") {
  for (const bool atEnd : {false, true}) {
    for (const double end : {0.3, 0.6}) {
      BeadPath path = pathOf({{0, 0}, {0.06, 0}, {10, 0}, {10.06, 0}}, 0.4);  // steps of 0.06 mm stay one move
      path.widths[atEnd ? 3 : 0] = end;
      const MotionLimits limits = someLimits();
      const Motion motion = planMotion(path, 0, limits);
      for (std::size_t i = 0; i < motion.lengths.size(); ++i) {
        const double least = std::min(motion.widths[i], motion.widths[i + 1]);
        const double allowed = 0.75 * least / (limits.pressureAdvance * motion.feedrates[i] / 60);
        CHECK(std::abs(motion.widths[i + 1] - motion.widths[i]) <= allowed * motion.lengths[i] + 1e-9);
      }
    }
  }
}

TEST_CASE("the slope limit holds in the printed text") {
  std::mt19937 random(11);
  Job job = plate(30, 30);
  job.printer.maxSegmentsPerSecond = 1e5;  // moves that are joined for slow boards change their width in steps
  job.params.base = 0;
  job.params.skirt = 0;
  job.printer.firstLayerSpeed = 50;
  job.toolpath.cycles = {roughCircle(random, 12, 400, 0.25, 0.6)};
  const ReadFile file = checkFile(job, job.write());
  const std::vector<ReadMove>& moves = lastPath(file).moves;
  for (std::size_t i = 0; i + 1 < moves.size(); ++i) {
    const auto width = [&](const ReadMove& m) { return double(m.e) / 1e5 * kArea / (0.95 * 0.2 * m.length()); };
    const double reach = (moves[i].length() + moves[i + 1].length()) / 2;
    const double slope = std::abs(width(moves[i + 1]) - width(moves[i])) / reach;
    const double speed = double(std::max(moves[i].feedrate, moves[i + 1].feedrate)) / 60;
    // A digit of E more or less is much of a short move's width.
    const auto digit = [&](const ReadMove& m) { return 1e-5 * kArea / (0.95 * 0.2 * m.length()); };
    const double noise = (digit(moves[i]) + digit(moves[i + 1])) / reach;
    CHECK(slope <= 0.75 * std::max(width(moves[i]), width(moves[i + 1])) / (0.04 * speed) * 1.15 + 0.01 + noise);
  }
}

TEST_CASE("speed follows the flow limit in whole mm/s and does not flicker") {
  std::vector<Vec2> points;
  for (int k = 0; k <= 200; ++k) points.push_back({k * 1.0, 0});
  BeadPath path = pathOf(points, 0.4);
  for (std::size_t k = 0; k < path.widths.size(); ++k) path.widths[k] = 0.5 + 0.004 * double(k / 2 % 2);
  MotionLimits limits = someLimits();
  limits.maxFlow = 4;  // 40 mm/s at 0.5, 39.7 at 0.504
  const Motion flat = planMotion(path, 0, limits);
  CHECK(flat.feedrates.front() == 40 * 60);
  for (std::size_t k = 1; k < flat.feedrates.size(); ++k) CHECK(flat.feedrates[k] == 39 * 60);
  CHECK(flat.flowSlowedMm == Approx(200));

  for (std::size_t k = 0; k < path.widths.size(); ++k) path.widths[k] = 0.3 + 0.002 * double(k);
  const Motion rising = planMotion(path, 0, limits);
  int changes = 0;
  for (std::size_t k = 0; k < rising.feedrates.size(); ++k) {
    const double speed = rising.feedrates[k] / 60.0;
    CHECK(speed * 0.2 * rising.widths[k + 1] <= 4 + 1e-9);
    CHECK(speed * 0.2 * rising.widths[k + 1] > 4 - 0.2 * 0.75 * 3 - (speed == 50 ? 10 : 0));
    CHECK(rising.feedrates[k] % 60 == 0);
    if (k > 0) changes += rising.feedrates[k] != rising.feedrates[k - 1];
  }
  CHECK(changes >= 15);
  CHECK(changes <= 25);
}

TEST_CASE("beads that slow down go in whole mm/s down to 1, and in whole mm/min below") {
  MotionLimits limits = someLimits();
  limits.pressureAdvance = 0;
  for (const auto& [speed, feedrate] : {std::pair{2.5, 120}, {1.5, 60}, {1.0, 60}, {0.75, 45}}) {
    limits.maxFlow = speed * limits.layerHeight * 0.4;
    CAPTURE(limits.maxFlow);
    BeadPath path = pathOf({{0, 0}, {10, 0}, {10.03, 0}, {20, 0}}, 0.4);
    path.widths[0] = path.widths[1] = 0.004;  // as fast as may be
    const Motion motion = planMotion(path, 0, limits);
    CHECK(motion.feedrates.front() == 50 * 60);
    CHECK(motion.feedrates.back() == feedrate);
  }
  limits.maxFlow = 1e-4;
  CHECK(planMotion(pathOf({{0, 0}, {10, 0}}, 0.4), 0, limits).feedrates.front() == 1);
}

TEST_CASE("with constant flow the speed follows the width, as far as 1.5 times its value") {
  Job job = plate();
  job.params.skirt = 0;
  job.params.constantFlow = true;
  job.printer.curveAcceleration = 0;
  job.printer.speed = job.printer.showSpeed = 40;
  job.printer.maxFlow = 30;
  job.printer.pressureAdvance = 0;
  Cycle& cycle = job.toolpath.cycles[0];
  for (std::size_t i = 0; i < cycle.widths.size(); ++i) {
    cycle.widths[i] = static_cast<float>(0.25 + 0.35 * double(i) / double(cycle.widths.size()));
  }
  const Written written = job.write();
  REQUIRE(written.result.ok());
  CHECK(checkGcode(written.text, job.printer).errors() == 0);
  const ReadFile file = readGcode(written.text);
  int checked = 0;
  int even = 0;
  for (const ReadMove& move : lastPath(file).moves) {
    const double width = double(move.e) / 1e5 * kArea / 0.2 / 0.95 / move.length();
    const double speed = double(move.feedrate) / 60;
    if (width < 0.26) CHECK(speed > 58);  // hysteresis
    if (width > 0.29) {
      even += std::abs(speed * width / 16 - 1) < 0.09 ? 1 : 0;  // whole mm/s, 2 mm/s of hysteresis
      ++checked;
    }
  }
  CHECK(checked > 50);
  CHECK(even >= checked - 1);  // one segment leads from the last width to the first
}

TEST_CASE("short segments slow down only where they come in numbers") {
  std::vector<Vec2> points;
  for (int k = 0; k < 100; ++k) points.push_back({k * 1.0, 0});
  points.push_back({99.05, 0});
  for (int k = 1; k < 100; ++k) points.push_back({99.05 + k, 0});
  MotionLimits limits = someLimits();
  limits.maxSegmentsPerSecond = 300;
  for (const std::int32_t feedrate : planMotion(pathOf(points, 0.4), 0, limits).feedrates) CHECK(feedrate == 3000);

  points.clear();
  for (int k = 0; k < 100; ++k) points.push_back({k * 0.05, 0});  // on one line: joined, and as fast as it
  const Motion line = planMotion(pathOf(points, 0.4), 0, limits);
  for (const std::int32_t feedrate : line.feedrates) CHECK(feedrate == 3000);
  CHECK(line.lengths.size() < 5);
  CHECK(line.segmentSlowedMm == 0);

  points.clear();
  for (int k = 0; k < 100; ++k) points.push_back({k * 0.03, k % 2 * 0.04});  // legs of 0.05 mm that are meant
  const Motion dense = planMotion(pathOf(points, 0.4), 0, limits);
  CHECK(dense.lengths.size() == 99);
  for (const std::int32_t feedrate : dense.feedrates) CHECK(feedrate == dense.feedrates.front());  // one even speed
  CHECK(dense.feedrates.front() <= 15 * 60);
  CHECK(dense.feedrates.front() >= 0.8 * 15 * 60 - 60);
  CHECK(dense.segmentSlowedMm == Approx(4.95));
}

TEST_CASE("joined moves lie within 10 um of the path, keep its plastic and are no more than the board takes") {
  std::mt19937 random(5);
  MotionLimits limits = someLimits(GcodeFlavor::Marlin);
  limits.maxSegmentsPerSecond = 100;
  limits.pressureAdvance = 0;
  limits.curveAcceleration = 0;
  BeadPath path;  // a wavy circle of 20 mm, a point every 0.06 mm, its width changing along it
  path.closed = true;
  for (int k = 0; k < 2000; ++k) {
    const double angle = 2 * 3.14159265358979 * k / 2000;
    const double r = 20 + 0.4 * std::sin(40 * angle);
    path.points.push_back({std::llround(1000 * r * std::cos(angle)), std::llround(1000 * r * std::sin(angle))});
    path.widths.push_back(0.4 + 0.1 * std::sin(25 * angle));
  }
  MotionLimits fast = limits;
  fast.maxSegmentsPerSecond = 1e5;
  const Motion all = planMotion(path, 0, fast);
  const Motion few = planMotion(path, 0, limits);
  CHECK(few.points.size() < all.points.size() / 3);
  CHECK(few.points.front() == all.points.front());
  CHECK(few.points.back() == all.points.back());
  double area = 0;
  for (const double part : all.areas) area += part;
  double joined = 0;
  for (const double part : few.areas) joined += part;
  CHECK(joined == Approx(area).epsilon(1e-12));
  std::size_t at = 0;
  for (std::size_t i = 0; i + 1 < few.points.size(); ++i) {
    const Vec2 a{double(few.points[i].x), double(few.points[i].y)};
    const Vec2 b{double(few.points[i + 1].x), double(few.points[i + 1].y)};
    double lowest = 1e9;
    double highest = 0;
    do {
      const Vec2 p{double(all.points[at].x), double(all.points[at].y)};
      CHECK(std::abs(cross(b - a, p - a)) / length(b - a) <= 10.001);
      lowest = std::min(lowest, all.widths[at]);
      highest = std::max(highest, all.widths[at]);
      ++at;
    } while (all.points[at] != few.points[i + 1]);
    const double written = few.areas[i] / few.lengths[i];
    CHECK(written <= lowest + 0.0801);
    CHECK(written >= highest - 0.0801);
  }
  for (std::size_t i = 0; i + 8 <= few.lengths.size(); ++i) {
    double seconds = 0;
    for (std::size_t k = i; k < i + 8; ++k) seconds += few.lengths[k] * 60 / few.feedrates[k];
    CHECK(seconds >= 8 / 100.0 * (1 - 1e-9));
  }
}

TEST_CASE("a circle goes at most at the root of acceleration times radius, evenly; a straight line as before") {
  for (const GcodeFlavor flavor : {GcodeFlavor::Klipper, GcodeFlavor::Marlin}) {
    for (const double radius : {0.4, 0.9, 2.0, 2.4, 10.0}) {
      CAPTURE(radius);
      MotionLimits limits = someLimits(flavor);
      limits.curveAcceleration = 800;
      std::vector<Vec2> circle;
      for (int k = 0; k < 60; ++k) {
        const double angle = 2 * 3.14159265358979 * k / 60;
        circle.push_back({20 + radius * std::cos(angle), 20 + radius * std::sin(angle)});
      }
      const BeadPath path = pathOf(circle, 0.4, true);
      const Motion motion = planMotion(path, 0, limits);
      const double allowed = std::sqrt(800 * radius);
      const bool slowed = allowed < 50;
      const auto [least, most] = std::minmax_element(motion.feedrates.begin(), motion.feedrates.end());
      CHECK(*most <= 60 * std::min(50.0, 1.01 * allowed));  // points are whole µm: a little flatter here and there
      CHECK(*least >= 60 * std::floor(std::min(50.0, 0.97 * allowed)));
      CHECK(motion.curveSlowedMm == Approx(slowed ? 2 * 3.14159265 * radius : 0).epsilon(0.01));
      limits.curveAcceleration = 0;
      CHECK(planMotion(path, 0, limits).feedrates == std::vector<std::int32_t>(60, 3000));
    }
    MotionLimits limits = someLimits(flavor);
    limits.curveAcceleration = 1;
    const Motion line = planMotion(pathOf({{0, 0}, {0.1, 0.1}, {0.2, 0.2}, {7, 7}, {7.3, 7.3}}, 0.4), 0, limits);
    CHECK(line.feedrates == std::vector<std::int32_t>(4, 3000));
    CHECK(line.curveSlowedMm == 0);
  }
}

TEST_CASE("a U-turn is slower than its straights, which keep their speed, and so are its first and last bends") {
  for (const GcodeFlavor flavor : {GcodeFlavor::Klipper, GcodeFlavor::Marlin}) {
    MotionLimits limits = someLimits(flavor);
    limits.curveAcceleration = 1000;
    std::vector<Vec2> points;
    for (int k = 0; k <= 50; ++k) points.push_back({0, 0.2 * k});
    for (int k = 1; k < 12; ++k) {
      const double angle = 3.14159265358979 * (1 - k / 12.0);
      points.push_back({0.2 + 0.2 * std::cos(angle), 10 + 0.2 * std::sin(angle)});
    }
    for (int k = 0; k <= 50; ++k) points.push_back({0.4, 10 - 0.2 * k});
    const Motion motion = planMotion(pathOf(points, 0.4), 0, limits);
    CHECK(motion.feedrates.front() == 3000);
    CHECK(motion.feedrates[45] == 3000);
    CHECK(motion.feedrates[56] <= 60 * std::sqrt(1000 * 0.2) * 1.01);  // its top
    CHECK(motion.feedrates[56] >= 60 * 12);
    CHECK(motion.feedrates[51] <= 60 * 21);  // its first bend: half of a bead's width lies on the straight
    CHECK(motion.feedrates[61] <= 60 * 21);
    CHECK(motion.feedrates.back() == 3000);
    CHECK(motion.curveSlowedMm > 0.2 * 3.14);
    CHECK(motion.curveSlowedMm < 0.2 * 3.14 + 2 * 0.8);  // and a bead's width to either side
    // Down, and up again: never back and forth.
    int rises = 0;
    for (std::size_t i = 1; i < motion.feedrates.size(); ++i) {
      if (motion.feedrates[i] > motion.feedrates[i - 1]) {
        ++rises;
        CHECK(motion.feedrates[i] >= motion.feedrates[i - 1] + 120);
      } else {
        CHECK(rises * (motion.feedrates[i - 1] - motion.feedrates[i]) == 0);
      }
      CHECK(motion.feedrates[i] % 60 == 0);
    }
  }
}

TEST_CASE("a corner between long lines is the firmware's own, a short line between two is a curve") {
  MotionLimits limits = someLimits(GcodeFlavor::Marlin);
  limits.curveAcceleration = 1000;
  const Motion square = planMotion(pathOf({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, 0.4, true), 0, limits);
  CHECK(square.feedrates == std::vector<std::int32_t>(4, 3000));
  // On the 0.4 mm about its middle the angle grows by 2 x 0.2 / 0.375 right angles: r = 0.239 mm, 15.5 mm/s.
  const Motion pin = planMotion(pathOf({{0, 0}, {10, 0}, {10, 0.35}, {0, 0.35}}, 0.4), 0, limits);
  CHECK(pin.feedrates == std::vector<std::int32_t>{3000, 60 * 15, 3000});
  // By the mean width of the whole path, however short it is.
  CHECK(planMotion(pathOf({{0, 0}, {1, 0}, {1, 0.35}, {0, 0.35}}, 0.4), 0, limits).feedrates == pin.feedrates);
}

TEST_CASE("noise of micrometres slows nothing, and no curve is slower than 5 mm/s") {
  std::mt19937 random(5);
  MotionLimits limits = someLimits(GcodeFlavor::Marlin);
  limits.curveAcceleration = 1000;
  std::vector<Vec2> points;
  for (int k = 0; k < 500; ++k) points.push_back({0.2 * k, 0.001 * double(random() % 5)});
  CHECK(planMotion(pathOf(points, 0.4), 0, limits).curveSlowedMm == 0);
  limits.curveAcceleration = 1;
  points.clear();
  for (int k = 0; k < 500; ++k)
    points.push_back({5 + 0.001 * double(random() % 300), 5 + 0.001 * double(random() % 300)});
  BeadPath path = pathOf(points, 0.4, true);
  path.points.erase(std::unique(path.points.begin(), path.points.end()), path.points.end());
  path.widths.resize(path.points.size());
  const Motion wild = planMotion(path, 0, limits);
  CHECK(*std::min_element(wild.feedrates.begin(), wild.feedrates.end()) == 300);
}

TEST_CASE("a straight line takes L / v + (v - u)^2 / (a v), however it is cut; u is the jerk, 0 for Klipper") {
  const MotionLimits limits = someLimits();
  CHECK(planMotion(pathOf({{0, 0}, {100, 0}}, 0.4), 0, limits).totalSeconds == Approx(2.05));
  std::vector<Vec2> points;
  for (int k = 0; k <= 1000; ++k) points.push_back({k * 0.1, 0});
  CHECK(planMotion(pathOf(points, 0.4), 0, limits).totalSeconds == Approx(2.05));
  const MotionLimits marlin = someLimits(GcodeFlavor::Marlin);  // jerk 8 mm/s
  CHECK(planMotion(pathOf(points, 0.4), 0, marlin).totalSeconds == Approx(2 + 42 * 42 / 50e3));
  // Too short to reach the speed: a triangle.
  CHECK(planMotion(pathOf({{0, 0}, {1, 0}}, 0.4), 0, limits).totalSeconds == Approx(2 * std::sqrt(1 / 1000.0)));
  CHECK(travelSeconds({{0, 0}, {100000, 0}}, 50, limits) == Approx(2.05));
  CHECK(travelSeconds({{0, 0}, {1000, 0}}, 50, limits) == Approx(2 * std::sqrt(1 / 1000.0)));
  CHECK(travelSeconds({{0, 0}, {40000, 0}, {100000, 0}}, 50, limits) == Approx(2.05));
  CHECK(travelSeconds({{0, 0}, {100000, 0}}, 50, marlin) == Approx(2 + 42 * 42 / 50e3));
  CHECK(travelSeconds({{0, 0}}, 50, marlin) == 0);
}

// Passing a corner at u instead of v costs (v - u)² / (a v), so the time tells the corner's speed.
TEST_CASE("corners slow down as Klipper and Marlin say") {
  const auto cornerSpeed = [](const MotionLimits& limits, double degrees) {
    const double turn = degrees * 3.14159265358979 / 180;
    const double leg = 60;
    const Motion motion =
        planMotion(pathOf({{0, 0}, {leg, 0}, {leg + leg * std::cos(turn), leg * std::sin(turn)}}, 0.4), 0, limits);
    const double v = limits.speed;
    const double u = limits.flavor == GcodeFlavor::Klipper ? 0 : 2 * limits.cornerSpeed;  // at the path's ends
    const double toward = std::max(std::abs(std::cos(turn)), std::abs(std::sin(turn)));
    const double lost = motion.totalSeconds - 2 * leg / v - (v - u) * (v - u) / (2 * limits.acceleration * v) -
                        (v - u / toward) * (v - u / toward) / (2 * limits.acceleration * v);
    return v - std::sqrt(std::max(0.0, lost) * limits.acceleration * v);
  };
  MotionLimits klipper = someLimits();
  klipper.speed = 150;
  const double table[][2] = {{5, 104}, {10, 52}, {20, 26}, {30, 17}, {45, 11}, {60, 8}, {90, 5}, {120, 3}};
  for (const auto& row : table) {
    CAPTURE(row[0]);
    CHECK(std::abs(cornerSpeed(klipper, row[0]) - row[1]) < 0.6);
  }
  CHECK(cornerSpeed(klipper, 180) == Approx(0).epsilon(0.01));
  const MotionLimits marlin = someLimits(GcodeFlavor::Marlin);  // jerk 8 mm/s
  CHECK(cornerSpeed(marlin, 9) == about(50, 0.01));
  CHECK(cornerSpeed(marlin, 90) == about(8, 0.01));
  CHECK(cornerSpeed(marlin, 180) == about(8, 0.01));  // Marlin takes the faster side, not both
}

TEST_CASE("short segments around corners go as their room allows") {
  // v2 of the table: a zigzag of 0.2 mm legs that turns by 90 degrees each time runs at 10 mm/s or less.
  std::vector<Vec2> points;
  for (int k = 0; k <= 1000; ++k) points.push_back({(k + 1) / 2 * 0.2, k / 2 * 0.2});
  MotionLimits limits = someLimits();
  limits.cornerSpeed = 100;  // leaves v2 alone
  const double seconds = planMotion(pathOf(points, 0.4), 0, limits).totalSeconds;
  // Corner at 10 mm/s, in the middle sqrt(100 + 2 * 1000 * 0.1) = 17.3.
  CHECK(seconds == about(1000 * 2 * (std::sqrt(300.0) - 10) / 1000, 0.02));

  // One such leg between two long ones: its corners go at 10 mm/s too.
  const double corners = planMotion(pathOf({{0, 0}, {60, 0}, {60, 0.2}, {120, 0.2}}, 0.4), 0, limits).totalSeconds;
  const double v = limits.speed;
  const double longLegs = 2 * (60 / v + v / (2 * 1000) + (v - 10) * (v - 10) / (2 * 1000 * v));
  CHECK(corners == about(longLegs + 2 * (std::sqrt(300.0) - 10) / 1000, 1e-4));
}

TEST_CASE("width jumps slow the extruder as Klipper does, and Marlin at five times the speed") {
  for (const GcodeFlavor flavor : {GcodeFlavor::Klipper, GcodeFlavor::Marlin}) {
    CAPTURE(static_cast<int>(flavor));
    std::vector<Vec2> points;
    for (int k = 0; k <= 8000; ++k) points.push_back({k * 0.03, 0});  // too short to be made several moves
    BeadPath path = pathOf(points, 0.4);
    MotionLimits limits = someLimits(flavor);
    limits.pressureAdvance = 0;
    limits.maxSegmentsPerSecond = 1e6;
    limits.maxFlow = 1e3;
    limits.speed = flavor == GcodeFlavor::Klipper ? 50 : 250;
    const double even = planMotion(path, 0, limits).totalSeconds;
    // Means of neighbouring segments alternate when widths go 0.4 0.4 0.6 0.6; such speeds are kept up to 0.24.
    const auto alternate = [&](double jump) {
      for (std::size_t k = 0; k < path.widths.size(); ++k) path.widths[k] = 0.4 + (k / 2 % 2 == 1 ? 2 * jump : 0);
      return planMotion(path, 0, limits).totalSeconds;
    };
    CHECK(alternate(0.23) == Approx(even));
    CHECK(alternate(0.30) > even * 1.02);
  }
}

TEST_CASE("coasting ends the plastic before the cycle's end, to the micrometre") {
  Job job = plate(30, 20, 1.3);
  job.params.base = 0;
  const ReadPath full = lastPath(checkFile(job, job.write()));
  job.params.coast = 0.25;
  const Written written = job.write();
  const GcodeCheck check = checkGcode(written.text, job.printer);
  CHECK(check.errors() == 0);
  CHECK(check.closed == 2);  // skirt and cycle: where the nozzle goes counts
  const ReadFile file = readGcode(written.text);
  const ReadPath& path = lastPath(file);
  double a = 0;
  double b = 0;
  for (const ReadMove& move : full.moves) a += move.length();
  for (const ReadMove& move : path.moves) b += move.length();
  CHECK(a - b == about(0.25, 0.01));
  CHECK(full.filament() - path.filament() == about(extrusion(0.2, 0.4, 0.25, 0.95), 0.02));
}

TEST_CASE("the skirt beside an oriented first layer neither coasts nor has a scarf") {
  Job job = plate(30, 20, 1.3);
  job.params.base = 0;
  const auto written = [&] {
    const ReadFile file = readGcode(job.write().text);
    REQUIRE(file.paths.size() == 3);  // the purge comes first
    REQUIRE(file.paths[1].role == "Skirt/Brim");
    return file;
  };
  const ReadFile plain = written();
  for (double* const end : {&job.params.coast, &job.params.scarf}) {
    *end = end == &job.params.coast ? 0.25 : 3;
    const ReadFile file = written();
    *end = 0;
    CHECK(file.paths[1].moves.size() == plain.paths[1].moves.size());
    CHECK(file.paths[1].filament() == plain.paths[1].filament());
    CHECK(file.paths[2].moves.back().e != plain.paths[2].moves.back().e);
  }
}

TEST_CASE("a scarf's ends lie upon each other and are one bead together") {
  Job job = plate(30, 20, 1.3);
  job.params.base = 0;
  job.printer.maxSegmentsPerSecond = 1000;
  const ReadPath full = lastPath(checkFile(job, job.write()));
  for (const double scarf : {2.0, 6.5}) {
    job.params.scarf = scarf;
    const Written written = job.write();
    CHECK(checkGcode(written.text, job.printer).errors() == 0);
    const ReadFile file = readGcode(written.text);
    const ReadPath& path = lastPath(file);
    double before = 0;
    double after = 0;
    for (const ReadMove& move : full.moves) before += move.length();
    for (const ReadMove& move : path.moves) after += move.length();
    CHECK(after - before == about(scarf, 0.01));
    CHECK(path.filament() == about(full.filament(), 1e-4));

    // The k-th moves of both ends are the same stretch. One's flow grows as the other's falls, up to rounding of E.
    double along = 0;
    std::size_t ends = 0;
    while (along < scarf - 0.01) along += path.moves[ends++].length();
    REQUIRE(ends >= 8);
    const double even = full.filament() / before;  // filament per mm
    double flow = 0;
    for (std::size_t k = 0; k < ends; ++k) {
      const ReadMove& in = path.moves[k];
      const ReadMove& out = path.moves[path.moves.size() - ends + k];
      CHECK(in.x0 == out.x0);
      CHECK(in.y1 == out.y1);
      const double grown = static_cast<double>(in.e) / 1e5 / in.length();
      CHECK(grown > flow);
      flow = grown;
      CHECK(static_cast<double>(in.e + out.e) / 1e5 / in.length() == about(even, 0.03));
    }
    CHECK(flow > 0.9 * even);
  }
}

TEST_CASE("what runs on beside its beginning is no closed cycle") {
  Job job = plate();
  job.params.scarf = 2;
  std::string text = job.write().text;
  const std::size_t wipe = text.rfind(" E-");  // the last move that draws back while it wipes
  std::size_t line = text.rfind("G1 X", wipe);
  while (text.substr(line, text.find('\n', line) - line).find("E-") != std::string::npos)
    line = text.rfind("G1 X", line - 1);
  const std::size_t digit = text.find('.', line) + 1;
  text[digit] = text[digit] == '9' ? '8' : static_cast<char>(text[digit] + 1);
  const GcodeCheck check = checkGcode(text, job.printer);
  CHECK(std::any_of(check.findings.begin(), check.findings.end(),
                    [](const GcodeFinding& one) { return one.code == "open-cycle"; }));
}

TEST_CASE("behind a scarf the filament is drawn back while the nozzle wipes over the bead") {
  Job job = plate();
  job.params.scarf = 3;
  job.printer.retractLength = 5;
  job.printer.retractSpeed = 25;
  const Written written = job.write();
  CHECK(checkGcode(written.text, job.printer).errors() == 0);
  double drawn = 0;
  double millimetres = 0;
  const ReadFile file = readGcode(written.text);
  CHECK(file.faults.empty());
  for (const ReadMove& move : file.wipes) {
    drawn -= static_cast<double>(move.e) / 1e5;
    millimetres += move.length();
  }
  CHECK(drawn == about(5, 1e-5));
  CHECK(millimetres == about(3, 0.001));
}

TEST_CASE("a scarf and a coast are refused together") {
  Job job = plate();
  job.params.scarf = 3;
  job.params.coast = 0.2;
  CHECK(job.write().result.error().message ==
        "print.scarf is 3 mm beside a print.coast of 0.2; one of them must be 0: both shape the end of a cycle");
}

TEST_CASE("no F is above the machine's own speed") {
  Job job = plate();
  job.printer.machineSpeed = 33;
  job.params.constantFlow = true;
  const Written written = job.write();
  REQUIRE(written.result.ok());
  const GcodeCheck check = checkGcode(written.text, job.printer);
  CHECK(check.fastest <= 33.001);
  CHECK(check.errors() == 0);
  Printer slower = job.printer;
  slower.machineSpeed = 30;
  CHECK(checkGcode(written.text, slower).findings.at(0).message == "faster than the printer: 33 mm/s");
  for (const std::string_view line : split(written.text, '\n')) {
    const std::size_t at = line.find(" F");
    if (!line.starts_with("G1 X") || at == std::string_view::npos) continue;
    CHECK(std::stoi(std::string(line.substr(at + 2))) <= 33 * 60);
  }
}
