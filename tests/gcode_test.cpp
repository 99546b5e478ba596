#include "sillon/gcode.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "base_layers.hpp"
#include "gcode_template.hpp"
#include "motion.hpp"
#include "offset_loops.hpp"
#include "sillon/bed_fit.hpp"
#include "sillon/gcode_check.hpp"
#include "sillon/presets.hpp"
#include "support/about.hpp"
#include "support/gcode_check.hpp"
#include "text.hpp"

using namespace sillon;
using namespace sillon::test;
using doctest::Approx;

namespace {

constexpr double kArea = 2.4052818754046854;  // of filament of 1.75 mm [mm²]
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Written {
  Result<GcodeSummary> result;
  std::string text;
  std::size_t chunks;
};

struct Job {
  Toolpath toolpath;
  Shape shape;
  Printer printer;
  PrintParams params;

  [[nodiscard]] Written write() const {
    std::string text;
    std::size_t chunks = 0;
    auto result = writeGcode(toolpath, shape, printer, params, [&](std::string_view piece) {
      CHECK(piece.size() <= 64 * 1024);
      text += piece;
      ++chunks;
      return true;
    });
    return {std::move(result), std::move(text), chunks};
  }
};

Shape rectangle(double width, double height) {
  return {{{{{{0, 0}, {width, 0}, {width, height}, {0, height}}}, FillRule::NonZero}}, {width, height}};
}

// A comb that covers width x height with beads of `spacing` and comes back along the bottom: cells exactly filled.
Cycle comb(double width, double height, double spacing, double step) {
  Cycle cycle;
  const auto add = [&](double x, double y) {
    const Vec2f p{static_cast<float>(std::round(x * 1000) / 1000), static_cast<float>(std::round(y * 1000) / 1000)};
    if (!cycle.points.empty()) {
      const Vec2f from = cycle.points.back();
      const int pieces = std::max(1, static_cast<int>(length(p - from) / step));
      for (int k = 1; k < pieces; ++k) {
        const float t = static_cast<float>(k) / static_cast<float>(pieces);
        const Vec2f q = from + t * (p - from);
        cycle.points.push_back({std::round(q.x * 1000) / 1000, std::round(q.y * 1000) / 1000});
      }
    }
    cycle.points.push_back(p);
  };
  const int columns = static_cast<int>(width / spacing / 2) * 2;  // even: the comb ends at the bottom
  add(spacing / 2, spacing / 2);
  for (int k = 0; k < columns; ++k) {
    const double x = (k + 0.5) * spacing;
    const double bottom = k == 0 ? spacing / 2 : 1.5 * spacing;
    const double top = height - spacing / 2;
    add(x, k % 2 == 0 ? bottom : top);
    add(x, k % 2 == 0 ? top : k + 1 == columns ? spacing / 2 : bottom);
  }
  cycle.points.erase(cycle.points.begin());
  cycle.widths.assign(cycle.points.size(), static_cast<float>(spacing));
  return cycle;
}

double pathVolume(const Cycle& cycle) {  // sum of w L
  double sum = 0;
  for (std::size_t i = 0; i < cycle.points.size(); ++i) {
    const std::size_t j = (i + 1) % cycle.points.size();
    const Vec2 a{cycle.points[i].x, cycle.points[i].y};
    const Vec2 b{cycle.points[j].x, cycle.points[j].y};
    sum += length(b - a) * (double(cycle.widths[i]) + double(cycle.widths[j])) / 2;
  }
  return sum;
}

Job plate(double width = 30, double height = 20, double step = 5) {
  Job job;
  job.shape = rectangle(width, height);
  job.toolpath.cycles = {comb(width, height, 0.4, step)};
  job.toolpath.spacing = 0.4;
  return job;
}

bool contains(const std::vector<std::string>& list, std::string_view part) {
  return std::any_of(list.begin(), list.end(), [&](const std::string& s) { return s.find(part) != std::string::npos; });
}

// Everything that holds for every file.
ReadFile checkFile(const Job& job, const Written& written) {
  REQUIRE_MESSAGE(written.result.ok(), written.result.error().message);
  const GcodeSummary& summary = written.result.value();
  CHECK(grammarError(written.text) == "");
  const GcodeCheck check = checkGcode(written.text, job.printer);
  for (const GcodeFinding& finding : check.findings) {
    // Thin plates without room to prime or slow down are warned about, as they should be.
    if (finding.error) FAIL_CHECK(finding.rule << " " << finding.message << " in line " << finding.line);
  }
  ReadFile file = readGcode(written.text);
  CHECK_MESSAGE(file.faults.empty(), file.faults.front());
  CHECK(file.minX >= job.printer.bedMin.x);
  CHECK(file.minY >= job.printer.bedMin.y);
  CHECK(file.maxX <= job.printer.bedMax.x);
  CHECK(file.maxY <= job.printer.bedMax.y);
  CHECK(file.maxZ <= job.printer.maxZ);
  CHECK(file.layers == job.params.base + job.params.layers);
  CHECK(file.moves == summary.moves);
  CHECK(static_cast<std::int64_t>(written.text.size()) == summary.bytes);
  CHECK(file.filament == Approx(summary.filamentMm).epsilon(1e-9));
  CHECK(check.filamentMm == Approx(summary.filamentMm).epsilon(1e-9));
  CHECK(check.layers == file.layers);
  CHECK(valueOf(written.text, "; filament used [mm] = ") == fixed(file.filament, 2));
  CHECK(valueOf(written.text, "; total layers count = ") == std::to_string(file.layers));

  double oriented = 0;
  for (const ReadPath& path : file.paths) {
    const bool isOriented = path.role == "Top solid infill";
    if (isOriented || (path.role == "Skirt/Brim" && path.moves.size() > 1)) CHECK(path.closed());
    CHECK(path.retractsAfter == (job.printer.retractLength > 0));
    const double height =
        path.layer == 1 && job.params.firstLayerHeight > 0 ? job.params.firstLayerHeight : job.params.layerHeight;
    const double speed = path.layer == 1 ? job.printer.firstLayerSpeed : job.printer.speed;
    if (isOriented) oriented += path.filament() / height / job.params.flow;
    double fastest = 0;
    double volumeRate = 0;
    for (const ReadMove& move : path.moves) {
      fastest = std::max(fastest, double(move.feedrate) / 60);
      if (move.length() > 0.02) {
        volumeRate =
            std::max(volumeRate, double(move.e - 1) / 1e5 * kArea / move.length() * double(move.feedrate) / 60);
      }
    }
    CHECK(fastest <= speed + 1e-9);
    CHECK(volumeRate <= job.printer.maxFlow);
    for (std::size_t i = 0; i + 8 <= path.moves.size(); ++i) {
      double seconds = 0;
      for (std::size_t k = i; k < i + 8; ++k) seconds += path.moves[k].length() * 60 / double(path.moves[k].feedrate);
      if (seconds * job.printer.maxSegmentsPerSecond < 8 * (1 - 1e-9)) FAIL_CHECK("too many segments per second");
    }
  }
  if (summary.clampedLengthMm == 0) {
    double expected = 0;
    for (const Cycle& cycle : job.toolpath.cycles) expected += pathVolume(cycle) / kArea;
    CHECK(oriented == Approx(expected * job.params.layers).epsilon(1e-5));
  }
  return file;
}

const ReadPath& lastPath(const ReadFile& file) { return file.paths.back(); }

// A rough closed path: a wavy circle whose widths jump.
Cycle roughCircle(std::mt19937& random, double radius, int count, double low, double high) {
  Cycle cycle;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * 3.14159265358979 * k / count;
    const double r = radius + 0.3 * double(random() % 1000) / 1000;
    cycle.points.push_back({static_cast<float>(std::round((15 + r * std::cos(angle)) * 1000) / 1000),
                            static_cast<float>(std::round((15 + r * std::sin(angle)) * 1000) / 1000)});
    cycle.widths.push_back(static_cast<float>(low + (high - low) * double(random() % 1000) / 999));
  }
  return cycle;
}

MotionLimits someLimits(GcodeFlavor flavor = GcodeFlavor::Klipper) {
  MotionLimits limits;
  limits.flavor = flavor;
  limits.layerHeight = 0.2;
  limits.filamentArea = kArea;
  limits.speed = 50;
  limits.acceleration = 1000;
  limits.cornerSpeed = flavor == GcodeFlavor::Klipper ? 5 : 4;
  limits.maxFlow = 100;
  limits.maxSegmentsPerSecond = 100000;
  limits.pressureAdvance = 0.04;
  return limits;
}

BeadPath pathOf(const std::vector<Vec2>& mm, double width, bool closed = false) {
  BeadPath path;
  path.closed = closed;
  for (const Vec2 p : mm) path.points.push_back({std::llround(p.x * 1000), std::llround(p.y * 1000)});
  path.widths.assign(mm.size(), width);
  return path;
}

double volumeOf(const std::vector<double>& widths, const std::vector<double>& lengths) {
  double sum = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i) sum += lengths[i] * (widths[i] + widths[i + 1]) / 2;
  return sum;
}

}  // namespace

// ---- numbers

TEST_CASE("numbers are printed with fixed digits and never as minus zero") {
  CHECK(fixed(0.4, 2) == "0.40");
  CHECK(fixed(-0.0001, 3) == "0.000");
  CHECK(fixed(-1.0005, 3) == "-1.001");
  CHECK(fixed(12345678.9, 0) == "12345679");
  CHECK(decimal(60, 3) == "60");
  CHECK(decimal(0.25, 3) == "0.25");
  CHECK(decimal(-12.5, 6) == "-12.5");
  CHECK(decimal(1000, 0) == "1000");
  CHECK(decimal(kNan, 3) == "not a number");
  CHECK(decimal(-kInfinity, 3) == "-infinite");
  CHECK(decimal(1e300, 3) == "above 1e12");
  char text[32];
  CHECK(std::string(text, printScaled(text, std::numeric_limits<std::int64_t>::min(), 5)) == "-92233720368547.75808");
  CHECK(std::string(text, printScaled(text, -1, 3)) == "-0.001");
}

TEST_CASE("the checker's grammar refuses what kills prints") {
  CHECK(grammarError("G1 X1.000 Y-2.500 E0.00001 F3000\n;note\nM104 S0\nSET_PRESSURE_ADVANCE ADVANCE=0.0400\n") == "");
  for (const char* bad : {"G1 E1.2e-05", "G1X50Y50", "g1 X5", "G1 Xnan", "G1 X-0.000", "G1 X1 X2", "G1 X+1", "G1 X1,5",
                          "G1  X1", "G1 X1 ", "G1 X.5", "G1 X5.", "G1 X05", "M117 hello", "G1 X1\r", "set_x A=1"}) {
    CAPTURE(bad);
    CHECK(grammarError(std::string(bad) + "\n") != "");
  }
  CHECK(grammarError("G1 X1") != "");
}

// ---- extrusion

