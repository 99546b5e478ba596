#include "sillon/gcode_check.hpp"

#include <fast_float/fast_float.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bed.hpp"
#include "gcode_coverage.hpp"
#include "gcode_grammar.hpp"
#include "text.hpp"

namespace sillon {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRounding = 0.0015;         // [mm], coordinates have 3 decimals
constexpr double kBeyondBed = 10;            // [mm], how far makers' start blocks go to wipe and purge
constexpr double kLongTravel = 2;            // [mm], shorter ones draw no thread
constexpr double kCoast = 1.01;              // [mm], travel at a path's end that still belongs to it
constexpr double kColdest = 170;             // [degrees Celsius]
constexpr double kLongestPrime = 50;         // [mm of filament], Klipper's max_extrude_only_distance
constexpr std::size_t kWindow = 8;           // [moves], half of a small firmware's buffer
constexpr double kLongNoise = 1;             // [mm], a zigzag of longer legs is meant
constexpr double kNoiseStep = 0.0001;        // [mm]
constexpr double kMostNoise = 0.005;         // [mm], more makes planners brake
constexpr double kLeastCovered = 0.9;        // of the base
constexpr std::size_t kMostBeads = 4000000;  // whose coverage is judged, in 100 MB
constexpr double kTotalSlack = 0.006;        // [mm], two decimals
constexpr double kForeignTotalSlack = 0.02;  // of other programs, who count their start block or do not

enum class Letter { E, F, I, J, P, R, S, T, X, Y, Z, Count };
constexpr std::string_view kLetters = "EFIJPRSTXYZ";

struct Words {
  std::array<double, static_cast<std::size_t>(Letter::Count)> values{};
  std::array<bool, static_cast<std::size_t>(Letter::Count)> given{};
  [[nodiscard]] bool has(Letter letter) const { return given[static_cast<std::size_t>(letter)]; }
  [[nodiscard]] double at(Letter letter, double otherwise = 0) const {
    return has(letter) ? values[static_cast<std::size_t>(letter)] : otherwise;
  }
};

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

std::string shown(std::string_view text) {
  std::string out = "\"";
  for (const char c : text.substr(0, 60)) out += c < ' ' || c > '~' || c == '"' ? '?' : c;
  return out + "\"";
}

// The number a text begins with, as firmwares read it: no exponent. \return characters read.
std::size_t readNumber(std::string_view text, double& value) {
  const std::size_t sign = text.starts_with('+') ? 1 : 0;
  std::size_t end = sign + (text.substr(sign).starts_with('-') ? 1 : 0);
  while (end < text.size() && ((text[end] >= '0' && text[end] <= '9') || text[end] == '.')) ++end;
  const auto read =
      fast_float::from_chars(text.data() + sign, text.data() + end, value, fast_float::chars_format::fixed);
  if (read.ec != std::errc{} || !(std::abs(value) < 1e9)) return 0;
  return static_cast<std::size_t>(read.ptr - text.data());
}

std::optional<double> numberAfter(std::string_view text, std::string_view key) {
  if (!text.starts_with(key)) return std::nullopt;
  double value = 0;
  const std::string_view rest = trimmed(text.substr(key.size()));
  return readNumber(rest, value) > 0 ? std::optional<double>(value) : std::nullopt;
}

bool contains(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

// Klipper's and others' macros home and heat by themselves: PRINT_START, START_PRINT and their kin.
bool isMacro(std::string_view line, std::string_view what) {
  const std::string_view head = line.substr(0, line.find(' '));
  return contains(head, what) && contains(head, "PRINT") &&
         head.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789") == std::string_view::npos;
}

// PrusaSlicer, Cura and Orca; Orca and Bambu Studio for Bambu's printers; Simplify3D.
enum class LayerMark { None, Usual, Bambu, Simplify };

LayerMark layerMark(std::string_view comment) {
  if (comment == "LAYER_CHANGE" || comment.starts_with("LAYER:")) return LayerMark::Usual;
  if (comment == "CHANGE_LAYER") return LayerMark::Bambu;
  return comment.starts_with("layer ") && contains(comment, ", Z = ") ? LayerMark::Simplify : LayerMark::None;
}

// What the comments of any slicer say of the machine, where the caller does not.
struct Machine {
  std::optional<Printer> printer;  // bed and limits, if given
  Bounds bed;                      // else: the box of bed_shape
  double maxZ = 0;                 // 0: unknown
  double nozzle = 0;
  double filamentDiameter = 1.75;
  bool klipper = false;
};

// "0x0,220x0,220x220,0x220"
Bounds readBed(std::string_view text) {
  Bounds box;
  while (!text.empty()) {
    Vec2 corner;
    const std::size_t x = readNumber(text, corner.x);
    if (x == 0 || x >= text.size() || text[x] != 'x') return {};
    text.remove_prefix(x + 1);
    const std::size_t y = readNumber(text, corner.y);
    if (y == 0) return {};
    text.remove_prefix(y);
    if (text.starts_with(',')) text.remove_prefix(1);
    box.add(corner);
  }
  return box;
}

// Settings stand behind the moves in most files, so they are read first.
Machine machineOf(std::string_view text, const std::optional<Printer>& printer) {
  Machine machine;
  machine.printer = printer;
  if (printer) {
    machine.maxZ = printer->maxZ;
    machine.nozzle = printer->nozzle;
    machine.filamentDiameter = printer->filamentDiameter;
    machine.klipper = printer->flavor == GcodeFlavor::Klipper;
    return machine;
  }
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    at = end + 1;
    if (!line.starts_with(';')) continue;
    const std::string_view comment = trimmed(line.substr(1));
    const auto number = [&](std::string_view key, double low, double high, double& out) {
      const auto value = numberAfter(comment, key);
      if (value && *value >= low && *value <= high) out = *value;
    };
    number("nozzle_diameter =", 0.05, 2, machine.nozzle);
    number("filament_diameter =", 0.5, 5, machine.filamentDiameter);
    number("max_print_height =", 1, 5000, machine.maxZ);
    number("printable_height =", 1, 5000, machine.maxZ);
    for (const std::string_view key : {"bed_shape = ", "printable_area = "}) {
      if (comment.starts_with(key)) machine.bed = readBed(comment.substr(key.size()));
    }
    if (comment.starts_with("gcode_flavor = klipper")) machine.klipper = true;
  }
  return machine;
}

class Reader {
 public:
  Reader(Machine machine, bool ours) : machine_(std::move(machine)), ours_(ours) {
    area_ = kPi * machine_.filamentDiameter * machine_.filamentDiameter / 4;
  }

