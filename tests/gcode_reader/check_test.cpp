#include "sillon/gcode_reader/check.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "base/fast_math.hpp"
#include "gcode_reader/coverage.hpp"
#include "gcode_reader/parser.hpp"
#include "support/about.hpp"
#include "support/damaged.hpp"

using namespace sillon;
using doctest::Approx;

namespace {

constexpr double kArea = 2.4052818754046854;  // of filament of 1.75 mm [mm²]

const std::string kStart = "M140 S60\nG28\nM190 S60\nM109 S215\nG21\nG90\nM83\nG92 E0\nG1 Z0.2 F600\n";
const std::string kSquare =
    ";LAYER_CHANGE\n;TYPE:Top solid infill\nG1 X50 Y50 F6000\nG1 X60 E0.33260 F1800\nG1 Y60 E0.33260\nG1 X50 E0.33260\n"
    "G1 Y50 E0.33260\n";
const std::string kEnd = ";TYPE:Custom\nG1 E-0.8 F2100\nG1 Z10 F600\nM104 S0\nM140 S0\n";

/// The finding of a rule; one without a rule if there is none.
GcodeFinding finding(const GcodeCheck& check, const std::string& rule) {
  for (const GcodeFinding& found : check.findings) {
    if (found.rule == rule) return found;
  }
  return {};
}

std::string rules(const GcodeCheck& check) {
  std::string all;
  for (const GcodeFinding& found : check.findings) all += (found.error ? "!" : "") + found.rule + " ";
  return all;
}

}  // namespace

TEST_CASE("the grammar takes plain commands and refuses what kills prints") {
  for (const char* good :
       {"G1 X1.000 Y-2.500 E0.00001 F3000", ";note", "M104 S0", "", "G28", "M84 X Y", "T0", "G29.1",
        "SET_PRESSURE_ADVANCE ADVANCE=0.0400", "EXCLUDE_OBJECT_START NAME=PLATE_1", "G1 X1 ;aside"}) {
    CAPTURE(good);
    CHECK(lineFault(good) == nullptr);
  }
  for (const char* bad :
       {"G1 E1.2e-05", "G1X50Y50",  "g1 X5",   "G1 Xnan", "G1 X-0.000", "G1 X1 X2",   "G1 X+1",  "G1 X1,5",
        "G1  X1",      "G1 X1 ",    "G1 X.5",  "G1 X5.",  "G1 X05",     "M117 hello", "G1 X1\r", "set_x A=1",
        " G1",         "SET_X A=b", "SET_X A", "G",       "\xc3\xa9",   "; \t"}) {
    CAPTURE(bad);
    CHECK(lineFault(bad) != nullptr);
  }
  CHECK(lineFault("M117 " + std::string(91, '1')) != nullptr);
}

TEST_CASE("a plain move read in one go is what the grammar takes and the words say") {
  const auto agrees = [](const std::string& line) {
    GcodeWords fast;
    if (!readPlainMove(line, fast)) return false;
    CAPTURE(line);
    CHECK(lineFault(line) == nullptr);
    const GcodeCommand command = commandOf(line);
    CHECK((command.is('G', 0) || command.is('G', 1)));
    const GcodeWords words = wordsOf(command.rest);
    CHECK(words.fault == GcodeWords::None);
    CHECK_FALSE((words.lower || words.crowded || words.unusual));
    CHECK(words.named == fast.named);
    CHECK(words.given == fast.given);
    CHECK(words.values == fast.values);  // to the last bit
    return true;
  };
  for (const char* plain : {"G1 X1", "G0 X12.345 Y-0.5", "G1 X0 Y-0.001 E123456789.012345 F1800", "G1 E-0.80000 F2100",
                            "G1 X0.1 Y0.7 Z999999999 E0.30000000000001"}) {
    CAPTURE(plain);
    CHECK(agrees(plain));
  }
  for (const char* other : {"G1",       "G1 ",    "G1 X",    "G1 X1 ",         "G1  X1",
                            "G1 X1 X2", "G1 X01", "G1 X1.",  "G1 X.5",         "G1 X-0",
                            "G1 X-",    "G1 x1",  "G1X1",    "G1 X1Y2",        "G2 X1",
                            "G1.1 X1",  "G11 X1", "G1 X1;",  "G1 M1",          "G1 X1 G1",
                            "G1 X1e5",  "G1 X+1", "G1 X1\r", "G1 X1234567890", "G1 X0.3000000000000001",
                            ";G1 X1",   ""}) {
    CAPTURE(other);
    CHECK_FALSE(agrees(other));
  }
  CHECK_FALSE(agrees("G1 X1" + std::string(91, ' ') + "Y1"));
  // Moves with a few characters changed for others that mean something.
  std::uint64_t seed = 1;
  const auto below = [&](std::size_t count) { return static_cast<std::size_t>((seed = hash64(seed)) >> 11) % count; };
  const std::string alphabet = "0123456789.- GXYEFM;";
  int plain = 0;
  for (int k = 0; k < 20000; ++k) {
    std::string line = "G1 X" + std::to_string(below(200000)) + ".305 Y-" + std::to_string(below(300)) + " E0.01";
    for (std::size_t changes = below(3); changes > 0; --changes)
      line[below(line.size())] = alphabet[below(alphabet.size())];
    plain += agrees(line) ? 1 : 0;
  }
  CHECK(plain > 5000);
  CHECK(plain < 19000);
}

TEST_CASE("a clean file has no findings, and its facts are right") {
  const GcodeCheck check = checkGcode(kStart + kSquare + kEnd);
  CHECK(rules(check) == "");
  CHECK(check.lines == 21);
  CHECK(check.moves == 8);
  CHECK(check.layers == 1);
  CHECK(check.filamentMm == Approx(1.3304));
  CHECK(check.pathMm == Approx(40));
  CHECK(check.slowedMm == 0);
  CHECK(check.closed == 1);
  CHECK(check.open == 0);
  CHECK(check.retractions == 1);
  CHECK((check.box.min == Vec2{50, 50} && check.box.max == Vec2{60, 60}));
  CHECK(check.top == 0.2);
  CHECK(check.fastest == Approx(30));
  CHECK(check.mostFlow == about(0.2 * 0.4 * 30, 1e-3));
  CHECK((check.homes && check.heatsBed && check.heatsNozzle));
}

TEST_CASE("the slowed length is that below the fastest oriented bead of each layer") {
  const std::string slow =
      ";LAYER_CHANGE\n;TYPE:Top solid infill\nG1 X50 Y50 F6000\nG1 X60 E0.33260 F1200\nG1 Y60 E0.33260 F1800\n"
      "G1 X50 E0.33260 F1740\nG1 Y50 E0.33260 F1800\n";
  CHECK(checkGcode(kStart + slow + kEnd).slowedMm == Approx(20));
  CHECK(checkGcode(kStart + slow + kSquare + kEnd).slowedMm == Approx(20));
  CHECK(checkGcode(kStart + slow + ";TYPE:Solid infill\nG1 X60 E0.33260 F300\n" + kEnd).slowedMm == Approx(20));
}