TEST_CASE("filament equals the plastic of the cell a bead fills") {
  CHECK(extrusion(0.2, 0.4, 10, 1.75, 1) == about(0.33260, 2e-5));
  CHECK(extrusion(0.2, 0.5, 2, 1.75, 1) == about(0.08315, 6e-5));
  CHECK(extrusion(0.2, 0.4, 10, 1.75, 0.95) == about(0.31597, 2e-5));
  CHECK(extrusion(0.2, 0.4, 4000, 1.75, 1) == Approx(133.041).epsilon(4e-6));
}

TEST_CASE("the file carries the same plastic: constant width, growing width, flow") {
  Job job = plate();
  job.params.base = 0;
  job.params.skirt = 0;
  job.params.flow = 1;
  job.printer.firstLayerSpeed = 20;
  job.shape = rectangle(12, 12);
  // Ten mm at 0.4, then 0.4 to 0.6 over 2 mm, which 20 mm/s and K 0.04 allow (slope 0.1 against 0.375).
  job.toolpath.cycles = {{{{1, 1}, {11, 1}, {11, 3}, {11, 11}}, {0.4f, 0.4f, 0.6f, 0.6f}}};
  const ReadFile file = checkFile(job, job.write());
  const std::vector<ReadMove>& moves = lastPath(file).moves;
  REQUIRE(moves.size() == 1 + 10 + 1 + 10);  // a width step of 0.02 mm per move, and back over the last ten mm
  CHECK(moves[0].e == 33260);
  std::int64_t growing = 0;
  for (std::size_t k = 1; k <= 10; ++k) {
    growing += moves[k].e;
    CHECK(moves[k].length() == Approx(0.2));
    CHECK(double(moves[k].e) / 1e5 == about(extrusion(0.2, 0.39 + 0.02 * double(k), 0.2, 1.75, 1), 1e-3));
  }
  CHECK(growing == 8315);
  job.params.flow = 0.95;
  CHECK(lastPath(checkFile(job, job.write())).moves[0].e == 31597);
}

TEST_CASE("a full layer of 40 x 40 mm takes 133.041 mm of filament") {
  Job job = plate(40, 40, 1);
  job.params.base = 0;
  job.params.flow = 1;
  // The comb misses its area by less than a cell per column.
  CHECK(pathVolume(job.toolpath.cycles[0]) == about(1600, 0.001));
  const ReadFile file = checkFile(job, job.write());
  CHECK(lastPath(file).filament() == about(133.041, 0.001));
}

TEST_CASE("tiny steps lose no plastic to rounding") {
  Job job = plate(30, 20, 0.02);
  job.params.base = 0;
  const Written written = job.write();
  const ReadFile file = checkFile(job, written);
  double exact = 0;
  double printed = 0;
  double worst = 0;
  for (const ReadMove& move : lastPath(file).moves) {
    exact += extrusion(0.2, 0.4, move.length(), 1.75, 0.95);
    printed += double(move.e) / 1e5;
    worst = std::max(worst, std::abs(exact - printed));
  }
  CHECK(worst < 1.2e-5);  // float widths add a little to the half unit on either end
}

// ---- skeleton

TEST_CASE("the file has the skeleton hosts look for") {
  Job job = plate();
  job.params.layers = 2;
  job.params.base = 1;
  job.params.firstLayerHeight = 0.25;
  job.params.date = "2026-11-21 at 10:11:12 UTC";
  job.params.notes = {"seed = 7"};
  for (const GcodeFlavor flavor : {GcodeFlavor::Marlin, GcodeFlavor::Klipper}) {
    job.printer.flavor = flavor;
    const Written written = job.write();
    checkFile(job, written);
    const std::string& text = written.text;
    CHECK(text.starts_with("; generated by Sillon "));
    CHECK(text.substr(0, text.find('\n')).ends_with(" on 2026-11-21 at 10:11:12 UTC"));
    std::size_t at = 0;
    for (const char* piece :
         {"; generated by Sillon ",
          "\n; plate = 30.0x20.0 mm, spacing = 0.40",
          "\n; seed = 7\n",
          "\n; external perimeters extrusion width = 0.44mm\n",
          "\n; max_z_height: 0.65\n",
          "\n; total layer number: 3\n",
          "\nM73 P0 R",
          "\n;TYPE:Custom\n; FEATURE: Custom\nM140 S60\nM104 S150\nG28\nM190 S60\nM109 S220\n",
          "\nG21\nG90\nM83\nG92 E0\n",
          "\n;BEFORE_LAYER_CHANGE\n;0.25\n;LAYER_CHANGE\n;Z:0.25\n;HEIGHT:0.25\n",
          "\nM106 S0\n",
          "\n;TYPE:Skirt/Brim\n; FEATURE: Skirt\n",
          "\n;TYPE:Solid infill\n",
          "\n;LAYER_CHANGE\n;Z:0.45\n;HEIGHT:0.2\n",
          "\nM106 S255\nM104 S215\n",
          "\n;TYPE:Top solid infill\n; FEATURE: Top surface\n",
          "\n;Z:0.65\n",
          "\n;TYPE:Custom\n; FEATURE: Custom\nG1 Z",
          "\nM104 S0\nM140 S0\nM107\n",
          "\nM84\nM73 P100 R0\n",
          "; filament used [mm] = ",
          "\n; filament used [cm3] = ",
          "\n; filament used [g] = ",
          "\n; total filament used [g] = ",
          "\n; total layers count = 3\n",
          "\n; estimated printing time (normal mode) = ",
          "\n; layer_height = 0.2\n; first_layer_height = 0.25\n; nozzle_diameter = 0.4\n; filament_diameter = 1.75\n",
          "\n; filament_type = PLA\n",
          "\n; bed_shape = 0x0,220x0,220x220,0x220\n",
          "\n; printer_model = Generic\n"}) {
      CAPTURE(piece);
      const std::size_t found = text.find(piece, at);
      REQUIRE(found != std::string::npos);
      at = found;
    }
    CHECK(text.find("PrusaSlicer") == std::string::npos);
    const bool klipper = flavor == GcodeFlavor::Klipper;
    CHECK((text.find("SET_PRINT_STATS_INFO TOTAL_LAYER=3") != std::string::npos) == klipper);
    CHECK(text.find(klipper ? "gcode_flavor = klipper" : "gcode_flavor = marlin2") != std::string::npos);
  }
}

TEST_CASE("nothing outlives the print") {
  Job job = plate();
  for (const char* code : {"M92", "M301", "M304", "M500", "M851", "M203", "M201", "M205", "M566", "SAVE_CONFIG", "M204",
                           "M900", "SET_VELOCITY_LIMIT", "SET_PRESSURE_ADVANCE"}) {
    CAPTURE(code);
    CHECK(job.write().text.find(code) == std::string::npos);
  }
  job.printer.setPressureAdvance = true;
  job.printer.machineAcceleration = 4000;
  std::string text = job.write().text;
  CHECK(text.find("M900 K0.0400\n") < text.find("M900 K0\n"));
  CHECK(text.find("M900 K0\n") != std::string::npos);
  CHECK(text.find("M204 P1000 T1000\n") < text.find("M204 P4000 T4000\n"));
  CHECK(text.find("M204 P4000 T4000\n") != std::string::npos);
  job.printer.flavor = GcodeFlavor::Klipper;
  const Written written = job.write();
  checkFile(job, written);
  text = written.text;
  CHECK(text.find("ADVANCE=0.0400\n") < text.find("ADVANCE=0\n"));
  CHECK(text.find("ADVANCE=0\n") != std::string::npos);
  CHECK(text.find("M204 S1000\n") < text.find("M204 S4000\n"));
  CHECK(text.find("M204 S4000\n") != std::string::npos);
}

TEST_CASE("acceleration is held at the machine's, with a warning") {
  Job job = plate();
  job.printer.acceleration = 9000;
  job.printer.machineAcceleration = 4000;
  const Written written = job.write();
  checkFile(job, written);
  CHECK(
      contains(written.result.value().warnings, "acceleration is 9000 mm/s2; it is held at machineAcceleration, 4000"));
  CHECK(written.text.find("M204 P9000") == std::string::npos);
  job.printer.acceleration = 4000;
  CHECK(job.write().text == written.text);
}

TEST_CASE("text of the user stays inside its comment") {
  Job job = plate();
  job.params.notes = {"first\nM112\r\nG28 \xc3\xa9", std::string(200000, 'x')};
  job.printer.name = "Mine\nM112";
  const Written written = job.write();
  checkFile(job, written);
  CHECK(written.text.find("\nM112") == std::string::npos);
  CHECK(written.text.find("; first M112  G28 ??\n") != std::string::npos);
  CHECK(written.text.find(std::string(200000, 'x')) != std::string::npos);
}

TEST_CASE("progress rises and ends at 100") {
  Job job = plate();
  const std::string text = job.write().text;
  int last = -1;
  int lastMinutes = 1 << 30;
  for (std::size_t at = text.find("\nM73 P"); at != std::string::npos; at = text.find("\nM73 P", at + 1)) {
    const int percent = std::atoi(text.c_str() + at + 6);
    const int minutes = std::atoi(text.c_str() + text.find(" R", at) + 2);
    CHECK(percent > last);
    CHECK(minutes <= lastMinutes);
    last = percent;
    lastMinutes = minutes;
  }
  CHECK(last == 100);
  CHECK(lastMinutes == 0);
}

TEST_CASE("the same job gives the same bytes") {
  std::mt19937 random(7);
  Job job = plate(30, 30);
  job.toolpath.cycles = {roughCircle(random, 12, 500, 0.3, 0.5)};
  const std::string once = job.write().text;
  CHECK(once == job.write().text);
  job.params.flow = 0.94;
  CHECK(once != job.write().text);
}

// ---- cycles

TEST_CASE("a cycle is written vertex by vertex, closing segment included") {
  Job job = plate(30, 20, 1.3);
  job.params.place = Vec2{20, 30};
  const ReadFile file = checkFile(job, job.write());
  const Cycle& cycle = job.toolpath.cycles[0];
  const std::vector<ReadMove>& moves = lastPath(file).moves;
  REQUIRE(moves.size() == cycle.points.size());
  for (std::size_t i = 0; i < moves.size(); ++i) {
    CHECK(moves[i].x0 == std::llround(double(cycle.points[i].x) * 1000) + 20000);
    CHECK(moves[i].y0 == std::llround(double(cycle.points[i].y) * 1000) + 30000);
  }
}

TEST_CASE("vertices that round to the same place are merged") {
  Job job = plate();
  job.params.base = 0;
  job.toolpath.cycles = {{{{1, 1}, {1.0001f, 1}, {9, 1}, {9, 9}, {9, 9}, {1, 9}, {1, 1}}, std::vector<float>(7, 0.4f)}};
  const ReadFile file = checkFile(job, job.write());
  CHECK(lastPath(file).moves.size() == 4);
}

TEST_CASE("the seam moves from layer to layer") {
  Job job = plate();
  job.params.layers = 4;
  const ReadFile file = checkFile(job, job.write());
  std::vector<std::pair<std::int64_t, std::int64_t>> starts;
  for (const ReadPath& path : file.paths) {
    if (path.role == "Top solid infill") starts.emplace_back(path.moves[0].x0, path.moves[0].y0);
  }
  REQUIRE(starts.size() == 4);
  std::sort(starts.begin(), starts.end());
  CHECK(std::adjacent_find(starts.begin(), starts.end()) == starts.end());
}