  void line(std::string_view raw);
  GcodeCheck finish();

 private:
  void found(const char* rule, bool error, std::string_view kind, const std::string& message);
  void comment(std::string_view text);
  void command(std::string_view text);
  void startMacro(std::string_view text);
  void gCode(int code, std::string_view rest);
  void mCode(int code, std::string_view rest);
  bool words(std::string_view text, Words& words);
  void move(int code, const Words& words);
  void bead(Vec2 from, Vec2 to, double length, double e);
  void travel(double length);
  void filament(double e);
  void endPath();
  void checkPlace(Vec2 p, const char* what);
  void checkRate(double seconds);
  void follow(Vec2 p);
  void lay(Vec2 from, Vec2 to, double section);
  void judgeLayers();
  void endLayer();

  [[nodiscard]] bool block() const { return layers_ == 0 || custom_; }

  Machine machine_;
  bool ours_;
  GcodeCheck check_;
  double area_ = 0;

  bool absolute_ = true;
  bool absoluteE_ = true;
  bool inches_ = false;
  Vec2 at_;
  double z_ = 0;
  bool zKnown_ = false;     // told since the last homing
  double startHeight_ = 0;  // of a print on the bed, in files of ours
  double e_ = 0;
  double speed_ = 0;  // [mm/s]
  bool endMacro_ = false;
  bool moved_ = false;  // a bead was laid
  double retracted_ = 0;
  bool firmwareRetracted_ = false;

