#include "gcode/blocks.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "base/lines.hpp"
#include "printer/dialect.hpp"
#include "sillon/settings/presets.hpp"
#include "support/gcode_job.hpp"
#include "support/told_reason.hpp"

using namespace sillon;
using namespace sillon::test;
using doctest::Approx;

TEST_CASE("blocks that go down to where a print stands are pointed out") {
  Job job = plate(30, 20, 1.3);
  job.params.startHeight = 5;
  const std::string start = "G28\nM190 S60\nM109 S[first_layer_temperature]\n";
  const auto warned = [&](const std::string& block, const char* part) {
    job.printer.startGcode = start + block;
    const Written written = job.write();
    REQUIRE_MESSAGE(written.result.ok(), written.result.error().message);
    CHECK(written.text.find("M109 S215\n") != std::string::npos);
    CHECK(contains(written.result.value().warnings, "not primed") == (block.find(" E") == std::string::npos));
    return contains(written.result.value().warnings, part);
  };
  const char* low = "startGcode goes down to Z 0.3; what stands there is 5 mm high";
  CHECK(warned("G1 Z9 F600\nG1 X60 F3000\nG1 Z0.3\nG1 X90 E9\nG1 Z9", low));
  CHECK(!warned("G1 Z9 F600\nG1 X60 E9 F3000", "startGcode goes"));
  CHECK(!warned("G1 Z0.3 F600\nG1 Z9\nG1 X60 F3000", "startGcode goes"));         // not along the bed
  CHECK(!warned("G1 X60 Y60 F3000\nG91\nG1 Z1\nG1 X1\nG90", "startGcode goes"));  // how high is not told
  CHECK(warned("G1 Z30 F600\nG1 X110 Y110 F3000\nG1 Z4", "startGcode goes down to Z 4;"));
  CHECK(warned("G1 Z0.3 F600\nG28\nG1 X60 F3000\nG1 X70 Z2", "startGcode goes down to Z 2;"));
  job.printer.endGcode = "M104 S0\nM140 S0\nG1 X0 F3000\nG1 Z5.5\nG1 X5";
  CHECK(warned("", "endGcode goes down to Z 5.5; what stands there is 5.6 mm high"));
  job.printer.endGcode = "M104 S0\nM140 S0\nG91\nG1 Z5 F600\nG90\nG1 X0 F3000";
  CHECK(!warned("", "endGcode goes"));
  job.params.startHeight = 0;
  job.printer.startGcode = start + "G1 Z0.3 F600\nG1 X60 E9 F3000";
  CHECK(job.write().result.value().warnings.empty());
}

TEST_CASE("the flow that a start block sets holds for the whole print, its speed does not; both are pointed out") {
  Job job = plate(30, 20, 1.3);
  const auto warned = [&](const std::string& block) {
    job.printer.startGcode = "G28\nM190 S60\nM109 S[first_layer_temperature]\n" + block;
    const Written written = job.write();
    REQUIRE_MESSAGE(written.result.ok(), written.result.error().message);
    for (const Warning& warning : written.result.value().warnings) {
      if (warning.code == WarningCode::StartScales || warning.code == WarningCode::StartFlow) return warning.message;
    }
    return std::string();
  };
  CHECK(warned("M221 S95").find("95") != std::string::npos);
  CHECK(warned("M221S97.5").find("97.5") != std::string::npos);
  CHECK(warned("M220 S50").find("speed") != std::string::npos);
  CHECK(warned("M221 S100.5 ; a little more").find("100.5") != std::string::npos);
  CHECK(warned("M221 S95\nM221 S100").empty());
  CHECK(warned("M2210 S95").empty());
  CHECK(warned("M221 T0").empty());
  // Set to 100 before the block alone, and back behind the last bead.
  const auto flows = [&](const std::string& block) {
    job.printer.startGcode = "G28\nM190 S60\nM109 S[first_layer_temperature]\n" + block;
    const std::string text = job.write().text;
    std::string all;
    for (std::string_view rest = text; !rest.empty();) {
      const std::string_view line = nextLine(rest);
      if (line.starts_with("M221"))
        all += std::string(line.substr(5)) +
               (text.find("LAYER_CHANGE", text.size() - rest.size()) == std::string::npos ? " at the end" : "") + ", ";
    }
    return all;
  };
  CHECK(flows("M221 S95") == "S100, S95, S100 at the end, ");
  CHECK(flows("M221 S{if layer_height < 0.075}100{else}95{endif}") == "S100, S95, S100 at the end, ");
  CHECK(flows("PRINT_START") == "S100, ");
  // A maker's own block is no news.
  for (const char* id : {"prusa-mk3s", "prusa-mini"}) {
    REQUIRE_FALSE(applyProfile(ProfileKind::Printer, id, job.printer));
    const Written written = job.write();
    CHECK(written.text.find("\nM221 S95\n") != std::string::npos);
    for (const Warning& warning : written.result.value().warnings) CHECK(warning.code != WarningCode::StartFlow);
  }
}