TEST_CASE("coverage is the share of the base that an oriented layer fills") {
  std::vector<LaidBead> beads;
  const auto lines = [&](int count, float width, bool base, int layer, float top, float x = 0) {
    for (int k = 0; k < count; ++k) {
      const float y = (static_cast<float>(k) + 0.5F) * 0.4F;
      beads.push_back({{x, y}, {x + 10, y}, width, base, layer, top});
    }
  };
  CHECK(orientedCoverage(beads).empty());
  lines(25, 0.4F, true, 1, 0.2F);
  CHECK(orientedCoverage(beads).empty());
  lines(25, 0.4F, false, 2, 0.4F);
  lines(12, 0.4F, false, 3, 0.6F);
  lines(25, 0.2F, false, 4, 0.8F);
  std::vector<double> shares = orientedCoverage(beads);
  REQUIRE(shares.size() == 3);
  CHECK(shares[0] == 1);
  CHECK(shares[1] == about(0.48, 0.01));
  CHECK(shares[2] == about(0.5, 0.03));
  // A second plate is a stack of its own; a third has no base.
  lines(25, 0.4F, true, 5, 0.2F, 50);
  lines(20, 0.4F, false, 6, 0.4F, 50);
  lines(20, 0.4F, false, 7, 0.2F, 80);
  shares = orientedCoverage(beads);
  REQUIRE(shares.size() == 5);
  CHECK(shares[3] == about(0.8, 0.01));
  CHECK(shares[4] == -1);
  // A bead that comes from far away and goes on, further than an int counts cells, covers what it passes.
  beads.clear();
  lines(25, 0.4F, true, 1, 0.2F);
  beads.push_back({{-1e9F, 5}, {1e9F, 5}, 2, false, 2, 0.4F});
  shares = orientedCoverage(beads);
  REQUIRE(shares.size() == 1);
  CHECK(shares[0] == about(0.2, 0.03));
  // A bead from corner to corner of the 10 mm covers what lies within a millimetre of the diagonal.
  beads.pop_back();
  beads.push_back({{0, 0}, {10, 10}, 2, false, 2, 0.4F});
  const double corner = 10 - std::sqrt(2.0);  // side of the triangles beside it
  CHECK(orientedCoverage(beads)[0] == about(1 - corner * corner / 100, 0.03));
  // Hostile files: wide beads over and over, far apart and in many stacks, end soon.
  beads.clear();
  for (int k = 0; k < 20000; ++k) {
    const auto layer = 2 * k;
    beads.push_back({{0, 0}, {150, 150}, 10, true, layer, 0.2F});
    beads.push_back({{0, 0}, {150, 150}, 10, false, layer + 1, 0.4F});
  }
  shares = orientedCoverage(beads);
  REQUIRE(shares.size() == 20000);
  CHECK(shares.front() == 1);
  CHECK(shares.back() == -1);
  // Slanted beads are drawn as upright ones are.
  beads.clear();
  beads.push_back({{0, 0}, {30, 40}, 2, true, 1, 0.2F});
  beads.push_back({{0, 0}, {30, 40}, 1, false, 2, 0.4F});
  const double area = (50 + 0.785398) / (100 + 3.14159);
  CHECK(orientedCoverage(beads)[0] == about(area, 0.01));
}

TEST_CASE("relative moves, absolute E, inches, arcs and set origins are followed") {
  // The same square by small steps of another kind.
  std::string relative = kStart +
                         ";LAYER_CHANGE\nG1 X50 Y50 F6000\nG91\nM83\nG1 X10 E0.3326 F1800\nG1 Y10 E0.3326\nG1 X-10 "
                         "E0.3326\nG1 Y-10 E0.3326\nG90\nM83\n" +
                         kEnd;
  CHECK(checkGcode(relative).filamentMm == Approx(1.3304));
  CHECK(checkGcode(relative).closed == 1);
  const std::string absolute =
      kStart + "M82\nG92 E5\n;LAYER_CHANGE\nG1 X50 Y50 F6000\nG1 X60 E5.3326 F1800\nG1 Y60 E5.6652\n" + "M83\n" + kEnd;
  CHECK(checkGcode(absolute).filamentMm == Approx(0.6652));
  // A full circle of radius 10.
  const std::string circle = kStart + ";LAYER_CHANGE\nG1 X50 Y50 F6000\nG2 X50 Y50 I10 J0 E2.0897 F1800\n" + kEnd;
  CHECK(checkGcode(circle).pathMm == Approx(62.83185).epsilon(1e-6));
  Printer printer;
  printer.bedMax = {65, 100};  // the circle reaches x 70
  CHECK(finding(checkGcode(circle, printer), "bounds").message.find("an arc over the bed's edge") == 0);
  const GcodeCheck inches = checkGcode(kStart + ";LAYER_CHANGE\nG20\nG1 X1 Y1 F100\nG1 X2 E0.01\nG21\n" + kEnd);
  CHECK(inches.pathMm == Approx(25.4));
  CHECK(inches.filamentMm == Approx(0.254));
  CHECK(finding(inches, "modes").error);
}

