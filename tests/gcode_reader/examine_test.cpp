#include "sillon/gcode_reader/check.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "gcode_reader/parser.hpp"

using namespace sillon;

namespace {

constexpr GcodeFlavor kFlavors[] = {GcodeFlavor::Marlin, GcodeFlavor::Klipper, GcodeFlavor::RepRap,
                                    GcodeFlavor::PrusaBuddy, GcodeFlavor::Bambu};

std::string codes(const std::vector<GcodeFinding>& findings) {
  std::string all;
  for (const GcodeFinding& finding : findings) all += (finding.error ? "!" : "") + finding.code + " ";
  return all;
}

bool hasError(const std::vector<GcodeFinding>& findings) {
  return std::any_of(findings.begin(), findings.end(), [](const GcodeFinding& finding) { return finding.error; });
}

// What may stand in a maker's own block: known to be so, or not known at all.
bool isHarmless(const GcodeFinding& finding) {
  return !finding.error && (finding.code == "macro" || finding.code == "unknown" || finding.code == "outlives" ||
                            finding.code == "below-bed" || finding.code == "unfollowed");
}

// Lines that a stranger's block must not slip in: an error wherever they stand, in any dialect.
const std::string kHostile[] = {
    // Heat, by every door and spelling.
    "M104 S480",
    "M109 S301",
    "m104 s480",
    "M104S480",
    "M 104 S480",
    "M104  S 480",
    "M0104 S480",
    "N5 M104 S480*99",
    "M104 T1 S480",
    "M109 T3 R480",
    "M104.1 S480",
    "M104 I480",
    "M104 B480",
    "M104 F480",
    "M109 R350",
    "M140 S121",
    "M190 S200",
    "M190 R180",
    "M144 S200",
    "M141 S200",
    "M191 S150",
    "G10 P0 S480",
    "G10 P1 R480",
    "G10 S480",
    "G10 R170 S480",
    "M568 P0 S480",
    "M568 P0 R480 A2",
    "M145 S0 H480",
    "M145 S1 B200",
    "M149 F",
    "M149 K",
    "SET_HEATER_TEMPERATURE HEATER=extruder TARGET=480",
    "set_heater_temperature heater=extruder target=480",
    "SET_HEATER_TEMPERATURE HEATER=heater_bed TARGET=200",
    "PRINT_START BED=60 EXTRUDER=480",
    "START_PRINT EXTRUDER_TEMP=400 BED_TEMP=60",
    "PRINT_START BED_TEMP=180 EXTRUDER_TEMP=215",
    "HEAT_NOZZLE TEMP=500",
    "M303 E0 S290 U1",
    "M303 E-1 C8 S100",
    "PID_CALIBRATE HEATER=extruder TARGET=240",
    "MPC_CALIBRATE HEATER=extruder",
    "M143 H1 S500",
    "M570 H1 P60 T100",
    // Into the bed.
    "G28\nG1 Z-10 F9000",
    "G28\nG91\nG1 Z-10\nG90",
    "G28\nG0 Z-3",
    "G28\nG1 X5 Y5 Z-1",
    "G28\nG92 Z20\nG1 Z5",
    "G28\nG1 Z5\nG91\nG1 Z-8",
    "G28\nG20\nG1 Z-1",
    "G28\ng1z-5",
    "G28\nG1 Z5\nG92 Z50\nG1 Z30",
    "G28\nG2 X5 Y5 I2 J0 Z-4",
    "G1 Z-4",
    "G28\nG1 Z-2.5 Y300",
    "M206 Z-5",
    "M290 Z-2",
    "SET_GCODE_OFFSET Z=-5",
    "SET_GCODE_OFFSET Z_ADJUST=-3 MOVE=1",
    "G10 L2 P1 Z-20",
    "G29.1 Z-3",
    "M421 I0 J0 Z-5",
    "M851 Z-20",
    // Moves and currents that nobody can follow.
    "FORCE_MOVE STEPPER=stepper_z DISTANCE=-50 VELOCITY=50",
    "SET_KINEMATIC_POSITION Z=100",
    "MANUAL_STEPPER STEPPER=lift MOVE=-50",
    "STEPPER_BUZZ STEPPER=stepper_z",
    "TESTZ Z=-10",
    "MANUAL_PROBE",
    "SET_TMC_CURRENT STEPPER=stepper_z CURRENT=3",
    "G53 G1 Z-10",
    "G6 I5",
    "M906 X2500",
    "M907 X4000",
    "M452",
    "M260 A99",
    "M261 A99 B1",
    // Beyond any machine.
    "M203 X99999",
    "M201 X900000",
    "M204 S900000",
    "M205 X900",
    "M220 S999",
    "M221 S500",
    "M221 S5",
    "M220 S1",
    "SET_VELOCITY_LIMIT ACCEL=900000",
    "SET_VELOCITY_LIMIT VELOCITY=900000",
    "M200 D1.75",
    "M218 T1 Z-9",
    // Ends, restarts, firmware, locks.
    "M112",
    "M997",
    "m997",
    "M997 S0",
    "M 997",
    "M999",
    "M502",
    "M410",
    "M524",
    "M993",
    "M995",
    "M43 T",
    "M512 P1",
    "M510",
    "M511 P1",
    "M513",
    "M810 M997",
    "M811 G1 Z-5",
    "M952 B20 A21",
    "D0",
    "D1",
    "D-1",
    "D2 R0x0000",
    "D3 Ax0000 X00",
    "RESTART",
    "FIRMWARE_RESTART",
    "firmware_restart",
    "SHUTDOWN",
    "REBOOT",
    "CANCEL_PRINT",
    "DELTA_CALIBRATE",
    "PROBE_CALIBRATE",
    "Z_ENDSTOP_CALIBRATE",
    "SHAPER_CALIBRATE",
    // Files, network, programs.
    "M30 /other.gco",
    "M28 /a.gco",
    "M29",
    "M32 /other.gco",
    "M23 /other.gco",
    "M24",
    "M26 S0",
    "M33 x",
    "M34 S1",
    "M928 log.gco",
    "M587 S\"net\" P\"pw\"",
    "M588 S\"net\"",
    "M589 S\"ap\" P\"pw\"",
    "M586 P1 S1",
    "M550 P\"x\"",
    "M551 P\"x\"",
    "M552 S1",
    "M553 P255.255.255.0",
    "M554 P10.0.0.1",
    "M505 P\"/sys2\"",
    "M559 P\"config.g\"",
    "M560 P\"x\"",
    "M471 S\"a\" T\"b\"",
    "M470 P\"/x\"",
    "M37 P\"a.g\"",
    "M929 P\"log\" S1",
    "M956 P0 S100 A0",
    "M575 P1 B57600",
    "RUN_SHELL_COMMAND CMD=x",
    "run_shell_command CMD=x",
    "SDCARD_PRINT_FILE FILENAME=x.gcode",
    "SDCARD_RESET_FILE",
    "SAVE_CONFIG",
    "CALL_REMOTE_METHOD method=reboot",
    "UPDATE_MANAGER X=1",
    "echo >\"0:/sys/config.g\" \"M997\"",
    // Hidden behind other text.
    "M117 hello\rM997",
    "G28 ; home\rM104 S480",
    "G4 P1 M997",
    "G1 X5 Y5 M112",
    "M117 a:M997",
    "M117 b#M502",
    "(home) M997",
    "/M997",
    "%M502",
    "  \t M112",
    "\x0bM112",
    "G28 M104 S480",
    "T0 M502",
    "M105 M303 E0 S290",
    "N10 M997 *12",
    "M118 ok:M112",
};

// Lines that deserve a word, and may stand in somebody's own block.
const std::string kDoubtful[] = {
    "G5 X10 Y10 I0 J3 P0 Q-3",
    "M302 S0",
    "M302 P1 S170",
    "M211 S0",
    "M500",
    "M501",
    "M92 E400",
    "M301 P22 I1 D114",
    "M304 P10",
    "M206 X5",
    "M851 Z-1.2",
    "M42 P4 S255",
    "M81",
    "M98 P\"/macros/x\"",
    "G4 S3000",
    "G4 P3000000",
    "M3 S1000",
    "M111 S8",
    "M918 Y1",
    "M913 X200",
    "M914 X60",
    "M350 X16",
    "M569.1 P0",
    "M665 L200",
    "M666 X-0.1",
    "M558 F500",
    "M563 P0 D0",
    "M308 S0 P\"x\"",
    "M950 H0",
    "G54",
    "G55",
    "G38.2 Z-5",
    "G42 I1 J1",
    "G26",
    "G33",
    "G425",
    "M48 P10",
    "M360",
    "M380",
    "M423 X1",
    "M540 S1",
    "M852 I0.1",
    "M871 P1",
    "M912",
    "SAVE_VARIABLE VARIABLE=x VALUE=1",
    "SET_PIN PIN=x VALUE=1",
    "SET_IDLE_TIMEOUT TIMEOUT=99999",
    "INIT_TMC STEPPER=stepper_x",
    "SET_STEPPER_ENABLE STEPPER=stepper_z ENABLE=0",
    "UPDATE_DELAYED_GCODE ID=x DURATION=1",
    "TEST_RESONANCES AXIS=X",
    "BED_MESH_PROFILE SAVE=x",
};

// Start and end blocks as makers write them, shortened, by the commands that their documentation names.
const std::string kBlocks[] = {
    "G90\nM83\nM104 S215\nM140 S60\nM190 S60\nM109 S215\nG28 W\nG80\nG1 Y-3.0 F1000.0\nG92 E0.0\nG1 X60.0 E9.0 "
    "F1000.0\n"
    "G1 X100.0 E12.5 F1000.0\nG92 E0.0\nM221 S95",
    "M17\nM862.1 P0.4\nM862.3 P \"MK4\"\nM862.5 P2\nM862.6 P\"Input shaper\"\nM115 U6.0.1\nG90\nM83\nM140 S60\nM104 T0 "
    "S170\nM109 T0 R170\n"
    "M84 E\nG28\nG1 X42 Y-4 Z5 F4800\nM302 S160\nG1 E-2 F2400\nM84 E\nG29 P9 X10 Y-4 W32 H4\nM106 S100\nG0 Z40 F10000\n"
    "M190 S60\nM107\nG29 P1\nG29 P1 X0 Y0 W50 H20 C\nG29 P3.2\nG29 P3.13\nG29 A\nM104 S215\nM109 S215\nG92 E0\nM569 S0 "
    "E",
    "M104 S120\nM140 S60\nG4 S10\nG28\nG1 Z50 F240\nG1 X2 Y10 F3000\nM104 S215\nM190 S60\nM109 S215\nG1 Z0.28 "
    "F240\nG92 E0\n"
    "G1 Y140 E10 F1500\nG1 X2.3 F5000\nG92 E0\nG1 Y10 E10 F1200\nG92 E0",
    "M201 X1250 Y1250 Z400 E5000\nM203 X180 Y180 Z12 E80\nM204 P1250 R1250 T1250\nM205 X8 Y8 Z2 "
    "E10\nM107\nG21\nG90\nM83\nG28",
    "PRINT_START EXTRUDER=215 BED=60 CHAMBER=40",
    "START_PRINT EXTRUDER_TEMP=215 BED_TEMP=60",
    "BEGIN_PRINT EXTRUDER=215 BED=60",
    "print_start EXTRUDER=240 BED=110",
    "M190 S0\nM109 S0\nPRINT_START EXTRUDER=215 BED=60\nSET_PRESSURE_ADVANCE ADVANCE=0.04",
    "G32\nM116\nT0\nG28\nM572 D0 S0.04",
    "M140 S60\nG28\nG29 S1\nM190 S60\nG10 P0 S215 R170\nT0\nM116 P0",
    "M220 S100\nM221 S100\nM73 P0 R10\nM900 K0.05\nG28 ; home\nG29 ; level\nM420 S1 Z3",
    "G28\nG33 ; delta",
    "M280 P0 S160\nG28\nG29",
    "M413 S0\nM600\nM300 S440 P200\nM117 Printing: 10% #1",
    "G92 E0\nG1 E-4 F3000\nG91\nG1 Z10 F600\nG90\nG28 X0 Y0\nM104 S0\nM140 S0\nM84",
    "M107\nM104 S0\nM140 S0\nG1 X0 Y200 F3000\nM18 S180",
    "M593 F0\nM84 X Y E\nM77",
    "END_PRINT",
    "PRINT_END",
    "print_end",
    "M862.3 P \"MK3S\"\nM115 U3.13.0\nM555 X10 Y10 W50 H50\nP0 S1\nM217 Z2",
    "G21\nG90\nM82\nM107\nG28 X0 Y0\nG28 Z0\nG1 Z15.0 F9000\nG92 E0\nG1 F200 E3",
    "M104 S{first_layer_temperature}\nM190 S[first_layer_bed_temperature]\nG28",
    "SET_GCODE_OFFSET Z=-0.02\nSET_RETRACTION RETRACT_LENGTH=0.5",
    "BED_MESH_CALIBRATE\nBED_MESH_PROFILE LOAD=default\nG28\nQUAD_GANTRY_LEVEL",
    "EXCLUDE_OBJECT_DEFINE NAME=A CENTER=10,10\nSET_PRINT_STATS_INFO TOTAL_LAYER=5",
    "M486 T2\nM486 S0\nM486 AName",
    "G91\nG1 Z5 F1200\nG90\nG28",
    "M75\nG26 ; clear probe fault\nM420 S0",
    "T0\nM104 T0 S215\nM104 T1 S170\nM109 T0 S215",
    "G28\nG1 Z5 F5000\nG12 ; wipe\nG1 X42 Y173 Z-.5 F4000",
    "M84 S0\nM85 S0",
    "M107\nM190 S100\nM104 S235 T0\nG28 X0 Y0\nG28 Z0\nT0\nG92 E0",
    "M1002 gcode_claim_action : 2\nM140 S65\nM17 X0.65 Y1.2 Z0.6\nM960 S5 P1\nM73.2 R1.0\nM975 S1",
    "G91\nG380 S2 Z40 F1200\nG380 S3 Z-15 F1200\nG90\nG28 X\nG91\nG1 Z5 F1200\nG90\nG0 X128 F30000\nG91\nG1 Z-5 "
    "F1200\nG90",
    "M620 M\nM620 S0A\nM109 S220\nT0\nM620.1 E F299 T240\nM621 S0A\nM412 S1\nM622 J1\nM983 F8.3 A0.3 H0.4\nM623",
    "M1006 S1\nM1006 A0 B10 L100 C37 D10 M60 E37 F10 N60\nM1006 W\nM18",
    "G28 Z P0 T300\nG29.2 S0\nG0 Z5 F20000\nG0 X128 Y261 F20000\nG0 Z-1.01 F1200\nG1 Z10",
    "G29 A1 X54.8 Y54.8 I70.4 J70.4\nM400\nM970.3 Q1 A7 B30 C80 H15 K0\nM974 Q1 S2 P0",
    "M1002 gcode_claim_action : 2\nM211 S\nM211 R\nM220 S100\nM991 S0 P0\nM993 A0 B0 C0",
};

std::string fileText(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("every hostile line is an error, whatever machine its writer claims") {
  CHECK(std::size(kHostile) >= 150);
  for (const std::string& line : kHostile) {
    CAPTURE(line);
    for (const GcodeFlavor flavor : kFlavors) {
      CAPTURE(static_cast<int>(flavor));
      const auto findings = examineBlock(line, flavor);
      CAPTURE(codes(findings));
      CHECK(hasError(findings));
    }
  }
}

TEST_CASE("what a file is checked for is what a block is examined for") {
  const std::string start = "G28\nM190 S60\nM109 S215\nG90\nM83\nG1 Z5 F600\n";
  for (const std::string& line : kHostile) {
    CAPTURE(line);
    CHECK(checkGcode(start + line + "\n").errors() > checkGcode(start).errors());
  }
}

TEST_CASE("doubtful lines are told of, but are no errors") {
  for (const std::string& line : kDoubtful) {
    CAPTURE(line);
    for (const GcodeFlavor flavor : {GcodeFlavor::Marlin, GcodeFlavor::Klipper}) {
      const auto findings = examineBlock(line, flavor);
      CAPTURE(codes(findings));
      CHECK_FALSE(findings.empty());
      CHECK_FALSE(hasError(findings));
    }
  }
}

TEST_CASE("blocks as makers write them are clean") {
  CHECK(std::size(kBlocks) >= 40);
  for (const std::string& block : kBlocks) {
    CAPTURE(block);
    const auto findings =
        examineBlock(block, block.find("M1002") != std::string::npos ? GcodeFlavor::Bambu : GcodeFlavor::Marlin);
    CAPTURE(codes(findings));
    CHECK(std::all_of(findings.begin(), findings.end(), isHarmless));
  }
}

// "start_gcode = ..." of a slicer's bundle of printers, with its line ends written out.
TEST_CASE("the blocks of PrusaSlicer's printers are clean") {
  const std::filesystem::path folder = "/usr/share/PrusaSlicer/profiles";
  if (!std::filesystem::is_directory(folder)) {
    std::puts("skipped: the blocks of PrusaSlicer's printers; prusa-slicer is not installed");
    return;
  }
  int blocks = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".ini") continue;
    std::istringstream lines(fileText(entry.path()));
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with("start_gcode = ") && !line.starts_with("end_gcode = ")) continue;
      if (line.ends_with('\r')) line.pop_back();
      std::string block;
      for (std::size_t k = line.find('=') + 2; k < line.size(); ++k) {
        const bool end = line.compare(k, 2, "\\n") == 0;
        block += end ? '\n' : line[k];
        k += end ? 1 : 0;
      }
      ++blocks;
      CAPTURE(entry.path().filename().string());
      for (const GcodeFinding& finding : examineBlock(block, GcodeFlavor::Marlin)) {
        CAPTURE(finding.message);
        CAPTURE(finding.line);
        CAPTURE(block);
        CHECK(isHarmless(finding));
      }
    }
  }
  CHECK(blocks >= 40);
  std::printf("%d blocks of PrusaSlicer's printers\n", blocks);
}