TEST_CASE("a start block that purges where the plate will lie is pointed out") {
  Job job = plate(30, 20, 1.3);
  const auto warned = [&](const std::string& block) {
    job.printer.startGcode = "G28\nM190 S60\nM109 S[first_layer_temperature]\nM83\nG1 Z0.3 F600\n" + block;
    const Written written = job.write();
    REQUIRE_MESSAGE(written.result.ok(), written.result.error().message);
    return contains(written.result.value().warnings, "of the start G-code: lays a bead where the plate will lie");
  };
  // The plate lies about the middle of the bed, from 95 and 100 mm on.
  CHECK(warned("G1 X80 Y110 F3000\nG1 X140 E4 F900"));
  CHECK(warned("G1 X80 Y90 F3000\nG1 X97 Y103 E2 F900"));
  CHECK(!warned("G1 X80 Y90 F3000\nG1 X140 E4 F900"));                         // beside it
  CHECK(!warned("G1 X80 Y110 F3000\nG1 X140\nG1 Y5\nG1 X80 E4 F900"));         // without filament
  CHECK(!warned("G1 X110 Y110 F3000\nG1 E2 F300\nG1 X5 Y5\nG1 X80 E4 F900"));  // a drop, which a cleaner takes off
  CHECK(!warned("G1 Z5\nG1 X80 Y110 F3000\nG1 X140 E4 F900"));                 // above it
  const char* follows = "G1 X{first_layer_print_min[0]} Y{first_layer_print_min[1] - 5} F3000\nG1 X140 E4 F900";
  CHECK(!warned(follows));
}

TEST_CASE("an end block that comes down on the plate is refused, one that homes Z there is pointed out") {
  Job job = plate(30, 20, 1.3);
  const auto end = [&](const std::string& block) {
    job.printer.endGcode = "M104 S0\nM140 S0\n" + block;
    return job.write().result;
  };
  const std::string top = "over the plate, which is 0.6 mm high; it must rise or go aside";
  CHECK(end("G1 Z0.2 F600").error().message == "line 3 of the end G-code: goes down to Z 0.2 " + top);
  CHECK(end("G91\nG1 Z-20 F600").error().message.find("line 4 of the end G-code: goes down to Z -") == 0);
  CHECK(end("G1 X112 Y110 Z0.5 F600").error().message.find(top) != std::string::npos);
  CHECK(end("G1 X1 Y1 F3000\nG1 Z0.2 F600"));             // beside it
  CHECK_FALSE(end("G1 X94.5 Y110 F3000\nG1 Z0.2 F600"));  // its plate begins at 95, and a nozzle is wide
  CHECK(end("G1 Z0.6 F600\nG1 X1 F3000"));                // as high
  const char* homes = "line 3 of the end G-code: homes Z, for which most printers come down on the plate";
  for (const char* block : {"G28", "G28 Z", "g28 z0", "G28 W"}) CHECK(contains(end(block).value().warnings, homes));
  for (const char* block : {"G28 X", "G28 X0 Y0", "G28 XY"}) CHECK(!contains(end(block).value().warnings, homes));
  CHECK(end("G28\nG1 X110 Y110 F3000"));  // how high it stands is not told
  const char* probes = "line 3 of the end G-code: probes the bed, for which printers come down on the plate";
  for (const char* block : {"G29", "G30", "G34", "quad_gantry_level", "BED_MESH_CALIBRATE PROFILE=a"}) {
    CAPTURE(block);
    CHECK(contains(end(block).value().warnings, probes));
  }
  CHECK(!contains(end("M84").value().warnings, probes));
  job.printer.roundBed = true;  // deltas home at their top
  job.printer.bedMin = {-100, -100};
  job.printer.bedMax = {100, 100};
  CHECK(!contains(end("G28").value().warnings, homes));
}