TEST_CASE("each fault is found by its rule, in its line") {
  struct Fault {
    const char* rule;
    bool error;
    std::string text;
    const char* message;
  };
  const std::string cold = "G28\nG21\nG90\nM83\nG1 Z0.2 F600\n";
  const std::string unhomed = "M190 S60\nM109 S215\nG90\nM83\nG1 Z0.2 F600\n";
  const auto with = [](const std::string& line) { return kStart + kSquare + line + "\n" + kEnd; };
  const Fault faults[] = {
      {"homing", true, unhomed + kSquare + kEnd, "moves before it homes"},
      {"heating", true, cold + kSquare + kEnd, "extrudes before it has waited for a hot nozzle"},
      {"heating", true, with("M104 S0\nG1 X51 E0.03326"), "extrudes with the nozzle at 0 degrees"},
      {"heating", true, with("M104 S310"), "hotter than 300 degrees: 310"},
      {"grammar", true, with("G1 X51 E1.2e-05"), "no plain number: \"E1.2e-05\""},
      {"grammar", true, with("G1 X51 E1.2E-05"), "no plain number: \"E1.2E-05\""},
      {"grammar", true, with("G1 X51,5 E0.01"), "no plain number: \"X51,5\""},
      {"grammar", true, with("G1 Xnan"), "no number after a letter"},
      {"grammar", true, with("G1 X51 X52 E0.03"), "a letter given twice"},
      {"grammar", true, with("G1 (51)"), "not a word: \"(51)\""},
      {"grammar", false, with("%"), "no command: \"%\""},
      {"grammar", false, with("G1X51Y50E0.03326"), "words without spaces"},
      {"grammar", false, with("g1 x51 E0.03326"), "lower case letters"},
      {"grammar", false, with("N5 G1 X51 E0.03326*57"), "line numbers"},
      {"grammar", false, with("M105\r"), "lines end with CR LF"},
      {"modes", true, with("M200 D1.75"), "volumetric extrusion"},
      {"modes", true, with("G92 X0"), "G92 moves the origin"},
      {"bounds", true, with("G1 E-0.8 F2100\nG1 X230 F6000"), "a move over the bed's edge at (230, 50), 10 mm"},
      {"bounds", true, with("G1 X-0.1 Y50 E1 F600"), "a bead over the bed's edge"},
      {"height", true, with("G1 E-0.8 F2100\nG1 Z201 F600"), "above the printer's height: 201 mm"},
      {"height", true, with("G1 Z0\nG1 X51 E0.03326 F600"), "a bead at or below the bed"},
      {"extrusion", true, with("G1 X50.1 E1 F600"), "more plastic per mm than 4 nozzle diameters squared"},
      {"extrusion", true, with("G1 E51"), "more than 50 mm of filament in one move"},
      {"flow", true, with("G1 X60 E0.33260 F12000"), "more flow than printer.maxFlow: 16 mm3/s"},
      {"speed", true, with("G1 X51 F0"), "F is not above 0"},
      {"rate", false,
       with("G1 X50.01 E0.0003\nG1 X50.02 E0.0003\nG1 X50.03 E0.0003\nG1 X50.04 E0.0003\n"
            "G1 X50.05 E0.0003\nG1 X50.06 E0.0003\nG1 X50.07 E0.0003\nG1 X50.08 E0.0003"),
       "more moves per second than the printer takes: 3000"},
      {"retraction", false, with("G1 X90 F6000"), "travels without retraction over 40 mm"},
      {"retraction", true, with("G1 E-0.8 F2100\nG1 X51 E0.03326 F1800"), "extrudes while retracted by 0.8 mm"},
      {"settings", false, with("M500"), "M500 outlives the print"},
      {"settings", false, with("M555 P2"), "M555 outlives the print"},  // RepRapFirmware: whom it pretends to be
      {"end", false, kStart + kSquare + "M400\n", "the nozzle stays hot at the end"},
      {"end", true, kStart + kSquare, "the file ends in the middle of its moves, with a hot nozzle"},
      {"height", true, with("G1 Z20.4\nG1 X55 E0.3"),
       "a bead in the air: Z 20.4, and nothing printed is higher than 0.2"},
      {"height", true, with("G28\nG1 X50 Y50 Z0.4"), "\"G28\" after the first layer: most printers come down on the"},
      {"height", true, with("G29"), "\"G29\" after the first layer"},
      {"commands", true, with("SET_GCODE_OFFSET Z_ADJUST=-0.3\nSET_GCODE_OFFSET Z_ADJUST=-0.3"),
       "offsets move Z by -0.6 mm in all; it must be -0.5 to 10"},
      {"commands", true, with("M206 X200"), "offsets move X by 200 mm in all; it must be -10 to 10"},
      {"commands", true, with("M204 S0"), "M204 S is 0; it must be 10 to 200000"},
      {"commands", true, with("M221 S1"), "M221 S is 1; it must be 20 to 200"},
      {"commands", true, with("SET_PRESSURE_ADVANCE ADVANCE=10"),
       "SET_PRESSURE_ADVANCE ADVANCE is 10; it must be -2.5 to 2.5"},
      {"extrusion", true, with("G1 E4\nG1 E4"), "pushes 8 mm of filament without moving"},
      {"grammar", true, with("G2 X70 Y70 I1 J1 E0.1"),
       "an arc without a centre, or whose circle does not reach its end"},
      {"totals", false, with("; filament used [mm] = 5.00"), "the file states 5 mm of filament; its moves take 1.33"},
      {"totals", false, with("; total layers count = 3"), "the file states 3 layers; 1 are marked"},
      {"extrusion", true, "G28\n", "the file has no move"},
  };
  Printer printer;
  printer.flavor = GcodeFlavor::Klipper;
  for (const Fault& fault : faults) {
    CAPTURE(std::string(fault.message));
    const GcodeCheck check = checkGcode(fault.text, printer);
    CAPTURE(rules(check));
    const auto match = std::find_if(check.findings.begin(), check.findings.end(), [&](const GcodeFinding& found) {
      return found.rule == fault.rule && found.error == fault.error && found.message.find(fault.message) == 0;
    });
    CHECK(match != check.findings.end());
  }
  const std::string longer = with("M117 " + std::string(95, 'x'));
  CHECK(rules(checkGcode(longer, printer)) == "");  // Klipper reads lines of any length
  CHECK(finding(checkGcode(longer), "grammar").code == "long-command");
  CHECK(finding(checkGcode(with("M104 S140 A")), "grammar").code == "no-number");
  CHECK(!finding(checkGcode(with("M104 S140 A")), "grammar").error);
  CHECK(finding(checkGcode(with("G1 X51 E1.2e-05")), "grammar").line == 17);
  CHECK(finding(checkGcode(with("M500\nM500\nM500")), "settings").count == 3);
}

TEST_CASE("what other slicers mean is no finding: short gaps, and travels inside a part where they retract elsewhere") {
  const std::string gap = "G1 X50.5\nG1 X60 E0.3\n";
  const std::string far = "G1 X90 F6000\n";
  const std::string retracts = "G1 E-0.8 F2100\nG1 X50 F6000\nG1 E0.8 F2100\nG1 X60 E0.33260 F1800\n";
  const std::string ours = "; generated by Sillon 0\n";
  CHECK(rules(checkGcode(kStart + kSquare + gap + kEnd)) == "");
  CHECK(rules(checkGcode(kStart + kSquare + retracts + far + kEnd)) == "");
  CHECK(rules(checkGcode(kStart + kSquare + far + kEnd)) == "retraction ");
  CHECK(rules(checkGcode(ours + kStart + kSquare + retracts + far + kEnd)).find("!retraction") != std::string::npos);
}

TEST_CASE("a nozzle that comes down on what is printed is noticed, above the bed and in end blocks") {
  const auto height = [](const std::string& more) { return finding(checkGcode(kStart + kSquare + more), "height"); };
  const std::string second = ";LAYER_CHANGE\nG1 Z0.4 F600\n";
  const std::string line = "G1 X50 Y50 F6000\nG1 X60 E0.3326 F1800\n";
  CHECK(height(second + line + kEnd).code.empty());
  CHECK(height(";LAYER_CHANGE\nG1 Z0.04 F600\n" + line + kEnd).message ==
        "moves 0.16 mm below the top of what is printed there");
  // Lower beside it, as one object after the other is printed.
  CHECK(height(second + line + ";LAYER_CHANGE\nG1 Z5\nG1 X90 Y90\nG1 Z0.2\nG1 X95 E0.16\n" + kEnd).code.empty());
  CHECK(height(second + line + ";LAYER_CHANGE\nG1 X90 Y90 Z5\nG1 Z0.2\nG1 X70\nG1 X50 Y40 E1\n" + kEnd).code ==
        "in-print");
  // On an arc whose ends lie beside it, and slowly down.
  CHECK(height("G1 Z5\nG1 X40 Y45\nG1 Z0.02\nG3 X70 Y45 I15 J0\n" + kEnd).code.empty());
  CHECK(height("G1 Z5\nG1 X40 Y45\nG1 Z0.02\nG2 X70 Y45 I15 J0\n" + kEnd).code == "in-print");
  CHECK(height("G1 X40 Y50\nG1 X62 Z0.02\n" + kEnd).code == "in-print");
  const std::string end = ";TYPE:Custom\nM104 S0\nM140 S0\nG1 E-1 F2100\n";
  CHECK(height(end + "G1 Z10\nG1 X0 Y200\n").code.empty());
  CHECK(height(end + "G1 X90 Y50\nG1 Z0.05\nG1 X0\n").code == "in-print");
  CHECK(height(end + "G28 X Y\n").code.empty());
  CHECK_FALSE(height(end + "G28\n").error);
  CHECK(height(end + "G28\n").code == "homes-on-print");
  std::string round = "; bed_shape = ";
  for (int k = 0; k < 24; ++k) round += "100x1.2e-14,100x200,0x100,200x100" + std::string(k < 23 ? "," : "\n");
  CHECK(rules(checkGcode(kStart + kSquare + end + "G28\n" + round)) == "");
  CHECK(finding(checkGcode(kStart + kSquare + "G1 X201 E1\n" + kEnd + round), "bounds").error);
  Printer delta;
  delta.roundBed = true;
  delta.bedMin = {-100, -100};
  CHECK(finding(checkGcode(kStart + kSquare + end + "G28\n", delta), "height").code.empty());
}

TEST_CASE("beads of ours lie where their layer is told to be") {
  const std::string ours = "; generated by Sillon 0\n";
  std::string square = kSquare;
  square.insert(square.find('\n') + 1, ";Z:0.2\n");
  CHECK(rules(checkGcode(ours + kStart + square + kEnd)) == "");
  std::string lifted = square;  // a line that goes down is lost
  lifted.insert(lifted.find("G1 X60"), "G1 Z0.6 F600\n");
  CHECK(finding(checkGcode(ours + kStart + lifted + kEnd), "height").message ==
        "a bead at Z 0.6 in a layer that ends at 0.2");
  CHECK(rules(checkGcode(ours + kStart + lifted + kEnd + "; z_offset = 0.4\n")) == "");
}