TEST_CASE("between cycles: retract, wipe 2 to 5 mm back on the path, lift, travel, lower, prime") {
  Job job = plate();
  job.params.base = 0;
  job.params.skirt = 0;
  job.params.place = Vec2{50, 50};
  job.toolpath.cycles = {{{{1, 1}, {9, 1}, {9, 9}, {1, 9}}, std::vector<float>(4, 0.4f)},
                         {{{11, 1}, {19, 1}, {19, 9}, {11, 9}}, std::vector<float>(4, 0.4f)}};
  const Written written = job.write();
  checkFile(job, written);
  // The first cycle ends at its start (51, 51), having come down from (51, 59).
  const std::string tail =
      "G1 E-0.80000 F2100\nG1 X51.000 Y54.000 F1200\nG1 Z0.600 F600\nG1 X61.000 Y51.000 F7200\nG1 Z0.200 F600\n"
      "G1 E0.80000 F2100\nG1 X69.000 Y51.000 E";
  const std::size_t at = written.text.find("G1 E-0.80000 F2100\nG1 X51.000 Y54.000 F1200\n");
  REQUIRE(at != std::string::npos);
  CHECK(written.text.substr(at, tail.size()) == tail);
  // No fast way across the print without a lift.
  for (const ReadMove& move : readGcode(written.text).travels) {
    if (move.feedrate == 7200 && move.z < 1000) CHECK(move.z == 600);
  }
}

TEST_CASE("without retraction length no empty E lines are written") {
  Job job = plate();
  job.printer.retractLength = 0;
  job.printer.lift = 0;
  const Written written = job.write();
  CHECK(grammarError(written.text) == "");
  CHECK(written.text.find("\nG1 E") == std::string::npos);
}

// ---- widths