TEST_CASE("findings name their line, and unknown commands and macros are marked") {
  const auto findings =
      examineBlock("G28\nG1 Z5\n\nMY_MACRO X=1\nM12345\nM6789\n@pause\nM500 ; keep\nM997\n", GcodeFlavor::Klipper);
  REQUIRE(findings.size() == 6);
  CHECK(findings[0].code == "macro");
  CHECK(findings[0].line == 4);
  CHECK(findings[0].message == "MY_MACRO is a macro of the printer; what it does is not in this file");
  CHECK(findings[1].message == "M12345 is not in the list of known commands");
  CHECK(findings[2].message == "M6789 is not in the list of known commands");
  CHECK(findings[3].line == 7);
  CHECK(findings[4].message == "M500 outlives the print");
  CHECK(findings[4].rule == "settings");
  CHECK(findings[5].message == "M997 does not belong in a print file");
  CHECK(findings[5].error);
  CHECK(findings[5].values == std::vector<std::pair<std::string, std::string>>{{"command", "M997"}});
  CHECK(examineBlock("", GcodeFlavor::Marlin).empty());
  CHECK(examineBlock("; a remark: M997\n;M104 S480\n", GcodeFlavor::Marlin).empty());
  CHECK(examineBlock("M104 S300\nM140 S120\n", GcodeFlavor::Marlin).empty());
  CHECK(examineBlock("SUSPEND_PRINT", GcodeFlavor::Klipper).at(0).code == "macro");
}

TEST_CASE("any bytes can be examined") {
  const std::string bytes(100000, 'M');
  CHECK(examineBlock(bytes, GcodeFlavor::Marlin).size() <= 1);
  std::string nested;
  for (int k = 0; k < 20000; ++k) nested += "M117 ";
  CHECK_FALSE(hasError(examineBlock(nested, GcodeFlavor::RepRap)));
}
