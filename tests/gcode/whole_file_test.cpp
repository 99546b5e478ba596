// Small files line by line: what each line says follows from the job.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "support/gcode_job.hpp"

using namespace sillon;
using namespace sillon::test;

namespace {

// A square of 12 mm, one base layer and two oriented ones, each the loop of 10 mm that lies 1 mm inside of it.
Job square() {
  Job job;
  job.shape = rectangle(12, 12);
  job.toolpath.spacing = 0.4;
  job.toolpath.cycles = {{{{1, 1}, {11, 1}, {11, 11}, {1, 11}}, std::vector<float>(4, 0.4f)}};
  job.params.base = 1;
  job.params.layers = 2;
  job.params.basePattern = BasePattern::Same;
  job.params.skirt = 0;
  job.params.purgeLength = 0;
  job.params.place = Vec2{50, 50};
  return job;
}

// The lines between header and footer, but for the progress.
std::string linesOf(const Job& job) {
  const Written written = job.write();
  REQUIRE_MESSAGE(written.result.ok(), written.result.error().message);
  std::string lines;
  bool begun = false;
  for (const std::string_view line : split(written.text, '\n')) {
    begun = begun || line == ";TYPE:Custom";
    if (line.starts_with("; filament used")) break;
    if (begun && !line.starts_with("M73 ")) lines += std::string(line) + "\n";
  }
  return lines;
}

// Puts the filament of 10 mm of a bead of 0.4 x 0.2 mm in the place of each E! (of base layers) and E? (of oriented
// ones). What rounding takes from one the next one brings. With absolute E, it counts from the last G92.
std::string filled(std::string_view pattern, double flow, bool absolute = false) {
  std::string text;
  double exact = 0;
  std::int64_t written = 0;
  std::int64_t axis = 0;
  const auto number = [](std::int64_t e) { return fixed(static_cast<double>(e) / 1e5, 5); };
  for (const std::string_view line : split(pattern, '\n')) {
    std::string words(line);
    if (words == "G92 E0") axis = 0;
    const std::size_t mark = words.find_first_of("!?");
    if (mark != std::string::npos) {
      exact += extrusion(0.2, 0.4, 10, words[mark] == '!' ? 1 : flow);
      const std::int64_t due = std::llround(exact * 1e5);
      axis += due - written;
      words.replace(mark, 1, number(absolute ? axis : due - written));
      written = due;
    } else if (absolute && words.starts_with("G1 E")) {
      axis += std::llround(std::strtod(words.c_str() + 4, nullptr) * 1e5);
      words = "G1 E" + number(axis) + words.substr(words.find(" F"));
    }
    text += words + "\n";
  }
  text.pop_back();
  return text;
}

}  // namespace

TEST_CASE("a small file says what it must, line by line") {
  CHECK(linesOf(square()) == filled(R"(;TYPE:Custom
; FEATURE: Custom
G21
G90
M82
M221 S100
M140 S60
M104 S150
G28
G21
G90
M83
G92 E0
M220 S100
G1 Z10.000 F600
G1 X1.000 Y1.000 F7200
M190 S60
M109 S220
G1 E-0.80000 F2100
;BEFORE_LAYER_CHANGE
;0.2
;LAYER_CHANGE
;Z:0.2
;HEIGHT:0.2
M106 S0
;TYPE:Solid infill
; FEATURE: Internal solid infill
G1 X51.000 Y51.000 F7200
G1 Z0.200 F600
G1 E0.80000 F2100
G1 X61.000 Y51.000 E! F1200
G1 X61.000 Y61.000 E!
G1 X51.000 Y61.000 E!
G1 X51.000 Y51.000 E!
G1 E-0.80000 F2100
G1 X51.000 Y54.000 F1200
G1 Z0.600 F600
;BEFORE_LAYER_CHANGE
;0.4
;LAYER_CHANGE
;Z:0.4
;HEIGHT:0.2
M106 S255
M104 S215
;TYPE:Top solid infill
; FEATURE: Top surface
G1 Z0.800
G1 X51.000 Y51.000 F7200
G1 Z0.400 F600
G1 E0.80000 F2100
G1 X61.000 Y51.000 E? F3000
G1 X61.000 Y61.000 E?
G1 X51.000 Y61.000 E?
G1 X51.000 Y51.000 E?
G1 E-0.80000 F2100
G1 X51.000 Y54.000 F3000
G1 Z0.800 F600
;BEFORE_LAYER_CHANGE
;0.6
;LAYER_CHANGE
;Z:0.6
;HEIGHT:0.2
;TYPE:Top solid infill
; FEATURE: Top surface
G1 Z1.000
G1 X61.000 Y51.000 F7200
G1 Z0.600 F600
G1 E0.80000 F2100
G1 X61.000 Y61.000 E? F3000
G1 X51.000 Y61.000 E?
G1 X51.000 Y51.000 E?
G1 X61.000 Y51.000 E?
G1 E-0.80000 F2100
G1 X58.000 Y51.000 F3000
G1 Z1.000 F600
;BEFORE_LAYER_CHANGE
;0.6
;TYPE:Custom
; FEATURE: Custom
G1 Z11.000
G1 X0.000 Y220.000 F7200
M104 S0
M140 S0
M107
M84
)",
                                    0.95));
}