TEST_CASE("widths beyond 0.6 and 1.6 nozzle are held there and reported") {
  Job job = plate();
  job.params.base = 0;
  job.params.layers = 3;
  job.params.flow = 1;
  job.toolpath.cycles = {{{{1, 1}, {11, 1}, {11, 11}, {1, 11}}, {0.1f, 0.1f, 0.4f, 0.4f}}};
  const Written written = job.write();
  const ReadFile file = checkFile(job, written);
  CHECK(written.result.value().clampedLengthMm == Approx(60));  // one whole segment and two halves, three times
  CHECK(
      contains(written.result.value().warnings, "50.0 % of the path is printed with a width held at 0.24 or 0.64 mm"));
  CHECK(lastPath(file).filament() == about(extrusion(0.2, 0.24 + 0.32 + 0.4 + 0.32, 10, 1.75, 1), 1e-4));
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

TEST_CASE("the slope limit holds in the printed text") {
  std::mt19937 random(11);
  Job job = plate(30, 30);
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

// ---- speed

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

TEST_CASE("with constant flow the speed follows the width, as far as 1.5 times its value") {
  Job job = plate();
  job.params.skirt = 0;
  job.params.constantFlow = true;
  job.printer.curveAcceleration = 0;
  job.printer.speed = 40;
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
  for (int k = 0; k < 100; ++k) points.push_back({k * 0.05, 0});
  const Motion dense = planMotion(pathOf(points, 0.4), 0, limits);
  for (const std::int32_t feedrate : dense.feedrates) CHECK(feedrate == 15 * 60);
  CHECK(dense.segmentSlowedMm == Approx(4.95));

  points.clear();
  for (int k = 0; k < 100; ++k) points.push_back({k * 0.001, 0});  // the printer crawls, but it moves
  for (const std::int32_t feedrate : planMotion(pathOf(points, 0.4), 0, limits).feedrates) CHECK(feedrate == 18);
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

TEST_CASE("a hairpin is slower than its straights, which keep their speed, and so are its first and last bends") {
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
}

TEST_CASE("width jumps slow the extruder as Klipper does") {
  std::vector<Vec2> points;
  for (int k = 0; k <= 4000; ++k) points.push_back({k * 0.03, 0});  // too short to be made several moves
  BeadPath path = pathOf(points, 0.4);
  MotionLimits limits = someLimits();
  limits.pressureAdvance = 0;
  limits.maxSegmentsPerSecond = 1e6;
  const double even = planMotion(path, 0, limits).totalSeconds;
  // Means of neighbouring segments alternate when widths go 0.4 0.4 0.6 0.6; Klipper keeps 50 mm/s up to 0.24.
  const auto alternate = [&](double jump) {
    for (std::size_t k = 0; k < path.widths.size(); ++k) path.widths[k] = 0.4 + (k / 2 % 2 == 1 ? 2 * jump : 0);
    return planMotion(path, 0, limits).totalSeconds;
  };
  CHECK(alternate(0.23) == Approx(even));
  CHECK(alternate(0.30) > even * 1.02);
}

// ---- base layers and skirt

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
  REQUIRE(file.paths.size() > 2);
  CHECK(file.paths[0].role == "Skirt/Brim");
  CHECK(file.paths[0].moves[0].x0 == 50000 - 5400);
  CHECK(file.paths[1].moves[0].x0 == 50000 - 5000);
  CHECK(file.paths[1].moves[0].x1 == 80000 + 5000);
  CHECK(file.paths[1].moves[1].y1 == 80000 + 5000);
  CHECK(std::count_if(file.paths.begin(), file.paths.end(), [](auto& p) { return p.role == "Skirt/Brim"; }) == 2);
}

TEST_CASE("a skirt that does not fit is left out with a warning, and a purge line primes instead") {
  Job job = plate();
  job.printer.bedMax = {32, 60};
  const Written written = job.write();
  const ReadFile file = checkFile(job, written);
  CHECK(contains(written.result.value().warnings, "skirt does not fit"));
  REQUIRE(file.paths[0].role == "Skirt/Brim");
  CHECK(file.paths[0].moves.size() == 1);
  CHECK(file.paths[0].moves[0].y0 == 5000);

  job.printer.bedMax = {60, 22};
  CHECK(checkFile(job, job.write()).paths[0].moves[0].x0 == 5000);

  job.printer.bedMax = {31, 21};
  const Written tight = job.write();
  CHECK(checkFile(job, tight).paths[0].role == "Solid infill");
  CHECK(contains(tight.result.value().warnings, "no room for a purge line"));
}

// ---- above a print

TEST_CASE("above a print all layers are ordinary ones, and nothing moves below its height") {
  Job job = plate(30, 20, 1.3);
  job.params.startHeight = 5.05;
  job.params.base = 1;
  job.params.layers = 2;
  // Of what only layers on the bed have, nothing is heeded.
  job.params.firstLayerHeight = 0.3;
  job.params.brim = 3;
  job.params.skirt = 2;
  job.params.elephantFoot = 0.3;
  const Written written = job.write();
  REQUIRE_MESSAGE(written.result.ok(), written.result.error().message);
  const std::string& text = written.text;
  CHECK(grammarError(text) == "");
  CHECK(checkGcode(text, job.printer).findings.empty());
  CHECK(checkGcode(text).findings.empty());
  CHECK(checkGcode(text).lowest == 5.25);
  const ReadFile file = readGcode(text);
  CHECK_MESSAGE(file.faults.empty(), file.faults.front());

  const std::int64_t tops[] = {5250, 5450, 5650};
  REQUIRE(file.paths.size() > 2);
  CHECK(file.paths.front().role == "Solid infill");
  for (const ReadPath& path : file.paths) {
    CHECK(path.role != "Skirt/Brim");
    std::int64_t fastest = 0;
    for (const ReadMove& move : path.moves) {
      CHECK(move.z == tops[path.layer - 1]);
      fastest = std::max(fastest, move.feedrate);
    }
    if (path.moves.size() > 9) CHECK(fastest == 3000);  // 50 mm/s on the first layer, too
  }
  for (const ReadMove& move : file.travels) CHECK(move.z >= 5250);
  CHECK(text.find("G28\nM190 S60\nM109 S215\n") != std::string::npos);
  CHECK(text.find("S220") == std::string::npos);  // of a first layer on the bed
  CHECK(text.find("M106 S0\n") == std::string::npos);
  CHECK(text.find("M106 S255\nM104 S215\n;TYPE:Solid infill\n") != std::string::npos);
  CHECK(text.find("\nM104 S215\n;TYPE:Top solid") == std::string::npos);  // once
  CHECK(text.find(
            "M109 S215\nG21\nG90\nM83\nG92 E0\n;BEFORE_LAYER_CHANGE\n;5.25\n;LAYER_CHANGE\n;Z:5.25\n;HEIGHT:0.2\n") !=
        std::string::npos);
  CHECK(text.find("\n;Z:5.65\n;HEIGHT:0.2\n") != std::string::npos);
  CHECK(valueOf(text, "; max_z_height: ") == "5.65");
  CHECK(valueOf(text, "; total layers count = ") == "3");
  CHECK(valueOf(text, "; start height = ") ==
        "5.05 mm, of a print on the bed that homing and probing (G28, G29) must not touch");
  CHECK(contains(written.result.value().warnings, "a print of 5.05 mm stands on the bed while the start block homes"));
  CHECK(contains(written.result.value().warnings, "the nozzle is not primed"));

  // The same layers as on the bed, but for its height, and but for what only the bed has.
  Job plain = job;
  plain.params.startHeight = 0;
  plain.params.firstLayerHeight = 0;
  plain.params.elephantFoot = 0;
  plain.params.brim = plain.params.skirt = 0;
  plain.printer.firstLayerSpeed = plain.printer.speed;
  plain.printer.bedMax = {30.5, 20.5};  // no room for a purge line
  job.printer.bedMax = plain.printer.bedMax;
  const ReadFile high = readGcode(job.write().text);
  const ReadFile low = readGcode(plain.write().text);
  CHECK(high.filament == low.filament);
  REQUIRE(high.paths.size() == low.paths.size());
  for (std::size_t k = 0; k < high.paths.size(); ++k) {
    REQUIRE(high.paths[k].moves.size() == low.paths[k].moves.size());
    for (std::size_t i = 0; i < high.paths[k].moves.size(); ++i) {
      const ReadMove& a = high.paths[k].moves[i];
      const ReadMove& b = low.paths[k].moves[i];
      if (a.x1 != b.x1 || a.y1 != b.y1 || a.e != b.e || a.feedrate != b.feedrate || a.z != b.z + 5050) FAIL_CHECK(k);
    }
  }
  CHECK(job.write().result.value().seconds == Approx(plain.write().result.value().seconds).epsilon(1e-3));
}

TEST_CASE("above a print the oriented layers may be all there is, in constant flow from the first bead") {
  Job job = plate(30, 20, 1.3);
  job.params.base = 0;
  job.params.startHeight = 0.4;
  job.params.constantFlow = true;
  for (float& width : job.toolpath.cycles[0].widths) width = 0.32f;
  const ReadFile file = readGcode(job.write().text);
  REQUIRE(file.paths.size() == 1);
  CHECK(file.paths[0].moves[0].z == 600);
  double fastest = 0;
  for (const ReadMove& move : file.paths[0].moves) fastest = std::max(fastest, double(move.feedrate) / 60);
  CHECK(fastest == Approx(50 * 0.4 / 0.32).epsilon(0.02));
}

TEST_CASE("copies above a print: their own layers must be low, and travels pass above those that are done") {
  Job job = plate(30, 20, 1.3);
  job.params.startHeight = 40;
  job.params.copies = {2, 1};
  job.params.brim = 2;
  const std::string text = job.write().text;
  CHECK(checkGcode(text, job.printer).errors() == 0);
  for (const ReadMove& move : readGcode(text).travels) {
    if (move.length() > 30 && move.x0 != 0) CHECK(move.z >= 40600);
  }
  CHECK(checkGcode(text).lowest == 40.2);
  // Brims keep their room, so that the copies stand where those of the base's file do.
  Job below = job;
  below.params.startHeight = 0;
  const auto starts = [](const ReadFile& file) {
    std::vector<std::int64_t> at;
    for (const ReadPath& path : file.paths) {
      if (path.role == "Top solid infill") at.push_back(path.moves[0].x0);
    }
    return at;
  };
  CHECK(starts(readGcode(text)) == starts(readGcode(below.write().text)));
  job.params.base = 20;
  CHECK(job.write().result.error().message.find("the plates are 4.2 mm high; several on one bed") == 0);
}

TEST_CASE("blocks that go down to where a print stands are pointed out") {
  Job job = plate(30, 20, 1.3);
  job.params.startHeight = 5;
  const std::string start = "G28\nM190 S60\nM109 S[first_layer_temperature]\n";
  const auto warned = [&](const std::string& block, const char* part) {
    job.printer.startGcode = start + block;
    const Written written = job.write();
    REQUIRE_MESSAGE(written.result.ok(), written.result.error().message);
    CHECK(written.text.find("M109 S215\n") != std::string::npos);
    CHECK(!contains(written.result.value().warnings, "not primed"));  // the block's matter
    return contains(written.result.value().warnings, part);
  };
  const char* low = "startGcode moves along the bed at Z 0.3; what stands there is 5 mm high";
  CHECK(warned("G1 Z9 F600\nG1 X60 F3000\nG1 Z0.3\nG1 X90 E9\nG1 Z9", low));
  CHECK(!warned("G1 Z9 F600\nG1 X60 E9 F3000", "startGcode moves"));
  CHECK(!warned("G1 Z0.3 F600\nG1 Z9\nG1 X60 F3000", "startGcode moves"));         // not along the bed
  CHECK(!warned("G1 X60 Y60 F3000\nG91\nG1 Z1\nG1 X1\nG90", "startGcode moves"));  // how high is not told
  CHECK(warned("G1 Z0.3 F600\nG28\nG1 X60 F3000\nG1 X70 Z2", "startGcode moves along the bed at Z 2;"));
  job.printer.endGcode = "M104 S0\nM140 S0\nG1 Z5.5 F600\nG1 X0 F3000";
  CHECK(warned("", "endGcode moves along the bed at Z 5.5; what stands there is 5.6 mm high"));
  job.printer.endGcode = "M104 S0\nM140 S0\nG91\nG1 Z5 F600\nG90\nG1 X0 F3000";
  CHECK(!warned("", "endGcode moves"));
  job.params.startHeight = 0;
  job.printer.startGcode = start + "G1 Z0.3 F600\nG1 X60 E9 F3000";
  CHECK(job.write().result.value().warnings.empty());
}

// ---- the stack

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
  CHECK(filament == about(2 * extrusion(0.2, 30, 20, 1.75, 1), 0.03));

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

TEST_CASE("a plate shown from below has its mirrored path on the bed and its base above") {
  Job job = plate(30, 20, 1.3);
  job.params.layers = 2;
  Job mirrored = job;
  mirrored.params.mirror = true;
  const Written warned = mirrored.write();
  CHECK(contains(warned.result.value().warnings, "the plate is mirrored but shown from above"));
  const ReadFile flipped = checkFile(mirrored, warned);
  job.params.showSide = ShowSide::Bed;
  const Written written = job.write();
  CHECK_FALSE(contains(written.result.value().warnings, "mirrored"));
  const ReadFile file = checkFile(job, written);
  std::vector<std::string> roles;
  for (const ReadPath& path : file.paths) {
    if (roles.empty() || roles.back() != path.role) roles.push_back(path.role);
  }
  CHECK(roles == std::vector<std::string>{"Skirt/Brim", "Top solid infill", "Solid infill"});
  const auto oriented = [](const ReadFile& read, int which) {
    for (const ReadPath& path : read.paths) {
      if (path.role == "Top solid infill" && which-- == 0) return path;
    }
    return ReadPath{};
  };
  for (int k = 0; k < 2; ++k) {
    const ReadPath a = oriented(file, k);
    const ReadPath b = oriented(flipped, k);
    REQUIRE(a.moves.size() == b.moves.size());
    for (std::size_t i = 0; i < a.moves.size(); ++i)
      CHECK((a.moves[i].x1 == b.moves[i].x1 && a.moves[i].y1 == b.moves[i].y1));
  }
}

TEST_CASE("both sides show the plate where its shape is its own mirror image") {
  Job job = plate(30, 20, 1.3);
  job.params.showSide = ShowSide::Both;
  const Written written = job.write();
  REQUIRE(written.result.ok());
  CHECK(checkGcode(written.text, job.printer).errors() == 0);
  const ReadFile file = readGcode(written.text);
  CHECK(file.layers == 4);
  const ReadPath& top = lastPath(file);
  const auto below = std::find_if(file.paths.begin(), file.paths.end(),
                                  [](const ReadPath& path) { return path.role == "Top solid infill"; });
  CHECK(below->layer == 1);
  CHECK(top.layer == 4);
  REQUIRE(below->moves.size() == top.moves.size());
  std::vector<std::pair<std::int64_t, std::int64_t>> a;
  std::vector<std::pair<std::int64_t, std::int64_t>> b;
  for (const ReadMove& move : below->moves) a.emplace_back(220000 - move.x1, move.y1);
  for (const ReadMove& move : top.moves) b.emplace_back(move.x1, move.y1);
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  std::size_t far = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    far += std::abs(a[i].first - b[i].first) > 1 || std::abs(a[i].second - b[i].second) > 1;
  }
  CHECK(far == 0);

  job.shape.paths[0].rings[0] = {{0, 0}, {30, 0}, {30, 20}, {0, 20}};
  job.toolpath.cycles = {{{{1, 1}, {29, 1}, {29, 19}}, {0.4f, 0.4f, 0.4f}}};  // in a triangle
  job.shape.paths[0].rings[0] = {{0, 0}, {30, 0}, {30, 20}};
  const Error error = job.write().result.error();
  CHECK(error.message.find("showSide is both, but the shape is not its own mirror image") == 0);
}

TEST_CASE("copies are printed one after the other, and travels pass above those that are done") {
  Job job = plate(30, 20, 1.3);
  job.params.skirt = 2;
  job.params.copies = {2, 3};
  job.params.copyGap = 7;
  const Written written = job.write();
  REQUIRE_MESSAGE(written.result.ok(), written.result.error().message);
  CHECK(checkGcode(written.text, job.printer).errors() == 0);
  const ReadFile file = readGcode(written.text);
  CHECK_MESSAGE(file.faults.empty(), file.faults.front());
  CHECK(file.layers == 6 * 3);
  CHECK(valueOf(written.text, "; total layers count = ") == "18");
  std::vector<const ReadPath*> tops;
  int skirts = 0;
  for (const ReadPath& path : file.paths) {
    if (path.role == "Top solid infill") tops.push_back(&path);
    skirts += path.role == "Skirt/Brim" ? 1 : 0;
  }
  CHECK(skirts == 2);
  REQUIRE(tops.size() == 6);
  const int columns[] = {0, 1, 1, 0, 0, 1};  // back and forth
  for (std::size_t k = 1; k < 6; ++k) {
    for (std::size_t i = 0; i < tops[0]->moves.size(); ++i) {
      CHECK(tops[k]->moves[i].x1 - tops[0]->moves[i].x1 == 37000 * columns[k]);
      CHECK(tops[k]->moves[i].y1 - tops[0]->moves[i].y1 == 27000 * static_cast<int>(k / 2));
    }
  }
  // 0.6 mm of plate and 0.4 mm of lift, wherever a travel is longer than a plate's gap.
  for (const ReadMove& move : file.travels) {
    if (move.length() > 7 && move.x0 != 0) CHECK(move.z >= 600);
  }
  const Bounds box = checkGcode(written.text).box;
  CHECK(0.5 * (box.min + box.max) == Vec2{110, 110});
  std::size_t objects = 0;
  for (std::size_t at = 0; (at = written.text.find("\nM486 S", at)) != std::string::npos; ++at) ++objects;
  CHECK(objects == 12);
  Job klipper = job;
  klipper.printer.flavor = GcodeFlavor::Klipper;
  const std::string named = klipper.write().text;
  CHECK(checkGcode(named, klipper.printer).errors() == 0);
  CHECK(grammarError(named) == "");
  CHECK(named.find("\nEXCLUDE_OBJECT_DEFINE NAME=PLATE_5\n") < named.find("\nEXCLUDE_OBJECT_START NAME=PLATE_0\n"));
  CHECK(named.find("\nEXCLUDE_OBJECT_END NAME=PLATE_5\n") > named.find("\nEXCLUDE_OBJECT_START NAME=PLATE_5\n"));
  Job single = plate(30, 20, 1.3);
  single.params.skirt = 0;
  CHECK(file.filament > 6 * readGcode(single.write().text).filament * 0.95);

  job.params.copies = {7, 1};
  CHECK(job.write().result.error().message.find("the plates of 252.0 x 20.0 mm reach over the edge of the bed") == 0);
  job.params.copies = {2, 1};
  job.params.base = 20;
  CHECK(job.write().result.error().message.find("the plates are 4.2 mm high; several on one bed") == 0);
  job.params.copies = {1.5, 1};
  CHECK(job.write().result.error().message.find("copies is 1.5 x 1; both must be whole") == 0);
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
  CHECK(full.filament() - path.filament() == about(extrusion(0.2, 0.4, 0.25, 1.75, 0.95), 0.02));
}

TEST_CASE("cycles begin at a concave corner if they pass one") {
  Job job = plate();
  job.params.layers = 5;
  job.shape.paths[0].rings[0] = {{0, 0}, {30, 0}, {30, 8}, {12, 8}, {12, 20}, {0, 20}};
  const std::vector<Vec2f> corners = {{0.2f, 0.2f},  {29.8f, 0.2f},  {29.8f, 7.8f},
                                      {11.8f, 7.8f}, {11.8f, 19.8f}, {0.2f, 19.8f}};
  Cycle cycle;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec2f a = corners[k];
    const Vec2f b = corners[k + 1 < corners.size() ? k + 1 : 0];
    for (int part = 0; part < 100; ++part) {
      cycle.points.push_back(a + (static_cast<float>(part) / 100) * (b - a));
      cycle.widths.push_back(0.4f);
    }
  }
  job.toolpath.cycles = {cycle};
  const Written written = job.write();
  REQUIRE_MESSAGE(written.result.ok(), written.result.error().message);
  int seams = 0;
  for (const ReadPath& path : readGcode(written.text).paths) {
    if (path.role != "Top solid infill") continue;
    ++seams;
    const ReadMove& first = path.moves.front();
    CHECK(std::hypot(double(first.x0) / 1000 - 95 - 11.8, double(first.y0) / 1000 - 100 - 7.8) < 1.3);
  }
  CHECK(seams == 5);
}

