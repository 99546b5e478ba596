// Joints toggled two by two: one path stays one path, and neighbours come nearer to each other in time.
#include "toolpath/even_order.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "input/stored_angle.hpp"
#include "sillon/input/plate_input.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "sillon/quality/metrics.hpp"
#include "support/scenes.hpp"
#include "toolpath/path.hpp"

using namespace sillon;

namespace {

// Cuts of a loop of elements that it is easy to be sure of.
struct Loop {
  std::vector<int> begins;
  std::vector<Link> links;
  int size = 0;

  explicit Loop(scenes::Random& random) {
    for (int e = 0; e < 40; ++e) {
      begins.push_back(size);
      size += 50 + random.index(400);
    }
    for (int k = 0; k < 600; ++k) {
      links.push_back({random.index(size), random.index(size)});
    }
  }
};

constexpr double kPointSeconds = 0.05;

double lateAfter(double seconds) {
  return 0.5 * std::min(1.0, seconds / 30) + 0.5 * std::min(1.0, seconds / 120) + 0.1 * std::min(1.0, seconds / 1000);
}

// Point by point, from the places that everything has now.
double slowLateness(const Loop& loop, const Tour& tour) {
  double sum = 0;
  for (const Link& link : loop.links) {
    if (tour.elementAt(link.a) == tour.elementAt(link.b)) continue;
    const int apart = std::abs(tour.placeNow(link.a) - tour.placeNow(link.b));
    sum += lateAfter(std::min(apart, loop.size - apart) * kPointSeconds);
  }
  return sum;
}

Cuts randomCuts(const Loop& loop, const Tour& tour, scenes::Random& random) {
  std::vector<int> cuts;
  while (cuts.size() < 4) {
    const int cut = tour.endOf(random.index(static_cast<int>(loop.begins.size())));
    if (std::find(cuts.begin(), cuts.end(), cut) == cuts.end()) cuts.push_back(cut);
  }
  std::sort(cuts.begin(), cuts.end());
  return {cuts[0], cuts[1], cuts[2], cuts[3]};
}

}  // namespace

TEST_CASE("what an exchange of blocks gains is what lateness falls by, and twice is nothing") {
  scenes::Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const Loop loop(random);
    Tour tour(loop.size, loop.begins, loop.links, kPointSeconds);
    for (int move = 0; move < 30; ++move) {
      const Cuts cuts = randomCuts(loop, tour, random);
      const double before = tour.lateness();
      const double gain = tour.gain(cuts);
      const Cuts back{cuts[0], cuts[0] + cuts[3] - cuts[2], cuts[0] + cuts[3] - cuts[1], cuts[3]};
      Tour twice = tour;
      tour.exchange(cuts);
      CHECK(tour.lateness() == doctest::Approx(before - gain));
      // Links between two elements are taken as one, with their mean distance.
      CHECK(tour.lateness() == doctest::Approx(slowLateness(loop, tour)).epsilon(0.02));
      twice.exchange(cuts);
      twice.exchange(back);
      CHECK(twice.lateness() == doctest::Approx(before));
      for (int place = 0; place < loop.size; place += 97) REQUIRE(twice.placeNow(place) >= 0);
    }
  }
}

TEST_CASE("a split tells for every further pair of cuts what the exchange gains") {
  scenes::Random random(4);
  const Loop loop(random);
  Tour tour(loop.size, loop.begins, loop.links, kPointSeconds);
  const auto elementEndingAt = [&](int place) {
    int e = 0;
    while (tour.endOf(e) != place) ++e;
    return e;
  };
  for (int move = 0; move < 200; ++move) {
    const Cuts cuts = randomCuts(loop, tour, random);
    Tour::Split::Room room;
    Tour::Split::Room otherRoom;
    const Tour::Split split(tour, cuts[0], cuts[2], room);
    std::int64_t work = 0;
    const auto gain = [&](const Tour::Split& by, std::size_t a, std::size_t b, double least) {
      return by.gain(elementEndingAt(cuts[a]), elementEndingAt(cuts[b]), least, work);
    };
    const double exact = tour.gain(cuts);
    CHECK(gain(split, 1, 3, exact - 1) == doctest::Approx(exact));
    CHECK(gain(split, 1, 3, exact + 1) < exact + 1);
    CHECK(split.atMost(elementEndingAt(cuts[1]), elementEndingAt(cuts[3])) >= exact);
    const Tour::Split other(tour, cuts[1], cuts[3], otherRoom);
    CHECK(gain(other, 2, 0, exact - 1) == doctest::Approx(exact));
    tour.exchange(cuts);
  }
}