TEST_CASE("Flashforge's printers home and heat before the file begins") {
  const std::string start = "M140 S60\nM104 S215\nG21\nG90\nM83\nG92 E0\nG1 Z0.2 F600\n";
  CHECK(checkGcode(start + kSquare + kEnd).errors() > 0);
  for (const char* head : {"; printer_model = Flashforge Adventurer 5M\n", "; printer_model = FlashForge AD5X\n",
                           ";generated by FlashPrint-MH 5.8.3\n"}) {
    CAPTURE(head);
    CHECK(checkGcode(head + start + kSquare + kEnd).errors() == 0);
  }
}

TEST_CASE("Bambu's machines wipe beside the bed between layers, and push soft filament in their blocks") {
  const std::string model = "; printer_model = Bambu Lab A1\n; bed_shape = 0x0,256x0,256x256,0x256\n";
  const std::string soft = "M109 S140\nG1 E1.2 F500\nM109 S215\n";
  const std::string wipe = "G1 E-0.8 F1800\nG1 Z5 F600\nG1 X-48.2 F3000\nG1 X50 F18000\nG1 Z0.2\nG1 E0.8 F1800\n";
  CHECK(checkGcode(model + kStart + soft + kSquare + wipe + kSquare + kEnd).errors() == 0);
  CHECK(checkGcode(kStart + soft + kSquare + kEnd).errors() > 0);
  const std::string bead = "G1 X-48.2 E3 F1800\n";
  CHECK(finding(checkGcode(model + kStart + kSquare + bead + kEnd), "bounds").error);
  CHECK(finding(checkGcode(model + kStart + kSquare + "G1 E-0.8 F1800\nG1 X-70 F3000\n" + kEnd), "bounds").error);
}

TEST_CASE("offsets count together, and as each firmware adds them up") {
  const auto told = [](GcodeFlavor flavor, const std::string& lines) {
    Printer printer;
    printer.flavor = flavor;
    return finding(checkGcode(kStart + lines + kSquare + kEnd, printer), "commands").message;
  };
  using enum GcodeFlavor;
  CHECK(told(Klipper, "SET_GCODE_OFFSET Z=-0.3\nSET_GCODE_OFFSET Z=-0.4\n").empty());
  CHECK(told(Klipper, "SET_GCODE_OFFSET Z=-0.3\nSET_GCODE_OFFSET Z_ADJUST=-0.3 MOVE=1\n") ==
        "offsets move Z by -0.6 mm in all; it must be -0.5 to 10");
  CHECK(told(Marlin, "M290 Z-0.45\nM290 Z0.2\nM290 Z-0.2\n").empty());
  CHECK(told(Marlin, "M290 Z-0.45\nM206 Z-0.2\n") == "offsets move Z by -0.65 mm in all; it must be -0.5 to 10");
  CHECK(told(Marlin, "M206 Z-0.4\nM206 Z-0.4\n").empty());
  CHECK(told(RepRap, "M290 S-0.4\nM290 R0 S-0.4\n").empty());
  // Marlin takes M206 off what is told, others add it: either sign may lower.
  CHECK(told(Marlin, "M206 Z0.4\nM290 Z-0.2\n") == "offsets move Z by -0.6 mm in all; it must be -0.5 to 10");
  CHECK(told(RepRap, "G10 L2 P1 Z-1.9\n") == "G10 Z is -1.9; it must be -0.5 to 0.5");
  CHECK(told(RepRap, "G10 P0 X50 Y-4\n") == "offsets move X by 50 mm in all; it must be -10 to 10");
  CHECK(told(Bambu, "M290 X40 Y40 Z2.6\n").empty());
}

TEST_CASE("blocks may wipe on steel beside the sheet, below it") {
  const std::string model = "; printer_model = Bambu Lab P1S\n; bed_shape = 0x0,256x0,256x256,0x256\n";
  const std::string wipe = "G1 X100 Y262 Z5 F6000\nG1 Y260 Z-1.5\nG1 X110\nG1 Z5\nG1 X50 Y50\nG1 Z0.2\n";
  CHECK(rules(checkGcode(model + kStart + wipe + kSquare + kEnd)) == "");
  const std::string sheet = "G1 X100 Y250 Z5 F6000\nG1 Y240 Z-1.5\n";
  CHECK(finding(checkGcode(model + kStart + sheet + kSquare + kEnd), "height").error);
  CHECK(finding(checkGcode(model + kStart + "M290 X40 Y40 Z2.6\nM500\n" + kSquare + kEnd), "settings").rule.empty());
}

TEST_CASE("the area of the print that Prusa's boards are told is no setting") {
  for (const GcodeFlavor flavor : {GcodeFlavor::Marlin, GcodeFlavor::PrusaBuddy}) {
    Printer printer;
    printer.flavor = flavor;
    CHECK(checkGcode("M555 X10 Y10 W50 H50\n" + kStart + kSquare + kEnd, printer).findings.empty());
  }
}

TEST_CASE("files of our own are held to more: closed cycles, plain lines, totals") {
  const std::string ours = "; generated by Sillon 0\n";
  CHECK(rules(checkGcode(ours + kStart + kSquare + kEnd)) == "");
  std::string open = kSquare;
  open.replace(open.find("G1 Y50 E0.33260"), 6, "G1 Y51");
  CHECK(finding(checkGcode(ours + kStart + open + kEnd), "cycle").message ==
        "a cycle that does not close: it ends 1 mm off");
  CHECK(rules(checkGcode(kStart + open + kEnd)) == "");
  CHECK(finding(checkGcode(ours + kStart + kSquare + "M117 hello\n" + kEnd), "grammar").error);
  CHECK(rules(checkGcode(ours + "M117 hello\n" + kStart + kSquare + kEnd)) == "");  // start blocks are the user's
  CHECK(finding(checkGcode(ours + kStart + kSquare + kEnd + "; filament used [mm] = 1.40\n"), "totals").error);
  CHECK(rules(checkGcode(ours + kStart + kSquare + kEnd + "; filament used [mm] = 1.33\n")) == "");
  const std::string retracts = "G1 E-0.8 F2100\nG1 X60 F6000\nG1 E0.8 F2100\n";
  CHECK(finding(checkGcode(ours + kStart + kSquare + retracts + "G1 X90 F6000\n" + kEnd), "retraction").error);
  // Without a retraction anywhere, none was asked for.
  const GcodeCheck never = checkGcode(ours + kStart + kSquare + "G1 X90 F6000\n" + kEnd);
  CHECK(finding(never, "retraction").message == "travels without retraction over 40 mm");
  CHECK_FALSE(finding(never, "retraction").error);
}

TEST_CASE("a file of ours that begins above a print must not go below it") {
  const std::string head = "; generated by Sillon 0.1.0\n; start height = 5 mm, of a print\n";
  std::string high = kStart + kSquare + kEnd;
  high.replace(high.find("G1 Z0.2"), 7, "G1 Z5.2");
  CHECK(rules(checkGcode(head + high)).find("height") == std::string::npos);
  CHECK(checkGcode(head + high).lowest == 5.2);
  const GcodeFinding low = finding(checkGcode(head + kStart + kSquare + kEnd), "height");
  CHECK(low.message == "moves below the print on the bed: Z 0.2");
  CHECK(low.error);
  CHECK(low.count == 5);
  // Straight down between layers, too.
  std::string plunge = high;
  plunge.insert(plunge.find(kEnd), "G1 Z4\nG1 Z5.4\n");
  CHECK(finding(checkGcode(head + plunge), "height").message == "moves below the print on the bed: Z 4");
  // In a start block, which is the machine's own, it is worth a look; as is the way down while moving along.
  const GcodeFinding block = finding(checkGcode(head + kStart + "G1 X9 F600\n" + high), "height");
  CHECK((block.count == 1 && !block.error));
  std::string down = high;
  down.insert(down.find("G1 Y60"), "G1 X61 Z1\n");
  CHECK(finding(checkGcode(head + down), "height").count == 4);
  CHECK(finding(checkGcode(kStart + kSquare + kEnd), "height").count == 0);
}