  int layers_ = 0;
  LayerMark layerMark_ = LayerMark::None;
  bool custom_ = false;
  bool oriented_ = false;
  bool inPath_ = false;
  bool pathOriented_ = false;
  Vec2 pathStart_;
  Vec2 pathEnd_;
  double coasted_ = 0;
  std::array<double, kWindow> window_{};  // [s] of the last moves of a path
  std::size_t windowed_ = 0;
  std::vector<Vec2> trail_;                   // of an oriented path, the last five points
  std::array<std::int64_t, 1000> zigzags_{};  // vertices by amplitude, in steps of kNoiseStep
  std::vector<LaidBead> beads_;
  bool base_ = false;
  double layerFastest_ = 0;  // of its oriented beads
  double layerSlowedMm_ = 0;
  double layerAtFastestMm_ = 0;
  double layerHeight_ = 0;
  double flow_ = 1;      // of oriented layers
  double baseFlow_ = 1;  // not told by files: as it mostly is
  double fileTotal_ = -1;
  int fileLayers_ = -1;
  double counted_ = 0;  // [mm of filament] outside start and end blocks
};

void Reader::found(const char* rule, bool error, std::string_view kind, const std::string& message) {
  // One entry per rule and kind of fault; the kind is the message's first words.
  for (GcodeFinding& finding : check_.findings) {
    if (finding.rule == rule && finding.error == error && finding.message.starts_with(kind)) {
      ++finding.count;
      return;
    }
  }
  check_.findings.push_back({rule, error, check_.lines, 1, std::string(kind) + message});
}

void Reader::line(std::string_view raw) {
  ++check_.lines;
  if (raw.ends_with('\r')) {
    found("grammar", ours_, "lines end with CR LF", "; LF alone is what every host reads");
    raw.remove_suffix(1);
  }
  if (ours_ && !block()) {
    if (const char* fault = lineFault(raw); fault != nullptr)
      found("grammar", true, "the line ", shown(raw) + " " + fault);
  }
  std::string_view code = raw;
  if (const std::size_t semicolon = raw.find(';'); semicolon != std::string_view::npos) {
    code = raw.substr(0, semicolon);
    if (trimmed(code).empty()) comment(trimmed(raw.substr(semicolon + 1)));
  }
  code = trimmed(code);
  if (!code.empty()) command(code);
}

void Reader::comment(std::string_view text) {
  // Ours for Bambu's printers have two marks for each layer: the kind that comes first counts.
  const LayerMark mark = layerMark(text);
  if (layerMark_ == LayerMark::None) layerMark_ = mark;
  if (mark != LayerMark::None && mark == layerMark_) {
    endPath();
    endLayer();
    ++layers_;
  }
  if (text.starts_with("TYPE:") || text.starts_with("FEATURE: ")) {
    endPath();
    const std::string_view role = trimmed(text.substr(text.find(':') + 1));
    custom_ = role == "Custom";
    oriented_ = role == "Top solid infill" || role == "Top surface";
    base_ = role == "Solid infill" || role == "Internal solid infill";
  }
  if (text.starts_with("printer_model = ")) check_.printer = std::string(text.substr(16, 60));
  if (ours_ && layers_ == 0) startHeight_ = numberAfter(text, "start height =").value_or(startHeight_);
  if (const auto value = numberAfter(text, "HEIGHT:")) layerHeight_ = *value;
  if (const std::size_t at = text.find(", flow = "); ours_ && layers_ == 0 && at != std::string_view::npos) {
    flow_ = std::clamp(numberAfter(text.substr(at + 2), "flow =").value_or(1), 0.01, 2.0);
  }
  if (const auto value = numberAfter(text, "filament used [mm] =")) fileTotal_ = *value;
  if (const auto value = numberAfter(text, "total layers count =")) {
    fileLayers_ = static_cast<int>(std::clamp(*value, 0.0, 1e6));
  }
}

// Letters with numbers. What is no plain number is read as far as a firmware would.
bool Reader::words(std::string_view text, Words& words) {
  bool plain = true;
  std::array<bool, 26> seen{};
  std::size_t at = 0;
  bool spaced = true;
  while (at < text.size()) {
    const char c = text[at];
    if (c == ' ' || c == '\t') {
      spaced = true;
      ++at;
      continue;
    }
    const bool lower = c >= 'a' && c <= 'z';
    const char upper = lower ? static_cast<char>(c - 'a' + 'A') : c;
    if (upper < 'A' || upper > 'Z') {
      found("grammar", true, "not a word: ", shown(text.substr(at)));
      return false;
    }
    if (lower) found("grammar", false, "lower case letters", " in " + shown(text) + "; some firmwares skip them");
    if (!spaced) found("grammar", false, "words without spaces between them", " in " + shown(text));
    if (seen[static_cast<std::size_t>(upper - 'A')])
      found("grammar", true, "a letter given twice", " in " + shown(text));
    seen[static_cast<std::size_t>(upper - 'A')] = true;
    spaced = false;
    ++at;
    // The next word begins at a blank or at a letter; E and other exponents belong to this one.
    std::size_t end = at;
    while (end < text.size() && text[end] != ' ' && text[end] != '\t' &&
           !(text[end] >= 'A' && text[end] <= 'Z' && end > at)) {
      ++end;
    }
    double value = 0;
    const std::size_t read = readNumber(text.substr(at, end - at), value);
    const bool exponent = read > 0 && end < text.size() && text[end] == 'E' && end + 1 < text.size() &&
                          (text[end + 1] == '-' || text[end + 1] == '+');
    if (exponent) end = std::min(text.find_first_of(" \t", end), text.size());
    if (read == 0) {
      found("grammar", true, "no number", " after a letter in " + shown(text));
      plain = false;
    } else if (exponent || at + read < end || (ours_ && !isPlainNumber(text.substr(at, read)))) {
      found("grammar", true, "no plain number: ", shown(text.substr(at - 1, end - at + 1)));
    }
    at = end;
    const std::size_t index = kLetters.find(upper);
    if (index == std::string_view::npos) continue;
    words.values[index] = value;
    words.given[index] = read > 0;
  }
  return plain;
}

// The hottest value is the nozzle's, the next one the bed's.
void Reader::startMacro(std::string_view text) {
  check_.homes = true;
  for (std::size_t equal = text.find('='); equal != std::string_view::npos; equal = text.find('=', equal + 1)) {
    double value = 0;
    if (readNumber(text.substr(equal + 1), value) == 0) continue;
    if (value >= kColdest) {
      check_.nozzleTarget = value;
      check_.heatsNozzle = true;
    } else if (value > 0) {
      check_.bedTarget = value;
      check_.heatsBed = true;
    }
  }
}

void Reader::command(std::string_view text) {
  if (text.size() > 95) found("grammar", false, "a command of more than 95 characters", ", which Marlin cuts");
  if (isMacro(text, "START")) {
    startMacro(text);
    return;
  }
  if (isMacro(text, "END")) {
    endMacro_ = true;
    return;
  }
  if (text[0] == 'N') {  // a host's line number, and its checksum at the end
    found("grammar", false, "line numbers", "; they belong to a host's protocol, not into a file");
    double number = 0;
    text = trimmed(text.substr(1 + readNumber(text.substr(1), number)));
    text = trimmed(text.substr(0, text.rfind('*')));
    if (text.empty()) return;
  }
  if (!((text[0] >= 'A' && text[0] <= 'Z') || (text[0] >= 'a' && text[0] <= 'z') || text[0] == '_')) {
    return found("grammar", false, "no command: ", shown(text));
  }
  const char letter = text[0] >= 'a' && text[0] <= 'z' ? static_cast<char>(text[0] - 'a' + 'A') : text[0];
  double number = 0;
  const std::size_t digits = readNumber(text.substr(1), number);
  if ((letter != 'G' && letter != 'M') || digits == 0) return;
  const std::string_view rest = text.substr(1 + digits);
  const int code = number == std::floor(number) && number <= 10000 ? static_cast<int>(number) : -1;
  if (letter == 'G') {
    gCode(code, rest);
  } else {
    mCode(code, rest);
  }
}

void Reader::gCode(int code, std::string_view rest) {
  Words w;
  if (code >= 0 && code <= 3) {
    if (words(rest, w)) move(code, w);
    return;
  }
  if ((code == 10 || code == 11) && words(rest, w) && !w.has(Letter::P)) {  // G10 P is RepRapFirmware's tool setting
    firmwareRetracted_ = code == 10;
    endPath();
  }
  if (code == 20 || code == 21) {
    inches_ = code == 20;
    if (inches_ && !block()) found("modes", true, "inches", " (G20); millimetres are what everything else here is in");
  }
  if (code == 28) {
    check_.homes = true;
    at_ = {};
    zKnown_ = false;
  }
  if (code == 90 || code == 91) absolute_ = absoluteE_ = code == 90;
  if (code == 92 && words(rest, w)) {
    const double unit = inches_ ? 25.4 : 1;
    e_ = w.at(Letter::E, e_ / unit) * unit;
    if (w.has(Letter::X) || w.has(Letter::Y) || w.has(Letter::Z)) {
      found("modes", !block(), "G92 moves the origin", " of an axis; places on the bed can no longer be told");
    }
    at_ = {w.at(Letter::X, at_.x / unit) * unit, w.at(Letter::Y, at_.y / unit) * unit};
    z_ = w.at(Letter::Z, z_ / unit) * unit;
  }
}

void Reader::mCode(int code, std::string_view rest) {
  switch (code) {
    case 82:
    case 83:
      absoluteE_ = code == 82;
      break;
    case 104:
    case 109:
    case 140:
    case 190: {
      Words w;
      if (!words(rest, w) || w.at(Letter::T) != 0) break;  // other tools are not ours to follow
      const double target = w.at(Letter::S, w.at(Letter::R, -1));
      if (target < 0) break;
      (code == 104 || code == 109 ? check_.nozzleTarget : check_.bedTarget) = target;
      if (code == 109 && target >= kColdest) check_.heatsNozzle = true;
      if (code == 190 && target > 0) check_.heatsBed = true;
      const bool any = machine_.printer && machine_.printer->anyTemperature;
      const double most = any ? 1e9 : code == 104 || code == 109 ? 300 : 120;
      if (target > most) found("heating", true, "hotter than ", decimal(most, 0) + " degrees: " + decimal(target, 1));
      break;
    }
    case 92:
    case 301:
    case 304:
    case 500:
    case 851:
      found("settings", ours_, "M" + std::to_string(code) + " outlives the print", "");
      break;
    case 200:
      found("modes", true, "volumetric extrusion", " (M200) changes what every E means");
      break;
    default:
      break;
  }
}

void Reader::checkPlace(Vec2 p, const char* what) {
  double over = -1;
  if (machine_.printer) {
    const Bed bed(*machine_.printer);
    over = bed.overhang(p, 0);
    if (moved_ && inPath_ && bed.inZone(p, -kRounding))
      found("bounds", true, "a bead in the excluded part of the bed", "");
  } else if (!machine_.bed.empty()) {
    const Bounds& bed = machine_.bed;
    over = std::max({bed.min.x - p.x, p.x - bed.max.x, bed.min.y - p.y, p.y - bed.max.y});
  }
  if (over <= kRounding) return;
  const std::string place = " at (" + decimal(p.x, 3) + ", " + decimal(p.y, 3) + "), " + decimal(over, 3) + " mm";
  if (block() && over <= kBeyondBed) {
    found("bounds", false, "the start or end block goes over the bed's edge", place);
  } else {
    found("bounds", true, std::string(what) + " over the bed's edge", place);
  }
}

void Reader::checkRate(double seconds) {
  window_[windowed_ % kWindow] = seconds;
  if (++windowed_ < kWindow) return;
  double sum = 0;
  for (const double part : window_) sum += part;
  if (!(sum > 0)) return;
  const double rate = static_cast<double>(kWindow) / sum;
  check_.mostMoves = std::max(check_.mostMoves, rate);
  // Lengths are read back from 3 decimals here and there.
  if (machine_.printer && rate > machine_.printer->maxSegmentsPerSecond * 1.001) {
    found("rate", false, "more moves per second than the printer takes", ": " + decimal(rate, 0));
  }
}

void Reader::move(int code, const Words& w) {
  ++check_.moves;
  const double unit = inches_ ? 25.4 : 1;
  if (w.has(Letter::F)) {
    speed_ = w.at(Letter::F) * unit / 60;
    if (!(speed_ > 0)) found("speed", true, "F is not above 0", "");
  }
  const Vec2 from = at_;
  const double zFrom = z_;
  const auto target = [&](Letter letter, double now) {
    if (!w.has(letter)) return now;
    return absolute_ ? w.at(letter) * unit : now + w.at(letter) * unit;
  };
  at_ = {target(Letter::X, at_.x), target(Letter::Y, at_.y)};
  z_ = target(Letter::Z, z_);
  double e = 0;
  if (w.has(Letter::E)) {
    e = absoluteE_ ? w.at(Letter::E) * unit - e_ : w.at(Letter::E) * unit;
    e_ = absoluteE_ ? w.at(Letter::E) * unit : e_ + e;
  }
  const double low = zKnown_ ? std::min(zFrom, z_) : z_;
  zKnown_ = zKnown_ || (absolute_ && w.has(Letter::Z));
  if (z_ != zFrom) {
    endPath();
    if (machine_.maxZ > 0 && z_ > machine_.maxZ + kRounding) {
      found("height", true, "above the printer's height", ": " + decimal(z_, 3) + " mm");
    }
  }
  const Vec2 d = at_ - from;
  double span = length(d);
  const bool arc = code >= 2;
  if (arc && (w.has(Letter::I) || w.has(Letter::J))) {
    const Vec2 centre = from + unit * Vec2{w.at(Letter::I), w.at(Letter::J)};
    const Vec2 a = from - centre;
    const Vec2 b = at_ - centre;
    double angle = std::atan2(cross(a, b), dot(a, b));
    if (code == 2) angle = -angle;
    if (angle <= 1e-9) angle += 2 * kPi;
    span = length(a) * angle;
    constexpr int kPieces = 32;
    for (int k = 1; k < kPieces; ++k) {
      const double turn = (code == 2 ? -angle : angle) * k / kPieces;
      checkPlace(
          centre + Vec2{a.x * std::cos(turn) - a.y * std::sin(turn), a.x * std::sin(turn) + a.y * std::cos(turn)},
          "an arc");
    }
  }
  if (zKnown_ && (w.has(Letter::X) || w.has(Letter::Y))) {  // from where is not told in a block by itself
    check_.lowest = std::min(check_.lowest, low);
    if (low < startHeight_) found("height", !block(), "moves below the print on the bed", ": Z " + decimal(low, 3));
  }
  if (!check_.homes && (span > 0 || z_ != zFrom)) found("homing", true, "moves before it homes", " (G28)");
  if (span > 0) {
    if (speed_ <= 0) {
      found("speed", true, "moves before any F", "");
      speed_ = 1;
    }
    if (e > 0) {
      bead(from, at_, span, e);
    } else {
      if (e < 0) filament(e);
      travel(span);
    }
  } else if (e != 0) {
    filament(e);
  }
}

void Reader::bead(Vec2 from, Vec2 to, double length, double e) {
  if (!moved_) {
    moved_ = true;
    if (!check_.heatsNozzle) found("heating", true, "extrudes before it has waited for a hot nozzle", " (M109)");
    if (!check_.heatsBed) found("heating", false, "extrudes before it has waited for a hot bed", " (M190)");
  }
  if (check_.heatsNozzle && check_.nozzleTarget < kColdest) {
    found("heating", true, "extrudes with the nozzle at ", decimal(check_.nozzleTarget, 0) + " degrees");
  }
  if (!inPath_) {
    if ((retracted_ > 1e-4 || firmwareRetracted_) && !block()) {
      found("retraction", true, "extrudes while retracted", " by " + decimal(retracted_, 3) + " mm");
    }
    inPath_ = true;
    pathOriented_ = oriented_;
    pathStart_ = from;
    windowed_ = 0;
    trail_.clear();
    if (oriented_) follow(from);
  } else if (coasted_ > 0) {
    if (!block()) found("cycle", ours_ && pathOriented_, "a gap of travel inside a path", "");
  }
  coasted_ = 0;
  pathEnd_ = to;
  if (oriented_ && !block()) {
    follow(to);
    if (speed_ > layerFastest_) {
      layerFastest_ = speed_;
      layerSlowedMm_ += layerAtFastestMm_;
      layerAtFastestMm_ = 0;
    }
    (speed_ < layerFastest_ ? layerSlowedMm_ : layerAtFastestMm_) += length;
  }
  if (ours_ && (oriented_ || base_) && !block()) lay(from, to, e * area_ / length);
  check_.filamentMm += e;
  if (!block()) counted_ += e;
  check_.pathMm += length;
  const double section = e * area_ / length;
  // One step of the last decimal of E is no fault of the path.
  const double sure = (e - 1e-5) * area_ / length;
  if (!block()) {
    check_.box.add(from);
    check_.box.add(to);
    check_.top = std::max(check_.top, z_);
    check_.fastest = std::max(check_.fastest, speed_);
    check_.mostFlow = std::max(check_.mostFlow, sure * speed_);
  }
  if (z_ <= 0) found("height", true, "a bead at or below the bed", ": Z " + decimal(z_, 3));
  if (machine_.nozzle > 0 && sure > 4 * machine_.nozzle * machine_.nozzle) {
    found("extrusion", machine_.klipper || ours_, "more plastic per mm than 4 nozzle diameters squared",
          ": " + decimal(section, 3) + " mm2");
  }
  if (machine_.printer && !block() && sure * speed_ > machine_.printer->maxFlow * 1.0001) {
    found("flow", true, "more flow than maxFlow", ": " + decimal(sure * speed_, 2) + " mm3/s");
  }
  if (machine_.printer && machine_.printer->machineSpeed > 0 && speed_ > machine_.printer->machineSpeed * 1.001) {
    found("speed", true, "faster than the printer", ": " + decimal(speed_, 1) + " mm/s");
  }
  checkPlace(to, "a bead");
  if (!block()) checkRate(length / speed_);
}

// Noise is a zigzag: three turns in a row, left and right in turn. Its amplitude is half the middle's distance from the
// line between its neighbours, so that curves and corners, which turn to one side, have none.
void Reader::follow(Vec2 p) {
  trail_.push_back(p);
  if (trail_.size() < 5) return;
  const auto turn = [&](std::size_t k) { return cross(trail_[k] - trail_[k - 1], trail_[k + 1] - trail_[k]); };
  const Vec2 before = trail_[2] - trail_[1];
  const Vec2 after = trail_[3] - trail_[2];
  double amplitude = 0;
  if (turn(1) * turn(2) < 0 && turn(2) * turn(3) < 0 && length(before) <= kLongNoise && length(after) <= kLongNoise) {
    const double chord = length(before + after);
    if (chord > 0) amplitude = std::abs(turn(2)) / chord / 2;
  }
  const double step = std::min(amplitude / kNoiseStep, static_cast<double>(zigzags_.size() - 1));
  ++zigzags_[static_cast<std::size_t>(step)];
  trail_.erase(trail_.begin());
}

void Reader::lay(Vec2 from, Vec2 to, double section) {
  if (layerHeight_ <= 0 || beads_.size() >= kMostBeads) return;
  const double width = std::min(section / layerHeight_ / (base_ ? baseFlow_ : flow_), 10.0);
  const auto narrow = [](Vec2 p) { return Vec2f{static_cast<float>(p.x), static_cast<float>(p.y)}; };
  beads_.push_back({narrow(from), narrow(to), static_cast<float>(width), base_, layers_, static_cast<float>(z_)});
}

void Reader::endLayer() {
  check_.slowedMm += layerSlowedMm_;
  layerFastest_ = layerSlowedMm_ = layerAtFastestMm_ = 0;
}

void Reader::judgeLayers() {
  std::int64_t all = 0;
  for (const std::int64_t count : zigzags_) all += count;
  std::int64_t rest = all;
  for (std::size_t k = 0; k < zigzags_.size() && all > 0; ++k) {
    rest -= zigzags_[k];
    if (rest * 100 > all) continue;
    check_.noise = static_cast<double>(k) * kNoiseStep;
    break;
  }
  if (check_.noise > kMostNoise) {
    check_.findings.push_back(
        {"noise", false, 0, 1,
         "the path zigzags by " + decimal(1000 * check_.noise, 1) + " um; above 5 printers brake for it"});
  }
  if (beads_.size() >= kMostBeads) return;
  check_.coverage = orientedCoverage(beads_);
  for (const double share : check_.coverage) {
    if (share < 0 || share >= kLeastCovered) continue;
    check_.findings.push_back(
        {"coverage", false, 0, 1, "an oriented layer covers " + fixed(100 * share, 1) + " % of the layers below it"});
    break;
  }
}

void Reader::travel(double length) {
  check_.travelMm += length;
  checkPlace(at_, "a move");
  const bool tight = retracted_ > 0 || firmwareRetracted_;
  if (inPath_ && !tight && coasted_ + length <= kCoast) {
    coasted_ += length;
    if (pathEnd_ != pathStart_) pathEnd_ = at_;  // else this is a wipe without retraction
    return;
  }
  endPath();
  if (moved_ && !tight && !block() && length > kLongTravel) {
    const bool retracts = !machine_.printer || machine_.printer->retractLength >= 1e-5;  // else none is written
    if (retracts) found("retraction", ours_, "travels without retraction", " over " + decimal(length, 1) + " mm");
  }
}

void Reader::filament(double e) {
  if (e < 0) {
    endPath();
    ++check_.retractions;
    retracted_ -= e;
    if (retracted_ > 25) found("retraction", true, "retracted further than any hot end is long", "");
  } else {
    if (e > kLongestPrime) found("extrusion", machine_.klipper, "more than 50 mm of filament in one move", "");
    retracted_ = std::max(0.0, retracted_ - e);
    if (!check_.heatsNozzle) found("heating", true, "extrudes before it has waited for a hot nozzle", " (M109)");
  }
}

void Reader::endPath() {
  if (!inPath_) return;
  inPath_ = false;
  const bool closed = length(pathEnd_ - pathStart_) <= kRounding;
  ++(closed ? check_.closed : check_.open);
  if (ours_ && pathOriented_ && !closed) {
    found("cycle", true, "a cycle that does not close",
          ": it ends " + decimal(length(pathEnd_ - pathStart_), 3) + " mm off");
  }
  coasted_ = 0;
}

GcodeCheck Reader::finish() {
  endPath();
  endLayer();
  check_.layers = layers_;
  judgeLayers();
  const auto whole = [&](const char* rule, bool error, const std::string& message) {
    check_.findings.push_back({rule, error, 0, 1, message});
  };
  if (check_.moves == 0) whole("extrusion", true, "there is no move in it");
  if (moved_ && layers_ == 0) {
    whole(
        "layers", false,
        "no layer is marked (;LAYER_CHANGE, ;LAYER:0 or ; CHANGE_LAYER), so all of it counts as a start block: it may "
        "reach 10 mm over the bed's edge, and beads are not measured");
  }
  if (check_.moves > 0 && !moved_) whole("extrusion", false, "it moves but lays no bead");
  if (moved_ && check_.nozzleTarget > 0 && !endMacro_) whole("end", ours_, "the nozzle stays hot at the end");
  if (moved_ && check_.bedTarget > 0 && !endMacro_) whole("end", false, "the bed stays hot at the end");
  const double slack = ours_ ? kTotalSlack : kForeignTotalSlack * check_.filamentMm + kTotalSlack;
  if (fileTotal_ >= 0 && std::abs(fileTotal_ - counted_) > slack && std::abs(fileTotal_ - check_.filamentMm) > slack) {
    whole("totals", ours_,
          "it says it takes " + decimal(fileTotal_, 2) + " mm of filament; its moves take " + decimal(counted_, 2));
  }
  if (fileLayers_ >= 0 && layers_ > 0 && fileLayers_ != layers_) {
    whole("totals", ours_,
          "it says it has " + std::to_string(fileLayers_) + " layers; " + std::to_string(layers_) + " are marked");
  }
  // Those of lines came in their order, those of the file as a whole behind them.
  std::vector<GcodeFinding> sorted;
  for (const bool error : {true, false}) {
    for (const bool ofFile : {true, false}) {
      for (const GcodeFinding& finding : check_.findings) {
        if (finding.error == error && (finding.line == 0) == ofFile) sorted.push_back(finding);
      }
    }
  }
  check_.findings = std::move(sorted);
  return std::move(check_);
}

}  // namespace

GcodeCheck checkGcode(std::string_view text, const std::optional<Printer>& printer) {
  const bool ours = text.starts_with("; generated by Sillon ");
  Reader reader(machineOf(text, printer), ours);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    reader.line(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return reader.finish();
}

}  // namespace sillon
