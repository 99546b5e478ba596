#include "sillon/gcode/writer.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "base/numbers.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "support/about.hpp"
#include "support/gcode_job.hpp"

using namespace sillon;
using namespace sillon::test;
using doctest::Approx;

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

// ---- filament

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
    CHECK(double(moves[k].e) / 1e5 == about(extrusion(0.2, 0.39 + 0.02 * double(k), 0.2), 1e-3));
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
    exact += extrusion(0.2, 0.4, move.length(), 0.95);
    printed += double(move.e) / 1e5;
    worst = std::max(worst, std::abs(exact - printed));
  }
  CHECK(worst < 1.2e-5);  // float widths add a little to the half unit on either end
}

// ---- skeleton

TEST_CASE("every place that announces a height tells that of the highest bead, base layers included") {
  struct Stack {
    int base;
    int layers;
    double first;
    double start;
    const char* height;
  };
  for (const Stack& stack : {Stack{0, 1, 0, 0, "0.2"},
                             {2, 1, 0, 0, "0.6"},
                             {3, 2, 0.3, 0, "1.1"},
                             {5, 1, 0, 0, "1.2"},
                             {1, 1, 0, 5, "5.4"}}) {
    CAPTURE(stack.height);
    for (const GcodeFlavor flavor : {GcodeFlavor::Marlin, GcodeFlavor::Klipper, GcodeFlavor::Bambu}) {
      Job job = plate();
      job.params.base = stack.base;
      job.params.layers = stack.layers;
      job.params.firstLayerHeight = stack.first;
      job.params.startHeight = stack.start;
      job.printer.flavor = flavor;
      job.printer.startGcode = "G28\nM109 S{first_layer_temperature}\nM117 top {max_layer_z} of {total_layer_count}\n";
      const Written written = job.write();
      REQUIRE_MESSAGE(written.result.ok(), written.result.error().message);
      const ReadFile file = readGcode(written.text);
      std::int64_t highest = 0;
      for (const ReadPath& path : file.paths) {
        if (path.role == "Custom") continue;  // the purge
        for (const ReadMove& move : path.moves) highest = std::max(highest, move.z);
      }
      CHECK(decimal(double(highest) / 1000, 3) == stack.height);
      CHECK(std::stod(valueOf(written.text, "; max_z_height: ")) == about(double(highest) / 1000, 1e-9));
      const std::string layers = std::to_string(stack.base + stack.layers);
      CHECK(written.text.find("M117 top " + std::string(stack.height) + " of " + layers + "\n") != std::string::npos);
      const auto last = [&](const std::string& key) {
        const std::size_t at = written.text.rfind(key) + key.size();
        return written.text.substr(at, written.text.find('\n', at) - at);
      };
      CHECK(last("\n;Z:") == stack.height);
      CHECK(last("\n;BEFORE_LAYER_CHANGE\n;") == stack.height);  // the end's, which hosts read in the last MiB
      if (flavor == GcodeFlavor::Bambu) CHECK(last("\n; Z_HEIGHT: ") == stack.height);
    }
  }
}

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
          "\n;TYPE:Custom\n; FEATURE: Custom\nG21\nG90\nM82\nM221 S100\nM140 S60\nM104 S150\nG28\n",
          "\nG21\nG90\nM83\nG92 E0\nM220 S100\nG1 Z10.000 F600\nG1 X",
          "\nM190 S60\nM109 S220\n",
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
  CHECK(text.find("ADVANCE=0.0400\n") != std::string::npos);
  CHECK(text.find("ADVANCE=0\n") == std::string::npos);
  CHECK(text.find("M204 S1000\n") != std::string::npos);
  CHECK(text.find("M204 S4000\n") == std::string::npos);
}

TEST_CASE("acceleration is held at the machine's, with a warning") {
  Job job = plate();
  job.printer.acceleration = 9000;
  job.printer.machineAcceleration = 4000;
  const Written written = job.write();
  checkFile(job, written);
  CHECK(contains(written.result.value().warnings,
                 "acceleration is 9000 mm/s2; it is held at printer.machineAcceleration, 4000"));
  CHECK(written.text.find("M204 P9000") == std::string::npos);
  job.printer.acceleration = 4000;
  CHECK(job.write().text == written.text);
}