namespace {

// Share of the length, in percent, whose neighbour on the worse side is laid more than `seconds` earlier or later.
double lateShare(const ToolpathResult& plate, double seconds) {
  constexpr float kStep = 0.4f;
  struct Piece {
    Vec2f at, along;
    double time;
  };
  std::vector<Piece> pieces;
  double time = 0;
  for (const Cycle& cycle : plate.toolpath.cycles) {
    for (std::size_t k = 0; k < cycle.points.size(); ++k) {
      const Vec2f a = cycle.points[k];
      const Vec2f way = cycle.points[k + 1 < cycle.points.size() ? k + 1 : 0] - a;
      const float size = length(way);
      const int parts = static_cast<int>(size / kStep) + 1;
      for (int part = 0; part < parts; ++part) {
        const float share = (static_cast<float>(part) + 0.5f) / static_cast<float>(parts);
        pieces.push_back({a + way * share, way * (1 / size), time + static_cast<double>(size * share) / 20});
      }
      time += static_cast<double>(size) / 20;
    }
  }
  int late = 0;
  for (const Piece& piece : pieces) {
    double left = -1, right = -1;
    for (const Piece& other : pieces) {
      const Vec2f to = other.at - piece.at;
      const float across = piece.along.x * to.y - piece.along.y * to.x;
      if (std::abs(dot(piece.along, to)) > 0.25f || std::abs(across) < 0.25f || std::abs(across) > 0.55f) continue;
      double& side = across > 0 ? left : right;
      const double delay = std::abs(other.time - piece.time);
      side = side < 0 ? delay : std::min(side, delay);
    }
    late += std::max(left, right) > seconds ? 1 : 0;
  }
  return 100.0 * late / static_cast<double>(pieces.size());
}

PlateInput disc(double size, double degrees) {
  std::vector<Vec2> ring;
  for (int k = 0; k < 180; ++k) {
    const double a = 2 * std::numbers::pi * k / 180;
    ring.push_back({size / 2 * (1 + std::cos(a)), size / 2 * (1 + std::sin(a))});
  }
  PlateInput input;
  input.shape = scenes::shapeOf({ring}, {size, size});
  input.directions = uniformDirection(degrees).value();
  input.modes = uniformMode(DirectionMode::Constrained);
  return input;
}

}  // namespace

TEST_CASE("neighbours on a disc are laid soon after one another") {
  const PlateInput input = disc(60, 30);
  ToolpathParams params;
  const ToolpathResult even = generateToolpath(input, params, RunContext(1)).value();
  params.order = BeadOrder::Plain;
  const ToolpathResult plain = generateToolpath(input, params, RunContext(1)).value();
  CHECK(even.toolpath.cycles.size() == 1);
  CHECK(plain.toolpath.cycles.size() == 1);
  CHECK(lateShare(plain, 30) > 20);
  CHECK(lateShare(even, 30) < 6);
  CHECK(lateShare(even, 120) < 3);
}

TEST_CASE("a rectangle along its longer sides gets few stripes, for few U-turns, all at its border") {
  PlateInput input = disc(60, 0);
  input.shape = scenes::shapeOf({{{0, 0}, {60, 0}, {60, 40}, {0, 40}}}, {60, 40});
  ToolpathParams params;
  const RunContext run(1);
  const ToolpathResult even = generateToolpath(input, params, run).value();
  const Measures after = measureToolpath(even.toolpath, input, params, run).value();
  params.order = BeadOrder::Plain;
  const ToolpathResult plain = generateToolpath(input, params, run).value();
  const Measures before = measureToolpath(plain.toolpath, input, params, run).value();
  CHECK(lateShare(plain, 30) > 20);
  CHECK(lateShare(even, 30) < 10);
  CHECK(lateShare(even, 120) < 2);
  CHECK(static_cast<double>(after.uTurns) <= 1.12 * static_cast<double>(before.uTurns));
  CHECK(after.alignment < before.alignment + 0.0015);  // -1 is perfect
}

TEST_CASE("rings are laid one after the other, though their joints lie amid straight strands") {
  PlateInput input = disc(40, 0);
  constexpr int kSide = 400;
  input.directions = {kSide, kSide, {}};
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double outward = std::atan2(kSide / 2.0 - y - 0.5, x + 0.5 - kSide / 2.0);
      input.directions.angle.push_back(storedAngle((outward + std::numbers::pi / 2) / std::numbers::pi));
    }
  }
  ToolpathParams params;
  const ToolpathResult even = generateToolpath(input, params, RunContext(1)).value();
  params.order = BeadOrder::Plain;
  const ToolpathResult plain = generateToolpath(input, params, RunContext(1)).value();
  CHECK(even.toolpath.cycles.size() == 1);
  CHECK(lateShare(plain, 30) > 30);
  CHECK(lateShare(even, 30) < 15);
}

TEST_CASE("the order is the same on any number of threads") {
  const PlateInput input = disc(30, 70);
  const ToolpathResult one = generateToolpath(input, {}, RunContext(1)).value();
  const ToolpathResult three = generateToolpath(input, {}, RunContext(3)).value();
  REQUIRE(one.toolpath.cycles.size() == three.toolpath.cycles.size());
  for (std::size_t c = 0; c < one.toolpath.cycles.size(); ++c)
    CHECK(one.toolpath.cycles[c].points == three.toolpath.cycles[c].points);
}