TEST_CASE("bed, height, nozzle and filament are read from the file's own settings") {
  const std::string settings =
      "; bed_shape = 0x0,55x0,55x100,0x100\n; nozzle_diameter = 0.2\n; max_print_height = 5\n; filament_diameter = "
      "2.85\n; printer_model = MINI\n";
  const GcodeCheck check = checkGcode(kStart + kSquare + kEnd + settings);
  CHECK(check.printer == "MINI");
  CHECK(finding(check, "bounds").message.find("a bead over the bed's edge at (60, 50), 5 mm") == 0);
  CHECK(finding(check, "height").message == "above the printer's height: 10 mm");
  CHECK(finding(check, "extrusion").message.find("more plastic per mm") == 0);
  CHECK(check.mostFlow == about(0.033260 * 30 * kArea * 2.85 * 2.85 / 1.75 / 1.75, 1e-3));
}

TEST_CASE("makers' start blocks may wipe a little beside the bed, and macros home and heat") {
  Printer printer;
  const std::string wipe = kStart + "G1 Y-4 F6000\nG1 X60 E9 F1000\n";
  const GcodeCheck near = checkGcode(wipe + kSquare + kEnd, printer);
  CHECK(finding(near, "bounds").rule.empty());
  CHECK(near.box.min.y == 50);
  CHECK(checkGcode(kStart + "G1 Y-14 F6000\n" + kSquare + kEnd, printer).errors() == 1);
  const std::string macro =
      "PRINT_START BED=60 EXTRUDER=215\nM83\nG1 Z0.2 F600\n" + kSquare + "G1 E-0.8 F2100\nPRINT_END\n";
  CHECK(rules(checkGcode(macro, printer)) == "");
  CHECK(checkGcode(macro).nozzleTarget == 215);
  CHECK_FALSE(checkGcode("EXCLUDE_OBJECT_START NAME=PLATE_1\nTIMELAPSE_START\n").homes);
}

TEST_CASE("makers' end blocks may go to the end of an axis, where Klipper would end the print") {
  const auto height = [](const std::string& line, GcodeFlavor flavor = GcodeFlavor::Marlin) {
    Printer printer;
    printer.flavor = flavor;
    return finding(checkGcode(kStart + kSquare + kEnd + ";TYPE:Custom\n" + line + "\n", printer), "height");
  };
  CHECK(height("G1 Z205 F600").code == "too-high");
  CHECK_FALSE(height("G1 Z205 F600").error);
  CHECK(height("G1 Z205 F600", GcodeFlavor::Klipper).error);
  CHECK(height("G1 Z211 F600").error);
  CHECK(finding(checkGcode(kStart + kSquare + "G1 E-0.8 F2100\nG1 Z205 F600\n" + kEnd, Printer{}), "height").error);
}

TEST_CASE("behind Cura's last layer comes an end block, which may home, park and unload as others do") {
  const std::string head = ";FLAVOR:Marlin\n" + kStart + ";LAYER:0\n;TYPE:SKIN\n" + kSquare.substr(kSquare.find("G1"));
  const std::string end = "M104 S0\nM140 S0\nG1 E-8 F300\nG1 E1\nM84\nG28\nM84\nG1 Y180 F3000\nG92 E0\nG1 E-60 F300\n";
  CHECK(checkGcode(head + end).errors() > 0);
  CHECK(checkGcode(head + ";TIME_ELAPSED:8.5\n" + end).errors() == 0);
  // The next layer is none.
  CHECK(checkGcode(head + ";TIME_ELAPSED:8.5\n;LAYER:1\n" + end).errors() > 0);
}

TEST_CASE("blocks of old machines home by axis, lift first, and purge on the bed") {
  const std::string rest = "G21\nG90\nM83\nG92 E0\nG1 Z0.2 F600\n" + kSquare + kEnd;
  const auto errors = [&](const std::string& homing) {
    return checkGcode("M140 S60\nM104 S215\n" + homing + "M190 S60\nM109 S215\n" + rest).errors();
  };
  CHECK(errors("G28\n") == 0);
  CHECK(errors("G162 X Y F2500\nG161 Z F1100\n") == 0);
  CHECK(errors("G28 Y0\nG1 Y20 F6000\nG28 X0\nG28 Z0\n") == 0);
  CHECK(errors("G28 Y0\nG1 X20 F6000\nG28 X0\nG28 Z0\n") > 0);
  CHECK(errors("G1 Z15 F600\nG28\n") == 0);
  CHECK(errors("G1 Z25 F600\nG28\n") > 0);
  CHECK(checkGcode(kStart + "G1 Z1\nG1 X60 Z0 E9 F1000\nG1 Z0.2\n" + kSquare + kEnd).errors() == 0);
  CHECK(checkGcode(kStart + "G1 Z1\nG1 X60 Z-0.1 E9 F1000\nG1 Z0.2\n" + kSquare + kEnd).errors() > 0);
  CHECK(checkGcode(kStart + "G1 Z 1.0\nG1 Z0.2\n" + kSquare + kEnd).errors() == 0);  // all firmwares read 1
  CHECK(checkGcode(kStart + "G29 Z10\n" + kSquare + kEnd).errors() == 0);            // higher than the bed is
  CHECK(checkGcode(kStart + "G29 Z-2\n" + kSquare + kEnd).errors() > 0);
}

TEST_CASE("a purge of the printer's own waits for the nozzle") {
  const std::string start = "M190 S60\nM104 S215\nG28\nG29\n";
  const std::string rest = "G21\nG90\nM83\nG92 E0\nG1 Z0.2 F600\n" + kSquare + kEnd;
  CHECK(rules(checkGcode(start + "G1009\n" + rest)) == "");
  CHECK(finding(checkGcode(start + rest), "heating").code == "cold-start");
}

TEST_CASE("layers are known by the marks of each slicer, once where there are two") {
  const auto marked = [](const std::string& mark, bool twice = false) {
    std::string square = kSquare;
    return kStart + mark + square.replace(0, 14, twice ? "" : ";") + mark + "G1 X60 E0.33260\n" + kEnd;
  };
  for (const char* mark : {";LAYER_CHANGE\n", ";LAYER:0\n", "; CHANGE_LAYER\n", "; layer 1, Z = 0.200\n",
                           ";LAYER_CHANGE\n; CHANGE_LAYER\n"}) {
    CAPTURE(mark);
    const GcodeCheck check = checkGcode(marked(mark));
    CHECK(check.layers == 2);
    CHECK(rules(check) == "");
    CHECK(check.box.max.x == 60);
    Printer small;
    small.bedMax = {55, 100};
    CHECK(finding(checkGcode(marked(mark), small), "bounds").error);
  }
  const GcodeCheck unmarked = checkGcode(marked(""));
  CHECK(unmarked.layers == 0);
  CHECK(finding(unmarked, "layers").message.find("no layer is marked") == 0);
  CHECK_FALSE(finding(unmarked, "layers").error);
}