TEST_CASE("cycles begin near the border, elsewhere on each layer") {
  Job job = plate(30, 20, 0.5);
  job.params.layers = 5;
  const ReadFile file = checkFile(job, job.write());
  std::vector<std::pair<std::int64_t, std::int64_t>> seams;
  for (const ReadPath& path : file.paths) {
    if (path.role != "Top solid infill") continue;
    const ReadMove& first = path.moves.front();
    const double x = double(first.x0) / 1000 - 95;
    const double y = double(first.y0) / 1000 - 100;
    CHECK(std::min({x, y, 30 - x, 20 - y}) < 0.51);
    seams.emplace_back(first.x0, first.y0);
  }
  std::sort(seams.begin(), seams.end());
  CHECK(std::unique(seams.begin(), seams.end()) == seams.end());
}

TEST_CASE("thumbnails are in the header, in base64 of the length their first line tells") {
  Job job = plate();
  std::vector<std::uint8_t> bytes(200);
  for (std::size_t k = 0; k < bytes.size(); ++k) bytes[k] = static_cast<std::uint8_t>(7 * k);
  job.params.thumbnails = {{32, 16, {'M', 'a', 'n', 'y'}}, {300, 300, bytes}};
  const Written written = job.write();
  checkFile(job, written);
  CHECK(written.text.find("\n; thumbnail begin 32x16 8\n; TWFueQ==\n; thumbnail end\n") != std::string::npos);
  const std::string begin = "; thumbnail begin 300x300 268\n";  // 4 * ceil(200 / 3)
  const std::size_t at = written.text.find(begin);
  REQUIRE(at != std::string::npos);
  std::size_t digits = 0;
  std::size_t line = at + begin.size();
  while (written.text.compare(line, 15, "; thumbnail end") != 0) {
    const std::size_t end = written.text.find('\n', line);
    CHECK(end - line <= 80);
    digits += end - line - 2;
    line = end + 1;
  }
  CHECK(digits == 268);

  job.params.thumbnails[0].width = 0;
  CHECK(job.write().result.error().message.find("a thumbnail is 0 x 16 pixels in 4 bytes; it must be") == 0);
  job.params.thumbnails[0] = {16, 16, {1, 2, 3}, ThumbnailFormat::Qoi};
  CHECK(job.write().text.find("\n; thumbnail_QOI begin 16x16 4\n; AQID\n; thumbnail_QOI end\n") != std::string::npos);
  job.params.thumbnails = {{300, 300, std::vector<std::uint8_t>(400000)},
                           {300, 300, std::vector<std::uint8_t>(300001)}};
  CHECK(job.write().result.error().message.find("700000 bytes") != std::string::npos);  // hosts read one MiB
}

// ---- dialects, start and end blocks

TEST_CASE("each dialect sets acceleration, corner speed and pressure advance in its own words, and back") {
  struct Words {
    GcodeFlavor flavor;
    const char* acceleration;
    const char* back;
    const char* advance;
    const char* none;
    const char* name;
    const char* corner;
    const char* cornerBack;
  };
  const Words all[] = {
      {GcodeFlavor::Marlin, "M204 P1000 T1000\n", "M204 P4000 T4000\n", "M900 K0.0400\n", "M900 K0\n", "marlin2",
       "M205 X10.00 Y10.00\n", "M205 X15.00 Y15.00\n"},
      {GcodeFlavor::Klipper, "M204 S1000\n", "M204 S4000\n", "SET_PRESSURE_ADVANCE ADVANCE=0.0400\n",
       "SET_PRESSURE_ADVANCE ADVANCE=0\n", "klipper", "SET_VELOCITY_LIMIT SQUARE_CORNER_VELOCITY=5.00\n",
       "SET_VELOCITY_LIMIT SQUARE_CORNER_VELOCITY=7.50\n"},
      {GcodeFlavor::RepRap, "M204 P1000 T1000\n", "M204 P4000 T4000\n", "M572 D0 S0.0400\n", "M572 D0 S0\n",
       "reprapfirmware", "M566 X600 Y600\n", "M566 X900 Y900\n"},
      {GcodeFlavor::PrusaBuddy, "M204 P1000 T1000\n", "M204 P4000 T4000\n", "M572 S0.0400\n", "M572 S0\n", "marlin2",
       "M205 X10.00 Y10.00\n", "M205 X15.00 Y15.00\n"},
      {GcodeFlavor::Bambu, "M204 S1000\n", "M204 S4000\n", "M900 K0.0400\n", "M900 K0\n", "marlin",
       "M205 X10.00 Y10.00\n", "M205 X15.00 Y15.00\n"}};
  for (const Words& words : all) {
    Job job = plate();
    job.printer.flavor = words.flavor;
    job.printer.setPressureAdvance = true;
    job.printer.machineAcceleration = 4000;
    job.printer.machineCornerSpeed = 7.5;
    if (words.flavor == GcodeFlavor::Bambu) job.printer.startGcode = "G28\nM190 S60\nM109 S220";
    const Written written = job.write();
    checkFile(job, written);
    const std::string& text = written.text;
    CAPTURE(words.name);
    const std::size_t set = text.find(std::string("\n") + words.advance);
    const std::size_t unset = text.find(std::string("\n") + words.none);
    CHECK(set < text.find(";LAYER_CHANGE"));
    CHECK((unset != std::string::npos && unset > text.rfind(";TYPE:Top solid infill")));
    CHECK(text.find(std::string("\n") + words.acceleration) < text.find(";LAYER_CHANGE"));
    CHECK(text.find(std::string("\n") + words.back) != std::string::npos);
    CHECK(text.find(std::string("\n") + words.corner) < text.find(";LAYER_CHANGE"));
    CHECK((text.find(std::string("\n") + words.cornerBack) != std::string::npos &&
           text.find(std::string("\n") + words.cornerBack) > text.rfind(";TYPE:Top solid infill")));
    CHECK(valueOf(text, "; gcode_flavor = ") == words.name);
    CHECK((text.find("; CHANGE_LAYER\n; Z_HEIGHT: 0.2\n") != std::string::npos) ==
          (words.flavor == GcodeFlavor::Bambu));
  }
  Job job = plate();
  job.printer.flavor = GcodeFlavor::Bambu;
  CHECK(job.write().result.error().message.find("startGcode is empty; Bambu printers need") == 0);
  CHECK(job.write().text.empty());
}

TEST_CASE("placeholders of four programs stand for their values") {
  const std::vector<TemplateValue> values{{{"temp", "TEMP"}, {"215"}}, {{"min"}, {"1.5", "2.5"}}};
  const auto expand = [&](std::string_view text) {
    const Result<std::string> out = expandTemplate(text, values, "startGcode");
    return out ? out.value() : "error: " + out.error().message;
  };
  CHECK(expand("M109 S{temp}") == "M109 S215\n");
  CHECK(expand("M109 S{temp[0]}\nM104 S[temp] ; [x] {y} <z>") == "M109 S215\nM104 S215 ; [x] {y} <z>\n");
  CHECK(expand("M109 S<TEMP>") == "M109 S215\n");
  CHECK(expand("G1 X{min[0]} Y[min[1]] Z{ min }\r\n\n\tM84 \xc3\xa9  ") == "G1 X1.5 Y2.5 Z1.5\n\nM84 ??\n");
  CHECK(expand("PRINT_START BED=60 NAME='x'") == "PRINT_START BED=60 NAME='x'\n");
  CHECK(expand("") == "");
  CHECK(expand("\n\n") == "");
  for (const char* bad :
       {"{other}", "[temp", "{min[2]}", "{min[x]}", "M1 {if temp > 3}M2{endif}", "<>", "{}", "[[[", "{temp+5}"}) {
    CAPTURE(bad);
    const std::string out = expand(std::string("G28\n") + bad);
    CHECK(out.find("error: startGcode has \"") == 0);
    CHECK(out.find("in line 2, which stands for no value here") != std::string::npos);
  }
}

TEST_CASE("the user's blocks replace ours, and modes are restated after them") {
  Job job = plate();
  job.printer.startGcode =
      "G28\nM190 S{first_layer_bed_temperature}\nM109 S[nozzle_temperature_initial_layer]\nG20\nM82";
  job.printer.endGcode = "M104 S0\nM140 S0 ; bye\nG1 X0 Y200";
  const std::string text = job.write().text;
  CHECK(text.find("\n; FEATURE: Custom\nG28\nM190 S60\nM109 S220\nG20\nM82\nG21\nG90\nM83\nG92 E0\n") !=
        std::string::npos);
  CHECK(text.find("\nM104 S0\nM140 S0 ; bye\nG1 X0 Y200\nM73 P100 R0\n") != std::string::npos);
  CHECK(text.find("M84") == std::string::npos);
  const auto refusal = [&](const char* start) {
    Job bad = job;
    bad.printer.startGcode = start;
    const Written written = bad.write();
    CHECK(written.text.empty());
    return written.result ? "" : written.result.error().message;
  };
  CHECK(refusal("M190 S60\nM109 S220") == "startGcode does not home; it must have G28 or a start macro");
  CHECK(refusal("G28\nM190 S60\nM104 S220").find("startGcode does not wait for a hot nozzle") == 0);
  CHECK(refusal("G28\nM109 S220").find("startGcode does not wait for a hot bed") == 0);
  CHECK(refusal("G28\nM190 S60\nM109 S220\nG1 X300 F3000").find("line 4 of startGcode: a move over the bed's edge") ==
        0);
  CHECK(refusal("G1 X10 F3000\nG28\nM190 S60\nM109 S220").find("line 1 of startGcode: moves before it homes") == 0);
  CHECK(refusal("G28\nM190 S60\nM109 S220\nM104 S0") ==
        "startGcode leaves the nozzle at 0 degrees; it must leave it at 170 or more");
  const auto endRefusal = [&](const char* end) {
    Job bad = job;
    bad.printer.endGcode = end;
    const Written written = bad.write();
    CHECK(written.text.empty());
    return written.result ? "" : written.result.error().message;
  };
  CHECK(endRefusal("M104 S0\nG1 X300 F3000").find("line 2 of endGcode: a move over the bed's edge at (300, ") == 0);
  CHECK(endRefusal("G1 X1,5").find("line 1 of endGcode: no plain number: \"X1,5\"") == 0);
  Job own = job;
  own.printer.endGcode = "G91\nG1 E-2 X5 Y-5 F3000\nG1 Z5\nG90\nG1 X0\nM500";
  const std::vector<std::string> warnings = own.write().result.value().warnings;
  CHECK(contains(warnings, "line 6 of endGcode: M500 outlives the print"));
  CHECK(contains(warnings, "endGcode leaves the nozzle or the bed hot"));
  CHECK(warnings.size() == 2);
  own.printer.endGcode = "PRINT_END";
  CHECK(own.write().result.value().warnings.empty());
  own.printer.startGcode = "G28\nM190 S60\nM109 S220\nG92 X10\nM500";
  CHECK(contains(own.write().result.value().warnings, "line 4 of startGcode: G92 moves the origin"));
  CHECK(contains(own.write().result.value().warnings, "line 5 of startGcode: M500 outlives the print"));
  Job wipe = job;
  wipe.printer.startGcode = "G28\nM190 S60\nM109 S220\nG1 Z5 F600\nG1 Y-3 F3000";
  CHECK(contains(wipe.write().result.value().warnings, "line 5 of startGcode: the start or end block goes over"));
  wipe.printer.startGcode = "PRINT_START BED=60 HOTEND=180";
  const Written macro = wipe.write();
  REQUIRE(macro.result.ok());
  CHECK(contains(macro.result.value().warnings, "startGcode leaves the nozzle at 180 degrees"));
  job.printer.endGcode = "M104 S{oops}";
  const Written refused = job.write();
  CHECK(refused.result.error().message.find("endGcode has \"{oops}\" in line 1") == 0);
  CHECK(refused.text.empty());
  job.printer.endGcode = "; generated by PrusaSlicer";
  CHECK(job.write().result.error().message.find("endGcode must not contain \"generated by\"") == 0);
}