TEST_CASE("text of the user stays inside its comment") {
  Job job = plate();
  job.params.notes = {"first\nM112\r\nG28 \xc3\xa9", std::string(200000, 'x')};
  job.printer.name = "Mine\nM112";
  CHECK(job.write().result.error().message.find("printer.name is \"Mine?M112\"; it must be one line") == 0);
  job.printer.name = "Mine";
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
  CHECK(text.find("G1 Z15.050 F600\nG1 X1.000 Y1.000 F7200\nM190 S60\nM109 S215\n") != std::string::npos);
  CHECK(text.find("S220") == std::string::npos);  // of a first layer on the bed
  CHECK(text.find("M106 S0\n") == std::string::npos);
  CHECK(text.find("M106 S255\nM104 S215\n;TYPE:Solid infill\n") != std::string::npos);
  CHECK(text.find("\nM104 S215\n;TYPE:Top solid") == std::string::npos);  // once
  CHECK(
      text.find("M109 S215\nG1 E-0.80000 F2100\n;BEFORE_LAYER_CHANGE\n;5.25\n;LAYER_CHANGE\n;Z:5.25\n;HEIGHT:0.2\n") !=
      std::string::npos);
  CHECK(text.find("\n;Z:5.65\n;HEIGHT:0.2\n") != std::string::npos);
  CHECK(valueOf(text, "; max_z_height: ") == "5.65");
  CHECK(valueOf(text, "; total layers count = ") == "3");
  CHECK(valueOf(text, "; start height = ") ==
        "5.05 mm, of a print on the bed that homing and probing (G28, G29) must not touch");
  CHECK(contains(written.result.value().warnings, "a print of 5.05 mm stands on the bed while the printer homes"));
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
  CHECK(job.write().result.error().message.find("these plates are 4.2 mm high; several on one bed") == 0);
}

// ---- the stack