TEST_CASE("a nozzle that is not sure to be hot moves no filament before it is") {
  Job job = plate(30, 20, 1.3);
  const auto firstFilament = [&](const std::string& start) {
    job.printer.startGcode = start;
    const Written written = job.write();
    REQUIRE_MESSAGE(written.result.ok(), written.result.error().message);
    CHECK(checkGcode(written.text, job.printer).errors() == 0);
    return written.text.find("G1 E") < written.text.find("M109 S220");
  };
  CHECK(firstFilament("G28\nM190 S60\nM109 S210"));
  CHECK(firstFilament("START_PRINT BED=60 EXTRUDER=215"));
  CHECK_FALSE(firstFilament("M140 S60\nG28\nM109 S200\nM109 R140\nM104 S215\nM190 S60"));  // levelled cold
  CHECK_FALSE(firstFilament("G28\nM190 S60\nM109 S170"));
}

TEST_CASE("start blocks must home all axes, and give back what G10 has drawn back") {
  Job job = plate(30, 20, 1.3);
  const auto refusal = [&](const std::string& start) {
    job.printer.startGcode = start;
    const Written written = job.write();
    return written.result ? "" : written.result.error().message;
  };
  const std::string heat = "M190 S60\nM109 S215\n";
  CHECK(refusal("G28 X Y\n" + heat) == "printer.startGcode does not home; it must have G28 or a start macro");
  job.params.startHeight = 5;  // Z may be known from the print below
  CHECK(refusal("G28 X Y\n" + heat) == "");
  CHECK(checkGcode(job.write().text, job.printer).errors() == 0);
  CHECK(refusal("G28 X\n" + heat) == "printer.startGcode does not home; it must have G28 or a start macro");
  job.params.startHeight = 0;
  CHECK(refusal("G28 X Y\nG1 Z5 F600\nG1 X50 Y50 F3000\nG28 Z\n" + heat) == "");
  CHECK(refusal("G28\nM84\n" + heat) == "printer.startGcode does not home; it must have G28 or a start macro");
  CHECK(refusal("G28\nM84 E\n" + heat) == "");
  CHECK(refusal("G28\n" + heat + "G10\n") ==
        "printer.startGcode draws filament back by G10; it must give it back by G11");
  CHECK(refusal("G28\n" + heat + "G10\nG11\n") == "");
}

TEST_CASE("a start block that leaves the origin elsewhere is refused: beads would lie in the bed, or in the air") {
  Job job = plate(30, 20, 1.3);
  const auto refusal = [&](const std::string& shift) {
    job.printer.startGcode = "G28\nM190 S60\nM109 S215\n" + shift;
    const Written written = job.write();
    return written.result ? "" : written.result.error().message;
  };
  const auto leaves = [](int line, const char* mm) {
    return "line " + std::to_string(line) + " of the start G-code: G92 leaves the origin of an axis " + mm +
           " mm off; the print would be shifted by that";
  };
  CHECK(refusal("G92 Z5\n") == leaves(4, "-5"));
  CHECK(refusal("G1 Z5 F600\nG92 Z0\n") == leaves(5, "5"));
  CHECK(refusal("G1 X50 F3000\nG92 X0\n") == leaves(5, "50"));
  CHECK(refusal("G1 Z0.3 F600\nG92 Z0\nG92 E0\n") == "");         // as a first layer is put right
  CHECK(refusal("G92 X-110 Y-110\n") == "");                      // tells where the switches are
  CHECK(refusal("G1 X50 Y9 F3000\nG92 X0 Y0\nG28 X Y\n") == "");  // and homes anew
  CHECK(refusal("G1 Z5 F600\nG92 Z0\nG1 Z-2\nG92 Z3\n") == "");   // and puts it back
  // Behind the print nothing is laid any more.
  job.printer.startGcode.clear();
  job.printer.endGcode = "M104 S0\nM140 S0\nG92 Z0\nG1 Z5 F600\n";
  CHECK(job.write().result);
  job.printer.endGcode.clear();
  job.printer.roundBed = true;  // deltas home at their top, whose height they are told
  job.printer.bedMin = {-100, -100};
  job.printer.bedMax = {100, 100};
  CHECK(refusal("G92 Z250\n") == "");
}