TEST_CASE("absolute E carries the same plastic and starts anew with every layer") {
  Job job = plate();
  const ReadFile relative = checkFile(job, job.write());
  job.printer.absoluteE = true;
  const std::string text = job.write().text;
  CHECK(text.find("\nM82\n") != std::string::npos);
  CHECK(text.find("\nM83\n") == std::string::npos);
  std::int64_t e = 0;
  std::int64_t sum = 0;
  int resets = 0;
  for (const std::string_view line : split(text, '\n')) {
    if (line == "G92 E0") e = 0, ++resets;
    const std::size_t at = line.find(" E");
    if (!line.starts_with("G1 ") || at == std::string_view::npos) continue;
    const std::int64_t now = scaledWord(line.substr(at + 1), 1e5);
    if (line.find(" X") != std::string_view::npos) sum += now - e;
    e = now;
  }
  CHECK(resets == 1 + 3);
  job.printer.endGcode = "G1 E-2 F600\nM104 S0\nM140 S0";  // draws back by 2 mm, in either mode
  CHECK(job.write().text.find("\nG92 E0\nG1 E-2 F600\n") != std::string::npos);
  CHECK(static_cast<double>(sum) / 1e5 == Approx(relative.filament).epsilon(1e-9));
}

TEST_CASE("every printer and filament makes a file without faults") {
  for (const Preset& preset : presets(PresetKind::Printer)) {
    for (const Preset& filament : presets(PresetKind::Filament)) {
      CAPTURE(preset.id + " " + filament.id);
      Job job = plate(30, 20, 0.5);
      job.printer = preset.printer;
      REQUIRE(applyPreset(PresetKind::Filament, filament.id, job.printer).empty());
      if (job.printer.flavor == GcodeFlavor::Bambu) {
        CHECK(job.write().result.error().message.find("startGcode is empty") == 0);
        job.printer.startGcode = "G28\nM190 S{first_layer_bed_temperature}\nM109 S{first_layer_temperature}";
      }
      const Written written = job.write();
      REQUIRE_MESSAGE(written.result.ok(), written.result.error().message);
      const GcodeCheck check = checkGcode(written.text, job.printer);
      CHECK(check.errors() == 0);
      CHECK(check.layers == 3);
      CHECK(checkGcode(written.text).errors() == 0);  // by the settings the file itself tells
    }
  }
}

// ---- beds

TEST_CASE("a round bed holds what lies within its circle and nothing else") {
  Job job = plate(30, 40);
  job.params.skirt = 0;
  job.printer.bedMin = {-25, -25};
  job.printer.bedMax = {25, 25};
  job.printer.roundBed = true;
  const Written good = job.write();  // 25 mm from the centre to each corner, less than a tenth of a bead outside
  const ReadFile file = checkFile(job, good);
  for (const ReadMove& move : file.travels) CHECK(std::hypot(move.x1, move.y1) <= 25000);
  CHECK(file.minX < 0);
  CHECK(split(valueOf(good.text, "; bed_shape = "), ',').size() == 24);

  job.params.place = Vec2{-15.5, -20};
  const Error error = job.write().result.error();
  CHECK(error.code == ErrorCode::DoesNotFit);
  CHECK(error.message ==
        "the plate of 30.0 x 40.0 mm reaches over the edge of the round bed by 0.303 mm; it fits when it "
        "is centred");

  job.params.place.reset();
  job.printer.bedMin = {-40, -40};
  job.printer.bedMax = {40, 40};
  job.params.skirt = 1;
  const Written purged = job.write();  // the corners of the skirt lie 32 mm off, within 40
  CHECK(checkFile(job, purged).paths[0].moves.size() == 4);
  job.printer.bedMin = {-31, -31};
  job.printer.bedMax = {31, 31};
  const Written line = job.write();
  CHECK(contains(line.result.value().warnings, "the skirt does not fit"));
  const ReadFile lined = checkFile(job, line);
  for (const ReadMove& move : lined.paths[0].moves) {
    CHECK(std::hypot(move.x0, move.y0) < 31000);
    CHECK(std::hypot(move.x1, move.y1) < 31000);
  }
  CHECK(lined.paths[0].role == "Skirt/Brim");

  job.printer.bedMax = {31, 30};
  CHECK(job.write().result.error().message.find("the round bed's box is 62 x 61 mm; it must be a square") == 0);
}

TEST_CASE("nothing touches the excluded part of the bed") {
  Job job = plate(30, 20);
  job.printer.excludedMax = {18, 28};
  const ReadFile file = checkFile(job, job.write());
  CHECK(file.paths[0].closed());
  job.params.skirt = 0;
  const ReadFile purged = checkFile(job, job.write());
  CHECK(purged.paths[0].moves[0].x0 == 23000);  // the purge line begins right of it
  job.params.place = Vec2{17.9, 40};
  CHECK(job.write().result.ok());
  job.params.place = Vec2{17.9, 27};
  CHECK(job.write().result.error().code == ErrorCode::DoesNotFit);
  CHECK(job.write().result.error().message.find("touches the excluded part of the bed") != std::string::npos);
  job.printer.excludedMin = {20, 30};  // an island inside the plate
  job.printer.excludedMax = {21, 31};
  job.params.place = Vec2{15, 25};
  CHECK(job.write().result.error().code == ErrorCode::DoesNotFit);
}

// ---- placement

TEST_CASE("the plate is centred by its box unless placed by its page") {
  Job job = plate();
  for (Vec2f& p : job.toolpath.cycles[0].points) p = p + Vec2f{100, 7};
  for (Vec2& p : job.shape.paths[0].rings[0]) p = p + Vec2{100, 7};
  job.params.base = 0;
  job.params.skirt = 0;
  ReadPath path = lastPath(checkFile(job, job.write()));
  CHECK(path.moves[0].x0 == 110000 - 15000 + 200);
  CHECK(path.moves[0].y0 == 110000 - 10000 + 200);
  job.params.place = Vec2{-90, 5};
  path = lastPath(checkFile(job, job.write()));
  CHECK(path.moves[0].x0 == 10200);
  CHECK(path.moves[0].y0 == 12200);
  // Origin in the middle of the bed: negative coordinates are legal.
  job.params.place.reset();
  job.printer.bedMin = {-110, -110};
  job.printer.bedMax = {110, 110};
  path = lastPath(checkFile(job, job.write()));
  CHECK(path.moves[0].x0 == -14800);
}

TEST_CASE("a quarter turn of the plate is a quarter turn of every vertex, and a mirror is one") {
  Job job = plate();
  job.params.base = 0;
  job.params.skirt = 0;
  job.params.place = Vec2{50, 60};
  const auto vertices = [&] {
    std::vector<std::pair<std::int64_t, std::int64_t>> out;
    const ReadPath path = lastPath(checkFile(job, job.write()));
    for (const auto& move : path.moves) out.emplace_back(move.x0, move.y0);
    return out;
  };
  const auto straight = vertices();
  // The page of 30 x 20 mm: its corner stays at (50, 60), whatever its turn.
  const auto expect = [&](auto place) {
    const auto turned = vertices();
    REQUIRE(turned.size() == straight.size());
    for (std::size_t k = 0; k < straight.size(); ++k) {
      const auto [x, y] = place(straight[k].first - 50000, straight[k].second - 60000);
      CHECK(std::abs(turned[k].first - 50000 - x) <= 1);
      CHECK(std::abs(turned[k].second - 60000 - y) <= 1);
    }
  };
  using Um = std::pair<std::int64_t, std::int64_t>;
  job.params.rotate = 90;
  expect([](std::int64_t x, std::int64_t y) { return Um{20000 - y, x}; });
  job.params.rotate = -180;
  expect([](std::int64_t x, std::int64_t y) { return Um{30000 - x, 20000 - y}; });
  job.params.rotate = 0;
  job.params.mirror = true;
  expect([](std::int64_t x, std::int64_t y) { return Um{30000 - x, y}; });
  job.params.rotate = 270;
  expect([](std::int64_t x, std::int64_t y) { return Um{y, x}; });  // mirrored first, then turned
}

TEST_CASE("a turned plate keeps its lengths and stays upon the bed or is refused") {
  Job job = plate(200, 20);
  job.printer.bedMax = {220, 120};
  job.params.base = 0;   // its hatches run along the bed's axes
  job.params.skirt = 0;  // and this around a box
  const double straight = job.write().result.value().filamentMm;
  job.params.rotate = 20;
  const Written turned = job.write();
  checkFile(job, turned);
  CHECK(turned.result.value().filamentMm == about(straight, 2e-3));
  job.params.rotate = 60;
  REQUIRE(!job.write().result.ok());
  CHECK(job.write().result.error().code == ErrorCode::DoesNotFit);
  job.params.rotate = 400;
  CHECK(job.write().result.error().message.find("rotate is 400 degrees; it must be -360 to 360") == 0);
}

