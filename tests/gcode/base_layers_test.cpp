#include "gcode/base_layers.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/about.hpp"
#include "support/gcode_job.hpp"

using namespace sillon;
using namespace sillon::test;
using doctest::Approx;

TEST_CASE("hatched layers fill the shape at 45 and 135 degrees and stay half a line inside") {
  std::vector<Shape> shapes = {rectangle(30, 20), makeDisc(25).value()};
  Shape frame = rectangle(30, 30);
  frame.paths[0].rings.push_back({{10, 10}, {10, 20}, {20, 20}, {20, 10}});
  frame.paths[0].fillRule = FillRule::EvenOdd;
  shapes.push_back(frame);
  const double areas[] = {600, 3.14159265 * 25 * 25 / 4, 800};
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    for (const bool falling : {false, true}) {
      CAPTURE(s);
      CAPTURE(falling);
      const std::vector<Polyline> lines = hatchLines(shapes[s], 0.4, falling);
      double total = 0;
      double hatched = 0;
      double nearest = 1e9;
      std::size_t points = 0;
      for (const Polyline& line : lines) {
        points += line.size();
        for (std::size_t i = 0; i + 1 < line.size(); ++i) {
          const Vec2 d = line[i + 1] - line[i];
          total += length(d);
          if (std::abs(d.x + (falling ? d.y : -d.y)) < 1e-9 && length(d) >= 0.4 - 1e-9) hatched += length(d);
        }
        for (const Vec2 p : line) {
          if (s == 0) nearest = std::min({nearest, p.x, p.y, 30 - p.x, 20 - p.y});
          if (s == 1) nearest = std::min(nearest, 12.5 - length(p - Vec2{12.5, 12.5}));
          if (s == 2) {
            const double hole = std::max(std::abs(p.x - 15), std::abs(p.y - 15)) - 5;
            nearest = std::min({nearest, p.x, p.y, 30 - p.x, 30 - p.y, hole});
          }
        }
      }
      CHECK(nearest > 0.49 * 0.4 - 0.005);
      CHECK(nearest < 0.25);
      CHECK(total * 0.4 == about(areas[s], 0.02));
      CHECK(hatched > 0.93 * total);
      CHECK(lines.size() <= 12);
      CHECK(points > 100);
    }
  }
}

TEST_CASE("a strip just wider than its loops is hatched along all of its length") {
  for (const bool falling : {false, true}) {
    const std::vector<Polyline> lines = hatchLines(rectangle(20, 1.3), 0.4, falling, 0.36);
    REQUIRE(lines.size() == 1);
    Bounds box;
    for (const Vec2 p : lines[0]) box.add(p);
    CHECK(box.size().x > 18);
    CHECK(box.size().y == about(1.3 - 2 * 0.556, 0.01));
  }
}

TEST_CASE("shapes thinner than a line get no hatch, degenerate ones no crash") {
  CHECK(hatchLines(rectangle(20, 0.3), 0.4, false).empty());
  CHECK(hatchLines(Shape{}, 0.4, false).empty());
  CHECK(hatchLines(rectangle(0, 0), 0.4, true).empty());
}

TEST_CASE("base layers take turns and carry the volume of the plate") {
  Job job = plate();
  job.params.base = 3;
  const ReadFile file = checkFile(job, job.write());
  double filament[4] = {};
  double slope[4] = {};
  for (const ReadPath& path : file.paths) {
    if (path.role != "Solid infill") continue;
    filament[path.layer] += path.filament();
    for (const ReadMove& m : path.moves) {
      slope[path.layer] += m.length() > 3 ? double(m.x1 - m.x0) * double(m.y1 - m.y0) : 0;
    }
  }
  for (int layer = 1; layer <= 3; ++layer) {
    CHECK(filament[layer] == about(600 * 0.2 / kArea, 0.02));
    CHECK((slope[layer] > 0) == (layer % 2 == 1));
  }
}