TEST_CASE("what the start block heats beside the printing nozzle is switched off at the end") {
  Job job = plate(30, 20, 1.3);
  job.printer.startGcode = "G28\nM190 S60\nM141 S45\nM104 T2 S150\nM109 S215\n";
  const Written own = job.write();
  REQUIRE(own.result);
  CHECK(own.text.find("\nM104 S0\nM104 T2 S0\nM140 S0\nM141 S0\n") != std::string::npos);
  for (const GcodeFinding& finding : checkGcode(own.text, job.printer).findings) CHECK(finding.rule != "end");
  const auto warns = [&](const std::string& end) {
    job.printer.endGcode = end;
    return contains(job.write().result.value().warnings, "leaves a heater on");
  };
  CHECK(warns("M104 S0\nM140 S0\nM141 S0\n"));
  CHECK(warns("M104 S0\nM104 T2 S0\nM140 S0\n"));
  CHECK_FALSE(warns("M104 S0\nM104 T2 S0\nM140 S0\nM141 S0\n"));
}

TEST_CASE("a start block begins in the modes of a printer that was just switched on") {
  Job job = plate(30, 20, 1.3);
  job.printer.startGcode = "G28\nM190 S60\nM109 S215\n";
  const std::string text = job.write().text;
  CHECK(text.find("; FEATURE: Custom\nG21\nG90\nM82\nM221 S100\nG28\n") != std::string::npos);
}

TEST_CASE("what a block's lines are indented by stays, as RepRapFirmware reads it") {
  const auto expand = [](std::string_view text) { return expandTemplate(text, {}, "startGcode").value(); };
  CHECK(expand("if true\n  G28 X\n\tM84 ; x\n   \nG28\n") == "if true\n  G28 X\n M84 ; x\n\nG28\n");
}

TEST_CASE("macros and firmwares home and heat in words of their own") {
  Job job = plate(30, 20, 1.3);
  const auto refusal = [&](const std::string& start, GcodeFlavor flavor = GcodeFlavor::Klipper) {
    job.printer.flavor = flavor;
    job.printer.startGcode = start;
    const Written written = job.write();
    return written.result ? "" : written.result.error().message;
  };
  const std::string heat = "M190 S60\nM109 S215\n";
  const std::string homeless = "printer.startGcode does not home; it must have G28 or a start macro";
  for (const char* homes : {"CG28\n", "HOME_ALL\n", "_HOME_IF_NEEDED\n", "BEGIN_PRINT BED=60\n", "G32\n",
                            "G9111 bedTemp=60 extruderTemp=215\n", "HOME_X\nHOME_YZ\n"}) {
    CAPTURE(homes);
    CHECK(refusal(homes + heat) == "");
  }
  for (const char* other : {"MMU_HOME\n", "HOME_X\n", "SET_HEATER_TEMPERATURE HEATER=extruder TARGET=215\n"}) {
    CAPTURE(other);
    CHECK(refusal(other + heat) == homeless);
  }
  CHECK(refusal("G32\n" + heat, GcodeFlavor::RepRap) == "");
  CHECK(refusal("M98 P\"homeall.g\"\n" + heat, GcodeFlavor::RepRap) == "");
  CHECK(refusal("G32\n" + heat, GcodeFlavor::Marlin) == homeless);
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
  CHECK(expand("G1 X{min[0]} Y[min[1]] Z{ min }\r\n\n\tM117 \xc3\xa9  ") == "G1 X1.5 Y2.5 Z1.5\n\n M117 ??\n");
  CHECK(expand("M84 \xc3\xa9 ") == "M84 \xc3\xa9\n");  // to be refused as it was written
  CHECK(expand("PRINT_START BED=60 NAME='x'") == "PRINT_START BED=60 NAME='x'\n");
  CHECK(expand("") == "");
  CHECK(expand("\n\n") == "");
  for (const char* bad : {"{other}", "[temp", "{min[x]}", "<>", "{}", "[[[", "{temp+other}"}) {
    CAPTURE(bad);
    const std::string out = expand(std::string("G28\n") + bad);
    CHECK(out.find("error: startGcode has \"") == 0);
    CHECK(out.find("in line 2, which stands for no value here") != std::string::npos);
  }
}

