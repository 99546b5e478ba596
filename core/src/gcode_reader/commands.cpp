#include "gcode_reader/parser.hpp"

#include <charconv>
#include <iterator>
#include <map>

#include "base/numbers.hpp"
#include "gcode_reader/machine.hpp"
#include "gcode_reader/macros.hpp"
#include "gcode_reader/rules.hpp"

namespace sillon {
namespace {

// Effects of commands, from the harmless to the worst; rowOf compares them.
enum CommandKind {
  Safe,        // its effect ends with the print, or MachineState follows it
  Outlives,    // its effect outlasts the print
  Runs,        // runs commands that are written elsewhere
  Unfollowed,  // moves, heats or switches in a way that MachineState does not follow
  Files,       // reaches files, the network or other programs
  Never,       // has no place in a print
};

// Pages that describe the commands. Each row of the table names one of them, on which its commands are found by name.
//   Marlin   https://marlinfw.org/meta/gcode/
//   Klipper  https://www.klipper3d.org/G-Codes.html
//   RepRap   https://docs.duet3d.com/User_manual/Reference/Gcodes
//   Prusa    https://help.prusa3d.com/article/prusa-specific-g-codes_112173 and https://reprap.org/wiki/G-code
//   Bambu    the start and end blocks of https://github.com/bambulab/BambuStudio, resources/profiles/BBL/machine
//   Wiki     https://reprap.org/wiki/G-code, for older firmwares
enum Source : unsigned { Marlin = 1, Klipper = 2, RepRap = 4, Prusa = 8, Bambu = 16, Wiki = 32 };

// One row of the table: commands of the same kind and from the same page.
struct CommandRow {
  CommandKind kind;
  unsigned sources;        ///< bits of Source: the pages, and so the machines that the row is for
  bool error;              ///< true: a finding about it is an error; false: a warning
  std::string_view names;  ///< commands, separated by spaces; M201-M205 is a range
};

// The table of commands. If several rows have the same command, the one for the machine's own dialect counts. Such rows
// may differ in warnings only.
constexpr CommandRow kRows[] = {
    // Moves, modes, homing, levelling, waiting.
    {Safe, Marlin, false, "G0-G4 G10-G12 G17 G20-G21 G27-G32 G34-G35 G60 G80 G90-G92 M82-M84 M17-M18 M400-M402 M420 T"},
    {Safe, Wiki, false, "G22-G23 G75 G81 G161-G162 M101-M103 M126-M129 M70-M72 M132-M133"},
    {Safe, RepRap, false, "G69 M116 M120-M121 M561 M557"},
    {Safe, Prusa, false, "G29.1-G29.9 M555 M569 M862 M863 M958 M970 M977 P L P0 P1 Tx Tc T?"},
    {Safe, Bambu, false,
     "G29.1-G29.9 G39-G39.9 G150-G152 G150.1-G150.9 G380 G383 G392 G1009 G2814 M9833 M620-M630 M960 M970-M985 M991 "
     "M1000 "
     "M1002-M1007 M1012 M1022 M1026 M1028 M142 M211 M290 M412 M500 SYNC"},
    {Safe, Klipper, false,
     "BED_MESH_CALIBRATE BED_MESH_CLEAR QUAD_GANTRY_LEVEL Z_TILT_ADJUST SCREWS_TILT_CALCULATE SAVE_GCODE_STATE "
     "RESTORE_GCODE_STATE SET_VELOCITY_LIMIT TEMPERATURE_WAIT STATUS GET_POSITION M204 M220-M221"},
    // Heaters and fans, whose targets are judged by value.
    {Safe, Marlin, false, "M104 M109 M140-M141 M190-M192 M106-M107 M123 M144 M155 M105 M114-M115 M119 M122"},
    {Safe, RepRap, false, "M568 M135"},
    {Safe, Prusa, false, "M142 M410.1"},
    {Safe, Klipper, false, "SET_HEATER_TEMPERATURE TURN_OFF_HEATERS SET_FAN_SPEED SET_TEMPERATURE_FAN_TARGET"},
    // Settings of printing that hold until the next file changes them.
    {Safe, Marlin, false,
     "M200-M205 M207-M209 M220-M221 M217 M302 M412-M413 M425 M486 M493 M572 M592-M593 M600-M603 M605 M851.1 M900 M569"},
    {Safe, RepRap, false, "M566-M567 M571-M572 M591-M593 M309 M309.1 M280"},
    {Safe, Klipper, false,
     "SET_PRESSURE_ADVANCE SET_RETRACTION GET_RETRACTION SET_INPUT_SHAPER EXCLUDE_OBJECT EXCLUDE_OBJECT_DEFINE "
     "EXCLUDE_OBJECT_START EXCLUDE_OBJECT_END SET_PRINT_STATS_INFO SET_FILAMENT_SENSOR QUERY_FILAMENT_SENSOR "
     "ACTIVATE_EXTRUDER SET_GCODE_OFFSET BED_MESH_PROFILE BED_MESH_OFFSET SYNC_EXTRUDER_MOTION PAUSE RESUME "
     "CLEAR_PAUSE TIMELAPSE_TAKE_FRAME SKEW_PROFILE"},
    // Screen, host, sound, light, pauses, progress.
    {Safe, Marlin, false,
     "M0-M1 M20-M21 M25 M27 M31 M73 M75-M78 M80 M85-M86 M108 M110 M113 M117-M118 M145 M149-M150 M154 M163-M166 M226 "
     "M240 "
     "M250 M256 M280 M282 M300 M355 M403-M407 M503 M504 M701-M702 M710 M808.1 M862.1-M862.9 M876 M911 M913.1"},
    {Safe, RepRap, false, "M36 M38 M39 M291-M292 M408-M409 M577"},
    {Safe, Wiki, false, "M5 M16 M74 M530-M532 M907"},
    {Safe, Klipper, false,
     "SET_DISPLAY_TEXT SET_DISPLAY_GROUP RESPOND SET_LED SET_LED_TEMPLATE QUERY_PROBE QUERY_ENDSTOPS"},
    // Printers' own start and end macros, by the names that their makers gave them.
    {Safe, Klipper, false,
     "PRINT_START START_PRINT PRINT_END END_PRINT PRINT_WARMUP SMART_PARK LINE_PURGE CLEAN_NOZZLE"},

    {Outlives, Marlin, false,
     "M92 M111 M121 M206 M210-M212 M218 M281 M290 M301 M304-M307 M340 M350-M351 M421-M423 M500-M501 M540 "
     "M569.1-M569.9 "
     "M665-M666 M851-M852 M860-M861 M864-M871 M905-M906 M908-M910 M912-M919"},
    {Outlives, RepRap, false,
     "M305 M308 M555-M556 M558 M562-M564 M569 M573 M579 M594 M668 M670-M672 M906 M913 M917 M950 M951 G31 G33"},
    {Outlives, Prusa, false, "G82-G83 G86-G88 M45-M47 M310"},
    {Outlives, Klipper, false,
     "SAVE_VARIABLE SET_GCODE_VARIABLE SET_PIN SET_SERVO SET_IDLE_TIMEOUT SET_TMC_FIELD INIT_TMC "
     "SET_EXTRUDER_ROTATION_DISTANCE "
     "SET_STEPPER_ENABLE Z_OFFSET_APPLY_PROBE Z_OFFSET_APPLY_ENDSTOP SET_SKEW SET_Z_THERMAL_ADJUST"},

    {Runs, RepRap, false, "M98 M99 M581-M582"},
    {Runs, Marlin, true, "M808"},
    {Runs, Klipper, false, "UPDATE_DELAYED_GCODE"},

    {Unfollowed, Marlin, false, "G18-G19 G26 G38 G38.1-G38.9 G5 G42 G76 M3-M4 M7-M11 M42 M48 M360-M365 M380-M381 M430"},
    {Unfollowed, Marlin, true, "G6 G53 G61 M428"},
    {Unfollowed, Marlin, false, "G33 G54-G59 G59.1-G59.9 G425"},
    {Unfollowed, RepRap, false, "G68 G93 VAR SET GLOBAL"},
    {Unfollowed, RepRap, true, "IF ELIF ELSE WHILE"},  // the lines below them may run many times or never
    {Unfollowed, RepRap, true, "M260-M261 M452 M574 M584-M585 M667 M669"},
    {Unfollowed, Klipper, true,
     "FORCE_MOVE SET_KINEMATIC_POSITION MANUAL_STEPPER STEPPER_BUZZ MANUAL_PROBE TESTZ SET_TMC_CURRENT "
     "SET_STEPPER_PHASE "
     "SET_DUAL_CARRIAGE_OFFSET"},
    {Unfollowed, Klipper, false, "TEST_RESONANCES MEASURE_AXES_NOISE PROBE_ACCURACY"},

    {Files, Marlin, true, "M23-M24 M26 M28-M30 M32-M34 M928"},
    {Files, RepRap, true, "M37 M470-M472 M505 M550-M554 M559-M560 M575 M586-M589 M929 M956"},
    {Files, Klipper, true,
     "RUN_SHELL_COMMAND RUN_GCODE_SHELL_COMMAND SDCARD_PRINT_FILE SDCARD_RESET_FILE SDCARD_LOOP SAVE_CONFIG "
     "CALL_REMOTE_METHOD ACTION_CALL_REMOTE_METHOD ACTION_RESPOND_INFO UPDATE_MANAGER"},

    {Never, Marlin, true, "M43 M81.1 M112 M303 M410 M502 M510-M513 M524 M575.1 M810-M819 M993-M999 D"},
    {Outlives, Marlin, false, "M81"},  // switches the power off, as some end blocks do
    {Never, RepRap, true, "M143 M570 M576 M952-M953"},
    {Never, Klipper, true,
     "RESTART FIRMWARE_RESTART HOST_RESTART PID_CALIBRATE MPC_CALIBRATE PROBE_CALIBRATE DELTA_CALIBRATE "
     "Z_ENDSTOP_CALIBRATE "
     "SHAPER_CALIBRATE SHUTDOWN REBOOT CANCEL_PRINT ACCEPT ABORT SET_HEATER_PID"},
};

// The page of a dialect.
unsigned sourceOf(GcodeFlavor flavor) {
  return 1U << static_cast<unsigned>(flavor);  // sources and dialects stand in one order
}

using Rows = std::map<std::string, std::vector<const CommandRow*>, std::less<>>;

// Enters a row under each of its commands, and under every number of its ranges.
void addNames(Rows& rows, const CommandRow& row) {
  std::string_view rest = row.names;
  while (!rest.empty()) {
    const std::size_t space = std::min(rest.find(' '), rest.size());
    const std::string_view name = rest.substr(0, space);
    rest.remove_prefix(std::min(space + 1, rest.size()));
    if (name.empty()) continue;
    const std::size_t dash = name.find('-');
    if (dash == std::string_view::npos) {
      rows[std::string(name)].push_back(&row);
      continue;
    }
    // Ranges count behind the letter (M201-M205) or behind the point (G38.1-G38.9).
    const std::string_view first = name.substr(0, dash);
    const std::string_view last = name.substr(dash + 1);
    const std::size_t point = first.find('.');
    const std::size_t begin = point == std::string_view::npos ? 1 : point + 1;
    int from = 0;
    int to = 0;
    std::from_chars(first.data() + begin, first.data() + first.size(), from);
    std::from_chars(last.data() + begin, last.data() + last.size(), to);
    for (int number = from; number <= to; ++number) {
      rows[std::string(first.substr(0, begin)) + std::to_string(number)].push_back(&row);
    }
  }
}

// The row for a command by its name: that for the dialect, else the one of the worst kind; null: none.
const CommandRow* rowOf(std::string_view name, GcodeFlavor flavor) {
  static const Rows rows = [] {
    Rows made;
    for (const CommandRow& row : kRows) addNames(made, row);
    return made;
  }();
  const auto found = rows.find(name);
  if (found == rows.end()) return nullptr;
  const CommandRow* worst = nullptr;
  for (const CommandRow* row : found->second) {
    if ((row->sources & sourceOf(flavor)) != 0) return row;
    if (worst == nullptr || worst->kind < row->kind) worst = row;
  }
  return worst;
}

// Tells whether a command homes, or changes what later coordinates mean: units, modes, offsets.
bool movesOrigin(const GcodeCommand& command) {
  return command.isAny('G', {20, 28, 30, 90, 91}) || command.isAny('M', {82, 83, 206, 290});
}

// The row for a command as it was read; null: none.
const CommandRow* rowOf(const GcodeCommand& command, GcodeFlavor flavor) {
  if (command.letter == 0) {
    const std::string name = upperCase(command.name);
    // Prusa's D codes read and write the memory: D0, D-1, D3.
    if (name.size() > 1 && name[0] == 'D' && (name[1] == '-' || (name[1] >= '0' && name[1] <= '9')))
      return rowOf("D", flavor);
    return rowOf(name, flavor);
  }
  if (command.letter == 'T') return rowOf("T", flavor);
  if (command.code < 0) return nullptr;
  const std::string name = command.letter + std::to_string(command.code);
  if (command.sub != 0) {
    if (const CommandRow* row = rowOf(name + "." + std::to_string(command.sub), flavor)) return row;
    // Marlin runs G1.5 as G1 and others do not, so that its effect cannot be followed.
    static constexpr CommandRow kOfAnother{Unfollowed, 0, true, ""};
    GcodeCommand whole = command;
    whole.sub = 0;
    if (readsWords(whole) || movesOrigin(whole)) return &kOfAnother;
  }
  // On Prusa's boards M555 takes the area of the print (Prusa-Firmware-Buddy: X Y W H), and their files do not say that
  // they are for these boards; on RepRapFirmware it takes a mode after P.
  if (name == "M555" && !wordsOf(command.rest).has('P')) return rowOf(name, GcodeFlavor::PrusaBuddy);
  // M993 with A switches the camera at Bambu's nozzle; without A it is Marlin's, which copies the flash memory.
  if (name == "M993" && flavor == GcodeFlavor::Bambu && wordsOf(command.rest).has('A')) return rowOf("M991", flavor);
  return rowOf(name, flavor);
}

// Tells whether an M command is followed by text, a file's name or a list of its own instead of words.
bool takesText(const GcodeCommand& command) {
  constexpr int kCodes[] = {16, 23, 28, 30, 32, 36, 98, 117, 118, 486, 550, 587, 862, 1002, 1006};
  const bool listed = std::find(std::begin(kCodes), std::end(kCodes), command.code) != std::end(kCodes);
  return command.letter == 'M' && (listed || (command.code >= 810 && command.code <= 819));
}

// Tells the same of any command; the named ones show a text, send it to the host, or name an object.
bool takesAnyText(const GcodeCommand& command) {
  if (command.letter != 0) return takesText(command);
  const std::string name = upperCase(command.name);
  return name == "SET_DISPLAY_TEXT" || name == "RESPOND" || name.starts_with("EXCLUDE_OBJECT");
}

bool holds(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

constexpr double kMostAdvance = 2.5;  // [s], greatest pressure advance: twice that of the longest tubes

// Limits for the numbers behind some letters of an M command.
struct NumberLimits {
  int code;
  std::string_view letters;
  double low;
  double high;
};
constexpr NumberLimits kLimits[] = {
    {17, "XYZE", -3, 3},  // current of Bambu's motors [A]
    {92, "E", 20, 10'000},
    {201, "XYZEPRTS", 1, 200'000},
    {203, "XYZE", 0.1, 60'000},  // [mm/s], or [mm/min] for RepRapFirmware
    {204, "PRTS", 10, 200'000},
    {205, "XYZE", -200, 200},
    {205, "J", 0, 1},
    {206, "Z", -kMostLowered, kMostLowered},  // firmwares differ in which sign lowers the nozzle
    {207, "S", -25, 25},
    {207, "Z", -20, 20},
    {208, "S", -5, 5},
    {208, "Z", -kMostLowered, 5000},
    {218, "Z", -5, 5},
    {220, "S", 20, 200},
    {221, "S", 20, 200},
    {290, "Z", -kMostLowered, kMostOffset},
    {421, "ZQ", -2, 2},
    {425, "XYZ", -1, 1},
    {428, "Z", -kMostLowered, kMostOffset},
    {558, "H", 0, 100},
    {566, "XYZE", -12'000, 12'000},  // [mm/min]
    {572, "S", -kMostAdvance, kMostAdvance},
    {600, "Z", 0, 500},
    {603, "UL", -2000, 2000},
    {666, "XYZ", -2, 2},
    {851, "Z", -10, 10},
    {906, "XYZE", 50, 2000},  // [mA]; a motor without current lets its axis fall
    {906, "IJKS", 0, 2000},
    {907, "XYZE", 50, 2000},
    {907, "IJKS", 0, 2000},
    {913, "XYZE", 0, 200},
};

// Limits for the parameters of Klipper's named commands.
struct NamedLimits {
  std::string_view name;
  std::string_view key;
  double low;
  double high;
};
constexpr NamedLimits kNamedLimits[] = {
    {"SET_VELOCITY_LIMIT", "ACCEL", 1, 200'000},
    {"SET_VELOCITY_LIMIT", "ACCEL_TO_DECEL", 1, 200'000},
    {"SET_VELOCITY_LIMIT", "VELOCITY", 1, 200'000},
    {"SET_VELOCITY_LIMIT", "SQUARE_CORNER_VELOCITY", 0, 200},
    {"SET_VELOCITY_LIMIT", "MINIMUM_CRUISE_RATIO", 0, 1},
    {"SET_PRESSURE_ADVANCE", "ADVANCE", -kMostAdvance, kMostAdvance},
    {"SET_RETRACTION", "RETRACT_LENGTH", 0, 25},
    {"BED_MESH_CALIBRATE", "HORIZONTAL_MOVE_Z", 1, 100},
    {"SET_EXTRUDER_ROTATION_DISTANCE", "DISTANCE", 1, 1000},
};

// Letters that make an M command riskier than its row says: with them it switches pins of heaters, or changes the steps
// per mm, the heater that a fan cools, the limits of axes, or a motor's sense.
struct Telling {
  int code;
  std::string_view letters;
  std::string_view sentence;
  bool error;
};
constexpr Telling kTold[] = {
    {42, "I", "never", true},        {92, "XYZ", "unfollowed", true}, {106, "H", "never", true},
    {208, "XYZ", "outlives", false}, {569, "P", "unfollowed", true},
};

// Judges a line of code: its first command, and what some firmware may run behind that.
class Judge {
 public:
  Judge(std::string_view code, GcodeFlavor flavor, double hottestNozzle, double hottestBed, bool strict)
      : flavor_(flavor), hottestNozzle_(hottestNozzle), hottestBed_(hottestBed), strict_(strict) {
    command(code, 0);
  }
  std::vector<GcodeFinding> take() { return std::move(findings_); }

 private:
  static constexpr int kMostCommands = 100;     // most commands of one line that are judged; ends the recursion
  static constexpr double kRoom = 25;           // [degrees Celsius], coolest target that a heater may wait for
  static constexpr double kLongestWait = 3600;  // [s], longest pause by G4

  // Adds a finding, unless the line already has one with the same sentence.
  void add(std::string_view code, bool error, FindingValues values) {
    GcodeFinding finding = makeFinding(code, error, std::move(values));
    for (const GcodeFinding& other : findings_) {
      if (other.message == finding.message) return;
    }
    findings_.push_back(std::move(finding));
  }

  // Adds a finding whose sentence names the command and nothing else.
  void told(std::string_view code, bool error, const std::string& command) { add(code, error, {{"command", command}}); }

  // Judges a command and what follows it. `depth` counts the commands in front of it in the same line.
  void command(std::string_view code, int depth) {
    const std::size_t written = code.size();
    // Skips remarks in brackets, a block's mark, and whatever else firmwares skip before the first letter.
    while (!code.empty()) {
      if (code[0] == '(') {
        const std::size_t end = code.find(')');
        code.remove_prefix(end == std::string_view::npos ? code.size() : end + 1);
      } else if ((code[0] >= 'A' && code[0] <= 'Z') || (code[0] >= 'a' && code[0] <= 'z') || code[0] == '_' ||
                 code[0] == '@') {
        break;
      } else {
        code.remove_prefix(1);
      }
    }
    if (code.empty() || depth > kMostCommands) return;
    second_ = second_ || code.size() < written;
    const GcodeCommand head = commandOf(code);
    const std::string shown = shownName(head);
    const CommandRow* row = rowOf(head, flavor_);
    byKind(head, row, shown, depth);
    byValue(head, shown);
    // Some firmwares run a command behind another one or behind a remark; others do not.
    if (second_ && head.letter == 'G' && (readsWords(head) || movesOrigin(head))) {
      told("unfollowed", true, shown);
    }
    // Some firmwares read a number with a sign, as in G+1 or M-1, and run the command.
    if (head.letter == 0 && code.size() > 1 && (code[1] == '+' || code[1] == '-') && holds("GMgm", code.substr(0, 1))) {
      add("no-command", true, {{"text", shownText(code)}});
    }
    if (depth > 0 && head.letter == 0) return;
    further(head, depth);
  }

  // Name of a command as a sentence shows it: upper case, no quotes.
  [[nodiscard]] static std::string shownName(const GcodeCommand& head) {
    const std::string text = shownText(upperCase(head.name));
    return text.substr(1, text.size() - 2);
  }

  // Adds the finding that the row asks for; about macros and unknown commands only if strict.
  void byKind(const GcodeCommand& head, const CommandRow* row, const std::string& shown, int depth) {
    if (row == nullptr) {
      if (!strict_ || depth > 0) return;
      const bool macro = head.letter == 0 && !head.name.starts_with('@');
      if (!isStartMacro(head) && !isEndMacro(head)) told(macro ? "macro" : "unknown", false, shown);
      return;
    }
    constexpr const char* kSentences[] = {nullptr, "outlives", "runs", "unfollowed", "files", "never"};
    if (row->kind != Safe) told(kSentences[row->kind], row->error, shown);
  }

  // Adds a finding if a target is above its limit [degrees Celsius].
  void heat(double degrees, double limit) {
    if (degrees > limit) add("too-hot", true, {{"limit", decimal(limit, 0)}, {"degrees", decimal(degrees, 1)}});
  }

  // Adds the finding about a number that is not within its limits.
  void beyond(const std::string& what, double value, double low, double high) {
    add("out-of-range", true,
        {{"command", what}, {"value", decimal(value, 3)}, {"low", decimal(low, 3)}, {"high", decimal(high, 3)}});
  }

  // Judges R, with which a command waits for cooling, too: in a warm room, less than kRoom is never reached.
  void coolest(const GcodeWords& words, const std::string& shown) {
    if (words.at('R', kRoom) < kRoom && words.at('R') > 0) beyond(shown + " R", words.at('R'), kRoom, 500);
  }

  // Judges the numbers of a command with a letter.
  void byValue(const GcodeCommand& head, const std::string& shown) {
    if (head.letter == 0) return byName(head, shown);
    if (takesText(head)) return;
    const GcodeWords words = wordsOf(head.rest);
    // Firmwares disagree on the value of S1e3 and S1_0, but not on M115 U3.11.0 and M906 X800:800.
    const bool odd =
        words.fault == GcodeWords::NotPlain && words.faultText.find_first_of("eE_", 1) != std::string_view::npos;
    const bool power = head.letter == 'M' && readsWords(head) && words.crowded && words.has('E');  // M104 S48E1
    if (odd || power) add("no-plain-number", true, {{"text", shownText(odd ? words.faultText : head.rest)}});
    const auto within = [&](std::string_view letters, double low, double high) {
      for (const char letter : letters) {
        const double value = words.at(letter, low);
        if (value < low || value > high) beyond(shown + " " + letter, value, low, high);
      }
    };
    const auto hottest = [&](double limit) {
      for (const char letter : {'S', 'R', 'I', 'B', 'F'}) {
        if (words.has(letter)) heat(words.at(letter), limit);
      }
    };
    if (head.letter == 'G') {
      if (head.code == 4) {
        const double minutes = std::max(words.at('S') / 60, words.at('P') / 60000);
        within("S", 0, kLongestWait);
        within("P", 0, 1000 * kLongestWait);  // below 0, Marlin would wait for weeks
        if (minutes > 10) add("long-wait", false, {{"command", shown}, {"minutes", decimal(minutes, 0)}});
      }
      if (setsTool(head, words)) hottest(hottestNozzle_);
      if (head.code == 10 && (words.has('P') || words.has('L'))) within("Z", -kMostLowered, kMostLowered);
      // G29 with a Z above 0, but without P and S, raises the print.
      const bool raises = !words.has('P') && !words.has('S') && words.at('Z') > 0;
      if (head.code == 29 && (head.sub > 0 || !raises)) within("ZC", -1, 1);
      if (head.code == 31 && words.has('Z')) {
        within("Z", -5, 5);
        told("outlives", false, shown);
      }
      if (head.code <= 1 && head.code >= 0 && words.has('R')) told("unfollowed", true, shown);
      return;
    }
    if (head.letter != 'M') return;
    for (const NumberLimits& limits : kLimits) {
      if (limits.code == head.code) within(limits.letters, limits.low, limits.high);
    }
    for (const Telling& telling : kTold) {
      const bool named =
          std::any_of(telling.letters.begin(), telling.letters.end(), [&](char letter) { return words.has(letter); });
      if (telling.code == head.code && head.sub == 0 && named) told(telling.sentence, telling.error, shown);
    }
    if (head.code == 109 || head.code == 190 || head.code == 191) coolest(words, shown);
    switch (head.code) {
      case 104:
      case 109:
      case 568:
        return hottest(hottestNozzle_);
      case 140:
      case 144:
      case 190:
        return hottest(hottestBed_);
      case 141:
      case 142:
      case 191:
      case 192:
        return hottest(100);
      case 620:
        if (head.sub == 1 && words.has('T')) heat(words.at('T'), hottestNozzle_);
        return;
      case 145:
        if (words.has('H')) heat(words.at('H'), hottestNozzle_);
        if (words.has('B')) heat(words.at('B'), hottestBed_);
        return;
      case 149:
        if (!holds(upperCase(head.rest), "C")) told("never", true, shown);  // any other unit than degrees Celsius
        return;
      case 122:
        if (words.at('P') >= 1000) told("never", true, shown);  // runs tests that stop the machine
        return;
      case 302:
        if ((words.has('P') && words.at('P') > 0 && words.at('S', 999) >= 170) || words.at('S', 999) < 150)
          told("cold-extrusion", false, shown);
        return;
      case 211:
        if (flavor_ != GcodeFlavor::Bambu && words.has('S') && words.at('S') == 0) told("outlives", false, shown);
        return;
      default:
        return;
    }
  }

  // Judges the parameters of a named command: those with limits, and those that set a temperature.
  void byName(const GcodeCommand& head, const std::string& shown) {
    const std::string name = upperCase(head.name);
    const std::string words = upperCase(head.rest);
    if (name == "BED_MESH_PROFILE" && (holds(words, "SAVE") || holds(words, "REMOVE"))) told("outlives", false, shown);
    if (name == "RESPOND") toHost(words, shown);
    if (name == "ECHO" && holds(words, ">")) told("files", true, shown);  // RepRapFirmware's `echo >` writes a file
    if (name == "RESTORE_GCODE_STATE" || name == "EXCLUDE_OBJECT_DEFINE") return;
    const bool limits = name == "SET_VELOCITY_LIMIT";
    const bool advance = name == "SET_PRESSURE_ADVANCE";
    const bool offset = name == "SET_GCODE_OFFSET";
    const bool wait = name == "TEMPERATURE_WAIT";
    const bool heater = wait || name == "SET_HEATER_TEMPERATURE";
    const bool numbers = limits || advance || offset || heater;
    const bool nozzle = holds(words, "=EXTRUDER") || holds(words, "EXTRUDER\"") || holds(words, "EXTRUDER'") || !heater;
    const bool hotend = name == "SET_FAN_SPEED" && (holds(words, "HOTEND") || holds(words, "HEATER"));
    double minimum = 0;
    forEachParameter(head.rest, [&](const std::string& key, std::string_view text) {
      double value = 0;
      const std::size_t read = readNumber(text, value);
      // Klipper reads numbers as Python does: 4_80 is 480, 4e2 is 400, and "4"80 is 480.
      const std::string_view rest = head.rest.substr(text.data() - head.rest.data());
      const std::size_t next = std::min(text.size() + 1, rest.size());
      const bool glued = rest.substr(text.size(), 1).find_first_of("\"'") == 0 && rest.substr(next, 1) > " ";
      const bool number = numbers
                              ? key != "HEATER" && key != "SENSOR" && key != "EXTRUDER"
                              : read > 0 && macroHeat(key) != MacroHeat::None && holds("_eE\"'", text.substr(read, 1));
      if (number && (glued || read < text.size())) add("no-plain-number", true, {{"text", shownText(text)}});
      if (read == 0) return;
      const std::string what = shown + " " + key;
      for (const NamedLimits& own : kNamedLimits) {
        if (own.name != name || own.key != key) continue;
        return value < own.low || value > own.high ? beyond(what, value, own.low, own.high) : void();
      }
      if (hotend && key == "SPEED" && value < 1) return told("never", true, shown);
      if (wait && key == "MINIMUM") minimum = value;
      if (wait && key == "MAXIMUM" && value < minimum) return beyond(what, value, minimum, 500);
      if (offset && holds(key, "Z")) {
        if (value < -kMostLowered || value > kMostOffset) beyond(what, value, -kMostLowered, kMostOffset);
        return;
      }
      if (wait && key == "MAXIMUM" && value < kRoom) return beyond(what, value, kRoom, 500);
      // Keys with these words give a macro or a heater its temperature.
      if (holds(key, "BED")) return heat(value, hottestBed_);
      if (holds(key, "CHAMBER")) return heat(value, 100);
      if (holds(key, "TEMP") || holds(key, "TARGET") || holds(key, "EXTRUDER") || holds(key, "HOTEND") ||
          holds(key, "NOZZLE") || key == "TOOL0" || (wait && key == "MINIMUM")) {
        heat(value, nozzle ? hottestNozzle_ : hottestBed_);
      }
    });
  }

  // Judges text for the host, which may tell it to pause, cancel, shut down or ask the user; a notification is only
  // shown.
  void toHost(const std::string& words, const std::string& shown) {
    const std::size_t at = words.find("ACTION");
    if (at != std::string::npos && words.compare(at, 19, "ACTION:NOTIFICATION") != 0) told("runs", true, shown);
  }

  // Judges what follows a command: RepRapFirmware runs several commands of a line, old Marlins what follows ':' or '#'.
  void further(const GcodeCommand& head, int depth) {
    if (takesText(head)) {
      if (head.code == 118) toHost(upperCase(head.rest), "M118");
      second_ = true;
      const std::size_t cut = head.rest.find_first_of(":#");
      if (cut != std::string_view::npos) dangerous(head.rest.substr(cut + 1), depth);
      // RepRapFirmware reads on behind the text of these three.
      if (head.code != 486 && head.code != 862 && head.code != 1002) return;
      const std::size_t text = head.rest.rfind('"');
      for (std::size_t at = text == std::string_view::npos ? 1 : text + 1; at + 1 < head.rest.size(); ++at) {
        const bool word = at > 0 && head.rest[at - 1] <= ' ' && holds("GMgm", head.rest.substr(at, 1));
        if (word && head.rest[at + 1] >= '0' && head.rest[at + 1] <= '9') return dangerous(head.rest.substr(at), depth);
      }
      return;
    }
    if (head.letter == 0) return;
    if (head.is('M', 106) && holds(head.rest, " N")) return;  // fans of Prusa's chambers: M106 P3 N76 G3
    for (std::size_t at = 1; at < head.rest.size(); ++at) {
      const char letter = head.rest[at];
      if (letter == '"') {
        at = std::min(head.rest.find('"', at + 1), head.rest.size());
        continue;
      }
      if (letter != 'G' && letter != 'M' && letter != 'g' && letter != 'm') continue;
      if (at + 1 < head.rest.size() && head.rest[at + 1] >= '0' && head.rest[at + 1] <= '9') {
        second_ = true;
        return dangerous(head.rest.substr(at), depth);
      }
    }
  }

  // Judges what may or may not be a command, and keeps only the errors.
  void dangerous(std::string_view code, int depth) {
    const std::size_t before = findings_.size();
    command(trimmed(code), depth + 1);
    findings_.erase(std::remove_if(findings_.begin() + static_cast<std::ptrdiff_t>(before), findings_.end(),
                                   [](const GcodeFinding& finding) { return !finding.error; }),
                    findings_.end());
  }

  GcodeFlavor flavor_;
  double hottestNozzle_;
  double hottestBed_;
  bool strict_;
  bool second_ = false;  // the command stands behind another one of its line, or behind a remark
  std::vector<GcodeFinding> findings_;
};

}  // namespace

const char* spellingFault(std::string_view line) {
  const std::string_view code = partsOf(line).code;
  const bool text = takesAnyText(commandOf(code));
  const bool letter = !code.empty() && upperCase(code.substr(0, 1)) >= "A" && upperCase(code.substr(0, 1)) <= "Z";
  bool quoted = false;
  for (std::size_t at = 0; at < line.size(); ++at) {
    const char c = line[at];
    if (c == '"') quoted = !quoted;
    if (c == ';') {
      quoted = quoted && (!text || holds(line.substr(at), "\""));
      return quoted ? "no-plain-line" : nullptr;
    }
    if (text) continue;
    if ((c < ' ' && c != '\t') || c > '~') return "no-ascii";
    if (c == '\\') return "no-plain-line";
    // Marlin may cut a remark in brackets out of the words around it.
    const std::size_t behind = letter && c == ')' ? line.find_first_not_of(" \t", at + 1) : std::string_view::npos;
    if (behind != std::string_view::npos && line[behind] != ';' && !quoted) return "no-plain-line";
  }
  return quoted && !text ? "no-plain-line" : nullptr;
}

bool probesBed(const GcodeCommand& command) {
  if (command.isAny('G', {29, 30, 32, 34})) return true;
  const std::string name = command.letter == 0 ? upperCase(command.name) : std::string();
  return name == "QUAD_GANTRY_LEVEL" || name == "Z_TILT_ADJUST" || name == "BED_MESH_CALIBRATE" || name == "PROBE" ||
         name == "SCREWS_TILT_CALCULATE";
}

bool homesZ(const GcodeCommand& command) {
  if (!command.is('G', 28)) return false;
  const std::string words = upperCase(command.rest);
  const auto names = [&](char axis) { return words.find(axis) != std::string::npos; };
  return names('Z') || !(names('X') || names('Y'));
}

std::vector<GcodeFinding> judgeCommand(std::string_view code, GcodeFlavor flavor, double hottestNozzle,
                                       double hottestBed, bool strict) {
  return Judge(code, flavor, hottestNozzle, hottestBed, strict).take();
}

}  // namespace sillon
