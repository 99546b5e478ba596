#include "gcode/read_back.hpp"

#include "support/gcode_job.hpp"

using namespace sillon;
using namespace sillon::test;

namespace {

/// A ring that no turn or mirror maps onto itself, with widths of its own.
Job ringJob() {
  Job job;
  job.shape = rectangle(30, 20);
  job.toolpath.spacing = 0.4;
  Cycle cycle;
  const std::vector<Vec2f> points{{2, 2}, {28, 2}, {28, 9}, {20, 9}, {20, 17}, {2, 12}};
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec2f next = points[(k + 1) % points.size()];
    for (int step = 0; step < 8; ++step) {
      cycle.points.push_back(points[k] + (next - points[k]) * (static_cast<float>(step) / 8));
      cycle.widths.push_back(0.4f);
    }
  }
  job.toolpath.cycles = {cycle};
  return job;
}

/// Largest distance of the written points from the ring, and of the ring's corners from the written points.
float apart(const Toolpath& written, const Toolpath& read) {
  float worst = 0;
  for (const Toolpath* from : {&written, &read}) {
    const Toolpath& to = from == &written ? read : written;
    for (const Vec2f p : from->cycles[0].points) {
      float nearest = 1e9f;
      const std::vector<Vec2f>& line = to.cycles[0].points;
      for (std::size_t k = 0; k < line.size(); ++k) {
        const Vec2f a = line[k], d = line[(k + 1) % line.size()] - a;
        const float t = std::clamp(dot(p - a, d) / std::max(1e-9f, dot(d, d)), 0.0f, 1.0f);
        nearest = std::min(nearest, length(p - a - d * t));
      }
      worst = std::max(worst, nearest);
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("the path comes back from the file to where it was on the page, turned, mirrored or copied") {
  for (const ShowSide side : {ShowSide::Up, ShowSide::Bed}) {
    for (const double rotate : {0.0, 90.0, 33.0}) {
      for (const bool mirror : {false, true}) {
        for (const double copies : {1.0, 2.0}) {
          CAPTURE(rotate);
          CAPTURE(mirror);
          CAPTURE(copies);
          Job job = ringJob();
          job.params.showSide = side;
          job.params.rotate = rotate;
          job.printer.filamentFlow = 0.94;
          job.params.mirror = mirror;
          job.params.copies = {copies, 1};
          job.params.layers = 2;
          const Written written = job.write();
          REQUIRE(written.result.ok());
          const auto read = readBack(written.text, job.shape, job.printer, job.params, 0.4);
          REQUIRE(read.ok());
          REQUIRE(read.value().cycles.size() == 1);
          CHECK(read.value().spacing == 0.4);
          CHECK(apart(job.toolpath, read.value()) < 0.02f);  // what files are rounded and told anew by
        }
      }
    }
  }
}

TEST_CASE("widths are what the file's filament fills") {
  Job job = ringJob();
  for (float& width : job.toolpath.cycles[0].widths) width = 0.52f;
  const Written written = job.write();
  REQUIRE(written.result.ok());
  const auto read = readBack(written.text, job.shape, job.printer, job.params, 0.4);
  REQUIRE(read.ok());
  double sum = 0;
  for (const float width : read.value().cycles[0].widths) sum += static_cast<double>(width);
  CHECK(sum / static_cast<double>(read.value().cycles[0].widths.size()) == doctest::Approx(0.52).epsilon(0.01));
}

TEST_CASE("a file without an oriented layer on the page is refused") {
  const Job job = ringJob();
  for (const char* text : {"", "G28\n", ";TYPE:Solid infill\nG1 X5 Y5 E1\n"}) {
    const auto read = readBack(text, job.shape, job.printer, job.params, 0.4);
    REQUIRE(!read.ok());
    CHECK(read.error().code == ErrorCode::InvalidFile);
  }
}