TEST_CASE("the user's blocks replace ours, and modes and temperatures are restated after them") {
  Job job = plate();
  job.printer.startGcode =
      "G28\nM190 S{first_layer_bed_temperature}\nM109 S[nozzle_temperature_initial_layer]\nG20\nM82";
  job.printer.endGcode = "M104 S0\nM140 S0 ; bye\nG1 X0 Y200";
  const std::string text = job.write().text;
  CHECK(text.find("\n; FEATURE: Custom\nG21\nG90\nM82\nM221 S100\nG28\nM190 S60\nM109 "
                  "S220\nG20\nM82\nG21\nG90\nM83\nG92 E0\n") != std::string::npos);
  CHECK(text.find("\nM104 S0\nM140 S0 ; bye\nG1 X0 Y200\nM73 P100 R0\n") != std::string::npos);
  CHECK(text.find("M84") == std::string::npos);
  const auto refusal = [&](const char* start) {
    Job bad = job;
    bad.printer.startGcode = start;
    const Written written = bad.write();
    CHECK(written.text.empty());
    return written.result ? "" : written.result.error().message;
  };
  CHECK(refusal("G28\\nM190 S60\\nM109 S220") ==
        "printer.startGcode has line breaks written as \\n; each command must be on a line of its own");
  Job message = job;
  message.printer.startGcode = "G28\nM190 S60\nM109 S220\nM117 a\\nb";
  CHECK(message.write().result);
  CHECK(refusal("M190 S60\nM109 S220") == "printer.startGcode does not home; it must have G28 or a start macro");
  CHECK(refusal("G28\nM190 S60\nM109 S220\nG1 X300 F3000")
            .find("line 4 of the start G-code: a move over the bed's edge") == 0);
  CHECK(refusal("G1 X10 F3000\nG28\nM190 S60\nM109 S220").find("line 1 of the start G-code: moves before it homes") ==
        0);
  CHECK(refusal("G28\nG1 X10 E5 F600").find("line 2 of the start G-code: extrudes before it has waited") == 0);
  Job far = job;
  far.printer.startGcode = "G28\nM190 S60\nM109 S220\nG1 X300 F3000";
  CHECK(toldReason(far.write().result.error()).find("StartLine line=4 what=a move over the bed's edge") == 0);
  const auto endRefusal = [&](const char* end) {
    Job bad = job;
    bad.printer.endGcode = end;
    const Written written = bad.write();
    CHECK(written.text.empty());
    return written.result ? "" : written.result.error().message;
  };
  CHECK(endRefusal("M104 S0\nG1 X300 F3000").find("line 2 of the end G-code: a move over the bed's edge at (300, ") ==
        0);
  CHECK(endRefusal("G1 X1,5").find("line 1 of the end G-code: no plain number: \"X1,5\"") == 0);
  Job own = job;
  own.printer.endGcode = "G91\nG1 E-2 X5 Y-5 F3000\nG1 Z5\nG90\nG1 X0\nM500";
  const std::vector<Warning> warnings = own.write().result.value().warnings;
  CHECK(contains(warnings, "line 6 of the end G-code: M500 outlives the print"));
  CHECK(contains(warnings, "the end G-code leaves a heater on"));
  CHECK(warnings.size() == 2);
  own.printer.endGcode = "PRINT_END";
  CHECK(own.write().result.value().warnings.empty());
  own.printer.startGcode = "G28\nM190 S60\nM109 S220\nG92 X10\nM500";
  CHECK(contains(own.write().result.value().warnings, "line 4 of the start G-code: G92 moves the origin"));
  CHECK(contains(own.write().result.value().warnings, "line 5 of the start G-code: M500 outlives the print"));
  Job wipe = job;
  wipe.printer.startGcode = "G28\nM190 S60\nM109 S220\nG1 Z5 F600\nG1 Y-3 F3000";
  CHECK_FALSE(contains(wipe.write().result.value().warnings, "line 5 of startGcode"));  // 10 mm are for makers
  wipe.printer.startGcode = "PRINT_START BED=60 HOTEND=180";
  const Written macro = wipe.write();
  REQUIRE(macro.result.ok());
  CHECK(macro.text.find("PRINT_START BED=60 HOTEND=180\n") < macro.text.find("\nM190 S60\nM109 S220\n"));
  job.printer.endGcode = "M104 S{oops}";
  const Written refused = job.write();
  CHECK(refused.result.error().message.find("printer.endGcode has \"{oops}\" in line 1") == 0);
  CHECK(refused.text.empty());
  job.printer.endGcode = "; generated by PrusaSlicer";
  CHECK(job.write().result.error().message.find("printer.endGcode must not contain \"generated by\"") == 0);
}