TEST_CASE("skirt loops run 5 mm off the plate, on the first layer only") {
  Job job = plate();
  job.params.skirt = 2;
  job.params.place = Vec2{50, 60};
  const ReadFile file = checkFile(job, job.write());
  REQUIRE(file.paths.size() > 3);
  CHECK(file.paths[1].role == "Skirt/Brim");
  CHECK(file.paths[1].moves[0].x0 == 50000 - 5400);
  CHECK(file.paths[2].moves[0].x0 == 50000 - 5000);
  CHECK(file.paths[2].moves[0].x1 == 80000 + 5000);
  CHECK(file.paths[2].moves[1].y1 == 80000 + 5000);
  CHECK(std::count_if(file.paths.begin(), file.paths.end(), [](auto& p) { return p.role == "Skirt/Brim"; }) == 2);
}

TEST_CASE("a skirt that does not fit is left out with a warning, and the purge finds what room there is") {
  Job job = plate();
  job.printer.bedMax = {32, 60};
  const Written written = job.write();
  const ReadFile file = checkFile(job, written);
  CHECK(contains(written.result.value().warnings, "skirt does not fit"));
  REQUIRE(file.paths[0].role == "Custom");
  CHECK(file.paths[0].moves.size() == 7);  // four passes in front of the plate
  CHECK(file.paths[0].moves[0].y0 == 5667);
  CHECK(file.paths[0].filament() >= 10.8);

  job.printer.bedMax = {60, 22};
  const ReadPath beside = checkFile(job, job.write()).paths[0];
  CHECK(beside.moves[0].x0 == 1667);
  CHECK(beside.filament() >= 10.8);

  job.printer.bedMax = {31, 21};
  const Written tight = job.write();
  CHECK(checkFile(job, tight).paths[0].role == "Solid infill");
  CHECK(contains(tight.result.value().warnings, "no room for a purge line"));
}

TEST_CASE("loops lie at their distances from the border, inside and outside") {
  const auto boxOf = [](const Polyline& loop) {
    Bounds box;
    for (const Vec2 p : loop) box.add(p);
    return box;
  };
  const auto lengthOf = [](const Polyline& loop) {
    double sum = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) sum += length(loop[(i + 1) % loop.size()] - loop[i]);
    return sum;
  };
  const Shape square = rectangle(20, 20);
  const std::vector<Polyline> inner = offsetLoops(square, -0.2, -0.4, 1000).value();
  CHECK(inner.size() == 25);
  for (std::size_t k = 0; k + 1 < inner.size(); ++k) {
    const double d = 0.2 + 0.4 * double(k);
    const Bounds box = boxOf(inner[k]);
    CHECK(box.min.x == about(d, 0.001));
    CHECK(box.max.y == about(20 - d, 0.001));
    CHECK(std::abs(lengthOf(inner[k]) - 4 * (20 - 2 * d)) < 0.13);  // corners are cut by a cell
  }
  const std::vector<Polyline> outer = offsetLoops(makeDisc(20).value(), 0.2, 0.4, 3).value();
  REQUIRE(outer.size() == 3);
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(lengthOf(outer[k]) == about(2 * 3.14159265 * (10.2 + 0.4 * double(k)), 0.002));
    for (const Vec2 p : outer[k]) CHECK(length(p - Vec2{10, 10}) == about(10.2 + 0.4 * double(k), 0.001));
  }
  std::vector<Polyline> second;
  CHECK(offsetLoops(square, -0.2, -0.4, 3, &second, 0.3).value() == offsetLoops(square, -0.2, -0.4, 3).value());
  CHECK(second == offsetLoops(square, -0.5, -0.4, 3).value());
  CHECK_FALSE(offsetLoops(Shape{}, 0.2, 0.4, 1).ok());
}