TEST_CASE("what is for another tool, or a tool's setting, changes nothing") {
  CHECK(rules(checkGcode(kStart + "M104 S0 T1\nG10 P0 S215 R170\n" + kSquare + kEnd)) == "");
  CHECK(finding(checkGcode(kStart + "G10\n" + kSquare + kEnd), "retraction").error);
}

TEST_CASE("the heat of the tool that prints is followed, in the words of each firmware") {
  const auto heating = [](const std::string& start) {
    const GcodeCheck check = checkGcode("G28\n" + start + "G21\nG90\nM83\nG92 E0\nG1 Z0.2 F600\n" + kSquare);
    return finding(check, "heating").code;
  };
  CHECK(heating("M190 S60\nM109 S215\n").empty());
  CHECK(heating("M190 S60\nM104 T1 S215\nT1\nM109 T1 S215\n").empty());
  CHECK(heating("M190 S60\nM109 S215\nT3\n").empty());  // another filament for the same nozzle
  CHECK(heating("M140 S60\nG10 P0 S205 R205\nT0\nM116\n").empty());
  CHECK(heating("M140 S60\nM568 P1 S205 R205 A2\nT1\nM116\n").empty());
  CHECK(
      heating("SET_HEATER_TEMPERATURE HEATER=heater_bed TARGET=60\nSET_HEATER_TEMPERATURE HEATER=extruder TARGET=210\n"
              "TEMPERATURE_WAIT SENSOR=heater_bed MINIMUM=58\ntemperature_wait sensor=extruder minimum=205\n")
          .empty());
  CHECK(heating("M190 S60\nSET_HEATER_TEMPERATURE HEATER=\"extruder\" TARGET=210\nTEMPERATURE_WAIT SENSOR='extruder' "
                "MINIMUM=205\n")
            .empty());
  CHECK(heating("START_PRINT TOTAL_LAYER=250 X1=260.2 SIZE=300 BED_TEMP=60\n") == "cold-start");
  // Another tool that stands by takes nothing from the one that prints.
  CHECK(heating("M190 S60\nM109 S215\nM104 T1 S150\n").empty());
  CHECK(heating("START_PRINT BED=60 EXTRUDER=215\nM104 T1 S150\n").empty());
  CHECK(heating("M190 S60\nSET_HEATER_TEMPERATURE HEATER=extruder TARGET=210\nTEMPERATURE_WAIT SENSOR=extruder "
                "MINIMUM=205\nSET_HEATER_TEMPERATURE HEATER=extruder1 TARGET=150\n")
            .empty());
  CHECK(heating("M190 S60\nM104 S215\n") == "cold-start");
  CHECK(heating("M190 S60\nSET_HEATER_TEMPERATURE HEATER=extruder TARGET=210\n") == "cold-start");
  CHECK(heating("M190 S60\nM104 T1 S150\nM109 S215\n").empty());
  CHECK(heating("M190 S60\nM104 T1 S150\nM109 S215\nT1\n") == "cold-bead");
  CHECK(heating("M190 S60\nM109 T0 S215\nM104 T1 S150\nT1\n") == "cold-bead");
  CHECK(heating("M190 S60\nM109 S215\nM109 R140\nM104 S215\n") == "cold-bead");
  CHECK(heating("M190 S60\nM109 S215\nTURN_OFF_HEATERS\n") == "cold-bead");
  // And it is off at the end.
  CHECK(finding(checkGcode(kStart + kSquare + ";TYPE:Custom\nTURN_OFF_HEATERS\n"), "end").code.empty());
  CHECK(finding(checkGcode(kStart + kSquare + "M400\n"), "end").code == "hot-nozzle");
}

TEST_CASE("a start macro is given its nozzle's temperature by a name that says so") {
  const auto targets = [](const std::string& parameters) {
    const GcodeCheck check = checkGcode("START_PRINT " + parameters + "\n");
    return std::pair{check.nozzleTarget, check.bedTarget};
  };
  using Pair = std::pair<double, double>;
  CHECK(targets("EXTRUDER_TEMP=215 EXTRUDER_OTHER_LAYER_TEMP=225 BED_TEMP=60 TOTAL_LAYER_COUNT=250 X0=99 Y0=99 X1=180 "
                "Y1=260.2") == Pair{215, 60});
  CHECK(targets("hotend=215 bed='60'") == Pair{215, 60});
  CHECK(targets("TEMPERATURE=210 FIRST_LAYER_TEMPERATURE=215 BED=55 FIRST_LAYER_BED_TEMPERATURE=60") == Pair{215, 60});
  CHECK(targets("T=215 B=60") == Pair{215, 60});
  CHECK(targets("NOZZLE_DIAMETER=0.4 EXTRUDER=0 CHAMBER=175 SIZE=300 BED_TYPE=200") == Pair{0, 0});
}

TEST_CASE("every nozzle and the chamber must be off at the end") {
  const auto end = [](const std::string& before, const std::string& after) {
    std::string codes;
    for (const GcodeFinding& found : checkGcode(kStart + before + kSquare + kEnd + after).findings) {
      if (found.rule == "end") codes += found.code + " ";
    }
    return codes;
  };
  CHECK(end("", "") == "");
  CHECK(end("M104 T1 S200\n", "") == "hot-nozzle ");
  CHECK(end("M104 T1 S200\n", "M104 T1 S0\n") == "");
  CHECK(end("M141 S45\n", "") == "hot-chamber ");
  CHECK(end("M141 S45\n", "M141 S0\n") == "");
  // RepRapFirmware switches heaters off in ways of its own.
  CHECK(end("M568 P1 S200 R150\n", "M568 P1 A1\n") == "hot-nozzle ");
  CHECK(end("M568 P1 S200 R150\n", "M568 P1 A0\n") == "");
  CHECK(end("G10 P1 S200\n", "G10 P1 S-273.15\n") == "");
  CHECK(end("", "M104 S200\nG10 S-273.15\nM140 S-273.15\n") == "");
}

TEST_CASE("modes that are kept and given back hold again") {
  const auto height = [](const std::string& body, GcodeFlavor flavor) {
    Printer printer;
    printer.flavor = flavor;
    const std::string rest = "G1 X50 Y50 F6000\nG1 X60 E0.33260 F1800\n";
    return checkGcode(kStart + ";LAYER_CHANGE\n" + body + rest, printer).top;
  };
  const std::string hop = "G91\nG1 Z0.5\n";
  using enum GcodeFlavor;
  CHECK(height("SAVE_GCODE_STATE NAME=a\n" + hop + "RESTORE_GCODE_STATE NAME=a\nG1 Z0.3\n", Klipper) ==
        about(0.3, 1e-9));
  CHECK(height("save_gcode_state\n" + hop + "restore_gcode_state MOVE=1\n", Klipper) == about(0.2, 1e-9));
  CHECK(height("SAVE_GCODE_STATE NAME=a\n" + hop + "RESTORE_GCODE_STATE NAME=b\nG90\n", Klipper) == about(0.7, 1e-9));
  CHECK(height("M120\n" + hop + "M121\nG1 Z0.3\n", RepRap) == about(0.3, 1e-9));
  CHECK(height("M120\nM120\n" + hop + "M121\nM121\nG1 Z0.3\n", RepRap) == about(0.3, 1e-9));
  CHECK(height("M120\nG91\nM120\nG90\nM121\nG1 Z0.5\nM121\n", RepRap) == about(0.7, 1e-9));
  CHECK(height("M120\nG90\nG1 Z0.3\nM121\n", Marlin) == about(0.3, 1e-9));  // end stops there
  // E goes on from where it was kept, and the origin with it.
  const std::string absolute = "M82\nG92 E5\nSAVE_GCODE_STATE NAME=a\nM83\nG92 Z9 E0\n";
  const std::string after = absolute + "G1 E1 F300\nRESTORE_GCODE_STATE NAME=a\nG1 Z0.3\nG1 X50 Y50 F6000\n";
  const GcodeCheck check = checkGcode(kStart + ";LAYER_CHANGE\n" + after + "G1 X60 E5.3326 F1800\n");
  CHECK(check.filamentMm == about(0.3326, 1e-9));
  CHECK(check.top == about(0.3, 1e-9));
  // Neither is there an end of them for a file that means harm.
  std::string many = kStart;
  for (int k = 0; k < 20000; ++k)
    many += "SAVE_GCODE_STATE NAME=" + std::to_string(k) + "\nT" + std::to_string(k) + "\n";
  CHECK(checkGcode(many).lines > 40000);
}