TEST_CASE("cycles begin at a concave corner if they pass one, and on the layer that is seen where the toolpath does") {
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
    const Vec2 at{double(first.x0) / 1000 - 95, double(first.y0) / 1000 - 100};
    CHECK(length(at - (seams < 5 ? Vec2{11.8, 7.8} : Vec2{0.2, 0.2})) < (seams < 5 ? 1.3 : 0.01));
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

// ---- placement

TEST_CASE("whoever knows why may print colder and hotter than the printer's own limits") {
  Job job = plate();
  job.printer.generalHeatLimits = true;
  job.printer.maxNozzleTemperature = 240;
  job.printer.maxBedTemperature = 60;
  job.printer.nozzleTemperature = job.printer.firstLayerNozzleTemperature = 290;
  job.printer.bedTemperature = 110;
  const Written written = job.write();
  REQUIRE_MESSAGE(written.result.ok(), written.result.error().message);
  CHECK(written.text.find("M109 S290") != std::string::npos);
  CHECK(checkGcode(written.text, job.printer).errors() == 0);
  CHECK(checkGcode(written.text).errors() == 0);
  job.printer.generalHeatLimits = false;
  CHECK(checkGcode(written.text, job.printer).errors() > 0);
}

TEST_CASE("a file tells heat limits below the general ones, so that whoever checks it refuses the same blocks") {
  Job job = plate();
  CHECK(job.write().text.find("_temperature = 300") == std::string::npos);
  job.printer.maxNozzleTemperature = 255;
  job.printer.maxBedTemperature = 80;
  const std::string text = job.write().text;
  CHECK(checkGcode(text).errors() == 0);
  const std::string start = "G28\nM190 S60\nM109 S215\n";
  for (const char* line : {"M104 S256\n", "M140 S81\n"}) {
    CAPTURE(line);
    job.printer.startGcode = start + line;
    CHECK_FALSE(job.write().result.ok());
    std::string hot = text;
    hot.insert(hot.find("G28\n") + 4, line);
    CHECK(checkGcode(hot).errors() > 0);
  }
  job.printer.generalHeatLimits = true;
  CHECK(job.write().result.ok());
  CHECK(checkGcode(job.write().text).errors() == 0);
}

// ---- bad input

TEST_CASE("bad input is refused by name before a byte is written") {
  struct Row {
    const char* part;
    std::function<void(Job&)> spoil;
    ErrorCode code = ErrorCode::InvalidArgument;
  };
  const Row rows[] = {
      {"nozzle is 0 mm; it must be 0.05 to 2", [](Job& j) { j.printer.nozzle = 0; }},
      {"nozzle is 2.1 mm", [](Job& j) { j.printer.nozzle = 2.1; }},
      {"nozzle is not a number", [](Job& j) { j.printer.nozzle = kNan; }},
      {"filamentDiameter", [](Job& j) { j.printer.filamentDiameter = 0; }},
      {"filamentDensity", [](Job& j) { j.printer.filamentDensity = -1; }},
      {"filamentFlow", [](Job& j) { j.printer.filamentFlow = 3; }},
      {"startHeight is -1 mm; it must be 0 to 5000", [](Job& j) { j.params.startHeight = -1; }},
      {"startHeight is 201 mm", [](Job& j) { j.params.startHeight = 201; }},
      {"startHeight is not a number", [](Job& j) { j.params.startHeight = kNan; }},
      {"with the lift of the nozzle the print is 200.6 mm high", [](Job& j) { j.params.startHeight = 199.6; },
       ErrorCode::DoesNotFit},
      {"startHeight is 5 mm; it must be 0 where print.showSide is not up",
       [](Job& j) {
         j.params.startHeight = 5;
         j.params.showSide = ShowSide::Bed;
       }},
      {"startHeight is 5 mm; it must be 0 where print.showSide is not up",
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
      {"with the lift of the nozzle the print is",
       [](Job& j) {
         j.params.layers = 1000;
         j.printer.maxZ = 100;
       },
       ErrorCode::DoesNotFit},
      {"nozzleTemperature is 301 degrees Celsius; it must be 0 to 300",
       [](Job& j) {
         j.printer.generalHeatLimits = true;
         j.printer.nozzleTemperature = 301;
       }},
      {"bedTemperature is 121",
       [](Job& j) {
         j.printer.generalHeatLimits = true;
         j.printer.bedTemperature = 121;
       }},
      {"machineSpeed is 4 mm/s; it must be 5 to 1000, or 0", [](Job& j) { j.printer.machineSpeed = 4; }},
      {"; print.strict refuses that",
       [](Job& j) {
         j.params.strict = true;
         j.shape = rectangle(30, 15);
       }},
      {"the path's crossings with itself are 1; print.strict allows none",
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
      {"bedMax is [220, 0] mm; it must be 10 to 5000 mm right of", [](Job& j) { j.printer.bedMax.y = 0; }},
      {"place.x is not a number",
       [](Job& j) {
         j.params.place = Vec2{kNan, 0};
       }},
      {"place.y is 1e+200 mm",
       [](Job& j) {
         j.params.place = Vec2{0, 1e200};
       }},
      {"date is \"today\"; it must look like", [](Job& j) { j.params.date = "today"; }},
      {"generated by", [](Job& j) { j.params.notes = {"Generated By PrusaSlicer"}; }},
      {"generated by", [](Job& j) { j.printer.name = "generated by SuperSlicer"; }},
      {"no lines", [](Job& j) { j.toolpath.cycles.clear(); }, ErrorCode::EmptyShape},
      {"spacing is 0 mm", [](Job& j) { j.toolpath.spacing = 0; }},
      {"cycle 1 (from 0) has 0 different points", [](Job& j) { j.toolpath.cycles.emplace_back(); }},
      {"cycle 0 (from 0) has 2 different points at 0.001 mm; it must have at least 3",
       [](Job& j) {
         j.toolpath.cycles = {{{{1, 1}, {2, 2}}, {0.4f, 0.4f}}};
       }},
      {"has 2 different points at 0.001 mm",
       [](Job& j) {
         j.toolpath.cycles = {{{{1, 1}, {2, 2}, {2, 2}}, {0.4f, 0.4f, 0.4f}}};
       }},
      {" widths; there must be one width per point", [](Job& j) { j.toolpath.cycles[0].widths.pop_back(); }},
      {"a point lies at (not a number, ", [](Job& j) { j.toolpath.cycles[0].points[3].x = static_cast<float>(kNan); }},
      {"a point lies at (", [](Job& j) { j.toolpath.cycles[0].points[3].y = 1e30f; }},
      {"width is 0 mm; it must be ", [](Job& j) { j.toolpath.cycles[0].widths[5] = 0; }},
      {"width is not a number mm; it must be ",
       [](Job& j) { j.toolpath.cycles[0].widths[5] = static_cast<float>(kNan); }},
      {"a bead would be 3.3 x 0.2 mm = 0.66 mm2; it must be at most 4 nozzle2 = 0.64 mm2",
       [](Job& j) { j.toolpath.cycles[0].widths[5] = 3.3f; }},
      {"a point lies at (infinite, ", [](Job& j) { j.shape.paths[0].rings[0][1].x = kInfinity; }},
      {"the shape is too thin for lines of 0.4 mm",
       [](Job& j) {
         j.shape = rectangle(30, 0.3);
         j.toolpath.cycles = {{{{1, 0.1f}, {29, 0.1f}, {29, 0.2f}, {1, 0.2f}}, std::vector<float>(4, 0.24f)}};
       }},
      {"the shape has no area", [](Job& j) { j.shape.paths.clear(); }, ErrorCode::EmptyShape},
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
      {"layers thinner than 0.2 nozzle diameters", [](Job& j) { j.params.layerHeight = 0.06; }},
      {"flow is 0.7; 0.8 to 1.1 is usual", [](Job& j) { j.params.flow = 0.7; }},
      {"filamentFlow is 0.7; 0.8 to 1.1 is usual", [](Job& j) { j.printer.filamentFlow = 0.7; }},
      {"baseFlow is 1.2", [](Job& j) { j.params.baseFlow = 1.2; }},
      {"no wider than the layer is high",
       [](Job& j) {
         j.params.layerHeight = 0.3;
         j.toolpath.cycles[0].widths[9] = 0.25f;
       }},
      {"% of the shape's area", [](Job& j) { j.shape = rectangle(30, 40); }},
      {"points of the path that lie more than 0.1 mm outside the shape: ", [](Job& j) { j.shape = rectangle(30, 15); }},
      {"maxFlow slows", [](Job& j) { j.printer.maxFlow = 2; }},
      {"maxSegmentsPerSecond slows", [](Job& j) { j.printer.maxSegmentsPerSecond = 2; }},
      {"speed is 300 mm/s; it is held at printer.machineSpeed, 40",
       [](Job& j) {
         j.printer.machineSpeed = 40;
         j.printer.speed = 300;
       }},
      {"travelSpeed is 120 mm/s; it is held at printer.machineSpeed, 100",
       [](Job& j) { j.printer.machineSpeed = 100; }},
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
  job.printer.maxSegmentsPerSecond = 10000;  // a board that takes them all
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
  CHECK(contains(result.value().warnings, "printers get slow above 2 million"));
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
                        &p.filamentFlow,
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

TEST_CASE("the filament's flow multiplies the plastic of every role, and the purge line still takes its length") {
  Job job = plate(30, 20, 1.3);
  job.params.base = 2;
  job.params.skirt = 1;
  job.params.brim = 2;
  job.params.showSide = ShowSide::Both;
  const auto byRole = [&] {
    const Written written = job.write();
    REQUIRE_MESSAGE(written.result.ok(), written.result.error().message);
    std::map<std::string, double> all;
    for (const ReadPath& path : readGcode(written.text).paths) {
      all[path.role + (path.layer == 1 ? " of the first layer" : "")] += path.filament();
    }
    return all;
  };
  const std::map<std::string, double> whole = byRole();
  job.printer.filamentFlow = 0.94;
  const std::map<std::string, double> less = byRole();
  REQUIRE(less.size() == whole.size());
  CHECK(whole.size() >= 4);
  for (const auto& entry : whole) {
    const std::string& role = entry.first;
    CAPTURE(role);
    CHECK(less.at(role) == Approx((role.starts_with("Custom") ? 1 : 0.94) * entry.second).epsilon(1e-4));
  }
  const std::string text = job.write().text;
  CHECK(text.find("\n; extrusion_multiplier = 0.94\n") != std::string::npos);
  const GcodeCheck check = checkGcode(text, job.printer);
  CHECK(check.errors() == 0);
  for (const GcodeFinding& finding : check.findings) CHECK(finding.rule != "totals");
  for (const double share : check.coverage) CHECK((share < 0 || share > 0.97));
}

TEST_CASE("more flow of the filament slows what the hot end melts no faster") {
  Job job = plate(30, 20, 1.3);
  job.printer.maxFlow = 3;
  for (const double flow : {1.0, 1.5}) {
    job.printer.filamentFlow = flow;
    const GcodeCheck check = checkGcode(job.write().text, job.printer);
    CHECK(check.errors() == 0);
    CHECK(check.mostFlow <= 3 * 1.0001);
  }
}

TEST_CASE("the summary tells what an independent reader finds in the file, and what it weighs") {
  Job job = plate();
  job.printer.filamentDiameter = 2.85;
  job.printer.filamentDensity = 1.27;
  const Written written = job.write();
  const GcodeSummary& summary = written.result.value();
  const ReadFile file = readGcode(written.text);
  double mm = 0;
  for (const ReadPath& path : file.paths) mm += path.filament();
  CHECK(summary.filamentMm == Approx(mm).epsilon(1e-9));
  CHECK(summary.filamentCm3 == Approx(mm * 3.14159265358979 * 2.85 * 2.85 / 4 / 1000));
  CHECK(summary.filamentGrams == Approx(summary.filamentCm3 * 1.27));
  CHECK(summary.moves == file.moves);
  CHECK(summary.bytes == static_cast<std::int64_t>(written.text.size()));
}

TEST_CASE("warnings are a code with values, and the sentence made of them") {
  const Warning low{WarningCode::BlockMovesLow, {{"block", std::string("endGcode")}, {"z", 0.3}, {"height", 5.25}}};
  CHECK(std::string(warningName(low.code)) == "BlockMovesLow");
  CHECK(low.message == "endGcode goes down to Z 0.3; what stands there is 5.25 mm high");
  REQUIRE(low.value("z") != nullptr);
  CHECK(low.value("z")->number == 0.3);
  CHECK(low.value("speed") == nullptr);

  Job job = plate();
  job.params.flow = 0.5;
  const Written written = job.write();
  const std::vector<Warning>& warnings = written.result.value().warnings;
  const auto flow = std::find_if(warnings.begin(), warnings.end(),
                                 [](const Warning& w) { return w.code == WarningCode::UnusualFlow; });
  REQUIRE(flow != warnings.end());
  CHECK(flow->value("field")->text == "print.flow");
  CHECK(flow->value("value")->number == 0.5);
}

TEST_CASE("the fan follows the family of the filament, and does not run on the bed") {
  for (const auto& [type, fan] :
       {std::pair{"PLA", 255}, {"PLA Silk", 255}, {"PETG-CF", 128}, {"ABS", 26}, {"Wood", 128}}) {
    Job job = plate();
    job.printer.filamentType = type;
    const std::string text = job.write().text;
    std::vector<std::string> said;
    for (const std::string_view line : split(text, '\n')) {
      if (line.starts_with("M106") || line == "M107") said.emplace_back(line);
    }
    CHECK(said == std::vector<std::string>{"M106 S0", "M106 S" + std::to_string(fan), "M107"});
    CHECK(text.find("\nM106 S0\n") < text.find(";TYPE:Solid infill"));
    const std::size_t on = text.find("\nM106 S" + std::to_string(fan));
    CHECK(on > text.find("\n;Z:0.4\n"));
    CHECK(on < text.find("\n;Z:0.6\n"));
  }
}

TEST_CASE("first, base and show layers have their own speed, fan and acceleration") {
  Job job = plate(60, 60);
  job.params.skirt = 0;
  job.printer.firstLayerSpeed = 18;
  job.printer.baseSpeed = 70;
  job.printer.showSpeed = 30;
  job.printer.machineAcceleration = 3000;
  job.printer.acceleration = 1500;
  job.printer.firstLayerAcceleration = 600;
  job.printer.firstLayerFan = 10;
  job.printer.baseFan = 60;
  job.printer.showFan = 20;
  const std::string text = job.write().text;
  std::int64_t fastest[4] = {0, 0, 0, 0};
  for (const ReadPath& path : readGcode(text).paths) {
    for (const ReadMove& move : path.moves) fastest[path.layer] = std::max(fastest[path.layer], move.feedrate);
  }
  CHECK(fastest[1] == 18 * 60);
  CHECK(fastest[2] == 70 * 60);
  CHECK(fastest[3] == 30 * 60);
  std::vector<std::string> said;
  for (const std::string_view line : split(text, '\n')) {
    if (line.starts_with("M106") || line.starts_with("M204") || line == ";LAYER_CHANGE") said.emplace_back(line);
  }
  CHECK(said == std::vector<std::string>{"M204 P1500 T1500", ";LAYER_CHANGE", "M106 S26", "M204 P600 T600",
                                         ";LAYER_CHANGE", "M106 S153", "M204 P1500 T1500", ";LAYER_CHANGE", "M106 S51",
                                         "M204 P3000 T3000"});
}

TEST_CASE("without pressure advance oriented layers run at 20 mm/s throughout, and the time that takes is told") {
  Job job = plate(60, 60, 0.5);
  job.printer.showSpeed = 0;
  const auto speeds = [](const std::string& text) {
    std::int64_t low = 1 << 30;
    std::int64_t high = 0;
    for (const ReadPath& path : readGcode(text).paths) {
      if (path.role != "Top solid infill") continue;
      for (const ReadMove& move : path.moves) {
        low = std::min(low, move.feedrate);
        high = std::max(high, move.feedrate);
      }
    }
    return std::pair(low, high);
  };
  const Written without = job.write();
  CHECK(speeds(without.text) == std::pair<std::int64_t, std::int64_t>(1200, 1200));
  const std::vector<Warning>& warnings = without.result.value().warnings;
  const auto told = std::find_if(warnings.begin(), warnings.end(),
                                 [](const Warning& w) { return w.code == WarningCode::NoPressureAdvance; });
  REQUIRE(told != warnings.end());
  CHECK(told->value("minutes")->number == std::ceil(9000.0 / 60 * (1 / 20.0 - 1 / 50.0)));  // 60 x 60 / 0.4 mm
  for (int way = 0; way < 3; ++way) {
    Job with = job;
    if (way == 0) with.printer.setPressureAdvance = true;
    if (way == 1) with.printer.flavor = GcodeFlavor::Klipper;
    if (way == 2) with.printer.startGcode = "G28\nM190 S60\nM109 S220\nM900 K0.05";
    const Written written = with.write();
    CHECK(speeds(written.text).second == 3000);
    CHECK(speeds(written.text).first < 3000);  // turns are slower
    CHECK(!contains(written.result.value().warnings, "nothing sets pressure advance"));
  }
  job.printer.startGcode = "G28\nM190 S60\nM109 S220\nM900 K0.05\nM900 K0";
  CHECK(speeds(job.write().text).second == 1200);
}

TEST_CASE("layers that are too short for the plastic to set are slowed, not below 5 mm/s") {
  Job job = plate(12, 12, 2);
  job.params.skirt = 0;
  const auto seconds = [](const Job& of) { return of.write().result.value().seconds; };
  const double quick = seconds(job);
  job.printer.minLayerTime = 30;
  const double slow = seconds(job);
  CHECK(slow > 3 * 30);
  CHECK(slow < 3 * 30 * 1.1 + quick);
  job.printer.minLayerTime = 300;
  for (const ReadPath& path : readGcode(job.write().text).paths) {
    if (path.layer == 0) continue;
    for (const ReadMove& move : path.moves) CHECK(move.feedrate >= 300);
  }
}

TEST_CASE("hatched base layers have a perimeter, and fill what is within it") {
  Job job = plate(30, 20);
  job.params.skirt = 0;
  job.params.elephantFoot = 0;
  job.params.basePerimeters = 1;
  const ReadFile file = checkFile(job, job.write());
  double filament = 0;
  int loops = 0;
  for (const ReadPath& path : file.paths) {
    if (path.layer != 2) continue;
    filament += path.filament();
    if (!path.closed()) continue;
    ++loops;
    for (const ReadMove& move : path.moves) {
      const double x = double(move.x1) / 1000 - 95;
      const double y = double(move.y1) / 1000 - 100;
      CHECK(std::min({x, y, 30 - x, 20 - y}) == about(0.2, 0.1));
    }
  }
  CHECK(loops == 1);
  CHECK(filament == about(600 * 0.2 / kArea, 0.03));
}

TEST_CASE("with constant flow narrow beads run faster, up to half as fast again and never faster than the machine") {
  Job job = plate(60, 60);
  job.params.constantFlow = true;
  const auto fastest = [&](float width) {
    job.toolpath.cycles[0].widths.assign(job.toolpath.cycles[0].points.size(), width);
    const Written written = job.write();
    REQUIRE_MESSAGE(written.result.ok(), written.result.error().message);
    const ReadFile file = readGcode(written.text);
    std::int64_t feedrate = 0;
    for (const ReadMove& move : lastPath(file).moves) feedrate = std::max(feedrate, move.feedrate);
    return feedrate;
  };
  CHECK(fastest(0.5f) == 40 * 60);
  CHECK(fastest(0.32f) == 62 * 60);  // whole mm/s
  CHECK(fastest(0.25f) == 75 * 60);  // not 80
  job.printer.machineSpeed = 70;
  CHECK(fastest(0.25f) == 70 * 60);
  CHECK(fastest(0.4f) == 50 * 60);
}

TEST_CASE("what slows more than a tenth of the oriented beads is told with its share") {
  // A loop of 60 mm whose beads are 1.6 nozzles wide on its first part and half as wide on the rest.
  const auto told = [](WarningCode code, double part, double maxFlow, double segments) {
    Job job = plate();
    job.params.base = 0;  // and a skirt, which does not count
    job.printer.maxFlow = maxFlow;
    job.printer.maxSegmentsPerSecond = segments;
    job.printer.pressureAdvance = 0;
    Cycle& cycle = job.toolpath.cycles[0];
    cycle = {};
    const auto add = [&](float x, float y, float width) {
      cycle.points.push_back({x, y});
      cycle.widths.push_back(width);
    };
    for (int k = 0; k < 400; ++k) {
      const float s = 0.1f * static_cast<float>(k);
      add(2 + (s < 20 ? s : 40 - s), s < 20 ? 5.0f : 15.0f, s < part ? 0.64f : 0.32f);
    }
    const Written written = job.write();
    REQUIRE_MESSAGE(written.result.ok(), written.result.error().message);
    for (const Warning& warning : written.result.value().warnings) {
      if (warning.code == code) return warning.value("percent")->number;
    }
    return 0.0;
  };
  // 0.95 x 0.2 x 0.64 mm at 20 mm/s are 2.43 mm3/s, and half of it elsewhere. On the way back from the one side to the
  // other, 10 mm long, beads grow evenly: they pass 2 mm3/s after 6.4 mm.
  CHECK(told(WarningCode::MaxFlowSlows, 15, 2, 1000) == about(100 * (15 + 3.6) / 60, 0.03));
  CHECK(told(WarningCode::MaxFlowSlows, 3.6, 2, 1000) == about(100 * (3.6 + 3.6) / 60, 0.06));
  CHECK(told(WarningCode::MaxFlowSlows, 1.8, 2, 1000) == 0);  // 9 %
  CHECK(told(WarningCode::MaxFlowSlows, 15, 1, 1000) == about(100, 1e-6));
  CHECK(told(WarningCode::SegmentsSlow, 15, 10, 1000) == 0);
}

TEST_CASE("the nozzle wipes 3 mm back along however many moves, drawing back where it is asked to on the way") {
  Job job = plate(60, 60);
  job.params.base = 0;
  job.params.skirt = 0;
  Cycle& cycle = job.toolpath.cycles[0];
  cycle = {};
  for (int k = 0; k < 100; ++k) {  // 0.55 mm apart, so that 0.25 mm are left of the sixth
    const double a = 2 * 3.14159265358979 * k / 100;
    cycle.points.push_back(
        {static_cast<float>(30 + 8.755 * std::cos(a)), static_cast<float>(30 + 8.755 * std::sin(a))});
    cycle.widths.push_back(0.4f);
  }
  const auto wiped = [](const std::vector<ReadMove>& moves, std::size_t from) {
    double sum = 0;
    for (std::size_t k = from; k < moves.size() && moves[k].z < 1000; ++k) sum += moves[k].length();
    return sum;
  };
  const ReadFile file = readGcode(job.write().text);
  std::size_t first = 0;  // of the ways after the loop
  while (first < file.travels.size() && !(file.travels[first].retracted && file.travels[first].z == 200)) ++first;
  CHECK(wiped(file.travels, first) == about(3, 2e-3));

  for (const double scarf : {5.0, 0.5}) {
    job.params.scarf = scarf;
    const ReadFile scarfed = readGcode(job.write().text);
    CHECK(wiped(scarfed.wipes, 0) == about(3, 2e-3));
    std::int64_t drawn = 0;
    double along = 0;
    for (const ReadMove& move : scarfed.wipes) {  // evenly, at no more than the speed of retraction
      drawn -= move.e;
      along += move.length();
      CHECK(std::abs(double(drawn) - 80000 * along / 3) < 80);
      CHECK(double(move.feedrate) / 60 <= 3 * job.printer.retractSpeed / 0.8);
      CHECK(move.feedrate == scarfed.wipes[0].feedrate);
    }
    CHECK(drawn == 80000);
  }
}

TEST_CASE("comments tell heights in micrometres, as slicers do") {
  Job job = plate();
  job.params.layerHeight = 0.1234567;
  job.params.base = 1;
  const std::string text = job.write().text;
  CHECK(text.find("\n;Z:0.123\n;HEIGHT:0.123\n") != std::string::npos);
  CHECK(text.find("\n;Z:0.247\n;HEIGHT:0.123\n") != std::string::npos);
}

TEST_CASE("a single plate is not named, and limits are set only where the printer's own are known") {
  for (const GcodeFlavor flavor : {GcodeFlavor::Klipper, GcodeFlavor::Marlin}) {
    Job job = plate();
    job.printer.flavor = flavor;
    const std::string text = job.write().text;
    for (const char* none : {"EXCLUDE_OBJECT", "M486", "M204", "VELOCITY_LIMIT", "M205", "M900", "PRESSURE_ADVANCE"}) {
      CHECK(text.find(none) == std::string::npos);
    }
    job.printer.machineCornerSpeed = 0.5;
    const std::string slow = job.write().text;
    CHECK((slow.find("SQUARE_CORNER_VELOCITY=5.00\n") != std::string::npos) == (flavor == GcodeFlavor::Klipper));
    CHECK((slow.find("M205 X10.00 Y10.00\n") != std::string::npos) == (flavor == GcodeFlavor::Marlin));
    CHECK((slow.find("M205 X1.00 Y1.00\n") != std::string::npos) == (flavor == GcodeFlavor::Marlin));
    job.params.copies = {2, 1};
    CHECK(job.write().text.find(flavor == GcodeFlavor::Klipper ? "NAME=PLATE_1" : "M486 S1\n") != std::string::npos);
  }
}

TEST_CASE("the length of beads held at a limit is told for all layers, sides and copies") {
  // 20 mm of a bead wider than 1.6 nozzles, and its two ends of 10 mm.
  Job job = plate();
  job.toolpath.cycles = {
      {{{2, 2}, {12, 2}, {12, 4}, {22, 4}, {22, 14}, {2, 14}}, {0.4f, 0.4f, 0.4f, 0.7f, 0.7f, 0.4f}}};
  const double once = job.write().result.value().clampedLengthMm;
  CHECK(once >= 10);
  job.params.layers = 3;
  CHECK(job.write().result.value().clampedLengthMm == Approx(3 * once));
  job.params.copies = {2, 2};
  CHECK(job.write().result.value().clampedLengthMm == Approx(12 * once));
  job.params.showSide = ShowSide::Both;
  CHECK(job.write().result.value().clampedLengthMm == Approx(24 * once));
  job.params.showSide = ShowSide::Bed;
  CHECK(job.write().result.value().clampedLengthMm == Approx(12 * once));
}