namespace {

// What a person at the printer would see between homing and the first layer. Reads the text by itself.
struct Start {
  double purged = 0;           // [mm of filament], laid along the bed
  double drawnBack = 0;        // at the first layer [mm]
  double lowestTravel = 1e9;   // Z of ways along the bed longer than the wipe [mm]
  double lowestWait = 1e9;     // Z while the job's own temperatures are waited for
  Bounds purgeBox;             // of its beads' middles
  double firstBeadTravel = 0;  // Z of the way to the first layer's first bead
  bool lowersAbove = true;     // goes below 10 mm only where the next bead begins
  std::vector<std::string> order;
};

Start startOf(const std::string& text, const std::string& block) {
  Start start;
  double x = 0, y = 0, z = 0;
  bool low = false;
  Vec2 lowAt;
  const std::size_t after = text.find(block) + block.size();
  const std::size_t first = text.find(";LAYER_CHANGE");
  std::size_t at = after;
  while (at < text.size()) {
    const std::size_t end = text.find('\n', at);
    const std::string line = text.substr(at, end - at);
    const bool begun = at > first;
    at = end + 1;
    if (line.starts_with("M190") || line.starts_with("M109")) {
      start.order.push_back(line);
      start.lowestWait = std::min(start.lowestWait, z);
    }
    if (line.starts_with("M22")) start.order.push_back(line);
    if (!line.starts_with("G1 ")) continue;
    double nx = x, ny = y, nz = z, de = 0;
    for (const std::string_view word : split(line, ' ')) {
      const double value = std::strtod(std::string(word.substr(1)).c_str(), nullptr);
      if (word[0] == 'X') nx = value;
      if (word[0] == 'Y') ny = value;
      if (word[0] == 'Z') nz = value;
      if (word[0] == 'E') de = value;
    }
    const double way = std::hypot(nx - x, ny - y);
    if (nz < 10 && z >= 10) low = true, lowAt = {nx, ny};
    if (way > 0 && de > 0) {
      if (low && length(lowAt - Vec2{x, y}) > 1e-9) start.lowersAbove = false;
      low = false;
      if (begun) return start;
      start.purged += de;
      start.purgeBox.add({x, y});
      start.purgeBox.add({nx, ny});
    } else if (way > 3.1) {
      start.lowestTravel = std::min(start.lowestTravel, z);
      if (begun) start.firstBeadTravel = z;
    }
    if (!begun && way == 0) start.drawnBack -= de;
    x = nx, y = ny, z = nz;
  }
  return start;
}

}  // namespace

TEST_CASE("every start waits for heat above and aside, fills the nozzle off the plate, and comes down on its target") {
  const std::string donor = "G28\nM190 S55\nM109 S240\nG1 Z0.3 F600\nG1 X90 E12.5 F1000\nM221 S95\n";
  for (const GcodeFlavor flavor :
       {GcodeFlavor::Marlin, GcodeFlavor::Klipper, GcodeFlavor::RepRap, GcodeFlavor::PrusaBuddy, GcodeFlavor::Bambu}) {
    for (const std::string& block : {std::string(), std::string("G28\n"), std::string("PRINT_START\n"), donor}) {
      if (flavor == GcodeFlavor::Bambu && block.empty()) continue;
      CAPTURE(dialectName(flavor));
      CAPTURE(block);
      Job job = plate();
      job.params.skirt = 0;
      job.params.place = Vec2{60, 70};
      job.printer.flavor = flavor;
      job.printer.startGcode = block;
      job.printer.retractLength = 5;
      const Written written = job.write();
      REQUIRE_MESSAGE(written.result.ok(), written.result.error().message);
      const Start start = startOf(written.text, block.empty() ? std::string("\nG28\n") : block);
      CHECK(start.lowestWait >= 10);
      CHECK(start.lowestTravel >= 10);
      CHECK(start.firstBeadTravel >= 10);
      CHECK(start.lowersAbove);
      CHECK(start.order == std::vector<std::string>{"M220 S100", "M190 S60", "M109 S220"});
      CHECK(start.drawnBack == Approx(5));
      const bool own = block != donor && flavor != GcodeFlavor::Bambu;
      if (own) {
        CHECK(start.purged >= 15);
        CHECK(start.purged < 18);
        CHECK((start.purgeBox.max.x < 58 || start.purgeBox.max.y < 68));
        CHECK(start.purgeBox.min.x >= 0);
        CHECK(start.purgeBox.min.y >= 0);
      } else {
        CHECK(start.purged == 0);
      }
      CHECK(contains(written.result.value().warnings, "the start G-code sets the flow to 95 %") == (block == donor));
    }
  }
}