TEST_CASE("each tool holds back its own filament, and unloads it beside the print") {
  const std::string bead = "G1 X50 Y50 F6000\nG1 X60 E0.33260 F1800\n";
  const auto fault = [&](const std::string& body) {
    return finding(checkGcode(kStart + ";LAYER_CHANGE\n" + bead + body + kEnd), "retraction").code;
  };
  CHECK(fault("G1 E-10 F2100\nT1\n" + bead + "G1 E-1 F2100\nT0\nG1 E10 F2100\n" + bead).empty());
  CHECK(fault("G1 E-10 F2100\nT1\n" + bead + "G1 E-1 F2100\nT0\n" + bead) == "bead-retracted");
  const std::string unload = "G1 E-15 F2100\nG1 E-15\nG1 E-15\n";
  CHECK(fault(unload) == "far-retracted");
  CHECK(fault(";TYPE:Wipe tower\n" + unload + "T1\n;TYPE:Perimeter\n" + bead).empty());
  const std::string load = unload + "T1\nG1 X50 Y50 F6000\n";
  CHECK(fault("; CP TOOLCHANGE START\n" + load + "; CP TOOLCHANGE END\n" + bead).empty());
  CHECK(fault("M620 S1A\n" + load + "M621 S1A\n" + bead).empty());
  CHECK(fault("M620.1 E F100\n" + unload) == "far-retracted");
  const auto first = [&](const std::string& body) {
    return finding(checkGcode(kStart + body + kSquare + kEnd), "retraction").code;
  };
  CHECK(first(";TYPE:Custom\n" + unload) == "far-retracted");
  CHECK(first(";TYPE:Wipe tower\n; CP PRIMING START\n" + unload + "T1\n; CP PRIMING END\n").empty());
}

TEST_CASE("of several filaments no total is judged") {
  const std::string told = "; filament used [mm] = ";
  CHECK(finding(checkGcode(kStart + kSquare + kEnd + told + "5.00\n"), "totals").code == "filament-total");
  CHECK(finding(checkGcode(kStart + kSquare + kEnd + told + "5.00, 4.00\n"), "totals").code.empty());
}

TEST_CASE("a change of filament may go over the bed's edge, what is printed after it may not") {
  const std::string off = "G1 X60 Y-5 F6000\nG1 X61 E0.02 F1800\n";
  const auto places = [&](const std::string& body) {
    return checkGcode(kStart + kSquare + body + kEnd, Printer{}).errors();
  };
  CHECK(places("M620 S1A\nT1\n" + off + "G1 X50 Y50 F6000\nM621 S1A\n") == 0);
  CHECK(places("M620 S1A\nT1\nM621 S1A\n" + off) > 0);
  CHECK(places("M620 S1A\nT1\n;LAYER_CHANGE\n" + off) > 0);
  const std::string ours = "; generated by Sillon 0\n";
  CHECK(checkGcode(ours + kStart + kSquare + "M620 S1A\n" + off + kEnd, Printer{}).errors() > 0);
}

TEST_CASE("volumetric extrusion is refused in each of its forms") {
  for (const char* on : {"M200 D1.75\n", "M200 S1\n", "M200 D1.75 S1\n"}) {
    CAPTURE(on);
    CHECK(finding(checkGcode(kStart + on + kSquare), "modes").code == "volumetric");
  }
  for (const char* off : {"M200 D0\n", "M200 S0\n", "M200 D1.75 S0\n", "M200\n"}) {
    CAPTURE(off);
    CHECK(finding(checkGcode(kStart + off + kSquare), "modes").code.empty());
  }
}

TEST_CASE("each axis has to be homed before it is relied on, and anew when its motor was off") {
  const auto faults = [](const std::string& start) {
    return checkGcode(start + "M190 S60\nM109 S215\nG21\nG90\nM83\nG92 E0\nG1 Z0.2 F600\n" + kSquare + kEnd).errors();
  };
  CHECK(faults("G28\n") == 0);
  CHECK(faults("G28 W\n") == 0);
  CHECK(faults("G28 X Y\nG1 Z5 F600\nG1 X100 Y100 F6000\nG28 Z\n") == 0);
  CHECK(faults("G28 X0 Y0\n") > 0);
  CHECK(faults("G28 Z\n") > 0);
  CHECK(faults("G28\nM84 E\n") == 0);
  CHECK(faults("G28\nM84 S60\n") == 0);
  CHECK(faults("G28\nM84 X\n") > 0);
  Printer bambu;
  bambu.flavor = GcodeFlavor::Bambu;
  CHECK(checkGcode("G28 X\nG28 Z P0 T300\n", bambu).homes);
  const std::string twice = kStart + kSquare + "M18\n" + kSquare + kEnd;
  CHECK(finding(checkGcode(twice), "homing").code == "unhomed");
  // One axis homed on the way keeps the height.
  CHECK(checkGcode(kStart + kSquare + "G28 X\n" + kSquare + kEnd).errors() == 0);
}

TEST_CASE("arcs by their radius are followed: their bulge has to be bed too") {
  const auto bounds = [](const std::string& arc) {
    return finding(checkGcode(kStart + kSquare + "G1 X50 Y10\n" + arc + " E1\n" + kEnd, Printer{}), "bounds").code;
  };
  CHECK(bounds("G3 X70 Y10 R11").empty());            // 5 mm below its chord
  CHECK(bounds("G3 X70 Y10 R-11") == "arc-off-bed");  // the long way, below the bed
  CHECK(bounds("G2 X70 Y10 R-11").empty());           // the long way, above
  const GcodeCheck half = checkGcode(kStart + ";LAYER_CHANGE\nG1 X50 Y50 F6000\nG3 X70 Y50 R10 E1 F1800\n" + kEnd);
  CHECK(half.pathMm == Approx(10 * 3.14159265358979));
  CHECK(finding(checkGcode(kStart + kSquare + "G2 X60 Y50 R1 E1\n" + kEnd), "grammar").code == "unread-arc");
  CHECK(finding(checkGcode(kStart + kSquare + "G2 X60 Y50 E1\n" + kEnd), "grammar").code == "unread-arc");
}