TEST_CASE("two plates on a Klipper printer whose limits are known, line by line") {
  Job job = square();
  job.params.layers = 1;
  job.params.copies = {2, 1};
  job.printer.flavor = GcodeFlavor::Klipper;
  job.printer.setPressureAdvance = true;
  job.printer.machineAcceleration = 3000;
  job.printer.acceleration = 1500;
  job.printer.firstLayerAcceleration = 600;
  job.printer.machineCornerSpeed = 8;
  job.printer.bedTemperature = 0;
  CHECK(linesOf(job) == filled(R"(;TYPE:Custom
; FEATURE: Custom
G21
G90
M82
M221 S100
M140 S0
M104 S150
G28
G21
G90
M83
G92 E0
M220 S100
G1 Z10.000 F600
G1 X1.000 Y1.000 F7200
M140 S0
M109 S220
G1 E-0.80000 F2100
SET_PRINT_STATS_INFO TOTAL_LAYER=4
EXCLUDE_OBJECT_DEFINE NAME=PLATE_0 CENTER=56.00,56.00 POLYGON=[[50.00,50.00],[62.00,50.00],[62.00,62.00],[50.00,62.00]]
EXCLUDE_OBJECT_DEFINE NAME=PLATE_1 CENTER=78.00,56.00 POLYGON=[[72.00,50.00],[84.00,50.00],[84.00,62.00],[72.00,62.00]]
M204 S1500
SET_VELOCITY_LIMIT SQUARE_CORNER_VELOCITY=5.00
SET_PRESSURE_ADVANCE ADVANCE=0.0400
;BEFORE_LAYER_CHANGE
;0.2
;LAYER_CHANGE
;Z:0.2
;HEIGHT:0.2
SET_PRINT_STATS_INFO CURRENT_LAYER=1
M106 S0
M204 S600
EXCLUDE_OBJECT_START NAME=PLATE_0
;TYPE:Solid infill
; FEATURE: Internal solid infill
G1 X51.000 Y51.000 F7200
G1 Z0.200 F600
G1 E0.80000 F2100
G1 X61.000 Y51.000 E! F1200
G1 X61.000 Y61.000 E!
G1 X51.000 Y61.000 E!
G1 X51.000 Y51.000 E!
G1 E-0.80000 F2100
G1 X51.000 Y54.000 F1200
G1 Z0.600 F600
;BEFORE_LAYER_CHANGE
;0.4
;LAYER_CHANGE
;Z:0.4
;HEIGHT:0.2
SET_PRINT_STATS_INFO CURRENT_LAYER=2
M106 S255
M204 S1500
M104 S215
;TYPE:Top solid infill
; FEATURE: Top surface
G1 Z0.800
G1 X51.000 Y51.000 F7200
G1 Z0.400 F600
G1 E0.80000 F2100
G1 X61.000 Y51.000 E? F3000
G1 X61.000 Y61.000 E?
G1 X51.000 Y61.000 E?
G1 X51.000 Y51.000 E?
G1 E-0.80000 F2100
G1 X51.000 Y54.000 F3000
G1 Z0.800 F600
;BEFORE_LAYER_CHANGE
;0.2
;LAYER_CHANGE
;Z:0.2
;HEIGHT:0.2
SET_PRINT_STATS_INFO CURRENT_LAYER=3
EXCLUDE_OBJECT_END NAME=PLATE_0
M106 S0
M204 S600
M104 S220
EXCLUDE_OBJECT_START NAME=PLATE_1
;TYPE:Solid infill
; FEATURE: Internal solid infill
G1 X73.000 Y51.000 F7200
G1 Z0.200 F600
G1 E0.80000 F2100
G1 X83.000 Y51.000 E! F1200
G1 X83.000 Y61.000 E!
G1 X73.000 Y61.000 E!
G1 X73.000 Y51.000 E!
G1 E-0.80000 F2100
G1 X73.000 Y54.000 F1200
G1 Z0.600 F600
;BEFORE_LAYER_CHANGE
;0.4
;LAYER_CHANGE
;Z:0.4
;HEIGHT:0.2
SET_PRINT_STATS_INFO CURRENT_LAYER=4
M106 S255
M204 S1500
M104 S215
;TYPE:Top solid infill
; FEATURE: Top surface
G1 Z0.800
G1 X73.000 Y51.000 F7200
G1 Z0.400 F600
G1 E0.80000 F2100
G1 X83.000 Y51.000 E? F3000
G1 X83.000 Y61.000 E?
G1 X73.000 Y61.000 E?
G1 X73.000 Y51.000 E?
G1 E-0.80000 F2100
G1 X73.000 Y54.000 F3000
G1 Z0.800 F600
EXCLUDE_OBJECT_END NAME=PLATE_1
;BEFORE_LAYER_CHANGE
;0.4
;TYPE:Custom
; FEATURE: Custom
G1 Z10.800
G1 X0.000 Y220.000 F7200
M104 S0
M140 S0
M107
M84
)",
                               0.95));
}