TEST_CASE("what does not fit is refused with the overhang of each side") {
  Job job = plate();
  job.params.place = Vec2{-2, 205.5};
  Written written = job.write();
  REQUIRE(!written.result.ok());
  CHECK(written.result.error().code == ErrorCode::DoesNotFit);
  CHECK(written.result.error().message.find("2.000 mm on the left, 5.500 mm at the back; it fits when it is centred") !=
        std::string::npos);
  CHECK(written.text.empty());
  job.params.place.reset();
  job.printer.bedMax = {30, 20};
  CHECK(job.write().result.ok());  // exactly fits
  job.printer.bedMax = {29.9, 20};
  written = job.write();
  REQUIRE(!written.result.ok());
  CHECK(written.result.error().message.find("0.050 mm on the left, 0.050 mm on the right") != std::string::npos);
  // Half a bead counts.
  job.printer.bedMax = {30, 20};
  job.toolpath.cycles[0].points[0].x = 0;
  written = job.write();
  REQUIRE(!written.result.ok());
  CHECK(written.result.error().message.find("0.200 mm on the left") != std::string::npos);
  job.toolpath.cycles[0].points[0] = {30, 20};
  written = job.write();
  REQUIRE(!written.result.ok());
  CHECK(written.result.error().message.find("0.200 mm on the right, 0.200 mm at the back") != std::string::npos);
  job.toolpath.cycles[0].points[0] = {0.2f, 0.2f};
  job.printer.maxZ = 0.9;
  CHECK(job.write().result.error().code == ErrorCode::DoesNotFit);
  job.printer.maxZ = 1;
  CHECK(job.write().result.ok());
}

TEST_CASE("what brings a plate upon the bed is told, and helps") {
  const Job job = plate();  // 30 x 20 mm
  const auto fit = [&](Vec2 bed, bool round = false) {
    Printer printer = job.printer;
    printer.bedMax = printer.bedMin + bed;
    printer.roundBed = round;
    return fitBed(job.shape, printer, job.params);
  };
  CHECK(fit({30, 20}).centred);
  CHECK(fit({30, 20}).percent == 100);
  CHECK(!fit({20, 30}).centred);
  CHECK(fit({20, 30}).turned);
  CHECK(!fit({24, 24}).turned);
  CHECK(fit({24, 24}).percent == 80);
  CHECK(fit({36.1, 36.1}, true).centred);  // the diagonal is 36.06
  CHECK(!fit({36, 36}, true).centred);
  CHECK(fit({18.1, 18.1}, true).percent == 50);
  PrintParams two = job.params;
  two.copies = {2, 1};
  Printer printer = job.printer;
  printer.bedMax = printer.bedMin + Vec2{70, 20};
  CHECK(fitBed(job.shape, printer, two).centred);
  two.brim = 1;
  CHECK(!fitBed(job.shape, printer, two).centred);
  printer.bedMax = printer.bedMin + Vec2{100, 100};
  printer.excludedMin = printer.bedMin + Vec2{64, 0};
  printer.excludedMax = printer.bedMax;
  CHECK(!fitBed(job.shape, printer, job.params).centred);
  CHECK(fitBed(job.shape, printer, job.params).turned);  // 20 mm wide, from 40 to 60

  Job tall = plate();
  tall.printer.bedMax = tall.printer.bedMin + Vec2{22, 32};
  Written written = tall.write();
  REQUIRE(!written.result.ok());
  CHECK(written.result.error().message.find("; it fits when it is turned by 90 degrees and centred") !=
        std::string::npos);
  tall.params.rotate = 90;
  CHECK(tall.write().result.ok());
  tall.params.rotate = 0;
  tall.printer.bedMax = tall.printer.bedMin + Vec2{27, 19};
  written = tall.write();
  REQUIRE(!written.result.ok());
  CHECK(written.result.error().message.find("; it fits when it is scaled to 90 % and centred") != std::string::npos);
}