TEST_CASE("what makers write on purpose is no fault") {
  const auto with = [](const std::string& line) { return kStart + kSquare + line + "\n" + kEnd; };
  Printer printer;
  // A purge line in a start block is thicker than any bead; Klipper may stop there, as its configuration says.
  const std::string purge = kStart + "G1 X5 Y5 F6000\nG1 X60 E9 F1000\nG1 X100 E12.5 F1000\nG92 E0\n" + kSquare + kEnd;
  CHECK(finding(checkGcode(purge, printer), "extrusion").count == 0);
  printer.flavor = GcodeFlavor::Klipper;
  const std::string thick = kStart + "G1 X5 Y5 F6000\nG1 X7 E9 F600\n" + kSquare + kEnd;
  CHECK(finding(checkGcode(thick, printer), "extrusion").code == "too-thick");
  CHECK(!finding(checkGcode(thick, printer), "extrusion").error);
  CHECK(finding(checkGcode(with("G1 X70 Y70 F6000\nG1 X72 E9 F600"), printer), "extrusion").error);
  // A retraction given back 0.2 mm short, over and over.
  std::string restart;
  for (int k = 0; k < 5; ++k) restart += "G1 E-0.8 F2100\nG1 X50 Y50 F6000\nG1 E0.6 F2100\nG1 X60 E0.3326 F1800\n";
  CHECK(finding(checkGcode(with(restart)), "retraction").count == 0);
  // Once in the start block of a file of ours, whose own retractions are exact.
  const std::string ours = "; generated by Sillon 0\n";
  const std::string given = kStart + "G1 X5 Y5 F6000\nG1 E-5 F2100\nG1 E4.8 F2100\n";
  CHECK(rules(checkGcode(ours + given + kSquare + kEnd)) == "");
  CHECK(finding(checkGcode(ours + kStart + "G1 E-5 F2100\n" + kSquare + kEnd), "retraction").error);
  // An end block that takes the filament out; in between that is a fault.
  CHECK(finding(checkGcode(kStart + kSquare + kEnd + "G1 E-30 F3000\n"), "retraction").count == 0);
  CHECK(finding(checkGcode(with("G1 E-30 F3000")), "retraction").error);
  CHECK(finding(checkGcode(kStart + "G1 E-30 F3000\n" + kSquare + kEnd), "retraction").error);
  // A purge at the height at which homing and levelling leave the nozzle; a Z of 0 that is told is the bed.
  const std::string homed = "M140 S60\nG28 W\nG80\nM190 S60\nM109 S215\nG21\nG90\nM83\n";
  const std::string line = "G1 Y-3 F1000\nG1 X60 E9 F1000\nG1 Z0.2 F600\n";
  CHECK(finding(checkGcode(homed + line + kSquare + kEnd), "height").count == 0);
  CHECK(finding(checkGcode(homed + "G1 Z0 F600\n" + line + kSquare + kEnd), "height").code == "bead-in-bed");
  CHECK(finding(checkGcode(homed + ";LAYER_CHANGE\n" + line + kSquare + kEnd), "height").error);
  // A first move without F runs at the firmware's own speed; beside a block it is a fault.
  const GcodeCheck first = checkGcode("G28\nG0 X65 Y5 Z1\n" + kStart + kSquare + kEnd);
  CHECK(first.errors() == 0);
  CHECK(rules(first) == "speed ");
  CHECK(finding(checkGcode(homed + ";LAYER_CHANGE\n;TYPE:Top solid infill\nG1 X50 Y50\n" + kEnd), "speed").error);
  // Signs and numbers that firmwares read, and a lift before homing.
  CHECK(checkGcode("G91\nG1 Z+15 F600\nG90\n" + kStart + "G0 X53 E.3742 F600\n" + kSquare + kEnd).errors() == 0);
  CHECK(finding(checkGcode("G90\nG1 X15 F600\n" + kStart + kSquare + kEnd), "homing").error);
  CHECK(rules(checkGcode("G380 S2 Z30 F300\n" + kStart + kSquare + kEnd)) == "");
  // UltiGCode counts E in mm3, and its printer homes and heats by itself.
  const GcodeCheck ultimaker =
      checkGcode(";FLAVOR:UltiGCode\n;LAYER:0\nM82\nG92 E0\nG1 Z0.2 F600\nG1 X50 Y50 F6000\nG1 X60 E0.8 F1800\n");
  CHECK(rules(ultimaker) == "");
  CHECK(ultimaker.filamentMm == Approx(0.8 / kArea));
}

TEST_CASE("moves below the bed are found, with Z alone too, and behind relative moves and origins") {
  // In the layers nothing goes below it; makers' blocks wipe there.
  CHECK(finding(checkGcode(kStart + kSquare + "G1 Z-0.3 F600\n" + kEnd), "height").code == "below-bed");
  CHECK(finding(checkGcode(kStart + "G1 Z-0.3 F600\n" + kSquare + kEnd), "height").code != "below-bed");
  const auto depth = [](const std::string& lines) { return finding(checkGcode(kStart + lines), "height"); };
  for (const char* lines : {"G1 Z-10 F9000\n", "G91\nG1 Z-10\nG90\n", "G92 Z20\nG1 Z5\n", "G1 X5 Y5 Z-1\n"}) {
    CAPTURE(std::string(lines));
    CHECK(depth(lines).code == "below-bed");
    CHECK(depth(lines).error);
  }
  CHECK(depth("G1 Z-0.4\n").code.empty());
  CHECK(depth("G92 Z0\nG91\nG1 Z5\nG1 Z-5\nG90\n").code.empty());
  // Makers wipe up to 2 mm below the bed beside it.
  Printer printer;
  CHECK_FALSE(finding(checkGcode(kStart + "G1 Y224 F600\nG1 Z-1.5\n", printer), "height").error);
  CHECK(finding(checkGcode(kStart + "G1 Y224 F600\nG1 Z-3\n", printer), "height").error);
}

TEST_CASE("lines keep their bytes and places, in whatever pieces they come") {
  const std::string text = "G28\r\n\nG1 X5 ;to\rM117 a\n;end\r\n\r\nT0";
  for (std::size_t size = 1; size <= text.size(); ++size) {
    CAPTURE(size);
    GcodeParser parser;
    std::string joined;
    std::int64_t count = 0;
    const auto take = [&](const GcodeLine& line) {
      CHECK(line.offset == joined.size());
      CHECK(line.number == ++count);
      joined += line.text;
      joined += line.end;
    };
    for (std::size_t at = 0; at < text.size(); at += size) parser.feed(std::string_view(text).substr(at, size), take);
    parser.finish(take);
    CHECK(joined == text);
    CHECK(count == 7);
  }
  // A line without an end is cut, so that no file takes more memory than a mebibyte of it.
  GcodeParser parser;
  std::size_t longest = 0;
  std::size_t all = 0;
  const auto take = [&](const GcodeLine& line) {
    longest = std::max(longest, line.text.size());
    all += line.text.size();
  };
  for (int k = 0; k < 40; ++k) parser.feed(std::string(100000, 'x'), take);
  parser.finish(take);
  CHECK(all == 4000000);
  CHECK(longest == (std::size_t{1} << 20));
}

TEST_CASE("any bytes end in findings") {
  const std::string whole = "; generated by Sillon 0\n" + kStart + kSquare + kEnd;
  scenes::Random random(7);
  for (int round = 0; round < 3000; ++round) {
    CHECK(checkGcode(scenes::damaged(whole, random, 3, 8)).lines > 0);
  }
  CHECK(checkGcode("").lines == 0);
  CHECK(checkGcode(std::string(100000, '\n')).lines == 100000);
  CHECK(checkGcode("G1 X" + std::string(100000, '9')).errors() > 0);
  CHECK(checkGcode(std::string(100000, 'G')).errors() > 0);
}

TEST_CASE("what no limit is known for is told, and nothing with a printer") {
  const std::string body = "G90\nM83\nG28\nG1 X10 Y10 E99 F300\n";
  const std::vector<std::string> all{"bed", "height", "nozzle", "flow", "speed"};
  CHECK(uncheckedIn(body) == all);
  CHECK(uncheckedIn("") == all);
  CHECK(uncheckedIn(body +
                    "; nozzle_diameter = 0.4\n; max_print_height = 210\n; bed_shape = 0x0,250x0,250x210,0x210\n") ==
        std::vector<std::string>{"flow", "speed"});
  CHECK(uncheckedIn(body, Printer{}).empty());
}