TEST_CASE("two plates of both sides on a round bed with absolute E, line by line") {
  Job job = square();
  job.params.layers = 1;
  job.params.bedFlow = 1;
  job.params.copies = {2, 1};
  job.params.showSide = ShowSide::Both;
  job.printer.flavor = GcodeFlavor::RepRap;
  job.printer.absoluteE = true;
  job.printer.roundBed = true;
  job.printer.maxZ = 12;
  job.printer.baseFan = 20;
  job.printer.showFan = 40;
  job.printer.firstLayerFan = 10;
  job.printer.setPressureAdvance = true;
  job.printer.machineAcceleration = 3000;
  job.printer.acceleration = 1500;
  job.printer.machineCornerSpeed = 8;
  job.printer.endGcode = "M104 S0\nM140 S0\nM84";
  std::string expected;
  // Mirrored on the bed, the loop begins at its right corner and runs to the left.
  for (int copy = 0; copy < 2; ++copy) {
    const auto x = [&](int of) { return "G1 X" + fixed(of + 22 * copy, 3); };
    const std::string name = std::to_string(copy);
    expected += ";BEFORE_LAYER_CHANGE\n;0.2\n;LAYER_CHANGE\n;Z:0.2\n;HEIGHT:0.2\nG92 E0\n";
    if (copy > 0) expected += "M486 S-1\n";
    expected += "M106 S26\n";
    if (copy > 0) expected += "M104 S220\n";
    expected += "M486 S" + name + "\n";
    expected += ";TYPE:Top solid infill\n; FEATURE: Top surface\n";
    expected += x(61) + " Y51.000 F7200\nG1 Z0.200 F600\nG1 E0.80000 F2100\n";
    expected += x(51) + " Y51.000 E! F1200\n" + x(51) + " Y61.000 E!\n" + x(61) + " Y61.000 E!\n";
    expected += x(61) + " Y51.000 E!\nG1 E-0.80000 F2100\n" + x(61) + " Y54.000 F1200\nG1 Z0.600 F600\n";
    expected += ";BEFORE_LAYER_CHANGE\n;0.4\n;LAYER_CHANGE\n;Z:0.4\n;HEIGHT:0.2\nG92 E0\nM106 S51\nM104 S215\n";
    expected += ";TYPE:Solid infill\n; FEATURE: Internal solid infill\nG1 Z0.800\n";
    expected += x(51) + " Y51.000 F7200\nG1 Z0.400 F600\nG1 E0.80000 F2100\n";
    expected += x(61) + " Y51.000 E! F3000\n" + x(61) + " Y61.000 E!\n" + x(51) + " Y61.000 E!\n";
    expected += x(51) + " Y51.000 E!\nG1 E-0.80000 F2100\n" + x(51) + " Y54.000 F3000\nG1 Z0.800 F600\n";
    expected += ";BEFORE_LAYER_CHANGE\n;0.6\n;LAYER_CHANGE\n;Z:0.6\n;HEIGHT:0.2\nG92 E0\nM106 S102\n";
    expected += ";TYPE:Top solid infill\n; FEATURE: Top surface\nG1 Z1.000\n";
    expected += x(61) + " Y51.000 F7200\nG1 Z0.600 F600\nG1 E0.80000 F2100\n";
    expected += x(61) + " Y61.000 E? F3000\n" + x(51) + " Y61.000 E?\n" + x(51) + " Y51.000 E?\n";
    expected += x(61) + " Y51.000 E?\nG1 E-0.80000 F2100\n" + x(58) + " Y51.000 F3000\nG1 Z1.000 F600\n";
  }
  expected += "M486 S-1\n;BEFORE_LAYER_CHANGE\n;0.6\n;TYPE:Custom\n; FEATURE: Custom\nG1 Z11.000\n";
  expected += "M572 D0 S0\nM204 P3000 T3000\nM566 X960 Y960\nG92 E0\nM104 S0\nM140 S0\nM84\n";
  const std::string lines = linesOf(job);
  const std::size_t begin = lines.find(";BEFORE_LAYER_CHANGE");
  REQUIRE(begin != std::string::npos);
  CHECK(lines.substr(begin) == filled(expected, 0.95, true));
  CHECK(lines.substr(0, begin).find("\nM82\nG92 E0\n") != std::string::npos);

  job.printer.endGcode.clear();
  job.printer.machineAcceleration = job.printer.machineCornerSpeed = 0;
  job.printer.setPressureAdvance = false;
  const std::string plain = linesOf(job);
  const std::string end = "; FEATURE: Custom\nG1 Z11.000\nG1 X110.000 Y214.500 F7200\nM104 S0\nM140 S0\nM107\nM84\n";
  CHECK(plain.ends_with(end));
  for (const char* none : {"M204", "M566", "M572"}) CHECK(plain.find(none) == std::string::npos);
}
