#include "gcode_reader/rules.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/numbers.hpp"
#include "gcode_reader/macros.hpp"
#include "printer/bed.hpp"

namespace sillon {
namespace {

constexpr double kRounding = 0.0015;           // [mm]; coordinates have 3 decimals
constexpr double kLongTravel = 2;              // [mm]; shorter travels draw no thread
constexpr double kCoast = 1.01;                // [mm], longest travel at a path's end that still belongs to it
constexpr double kLongestPrime = 50;           // [mm of filament], Klipper's max_extrude_only_distance
constexpr std::size_t kLongestOverlap = 4096;  // [moves] at a path's beginning that are kept
constexpr double kLeastCovered = 0.9;          // least share of the base that an oriented layer covers
constexpr std::size_t kMostBeads = 4000000;    // beads whose coverage is judged, in 160 MB
constexpr double kTotalSlack = 0.006;          // [mm]; totals have two decimals
constexpr double kForeignTotalSlack = 0.02;    // share of the total; other programs may count their start block
constexpr double kBelowBed = 0.5;              // [mm]; makers' blocks wipe so deep
constexpr double kBelowBesideBed = 2;          // [mm], the same beside the sheet
constexpr double kMostShift = 0.5;             // [mm], greatest shift of X and Y by G92
constexpr double kMostRaised = 2;              // [mm], greatest shift of Z upwards by G92
constexpr double kFirstLift = 20;              // [mm], highest lift of a block before it homes
constexpr double kScratch = 0.1;               // [mm], greatest depth of a nozzle in what it passes over
constexpr double kOffLayer = 0.1;              // share of a layer's height that a bead may lie off it
constexpr double kMostGap = 2;     // [mm], greatest step from the highest bead to the next: the thickest layer
constexpr double kMostPushed = 5;  // [mm of filament], most that may be pushed without a move
constexpr double kFarSheet = 255;  // [mm], Y of the steel behind the sheets of Bambu's machines

// Distance of a place beyond the bed's edge [mm], below 0 inside; nothing if the bed is not known.
std::optional<double> beyondBed(const FileSettings& settings, Vec2 p) {
  if (settings.printer) return Bed(*settings.printer).overhang(p, 0);
  if (settings.bed.empty()) return std::nullopt;
  const Bounds& bed = settings.bed;
  return std::max({bed.min.x - p.x, p.x - bed.max.x, bed.min.y - p.y, p.y - bed.max.y});
}

// Tells whether a place is beside the bed, where nothing stands and no sheet lies.
bool beside(const FileSettings& settings, Vec2 p) {
  const auto beyond = beyondBed(settings, p);
  return beyond ? *beyond > 0.5 : p.y > kFarSheet;
}

std::string shownPlace(Vec2 p) {
  std::string place = "(";
  return place.append(decimal(p.x, 3)).append(", ").append(decimal(p.y, 3)).append(")");
}

}  // namespace

bool tooDeep(const MachineMove& move, const FileSettings& settings) {
  return move.z < (beside(settings, move.to) ? -kBelowBesideBed : -kBelowBed - 1e-9);
}

Rules::Rules(FileSettings settings, bool ours)
    : settings_(std::move(settings)), ours_(ours), machine_(settings_.flavor) {
  area_ = std::numbers::pi * settings_.filamentDiameter * settings_.filamentDiameter / 4;
  machine_.volumetric = settings_.volumetric;
  // Printers of this kind home and heat before the file begins.
  if (!settings_.homesItself) return;
  machine_.homedAxes = kAllAxes;
  check_.homes = check_.heatsBed = check_.heatsNozzle = true;
  heaters_.setNozzle(kColdest);
}

void Rules::found(std::string_view code, bool error, FindingValues values) {
  found(makeFinding(code, error, std::move(values)));
}

// Adds a finding about the current line, or counts it with the same one before.
void Rules::found(GcodeFinding finding) {
  // Findings with the same code share an entry, but different commands have one each, and so have errors and warnings.
  const auto same = [&](const GcodeFinding& other) {
    if (other.code != finding.code || other.error != finding.error) return false;
    if (finding.values.empty() || other.values.empty()) return true;
    const auto& [name, value] = finding.values.front();
    return name != "command" || other.values.front().second == value;
  };
  const auto before = std::find_if(check_.findings.begin(), check_.findings.end(), same);
  if (before != check_.findings.end()) {
    ++before->count;
    return;
  }
  finding.line = check_.lines;
  check_.findings.push_back(std::move(finding));
}

// Judges the line's spelling, and hands on its command or comment. Plain moves take a shorter way.
void Rules::line(const GcodeLine& line) {
  check_.lines = line.number;
  if (GcodeWords words; line.end == "\n" && readPlainMove(line.text, words)) {
    GcodeCommand move;
    move.letter = 'G';
    move.code = line.text[1] - '0';
    lastMoves_ = true;
    return run(move, words);
  }
  if (line.end == "\r\n") found("cr-lf", ours_);
  if (line.end == "\r") found("cr", ours_);
  if (const char* fault = ours_ && !block() ? lineFault(line.text) : spellingFault(line.text); fault != nullptr) {
    found(fault, true, {{"text", shownText(line.text)}});
  }
  const GcodeParts parts = partsOf(line.text);
  if (const auto changes = ours_ ? std::nullopt : toolChangeMark(parts)) {
    // The filament that a tool change draws back is cut off, or given back by the changer.
    if (changesTool_ && !*changes) machine_.retracted = 0;
    changesTool_ = *changes;
  }
  if (parts.numbered) found("line-numbers", false);
  if (parts.code.empty()) {
    if (line.text.find(';') != std::string_view::npos) comment(parts.comment);
    return;
  }
  command(parts.code);
  onCommand(parts.code);
}

// Reads marks of layers, roles, heights and totals.
void Rules::comment(std::string_view text) {
  // Our own files for Bambu's printers have two marks for each layer, of which the kind that comes first counts.
  const LayerMark mark = layerMark(text);
  if (layerMark_ == LayerMark::None) layerMark_ = mark;
  if (mark != LayerMark::None && mark == layerMark_) {
    endPath();
    endLayer();
    if (layers_ == 0) judgeOrigin();
    onLayer();
    changesTool_ = false;
    ++layers_;
  }
  // Cura marks no end block, so that all from a TIME_ELAPSED to the next LAYER counts as a block.
  if (text.starts_with("TIME_ELAPSED:")) custom_ = true;
  if (text.starts_with("LAYER:")) custom_ = false;
  if (const auto value = numberAfter(text, "Z:"); value && ours_) layerTop_ = *value;
  if (text.starts_with("TYPE:") || text.starts_with("FEATURE: ")) {
    endPath();
    const std::string_view role = trimmed(text.substr(text.find(':') + 1));
    custom_ = role == "Custom";
    tower_ = isPurge(role) && !custom_;
    oriented_ = role == "Top solid infill" || role == "Top surface";
    base_ = role == "Solid infill" || role == "Internal solid infill";
  }
  if (text.starts_with("printer_model = ")) check_.printer = std::string(text.substr(16, 60));
  if (ours_ && layers_ == 0) startHeight_ = numberAfter(text, "start height =").value_or(startHeight_);
  if (const auto value = numberAfter(text, "HEIGHT:")) layerHeight_ = *value;
  if (const std::size_t at = text.find(", flow = "); ours_ && layers_ == 0 && at != std::string_view::npos) {
    flow_ = std::clamp(numberAfter(text.substr(at + 2), "flow =").value_or(1), 0.01, 2.0);
  }
  // Several filaments have several totals, and each slicer has its own way to state what changes cost.
  const bool single = text.find(',') == std::string_view::npos;
  if (const auto value = numberAfter(text, "filament used [mm] ="); value && single) fileTotal_ = *value;
  if (const auto value = numberAfter(text, "total layers count =")) {
    fileLayers_ = static_cast<int>(std::clamp(*value, 0.0, 1e6));
  }
  onComment(text);
}

// Takes a start macro for homing and heating, with the temperatures in its parameters.
void Rules::startMacro(std::string_view parameters) {
  machine_.homedAxes = kAllAxes;
  check_.homes = check_.homesPlane = true;
  const MacroTargets targets = macroTargets(parameters);
  if (targets.nozzle > 0) heaters_.setNozzle(targets.nozzle);
  if (targets.bed > 0) heaters_.setBed(targets.bed);
  noteHeat();
}

// Judges a command by the table, adds up its offsets, and runs it.
void Rules::command(std::string_view text) {
  if (text.size() > 95 && !klipper()) found("long-command", false);
  const GcodeCommand command = commandOf(text);
  const bool moves = command.letter == 'G' && command.code <= 3 && command.code >= 0 && command.sub == 0;
  if (!moves || command.rest.find_first_of("GMRgmr") != std::string_view::npos) {
    for (GcodeFinding& finding :
         judgeCommand(text, settings_.flavor, settings_.hottestNozzle, settings_.hottestBed, false)) {
      if (finding.code == "outlives" && ours_ && !block()) finding.error = true;
      found(std::move(finding));
    }
    if (const auto sum = offsets_.run(command, settings_.flavor)) {
      if (FindingValues fault = offsetFault(*sum); !fault.empty()) found("offset", true, std::move(fault));
    }
  }
  lastMoves_ = moves;
  if (isStartMacro(command)) return startMacro(command.rest);
  if (isEndMacro(command)) {
    endMacro_ = true;
    return;
  }
  machine_.homedAxes |= homedByMacro(command);
  const char first = text[0];
  if (!((first >= 'A' && first <= 'Z') || (first >= 'a' && first <= 'z') || first == '_')) {
    return found("no-command", false, {{"text", shownText(text)}});
  }
  run(command, readsWords(command) ? this->words(command) : GcodeWords{});
}

FindingValues offsetFault(const Offsets::Axes& sum) {
  for (const auto& [axis, mm] : {std::pair{"X", sum.x}, {"Y", sum.y}, {"Z", sum.z}}) {
    const double least = *axis == 'Z' ? -kMostLowered : -kMostOffset;
    if (mm >= least - 1e-9 && mm <= kMostOffset) continue;
    return {{"axis", axis}, {"mm", decimal(mm, 3)}, {"low", decimal(least, 1)}, {"high", decimal(kMostOffset, 0)}};
  }
  return {};
}

// Runs a command and judges its move, homing and heat.
void Rules::run(const GcodeCommand& command, const GcodeWords& words) {
  // Deltas home at their top, away from the print.
  if (laid_.top() > 0 && (probesBed(command) || (homesZ(command) && !settings_.roundBed))) {
    found("homes-on-print", !block(), {{"command", shownText(command.name)}});
  }
  modes(command, words);
  const double retracted = machine_.retracted;
  const bool firmware = machine_.firmwareRetracted;
  if (const auto made = runCommand(machine_, command, words)) {
    move(*made);
    if (made->length == 0 && made->e != 0) filament(made->e, retracted);
  }
  if (firmware != machine_.firmwareRetracted) {
    endPath();
    retractsBetween_ = retractsBetween_ || !block();
  }
  // Bambu's printers home with moves of their own: their makers' blocks name X and Z alone.
  if (command.is('G', 28) && settings_.flavor == GcodeFlavor::Bambu) machine_.homedAxes = kAllAxes;
  // RepRapFirmware's bed.g and Klipper's macro of this name home before they level.
  if (command.is('G', 32) && (machine_.duet || klipper())) machine_.homedAxes = kAllAxes;
  if (!moved_) {
    check_.homes = machine_.homed();
    check_.homesPlane = machine_.homed(kPlane);
  }
  if (command.letter == 'G' && command.code <= 3) return;  // most lines end here
  heaters_.run(command, words, machine_.tool, klipper());
  noteHeat();
}

// Notes the current tool's and the bed's temperatures.
void Rules::noteHeat() {
  const Heater& nozzle = heaters_.nozzle(machine_.tool);
  check_.nozzleTarget = nozzle.target;
  check_.nozzleReady = nozzle.ready;
  check_.bedTarget = heaters_.bed().target;
  check_.heatsNozzle = check_.heatsNozzle || nozzle.ready >= kColdest;
  check_.heatsBed = check_.heatsBed || heaters_.bed().ready > 0;
}

const char* wordFault(const GcodeWords& words) {
  static constexpr const char* kCodes[] = {nullptr, "not-a-word", "no-number", "no-plain-number", "letter-twice"};
  return kCodes[words.fault];
}

// Reads a command's words, as far as a firmware would, and adds what is wrong with them.
GcodeWords Rules::words(const GcodeCommand& command) {
  const GcodeWords words = wordsOf(command.rest);
  if (const char* fault = wordFault(words)) {
    const bool error = words.fault != GcodeWords::NoNumber || command.letter != 'M';  // M104 S140 A: letters alone
    found(fault, error, {{"text", shownText(words.faultText)}});
  }
  if (words.fault == GcodeWords::None && words.unusual && ours_ && !block()) {
    found("no-plain-number", true, {{"text", shownText(trimmed(command.rest))}});
  }
  if (words.lower) found("lower-case", false, {{"text", shownText(command.rest)}});
  if (words.crowded) found("crowded", false, {{"text", shownText(command.rest)}});
  return words;
}

// Judges commands that change the unit, the origin, or what E means.
void Rules::modes(const GcodeCommand& command, const GcodeWords& words) {
  if (command.is('G', 20) && !block()) found("inches", true);
  if (command.is('G', 92) && (words.has('X') || words.has('Y') || words.has('Z'))) {
    found("origin", !block());
    for (const auto& [letter, axis] : {std::pair{'X', kAxisX}, {'Y', kAxisY}, {'Z', kAxisZ}}) {
      if (words.has(letter) && machine_.told(axis)) shifted_ |= axis;
    }
    // Most printers home Z at the bed, so that a G92 of Z behind it is a shift. Deltas home at their top.
    const bool homesLow = settings_.printer && !settings_.printer->roundBed;
    if (words.has('Z') && homesLow && machine_.homed(kAxisZ)) shifted_ |= kAxisZ;
    shiftLine_ = check_.lines;
  }
  if (volumetricBy(command, words).value_or(false) && !settings_.volumetric) found("volumetric", true);
}

// Judges the origins at the first layer: a start block may move them while it looks for the bed, but must put them
// back.
void Rules::judgeOrigin() {
  double most = 0;
  const auto judge = [&](unsigned axis, double origin, double low, double high) {
    if ((shifted_ & axis) == 0 || (origin >= -low && origin <= high)) return;
    if (std::abs(origin) > std::abs(most)) most = origin;
  };
  judge(kAxisX, machine_.origin.x, kMostShift, kMostShift);
  judge(kAxisY, machine_.origin.y, kMostShift, kMostShift);
  judge(kAxisZ, machine_.originZ, kBelowBed, kMostRaised);
  if (most == 0) return;
  GcodeFinding finding = makeFinding("origin-shift", true, {{"mm", decimal(most, 3)}});
  finding.line = shiftLine_;
  check_.findings.push_back(std::move(finding));
}

// Finds places in the excluded part of the bed or beyond its edge.
void Rules::checkPlace(Vec2 p, const char* offBed) {
  if (settings_.printer && moved_ && inPath_ && Bed(*settings_.printer).inZone(p, -kRounding)) found("excluded", true);
  const double over = beyondBed(settings_, p).value_or(-1);
  if (over <= kRounding) return;
  // Bambu's machines reach this far beside the bed to wipe, to cut, and to press a camera's shutter between layers.
  constexpr double kBambusWiper = 60;  // [mm] beyond the bed's edge
  const bool bambu = settings_.flavor == GcodeFlavor::Bambu && (block() || !inPath_);
  if ((block() || bambu) && over <= (bambu ? kBambusWiper : kBeyondBed)) return;
  found(offBed, true, {{"place", shownPlace(p)}, {"mm", decimal(over, 3)}});
}

// Finds moves of the nozzle through what has been printed.
void Rules::checkHeight(const MachineMove& move) {
  const double depth = laid_.depthOf(move);
  if (depth > kScratch) found("in-print", true, {{"mm", decimal(depth, 3)}});
}

// Finds beads in the air, and beads of our own files that lie off their layer.
void Rules::checkBeadHeight(double z) {
  const double top = std::max(laid_.top(), startHeight_);
  if (z > top + kMostGap) found("in-air", true, {{"z", decimal(z, 3)}, {"top", decimal(top, 3)}});
  if (ours_ && layerTop_ >= 0 && std::abs(z - layerTop_ - settings_.zOffset) > kOffLayer * layerHeight_ + kRounding) {
    found("off-layer", true, {{"z", decimal(z, 3)}, {"top", decimal(layerTop_ + settings_.zOffset, 3)}});
  }
}

// Finds more moves per second than the printer takes, as a mean of the last kWindow moves of a path.
void Rules::checkRate(double seconds) {
  window_[windowed_ % kWindow] = seconds;
  if (++windowed_ < kWindow) return;
  double sum = 0;
  for (const double part : window_) sum += part;
  if (!(sum > 0)) return;
  const double rate = static_cast<double>(kWindow) / sum;
  check_.mostMoves = std::max(check_.mostMoves, rate);
  // Lengths come from coordinates with 3 decimals, hence a little slack.
  if (settings_.printer && rate > settings_.printer->maxSegmentsPerSecond * 1.001) {
    found("rate", false, {{"rate", decimal(rate, 0)}});
  }
}

// Judges a move, and hands it on as a bead or a travel.
void Rules::move(const MachineMove& move) {
  ++check_.moves;
  onMove(move);
  if (move.toldF && !(machine_.speed > 0)) found("speed-zero", true);
  if (move.z != move.zFrom) {
    endPath();
    const double over = settings_.maxZ > 0 ? move.z - settings_.maxZ : 0;
    // Makers' blocks go to the end of the axis, where most firmwares stop; Klipper ends the print.
    if (over > kRounding) found("too-high", klipper() || !block() || over > kBeyondBed, {{"mm", decimal(move.z, 3)}});
    if (move.z < move.zFrom) {
      // Deltas home at the top, so that nothing is known before the first Z.
      const bool top = !machine_.told(kAxisZ) && settings_.printer && settings_.printer->roundBed;
      const bool deep = block() ? tooDeep(move, settings_) : move.z < -kRounding;
      if (!top && deep) found("below-bed", true, {{"mm", decimal(move.z, 3)}});
    }
  }
  if (move.arc && !move.readable) found("unread-arc", true);
  if (move.arc && move.readable) {
    constexpr int kPieces = 32;
    for (int k = 1; k < kPieces; ++k) checkPlace(onArc(move, static_cast<double>(k) / kPieces), "arc-off-bed");
  }
  const bool wipes = block() && beside(settings_, move.from) && beside(settings_, move.to);
  const bool zTold = machine_.told(kAxisZ);
  if (zTold && (move.xy || move.z < move.zFrom) && !wipes) {  // a block alone does not tell where a move begins
    const double low = lastZTold_ ? std::min(move.zFrom, move.z) : move.z;
    check_.lowest = std::min(check_.lowest, low);
    if (low < startHeight_ && (move.xy || startHeight_ > 0)) found("below-print", !block(), {{"mm", decimal(low, 3)}});
  }
  lastZTold_ = zTold;
  // Many blocks lift a little before they home, or between homing X and Y and homing Z in the middle of the bed.
  const bool lift = move.length == 0 && move.z > move.zFrom && (!machine_.absolute || machine_.homed(kPlane));
  const bool lowers = move.z != move.zFrom && !lift;
  // Makers' blocks lift before they home, from the height at which the printer was switched on.
  const bool first = block() && move.length == 0 && move.zFrom == 0 && move.z > 0 && move.z <= kFirstLift;
  const unsigned moved = (move.arc || move.to.x != move.from.x ? kAxisX : 0) |
                         (move.arc || move.to.y != move.from.y ? kAxisY : 0) | (lowers ? heightAxis() : 0);
  // After the print some blocks switch the motors off too early, which is only a warning.
  if (!machine_.homed(moved)) found("unhomed", !first && (layers_ == 0 || !block()));
  if (laid_.top() > 0) checkHeight(move);
  if (move.length > 0) {
    pushed_ = 0;
    if (machine_.speed <= 0) {
      found("no-speed", !block());  // firmwares have a speed to begin with
      machine_.speed = 1;
    }
    clock_ += move.length / machine_.speed;
    const double e = machine_.volumetric ? move.e / area_ : move.e;
    if (e > 0) return bead(move, e);
    if (e < 0) filament(e, 0);
    travel(move.length);
  }
}

// Judges a bead, and adds it to what is printed.
void Rules::bead(const MachineMove& move, double e) {
  const Vec2 from = move.from;
  const Vec2 to = move.to;
  if (!moved_) {
    moved_ = true;
    if (!check_.heatsNozzle) found("cold-start", true);
    if (!check_.heatsBed) found("cold-bed", false);
  }
  checkHot();
  if (!machine_.homed(kPlane | heightAxis())) found("unhomed", true);
  if (!inPath_) {
    if (machine_.retracted > 1e-4 && !block()) found("bead-retracted", true, {{"mm", decimal(machine_.retracted, 3)}});
    if (machine_.firmwareRetracted && !block()) found("bead-g10", true);
    inPath_ = true;
    pathOriented_ = oriented_;
    pathStart_ = from;
    pathHead_.clear();
    overlap_ = -1;
    windowed_ = 0;
  } else if (coasted_ > 0) {
    if (ours_ && !block()) found("gap", pathOriented_);  // other slicers travel short ways without retraction
  }
  if (block()) machine_.retracted = 0;  // purging fills the nozzle
  coasted_ = 0;
  pathEnd_ = to;
  followOverlap(to);
  const double speed = machine_.speed;
  if (oriented_ && !block()) {
    if (speed > layerFastest_) {
      layerFastest_ = speed;
      layerSlowedMm_ += layerAtFastestMm_;
      layerAtFastestMm_ = 0;
    }
    (speed < layerFastest_ ? layerSlowedMm_ : layerAtFastestMm_) += move.length;
  }
  const double section = e * area_ / move.length;
  if (ours_ && (oriented_ || base_) && !block()) lay(from, to, section, move.length / speed);
  check_.filamentMm += e;
  if (!block()) counted_ += e;
  check_.pathMm += move.length;
  // The section that is certain: E may be rounded up by a step of its last decimal.
  const double sure = (e - 1e-5) * area_ / move.length;
  if (!block()) {
    checkBeadHeight(move.z);
    laid_.add(move);
    check_.box.add(from);
    check_.box.add(to);
    check_.top = std::max(check_.top, move.z);
    check_.fastest = std::max(check_.fastest, speed);
    check_.mostFlow = std::max(check_.mostFlow, sure * speed);
  }
  // Only the printer knows how high homing and levelling leave the nozzle, and a block may purge there.
  const bool untold = block() && !machine_.told(kAxisZ) && move.z == 0;
  // Some purge at the height of homing, which is a sheet of paper above the bed.
  if (move.z <= 0 && !untold) found("bead-in-bed", !block() || move.z < 0, {{"mm", decimal(move.z, 3)}});
  // Makers' blocks purge thick lines, but Klipper stops at them unless the printer's configuration allows more.
  const double thickest = 4 * settings_.nozzle * settings_.nozzle;
  if (settings_.nozzle > 0 && sure > thickest && (klipper() || !block())) {
    const bool heap = e - thickest * move.length / area_ > kMostPushed;  // a heap, although the nozzle moves
    found("too-thick", !block() && (ours_ || klipper() || heap), {{"area", decimal(section, 3)}});
  }
  if (settings_.printer && !block() && sure * speed > settings_.printer->maxFlow * 1.0001) {
    found("flow", true, {{"flow", decimal(sure * speed, 2)}});
  }
  if (settings_.printer && settings_.printer->machineSpeed > 0 && speed > settings_.printer->machineSpeed * 1.001) {
    found("too-fast", true, {{"speed", decimal(speed, 1)}});
  }
  checkPlace(to, "bead-off-bed");
  if (!block()) checkRate(move.length / speed);
}

// Finds extrusion with a nozzle that is too cold.
void Rules::checkHot() {
  constexpr double kSoft = 130;  // [degrees Celsius], at which Bambu's blocks push what has been flushed
  const double coldest = block() && settings_.flavor == GcodeFlavor::Bambu ? kSoft : kColdest;
  if (check_.heatsNozzle && check_.nozzleReady < coldest) {
    found("cold-bead", layers_ == 0 || !block(), {{"degrees", decimal(check_.nozzleReady, 0)}});
  }
}

// Keeps a bead for the layers' coverage. Its width follows from its section, the layer height and the flow.
void Rules::lay(Vec2 from, Vec2 to, double section, double seconds) {
  if (layerHeight_ <= 0 || beads_.size() >= kMostBeads) return;
  const double flow = settings_.filamentFlow * (base_ ? baseFlow_ : flow_);
  const double width = std::min(section / layerHeight_ / flow, 10.0);
  const auto narrow = [](Vec2 p) { return Vec2f{static_cast<float>(p.x), static_cast<float>(p.y)}; };
  beads_.push_back({narrow(from), narrow(to), static_cast<float>(width), base_, layers_, static_cast<float>(machine_.z),
                    static_cast<float>(clock_ - seconds), static_cast<float>(seconds)});
}

// Adds the length that the layer's oriented beads were slowed over.
void Rules::endLayer() {
  check_.slowedMm += layerSlowedMm_;
  layerFastest_ = layerSlowedMm_ = layerAtFastestMm_ = 0;
}

// Measures the coverage of oriented layers and their beads' waits for neighbours.
void Rules::judgeLayers() {
  if (beads_.size() >= kMostBeads) return;
  check_.coverage = orientedCoverage(beads_);
  check_.delay = neighbourDelay(beads_);
  for (const double share : check_.coverage) {
    if (share < 0 || share >= kLeastCovered) continue;
    check_.findings.push_back(makeFinding("coverage", false, {{"percent", fixed(100 * share, 1)}}));
    break;
  }
}

// Judges a travel; a short one without retraction may belong to the path, as coasting does.
void Rules::travel(double length) {
  check_.travelMm += length;
  checkPlace(machine_.at, "move-off-bed");
  const bool tight = machine_.retracted > 0 || machine_.firmwareRetracted;
  if (inPath_ && !tight && coasted_ + length <= kCoast) {
    coasted_ += length;
    if (pathEnd_ != pathStart_) pathEnd_ = machine_.at;  // behind a closed path it is a wipe without retraction
    return;
  }
  endPath();
  if (moved_ && !tight && !block() && length > kLongTravel) {
    const bool retracts = !settings_.printer || settings_.printer->retractLength >= 1e-5;  // less is not written
    if (retracts) found("travel-unretracted", ours_, {{"mm", decimal(length, 1)}});
  }
}

// Judges filament that is pushed or drawn back without a bead.
void Rules::filament(double e, double retractedBefore) {
  onFilament(e, retractedBefore);
  if (e < 0) {
    endPath();
    ++check_.retractions;
    retractsBetween_ = retractsBetween_ || !block();
    const bool unloads = tower_ || changesTool_ || (custom_ && layers_ > 0);  // several filaments: one is unloaded
    if (machine_.retracted > 25 && !unloads) found("far-retracted", true);
    return;
  }
  if (e > kLongestPrime) found("long-prime", klipper());
  if (!block()) {
    pushed_ += e - std::min(e, retractedBefore);
    if (pushed_ > kMostPushed) found("blob", true, {{"mm", decimal(pushed_, 1)}});
  }
  // Other programs, and makers' blocks, give back a little less on purpose (retract_restart_extra below 0).
  if ((!ours_ || block()) && machine_.retracted <= 0.5 * retractedBefore) machine_.retracted = 0;
  // Bambu's blocks push filament that is no more than soft before they home.
  const bool soft = block() && settings_.flavor == GcodeFlavor::Bambu;
  if (!check_.heatsNozzle && !soft) found("cold-start", true);
  checkHot();
}

// Follows a path that has come back to its start and runs on over its first moves, as a scarf joint does.
void Rules::followOverlap(Vec2 to) {
  const auto same = [](Vec2 a, Vec2 b) { return length(a - b) <= kRounding; };
  const std::size_t next = std::max<std::ptrdiff_t>(overlap_, 0);
  if (overlap_ >= 0 && next < pathHead_.size() && same(to, pathHead_[next])) {
    ++overlap_;
  } else {
    overlap_ = same(to, pathStart_) ? 0 : -1;
  }
  if (pathHead_.size() < kLongestOverlap) pathHead_.push_back(to);
}

// Ends a path, and counts it as closed or open.
void Rules::endPath() {
  if (!inPath_) return;
  inPath_ = false;
  const bool closed = overlap_ >= 0 || length(pathEnd_ - pathStart_) <= kRounding;
  ++(closed ? check_.closed : check_.open);
  if (ours_ && pathOriented_ && !closed) {
    found("open-cycle", true, {{"mm", decimal(length(pathEnd_ - pathStart_), 3)}});
  }
  coasted_ = 0;
}

// Judges the end of the file: heaters that stay hot, and the totals that the file states.
void Rules::judgeTotals() {
  const auto whole = [&](std::string_view code, bool error, FindingValues values = {}) {
    check_.findings.push_back(makeFinding(code, error, std::move(values)));
  };
  if (check_.moves == 0) whole("no-move", true);
  if (moved_ && layers_ == 0) whole("no-layers", false);
  if (check_.moves > 0 && !moved_) whole("no-bead", false);
  check_.retracted = machine_.retracted;
  check_.otherHotTools = heaters_.otherHotTools(machine_.tool);
  check_.chamberTarget = heaters_.chamber().target;
  check_.firmwareRetracted = machine_.firmwareRetracted;
  const bool left = !endMacro_ && !settings_.homesItself;
  const bool hotNozzle = check_.nozzleTarget > 0 || !check_.otherHotTools.empty();
  if (moved_ && hotNozzle && left) whole(lastMoves_ && layers_ > 0 ? "cut-off" : "hot-nozzle", ours_ || lastMoves_);
  if (moved_ && check_.bedTarget > 0 && left) whole("hot-bed", false);
  if (moved_ && check_.chamberTarget > 0 && left) whole("hot-chamber", false);
  const double slack = ours_ ? kTotalSlack : kForeignTotalSlack * check_.filamentMm + kTotalSlack;
  if (fileTotal_ >= 0 && std::abs(fileTotal_ - counted_) > slack && std::abs(fileTotal_ - check_.filamentMm) > slack) {
    whole("filament-total", ours_, {{"told", decimal(fileTotal_, 2)}, {"counted", decimal(counted_, 2)}});
  }
  if (fileLayers_ >= 0 && layers_ > 0 && fileLayers_ != layers_) {
    whole("layer-total", ours_, {{"told", std::to_string(fileLayers_)}, {"counted", std::to_string(layers_)}});
  }
}

GcodeCheck Rules::finish() {
  endPath();
  endLayer();
  if (layers_ == 0) judgeOrigin();
  check_.layers = layers_;
  judgeLayers();
  judgeTotals();
  onFinish();
  // A file that never retracts was asked not to: it oozes, but nothing is broken.
  for (GcodeFinding& finding : check_.findings) {
    if (finding.code == "travel-unretracted" && !retractsBetween_) finding.error = false;
  }
  // Errors come before warnings, and findings about the whole file, which have no line, before those about lines.
  std::vector<GcodeFinding> sorted;
  for (const bool error : {true, false}) {
    for (const bool ofFile : {true, false}) {
      for (const GcodeFinding& finding : check_.findings) {
        // Other slicers leave out retractions inside a part on purpose.
        if (!ours_ && retractsBetween_ && finding.code == "travel-unretracted") continue;
        if (finding.error == error && (finding.line == 0) == ofFile) sorted.push_back(finding);
      }
    }
  }
  check_.findings = std::move(sorted);
  return std::move(check_);
}

}  // namespace sillon