TEST_CASE("concentric base layers fill the plate, the same cycle repeats it") {
  Job job = plate(30, 20, 1);
  job.params.elephantFoot = 0;
  job.params.basePattern = BasePattern::Concentric;
  const Written written = job.write();
  const ReadFile file = checkFile(job, written);
  double filament = 0;
  int loops = 0;
  for (const ReadPath& path : file.paths) {
    if (path.role != "Solid infill") continue;
    CHECK(path.closed());
    filament += path.filament();
    ++loops;
  }
  CHECK(loops == 2 * 25);
  CHECK(filament == about(2 * extrusion(0.2, 30, 20), 0.03));

  job.params.basePattern = BasePattern::Same;
  const ReadFile same = checkFile(job, job.write());
  const ReadPath& top = lastPath(same);
  int equal = 0;
  for (const ReadPath& path : same.paths) {
    if (path.role != "Solid infill") continue;
    CHECK(path.closed());
    CHECK(path.moves.size() == top.moves.size());
    CHECK(path.filament() == about(top.filament() / job.params.flow, 1e-3));
    ++equal;
  }
  CHECK(equal == 2);
}

TEST_CASE("the first layer keeps off the border by the elephant's foot") {
  Job job = plate(30, 20);
  const auto firstWidth = [&] {
    const ReadFile file = checkFile(job, job.write());
    std::int64_t lo[3] = {1 << 30, 1 << 30, 1 << 30};
    std::int64_t hi[3] = {};
    for (const ReadPath& path : file.paths) {
      if (path.role != "Solid infill") continue;
      for (const ReadMove& move : path.moves) {
        lo[path.layer] = std::min(lo[path.layer], move.x1);
        hi[path.layer] = std::max(hi[path.layer], move.x1);
      }
    }
    return std::pair{hi[1] - lo[1], hi[2] - lo[2]};
  };
  const auto [first, second] = firstWidth();
  CHECK(first == about(double(second) - 200, 0.001));
  job.params.elephantFoot = 0;
  CHECK(firstWidth().first == second);
}

TEST_CASE("a brim touches the outside of the plate, on the first layer only") {
  Job job = plate(30, 20);
  // A hole, which stays free.
  job.shape.paths[0].rings.push_back({{12, 8}, {18, 8}, {18, 12}, {12, 12}});
  job.shape.paths[0].fillRule = FillRule::EvenOdd;
  job.params.brim = 3;
  job.params.base = 0;
  const ReadFile file = checkFile(job, job.write());
  int loops = 0;
  double outermost = 0;
  double skirt = 0;
  for (const ReadPath& path : file.paths) {
    if (path.role != "Skirt/Brim") continue;
    CHECK(path.layer == 1);
    double lo = 1e9;
    for (const ReadMove& move : path.moves) lo = std::min(lo, double(move.x1) / 1000);
    if (++loops == 1) {
      skirt = lo;
      continue;
    }
    CHECK(lo == about(95 - 0.2 - 0.4 * (4 - loops), 1e-4));
    if (outermost == 0) outermost = lo;
  }
  CHECK(loops == 4);
  CHECK(outermost - skirt == about(5 + 0.2, 0.01));  // the skirt runs around the brim

  job.params.place = Vec2{0.5, 50};
  const Error error = job.write().result.error();
  CHECK(error.code == ErrorCode::DoesNotFit);
  CHECK(error.message.find("by 0.700 mm on the left") != std::string::npos);
}

TEST_CASE("parts too thin for the base layers are reported") {
  Job job = plate();
  job.shape.paths.push_back({{{{30, 0}, {60, 0}, {60, 30}, {59.7, 30}, {59.7, 0.3}, {30, 0.3}}}, FillRule::NonZero});
  job.shape.paths.push_back({{{{0, 20}, {0.35, 20}, {0.35, 190}, {0, 190}}}, FillRule::NonZero});
  const Written written = job.write();
  REQUIRE(written.result.ok());
  CHECK(contains(written.result.value().warnings, "a bottom layer covers only 8"));
}

namespace {

// The share of a path's length that runs within a degree of an angle [degrees].
double shareAlong(const ReadPath& path, double angle) {
  double along = 0;
  double all = 0;
  for (const ReadMove& move : path.moves) {
    const double heading = std::atan2(double(move.y1 - move.y0), double(move.x1 - move.x0));
    const double off = std::abs(std::sin(heading - angle * 3.14159265358979 / 180));
    all += move.length();
    if (off < 0.0175) along += move.length();
  }
  return along / all;
}

// Beads along y that show, and along x below them.
Job crossed(int base) {
  Job job = plate(30, 20);
  job.params.basePattern = BasePattern::Across;
  job.params.base = base;
  Toolpath across = job.toolpath;
  across.cycles = {comb(20, 30, 0.4, 5)};
  for (Vec2f& p : across.cycles[0].points) p = {p.y, p.x};
  job.across = across;
  return job;
}

}  // namespace