TEST_CASE("whoever knows why may print colder and hotter") {
  Job job = plate();
  job.printer.anyTemperature = true;
  job.printer.nozzleTemperature = job.printer.firstLayerNozzleTemperature = 420;
  job.printer.bedTemperature = 160;
  const Written written = job.write();
  REQUIRE_MESSAGE(written.result.ok(), written.result.error().message);
  CHECK(written.text.find("M109 S420") != std::string::npos);
  CHECK(checkGcode(written.text, job.printer).errors() == 0);
  job.printer.anyTemperature = false;
  CHECK(checkGcode(written.text, job.printer).errors() > 0);
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

// ---- bad input

TEST_CASE("bad input is refused by name before a byte is written") {
  struct Row {
    const char* part;
    std::function<void(Job&)> spoil;
    ErrorCode code = ErrorCode::InvalidArgument;
  };
  const Row rows[] = {
      {"nozzle is 0 mm; it must be above 0 and at most 2", [](Job& j) { j.printer.nozzle = 0; }},
      {"nozzle is 2.1 mm", [](Job& j) { j.printer.nozzle = 2.1; }},
      {"nozzle is not a number", [](Job& j) { j.printer.nozzle = kNan; }},
      {"filamentDiameter", [](Job& j) { j.printer.filamentDiameter = 0; }},
      {"filamentDensity", [](Job& j) { j.printer.filamentDensity = -1; }},
      {"startHeight is -1 mm; it must be 0 to 200", [](Job& j) { j.params.startHeight = -1; }},
      {"startHeight is 201 mm", [](Job& j) { j.params.startHeight = 201; }},
      {"startHeight is not a number", [](Job& j) { j.params.startHeight = kNan; }},
      {"the job is 200.6 mm high with the lift", [](Job& j) { j.params.startHeight = 199.6; }, ErrorCode::DoesNotFit},
      {"startHeight is 5 mm; it must be 0 where showSide is not up",
       [](Job& j) {
         j.params.startHeight = 5;
         j.params.showSide = ShowSide::Bed;
       }},
      {"startHeight is 5 mm; it must be 0 where showSide is not up",
       [](Job& j) {
         j.params.startHeight = 5;
         j.params.showSide = ShowSide::Both;
       }},
      {"layerHeight is 0.33 mm; it must be 0.05 to 0.32", [](Job& j) { j.params.layerHeight = 0.33; }},
      {"layerHeight is 0.04 mm", [](Job& j) { j.params.layerHeight = 0.04; }},
      {"layerHeight is not a number", [](Job& j) { j.params.layerHeight = kNan; }},
      {"firstLayerHeight is 0.4 mm", [](Job& j) { j.params.firstLayerHeight = 0.4; }},
      {"firstLayerHeight is -1 mm", [](Job& j) { j.params.firstLayerHeight = -1; }},
      {"firstLayerHeight is not a number", [](Job& j) { j.params.firstLayerHeight = kNan; }},
      {"flow is 0; it must be 0.01 to 2", [](Job& j) { j.params.flow = 0; }},
      {"flow is 2.5", [](Job& j) { j.params.flow = 2.5; }},
      {"baseFlow is -1", [](Job& j) { j.params.baseFlow = -1; }},
      {"layers is 0; it must be 1 to 1000", [](Job& j) { j.params.layers = 0; }},
      {"layers is 1001", [](Job& j) { j.params.layers = 1001; }},
      {"base is -1", [](Job& j) { j.params.base = -1; }},
      {"skirt is 21", [](Job& j) { j.params.skirt = 21; }},
      {"high with the lift",
       [](Job& j) {
         j.params.layers = 1000;
         j.printer.maxZ = 100;
       },
       ErrorCode::DoesNotFit},
      {"nozzleTemperature is 501 degrees Celsius; it must be 0 to 500",
       [](Job& j) {
         j.printer.anyTemperature = true;
         j.printer.nozzleTemperature = 501;
       }},
      {"bedTemperature is 201",
       [](Job& j) {
         j.printer.anyTemperature = true;
         j.printer.bedTemperature = 201;
       }},
      {"machineSpeed is 4 mm/s; it must be 5 to 1000, or 0", [](Job& j) { j.printer.machineSpeed = 4; }},
      {"points of the path lie more than 0.1 mm outside the shape; strict refuses that",
       [](Job& j) {
         j.params.strict = true;
         j.shape = rectangle(30, 15);
       }},
      {"the path crosses itself 1 time; strict refuses that",
       [](Job& j) {
         j.params.strict = true;
         j.toolpath.cycles = {{{{1, 1}, {29, 19}, {29, 1}, {1, 19}}, std::vector<float>(4, 0.4f)}};
       }},
      {"nozzleTemperature is 169", [](Job& j) { j.printer.nozzleTemperature = 169; }},
      {"firstLayerNozzleTemperature is 301", [](Job& j) { j.printer.firstLayerNozzleTemperature = 301; }},
      {"bedTemperature is 121", [](Job& j) { j.printer.bedTemperature = 121; }},
      {"speed is 0 mm/s", [](Job& j) { j.printer.speed = 0; }},
      {"firstLayerSpeed is infinite", [](Job& j) { j.printer.firstLayerSpeed = kInfinity; }},
      {"travelSpeed", [](Job& j) { j.printer.travelSpeed = -5; }},
      {"acceleration is 0", [](Job& j) { j.printer.acceleration = 0; }},
      {"machineAcceleration", [](Job& j) { j.printer.machineAcceleration = -1; }},
      {"cornerSpeed", [](Job& j) { j.printer.cornerSpeed = 0; }},
      {"machineCornerSpeed", [](Job& j) { j.printer.machineCornerSpeed = -1; }},
      {"curveAcceleration", [](Job& j) { j.printer.curveAcceleration = kNan; }},
      {"maxFlow is 0 mm3/s", [](Job& j) { j.printer.maxFlow = 0; }},
      {"need at least 0.4 to print at 5 mm/s", [](Job& j) { j.printer.maxFlow = 0.39; }},
      {"maxSegmentsPerSecond", [](Job& j) { j.printer.maxSegmentsPerSecond = 0; }},
      {"pressureAdvance", [](Job& j) { j.printer.pressureAdvance = -0.1; }},
      {"retractLength", [](Job& j) { j.printer.retractLength = 21; }},
      {"retractSpeed", [](Job& j) { j.printer.retractSpeed = 0; }},
      {"lift is -0.1", [](Job& j) { j.printer.lift = -0.1; }},
      {"maxZ is 0", [](Job& j) { j.printer.maxZ = 0; }},
      {"bedMin.x is not a number", [](Job& j) { j.printer.bedMin.x = kNan; }},
      {"bedMax.y is 0 mm; it must be 10 to 5000", [](Job& j) { j.printer.bedMax.y = 0; }},
      {"place.x is not a number",
       [](Job& j) {
         j.params.place = Vec2{kNan, 0};
       }},
      {"place.y is above 1e12",
       [](Job& j) {
         j.params.place = Vec2{0, 1e200};
       }},
      {"date does not look like", [](Job& j) { j.params.date = "today"; }},
      {"generated by", [](Job& j) { j.params.notes = {"Generated By PrusaSlicer"}; }},
      {"generated by", [](Job& j) { j.printer.name = "generated by SuperSlicer"; }},
      {"no cycles", [](Job& j) { j.toolpath.cycles.clear(); }, ErrorCode::EmptyShape},
      {"spacing is 0 mm", [](Job& j) { j.toolpath.spacing = 0; }},
      {"cycle 1 (from 0) has 0 points", [](Job& j) { j.toolpath.cycles.emplace_back(); }},
      {"cycle 0 (from 0) has 2 points; it must have at least 3",
       [](Job& j) {
         j.toolpath.cycles = {{{{1, 1}, {2, 2}}, {0.4f, 0.4f}}};
       }},
      {"has 2 different points at 0.001 mm",
       [](Job& j) {
         j.toolpath.cycles = {{{{1, 1}, {2, 2}, {2, 2}}, {0.4f, 0.4f, 0.4f}}};
       }},
      {"widths for", [](Job& j) { j.toolpath.cycles[0].widths.pop_back(); }},
      {"vertex 3 of cycle 0 (from 0) is at (not a number, ",
       [](Job& j) { j.toolpath.cycles[0].points[3].x = static_cast<float>(kNan); }},
      {"vertex 3 of cycle 0 (from 0) is at (", [](Job& j) { j.toolpath.cycles[0].points[3].y = 1e30f; }},
      {"vertex 5 of cycle 0 (from 0) is 0 mm wide", [](Job& j) { j.toolpath.cycles[0].widths[5] = 0; }},
      {"vertex 5 of cycle 0 (from 0) is not a number mm wide",
       [](Job& j) { j.toolpath.cycles[0].widths[5] = static_cast<float>(kNan); }},
      {"vertex 5 of cycle 0 (from 0) has a bead of 3.3 x 0.2 mm = 0.66 mm2; it must be at most 4 nozzle2 = 0.64 mm2",
       [](Job& j) { j.toolpath.cycles[0].widths[5] = 3.3f; }},
      {"the shape has a point at (infinite, ", [](Job& j) { j.shape.paths[0].rings[0][1].x = kInfinity; }},
      {"the shape is too thin for lines of 0.4 mm",
       [](Job& j) {
         j.shape = rectangle(30, 0.3);
         j.toolpath.cycles = {{{{1, 0.1f}, {29, 0.1f}, {29, 0.2f}, {1, 0.2f}}, std::vector<float>(4, 0.24f)}};
       }},
      {"the shape has no points", [](Job& j) { j.shape.paths.clear(); }, ErrorCode::EmptyShape},
      {"the shape has no area",
       [](Job& j) {
         j.shape.paths[0].rings[0] = {{0, 0}, {30, 20}, {0, 0}};
       },
       ErrorCode::EmptyShape},
  };
  for (const Row& row : rows) {
    CAPTURE(std::string(row.part));
    Job job = plate();
    row.spoil(job);
    const Written written = job.write();
    REQUIRE(!written.result.ok());
    CAPTURE(written.result.error().message);
    CHECK(written.result.error().code == row.code);
    CHECK(written.result.error().message.find(row.part) != std::string::npos);
    CHECK(written.chunks == 0);
  }
  const Job job = plate();
  CHECK(!writeGcode(job.toolpath, job.shape, job.printer, job.params, {}).ok());
}

TEST_CASE("what is odd but printable is written with a warning") {
  struct Row {
    const char* part;
    std::function<void(Job&)> change;
  };
  const Row rows[] = {
      {"filamentDiameter is 2.2 mm", [](Job& j) { j.printer.filamentDiameter = 2.2; }},
      {"below 0.2 nozzle", [](Job& j) { j.params.layerHeight = 0.06; }},
      {"flow is 0.7; usual are 0.8 to 1.1", [](Job& j) { j.params.flow = 0.7; }},
      {"baseFlow is 1.2", [](Job& j) { j.params.baseFlow = 1.2; }},
      {"no wider than the layer is high",
       [](Job& j) {
         j.params.layerHeight = 0.3;
         j.toolpath.cycles[0].widths[9] = 0.25f;
       }},
      {"% of the shape's area", [](Job& j) { j.shape = rectangle(30, 40); }},
      {"points of the path lie more than 0.1 mm outside the shape", [](Job& j) { j.shape = rectangle(30, 15); }},
      {"maxFlow slows", [](Job& j) { j.printer.maxFlow = 2; }},
      {"maxSegmentsPerSecond slows", [](Job& j) { j.printer.maxSegmentsPerSecond = 2; }},
      {"speed is 300 mm/s; it is held at machineSpeed, 40",
       [](Job& j) {
         j.printer.machineSpeed = 40;
         j.printer.speed = 300;
       }},
      {"travelSpeed is 120 mm/s; it is held at machineSpeed, 100", [](Job& j) { j.printer.machineSpeed = 100; }},
      {"writing on it reads backwards", [](Job& j) { j.params.mirror = true; }},
      {"pressure advance is 0 after the print", [](Job& j) { j.printer.setPressureAdvance = true; }},
  };
  const Written normal = plate().write();
  REQUIRE(normal.result.ok());
  CHECK(normal.result.value().warnings.empty());
  for (const Row& row : rows) {
    CAPTURE(std::string(row.part));
    Job job = plate();
    row.change(job);
    const Written written = job.write();
    REQUIRE_MESSAGE(written.result.ok(), written.result.error().message);
    CHECK(contains(written.result.value().warnings, row.part));
    CHECK(grammarError(written.text) == "");
  }
}

TEST_CASE("more moves and bytes than hosts like are written, with a warning") {
  Job job = plate();
  job.printer.maxZ = 1000;
  job.params.layers = 1000;
  job.params.base = 0;
  Cycle& cycle = job.toolpath.cycles[0];
  cycle = {};
  for (int k = 0; k < 2100; ++k) {  // up and down on 10 mm, finely cut
    const float x = 1 + 0.01f * static_cast<float>(k < 1050 ? k : 2100 - k);
    cycle.points.push_back({x, k < 1050 ? 2.0f : 2.4f});
    cycle.widths.push_back(0.4f);
  }
  std::int64_t bytes = 0;
  const auto result = writeGcode(job.toolpath, job.shape, job.printer, job.params, [&](std::string_view piece) {
    bytes += static_cast<std::int64_t>(piece.size());
    return true;
  });
  REQUIRE(result.ok());
  CHECK(bytes == result.value().bytes);
  CHECK(contains(result.value().warnings, "the file has 2"));
  CHECK(contains(result.value().warnings, "hosts get slow above 2 million"));
}

TEST_CASE("a sink that refuses stops the writing") {
  const Job job = plate(60, 60, 0.1);
  int calls = 0;
  const auto result = writeGcode(job.toolpath, job.shape, job.printer, job.params, [&](std::string_view) {
    ++calls;
    return calls < 2;
  });
  REQUIRE(!result.ok());
  CHECK(result.error().code == ErrorCode::Cancelled);
  CHECK(calls == 2);
}

// ---- everything at once

TEST_CASE("every rule holds on random rough plates, for both flavours") {
  std::mt19937 random(20);
  for (int round = 0; round < 30; ++round) {
    CAPTURE(round);
    Job job;
    job.shape = makeDisc(30).value();
    job.toolpath.spacing = 0.4;
    const int cycles = 1 + round % 3;
    for (int k = 0; k < cycles; ++k) {
      job.toolpath.cycles.push_back(roughCircle(random, 3 + 4 * k, 10 + static_cast<int>(random() % 3000), 0.26, 0.62));
    }
    job.printer.flavor = round % 2 == 0 ? GcodeFlavor::Marlin : GcodeFlavor::Klipper;
    job.printer.maxFlow = 2 + round % 7;
    job.printer.maxSegmentsPerSecond = round % 5 == 0 ? 100 : 1000;
    job.params.layers = 1 + round % 4;
    job.params.base = round % 3;
    job.params.skirt = round % 3;
    job.params.firstLayerHeight = round % 4 == 1 ? 0.28 : 0;
    job.params.place = Vec2{7 + double(random() % 1000000) / 7000, 7 + double(random() % 1000000) / 7000};
    checkFile(job, job.write());
  }
}

TEST_CASE("parts too thin for the base layers are reported") {
  Job job = plate();
  job.shape.paths.push_back({{{{30, 0}, {60, 0}, {60, 30}, {59.7, 30}, {59.7, 0.3}, {30, 0.3}}}, FillRule::NonZero});
  job.shape.paths.push_back({{{{0, 20}, {0.35, 20}, {0.35, 190}, {0, 190}}}, FillRule::NonZero});
  const Written written = job.write();
  REQUIRE(written.result.ok());
  CHECK(contains(written.result.value().warnings, "the base layers cover only 8"));
}

TEST_CASE("hostile values end in a valid file or in an error") {
  const double values[] = {kNan, kInfinity, -kInfinity, 1e300, -1e300, 0,  -0.0, 5e-324, 1e-9,
                           -1,   0.05,      0.2,        1,     3,      40, 200,  1e5,    1e9};
  std::mt19937 random(5);
  int written = 0;
  for (int round = 0; round < 1500; ++round) {
    Job job = plate(10, 10, 3);
    Printer& p = job.printer;
    PrintParams& q = job.params;
    double place = kNan;
    double* fields[] = {&p.bedMin.x,
                        &p.bedMin.y,
                        &p.bedMax.x,
                        &p.bedMax.y,
                        &p.maxZ,
                        &p.nozzle,
                        &p.filamentDiameter,
                        &p.filamentDensity,
                        &p.nozzleTemperature,
                        &p.firstLayerNozzleTemperature,
                        &p.bedTemperature,
                        &p.speed,
                        &p.firstLayerSpeed,
                        &p.travelSpeed,
                        &p.acceleration,
                        &p.machineAcceleration,
                        &p.cornerSpeed,
                        &p.maxFlow,
                        &p.maxSegmentsPerSecond,
                        &p.pressureAdvance,
                        &p.retractLength,
                        &p.retractSpeed,
                        &p.lift,
                        &q.layerHeight,
                        &q.firstLayerHeight,
                        &q.flow,
                        &q.baseFlow,
                        &place,
                        &job.toolpath.spacing,
                        &job.shape.paths[0].rings[0][2].x,
                        &job.shape.paths[0].rings[0][2].y};
    for (int k = 0; k <= round % 2; ++k) *fields[random() % std::size(fields)] = values[random() % std::size(values)];
    if (!std::isnan(place)) q.place = Vec2{place, 100};
    Cycle& cycle = job.toolpath.cycles[0];
    if (round % 6 == 0)
      cycle.points[random() % cycle.points.size()].x = static_cast<float>(values[random() % std::size(values)]);
    if (round % 6 == 1)
      cycle.widths[random() % cycle.widths.size()] = static_cast<float>(values[random() % std::size(values)]);
    if (round % 7 == 0) p.flavor = GcodeFlavor::Klipper;
    const Written file = job.write();
    if (!file.result.ok()) {
      CHECK(file.text.empty());
      CHECK(!file.result.error().message.empty());
      continue;
    }
    ++written;
    CHECK(grammarError(file.text) == "");
    CHECK(std::isfinite(file.result.value().seconds));
    const ReadFile read = readGcode(file.text);
    CHECK(read.minX >= p.bedMin.x);
    CHECK(read.maxX <= p.bedMax.x);
  }
  CHECK(written > 100);
}

TEST_CASE("the time in the footer is the time of the summary") {
  Job job = plate();
  const Written written = job.write();
  const double seconds = written.result.value().seconds;
  const std::string expected =
      std::to_string(std::llround(seconds) / 60) + "m " + std::to_string(std::llround(seconds) % 60) + "s";
  CHECK(valueOf(written.text, "; estimated printing time (normal mode) = ") == expected);
  // Two base layers and one oriented of about 1500 mm each, the first at 20 mm/s: 1500 / 20 + 2 * 1500 / 50 and
  // corners.
  CHECK(seconds > 135);
  CHECK(seconds < 200);
}