TEST_CASE("the base layer next to an oriented one runs across it, and only that one") {
  struct Case {
    ShowSide side;
    int base;
    std::vector<double> angles;  // of each layer from the lowest [degrees]
  };
  const std::vector<Case> cases = {
      {ShowSide::Up, 1, {0, 90}},       {ShowSide::Up, 2, {45, 0, 90}},      {ShowSide::Up, 3, {45, 135, 0, 90}},
      {ShowSide::Bed, 1, {90, 0}},      {ShowSide::Bed, 2, {90, 0, 135}},    {ShowSide::Bed, 3, {90, 0, 135, 45}},
      {ShowSide::Both, 1, {90, 0, 90}}, {ShowSide::Both, 2, {90, 0, 0, 90}}, {ShowSide::Both, 3, {90, 0, 135, 0, 90}},
  };
  for (const Case& c : cases) {
    Job job = crossed(c.base);
    job.params.showSide = c.side;
    const Written written = job.write();
    REQUIRE_MESSAGE(written.result.ok(), written.result.error().message);
    const ReadFile file = readGcode(written.text);
    for (std::size_t layer = 0; layer < c.angles.size(); ++layer) {
      CAPTURE(static_cast<int>(c.side));
      CAPTURE(c.base);
      CAPTURE(layer);
      const ReadPath* longest = nullptr;
      for (const ReadPath& path : file.paths) {
        if (path.layer != static_cast<int>(layer) + 1 || path.role == "Skirt/Brim" || path.role == "Custom") continue;
        if (longest == nullptr || path.filament() > longest->filament()) longest = &path;
      }
      REQUIRE(longest != nullptr);
      CHECK(shareAlong(*longest, c.angles[layer]) > 0.9);
    }
  }
}

TEST_CASE("a layer across takes the plastic of its beads, with the base's flow, and turns with the plate") {
  Job job = crossed(2);
  job.params.baseFlow = 1.03;
  const ReadFile file = checkFile(job, job.write());
  const ReadPath& below = file.paths[file.paths.size() - 2];
  CHECK(below.role == "Solid infill");
  CHECK(below.closed());
  CHECK(below.filament() == about(1.03 * 0.2 * pathVolume(job.across->cycles[0]) / kArea, 1e-4));

  job.params.rotate = 30;
  const ReadFile turned = readGcode(job.write().text);
  CHECK(shareAlong(turned.paths.back(), 120) > 0.9);
  CHECK(shareAlong(turned.paths[turned.paths.size() - 2], 30) > 0.9);
}

TEST_CASE("what a layer across needs is asked for by name, and not read where it is not needed") {
  Job job = crossed(2);
  job.across.reset();
  const Error missing = job.write().result.error();
  CHECK(missing.code == ErrorCode::InvalidArgument);
  CHECK(missing.message.find("basePattern is across") != std::string::npos);
  job.params.base = 0;
  CHECK(job.write().result.ok());

  job = crossed(2);
  job.across->cycles[0].widths.pop_back();
  CHECK(job.write().result.error().message.find("of the toolpath across: ") != std::string::npos);
  job = crossed(2);
  for (Vec2f& p : job.across->cycles[0].points) p.x += 5;  // of another shape
  CHECK(contains(job.write().result.value().warnings, "outside the shape"));
  for (Vec2f& p : job.across->cycles[0].points) p.x += 500;
  CHECK(job.write().result.error().code == ErrorCode::DoesNotFit);

  job = crossed(2);
  job.params.basePattern = BasePattern::Hatched;
  const std::string hatched = job.write().text;
  job.across.reset();
  CHECK(job.write().text == hatched);
}
