#include "gcode_reader/print_rules.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/numbers.hpp"
#include "gcode_reader/macros.hpp"

namespace sillon {
namespace {

constexpr FindingRow kRows[] = {
    {"heating", {"heat-changed", "the nozzle goes to {degrees} degrees in mid-print; it began with {told}"}},
    {"heating", {"bed-changed", "the bed goes to {degrees} degrees in mid-print; it began with {told}"}},
    {"flow", {"flow-changed", "the flow goes to {percent} % in mid-print; it began with {told} %"}},
    {"flow", {"odd-flow", "a layer gets {percent} % of the plastic that its marks tell; the others get {told} %"}},
    {"flow", {"advance", "pressure advance of {seconds} s; the layers began with {told} s"}},
    {"flow",
     {"flow-told", "{flow} mm3/s, more than the {limit} mm3/s that the file itself or its machine's profile has"}},
    {"speed", {"speed-told", "{speed} mm/s, more than the {limit} mm/s that the file tells of its machine"}},
    {"speed", {"speed-changed", "the speed goes to {percent} % in mid-print; it began with {told} %"}},
    {"speed", {"acceleration", "accelerates by {value} mm/s2 in mid-print; the start asked for {told}"}},
    {"speed", {"corners", "takes corners with a jerk of {value} mm/s in mid-print; the start asked for {told}"}},
    {"commands", {"other-tool", "changes to tool {tool} in mid-print; the file is for {filaments}"}},
    {"contact", {"pauses-on-print", "{command} pauses while the nozzle touches what it lays"}},
    {"contact", {"waits-on-print", "{command} waits while the nozzle touches what it lays"}},
    {"contact", {"rests-on-print", "the last layer ends with the nozzle on the print"}},
    {"contact", {"drags", "the nozzle is dragged over {mm} mm of the print"}},
    {"contact", {"pushes-twice", "pushes {mm} mm more filament than was drawn back, on the spot"}},
    {"height", {"odd-step", "a layer begins {mm} mm above the one before; the file tells layers of {told} mm"}},
    {"bounds", {"shifted", "a layer lies {mm} mm beside the one below"}},
    {"cooling", {"no-fan", "PLA without a fan above the second layer"}},
    {"cooling", {"first-fan", "the fan blows at {percent} % on the first layer"}},
};

constexpr auto kSentences = sentencesOf(kRows);

constexpr double kSame = 1e-6;   // difference that counts as none
constexpr double kSameHeat = 3;  // [degrees Celsius], change that counts as none
constexpr double kFarHeat = 12;  // [degrees Celsius], greatest distance from the targets of another program's file
constexpr double kFarBed = 25;   // [degrees Celsius], greatest change of the bed; first layers have a hotter one
constexpr double kMostFlowChange = 0.3;     // change of flow, as a share, that is an error: no print bears it
constexpr double kSmallFlowChange = 0.1;    // change of flow, as a share, that passes in other programs' files
constexpr double kHighSpeed = 1.3;          // factor of speed that passes in other programs' files
constexpr double kLongAdvance = 1.5;        // [s], pressure advance that tubes of 1 m do not reach
constexpr double kOldAdvance = 10;          // M900's K in its old unit is at least this
constexpr double kHighAcceleration = 2e4;   // [mm/s²], acceleration of the fastest machines that are sold
constexpr double kHighCorner = 25;          // [mm/s], jerk that passes in other programs' files
constexpr double kHighestCorner = 40;       // [mm/s], jerk above which it is an error there, too
constexpr double kWait = 0.3;               // [s], longest pause that is not judged
constexpr double kLongWait = 5;             // [s], longest pause that is not judged outside a path
constexpr double kTouch = 0.05;             // [mm] above what is laid, at which the nozzle still touches it
constexpr double kMostDragged = 6;          // [mm], longest drag that passes: a wipe is shorter
constexpr double kSurplus = 0.05;           // [mm of filament], most that our own files push beyond what they drew back
constexpr double kForeignSurplus = 0.5;     // [mm of filament], the same for other programs; some do it on purpose
constexpr double kHeightShare = 0.3;        // share of a layer's height that a bead may lie off its mark
constexpr double kFileOffset = 0.5;         // [mm], greatest shift of all heights of a file
constexpr double kSameSize = 0.5;           // [mm], difference in size that layers of one outline may have
constexpr double kShift = 1;                // [mm], longest shift between layers that passes
constexpr double kLeastShifted = 5;         // [mm], least size of a layer whose shift is judged
constexpr double kBlowing = 50;             // [%], least fan that counts on the first layer
constexpr std::size_t kMostChanges = 1000;  // changes that are kept, which bounds the memory
constexpr std::size_t kMostLayers = 100'000;  // layers whose flow is kept, which bounds the memory
constexpr double kOddFlow = 0.1;              // share that a layer's plastic may differ from the others'
constexpr double kLeastPlastic = 10;          // [mm³], least plastic of a layer that is judged
constexpr double kLeastGap = 0.5;  // [mm], longest gap that passes: shorter beads may have too little plastic for an E
constexpr double kLeastWay = 2;    // [mm], longest way there and back over the print that passes
constexpr double kFarPush = 4;     // times the speed that a file states for filament alone
constexpr std::int64_t kRarely = 20;  // least ways with a speed per gap; with fewer, the slicer just states no speeds
constexpr double kForeignFlowSlack = 1.15;  // times the flow that a file states: E is rounded, and gap fill is thick
constexpr double kFarFlow = 2;              // times these limits: an error in our own files, as no setting asks for it
constexpr double kProfileFlowSlack = 1.5;   // times a profile's flow, which is that of plain filament

std::string whole(double value) { return decimal(value, 0); }

// Adds each number of a list such as "215,215" once.
void addNumbers(std::string_view text, std::vector<double>& numbers) {
  while (!text.empty() && numbers.size() < 64) {
    double value = 0;
    const std::size_t end = std::min(text.find(','), text.size());
    if (readNumber(trimmed(text.substr(0, end)), value) == 0) return;
    if (std::find(numbers.begin(), numbers.end(), value) == numbers.end()) numbers.push_back(value);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

// Tells whether a command waits for a heater.
bool waitsForHeat(const GcodeCommand& command, const std::string& name) {
  return command.isAny('M', {109, 116, 190, 191}) || name == "TEMPERATURE_WAIT";
}

// Tells whether a command pauses the print for somebody; M400 U does so on Bambu's printers.
bool pauses(const GcodeCommand& command, const GcodeWords& words, const std::string& name) {
  return name == "PAUSE" || command.isAny('M', {0, 1, 25, 226, 600, 601}) || (command.is('M', 400) && words.has('U'));
}

}  // namespace

std::span<const Sentence> printFindingSentences() { return kSentences; }

PrintRules::PrintRules(FileSettings settings, bool ours, const std::optional<Printer>& machine)
    : Rules(std::move(settings), ours), profile_(machine) {
  now_.fill(-1);
  now_[Flow] = now_[Speed] = 100;
  now_[Tool] = 0;
  atFirst_ = before_ = now_;
}

std::vector<std::string> PrintRules::unchecked() const {
  std::vector<std::string> all;
  if (settings_.printer) return all;
  if (settings_.bed.empty()) all.emplace_back("bed");
  if (settings_.maxZ <= 0) all.emplace_back("height");
  if (settings_.nozzle <= 0) all.emplace_back("nozzle");
  if (!profile_ && mostFlowOf(settings_, 0) <= 0) all.emplace_back("flow");
  if (mostSpeed_ <= 0) all.emplace_back("speed");
  return all;
}

// Adds a finding about the current line, or about `line` if that is above 0.
void PrintRules::tell(std::string_view code, bool error, FindingValues values, std::int64_t line) {
  const std::int64_t here = std::exchange(check_.lines, line > 0 ? line : check_.lines);
  found(makeFinding(kRows, code, error, std::move(values)));
  check_.lines = here;
}

// Tells whether the nozzle touches what is printed.
bool PrintRules::standsOnPrint() const {
  if (!(laid_.top() > 0)) return false;
  MachineMove here;
  here.from = here.to = machine_.at;
  here.z = here.zFrom = machine_.z - kTouch;
  return laid_.depthOf(here) > 0;
}

// Notes the value of a setting. A change in the layers waits for the next bead, and is none if it was taken back.
void PrintRules::note(Setting setting, double value) {
  if (value == now_[setting]) return;
  now_[setting] = value;
  if (!laying_) before_[setting] = std::max(before_[setting], value);
  if (!laying_ || pending_.size() >= kMostChanges) return;
  pending_.push_back({setting, check_.lines, value});
}

// Notes the settings that a command changes, and judges waits and the end block.
void PrintRules::onCommand(std::string_view code) {
  const GcodeCommand command = commandOf(code);
  if (command.letter == 'G' && command.code >= 0 && command.code <= 3) return;
  const std::string name = command.letter == 0 ? upperCase(command.name) : std::string();
  const GcodeWords words = command.letter == 0 ? GcodeWords{} : wordsOf(command.rest);
  if (block()) retractionKnown_ = false;
  if (machine_.tool != static_cast<int>(now_[Tool])) {
    note(Tool, machine_.tool);
    now_[Nozzle] = check_.nozzleTarget;
    retractionKnown_ = false;
  }
  note(Nozzle, check_.nozzleTarget);
  note(Bed, check_.bedTarget);
  noteMotion(command, words, name);
  noteFan(command, words, name);
  judgeWait(command, words, name);
  homed_ = homed_ || (custom_ && layers_ > 0 && homesZ(command));  // from then on only the printer knows Z
  judgeEnd();
}

// Notes flow, speed, pressure advance, acceleration and jerk.
void PrintRules::noteMotion(const GcodeCommand& command, const GcodeWords& words, const std::string& name) {
  if (command.is('M', 221)) note(Flow, words.at('S', now_[Flow]));
  if (command.is('M', 220)) note(Speed, words.at('S', now_[Speed]));
  if (command.is('M', 900)) note(Advance, words.at('K', now_[Advance]));
  if (command.is('M', 572)) note(Advance, words.at('S', now_[Advance]));
  if (command.is('M', 204)) {
    const double most = std::max({words.at('S'), words.at('P'), words.at('T')});
    if (most > 0) note(Acceleration, most);
  }
  if (command.is('M', 205) || command.is('M', 566)) {
    const double most = std::max(words.at('X'), words.at('Y'));
    if (most > 0) note(Corner, command.code == 566 ? most / 60 : most);
  }
  if (name != "SET_VELOCITY_LIMIT" && name != "SET_PRESSURE_ADVANCE") return;
  forEachNumber(command.rest, [&](const std::string& key, double value) {
    if (key == "ADVANCE") note(Advance, value);
    if (key == "ACCEL") note(Acceleration, value);
    if (key == "SQUARE_CORNER_VELOCITY") note(Corner, value);
  });
}

// Notes the fan that cools the print [%].
void PrintRules::noteFan(const GcodeCommand& command, const GcodeWords& words, const std::string& name) {
  const bool part = !words.has('P') || words.at('P') <= 1;  // other fans cool the chamber or the board
  if (command.is('M', 107) && part) fan_ = 0;
  if (command.is('M', 106) && part) {
    const double told = words.at('S', 255);
    fan_ = told <= 1 && machine_.duet ? 100 * told : told / 2.55;
  }
  if (name != "SET_FAN_SPEED") return;
  forEachNumber(command.rest, [&](const std::string& key, double value) {
    if (key == "SPEED") fan_ = 100 * value;
  });
}

// Judges pauses and waits during which the nozzle touches the print.
void PrintRules::judgeWait(const GcodeCommand& command, const GcodeWords& words, const std::string& name) {
  if (block() || !moved_) return;
  const bool pause = pauses(command, words, name);
  const bool heats = waitsForHeat(command, name);
  const double seconds = command.is('G', 4) ? std::max(words.at('S'), words.at('P') / 1000) : 0;
  if (!pause && !heats && !(seconds > kWait)) return;
  const FindingValues values{{"command", shownText(command.name)}};
  if (inPath_) return tell(pause ? "pauses-on-print" : "waits-on-print", true, values);
  if ((pause && ours_) || seconds > kLongWait) {
    if (standsOnPrint()) tell(pause ? "pauses-on-print" : "waits-on-print", ours_, values);
  }
}

// Judges the nozzle's height in the end blocks of our own files; other programs may leave the lift to a macro.
void PrintRules::judgeEnd() {
  if (!ours_ || !custom_ || layers_ == 0 || homed_) return;
  if (standsOnPrint()) tell("rests-on-print", true);
}

// Reads temperatures, speed limits and filaments from a setting that the file states.
void PrintRules::readSettings(std::string_view text) {
  const std::size_t equal = text.find(" = ");
  if (equal == std::string_view::npos) return;
  const std::string_view key = text.substr(0, equal);
  const std::string_view value = text.substr(equal + 3);
  if (key == "temperature" || key == "first_layer_temperature" || key == "nozzle_temperature" ||
      key == "nozzle_temperature_initial_layer") {
    addNumbers(value, temperatures_);
  }
  if (key == "machine_max_speed_x" || key == "machine_max_feedrate_x") readNumber(value, mostSpeed_);
  if (key == "machine_max_speed_e" || key == "machine_max_feedrate_e") readNumber(value, mostPush_);
  if (key == "filament_type") {
    filaments_ = 1 + (std::count(value.begin(), value.end(), ';'));
    pla_ = filaments_ == 1 && upperCase(value).starts_with("PLA");
  }
}

// Reads roles, heights, widths and settings.
void PrintRules::onComment(std::string_view text) {
  if (text.starts_with("TYPE:") || text.starts_with("FEATURE: ")) {
    const std::string role = upperCase(trimmed(text.substr(text.find(':') + 1)));
    aside_ = role.starts_with("SKIRT") || role == "BRIM" || role.starts_with("SUPPORT");
    const auto odd = {"BRIDGE", "OVERHANG", "IRONING", "GAP"};  // these are laid thin or thick on purpose
    plain_ = !aside_ && std::none_of(odd.begin(), odd.end(),
                                     [&](const char* part) { return role.find(part) != std::string::npos; });
    dragged_ = 0;
    return;
  }
  for (const std::string_view key : {"Z:", "Z_HEIGHT:"}) {
    const auto value = numberAfter(text, key);
    if (!value || layers_ == 0) continue;
    told_ = *value;
    heightTold_ = false;
  }
  for (const std::string_view key : {"HEIGHT:", "LAYER_HEIGHT:"}) {
    const auto value = numberAfter(text, key);
    if (value) pathHeight_ = *value;
    if (!value || heightTold_) continue;
    height_ = *value;
    heightTold_ = true;
  }
  for (const std::string_view key : {"WIDTH:", "LINE_WIDTH:"}) width_ = numberAfter(text, key).value_or(width_);
  if (const auto value = numberAfter(text, "Layer height:")) usualStep_ = *value;
  readSettings(text);
}

// Finds filament that is pushed on the spot beyond what was drawn back.
void PrintRules::onFilament(double e, double retractedBefore) {
  quiet_ = quiet_ && e > 0 && retractedBefore <= 0;
  if (e < 0) {
    retractionKnown_ = !block();
    return;
  }
  if (block() || !moved_) return;
  const double surplus = e - retractedBefore;
  const bool known = ours_ ? retractionKnown_ || inPath_ : inPath_;
  if (known && surplus > (ours_ ? kSurplus : kForeignSurplus)) {
    tell("pushes-twice", true, {{"mm", decimal(surplus, 2)}});
  }
}

// Finds drags over the print, and judges height, speed, flow and cooling of each bead.
void PrintRules::onMove(const MachineMove& move) {
  toldF_ = toldF_ || move.toldF;
  if (!(move.length > 0)) {
    quiet_ = quiet_ && move.z == move.zFrom;
    if (move.e != 0 && !block() && machine_.speed > fastestPush_) {
      fastestPush_ = machine_.speed;
      fastestPushLine_ = check_.lines;
    }
    return;
  }
  if (!ours_) noteGap(move);
  if (!(move.e > 0)) {
    // Other slicers travel over layers as they like until the last one is done. So do our own files without a lift,
    // which is only a warning until then.
    const bool judged = ours_ || (custom_ && layers_ > 0);
    if (!judged || !(laid_.top() > 0)) return;
    dragged_ += laid_.touched(move, kTouch);
    if (dragged_ <= (!custom_ ? kMostDragged : ours_ ? kTouch : kLeastWay)) return;
    tell("drags", ours_ && custom_, {{"mm", decimal(dragged_, 0)}});
    dragged_ = 0;
    return;
  }
  if (block()) return;
  dragged_ = 0;
  if (!laying_) {
    laying_ = true;
    atFirst_ = now_;
    if (now_[Advance] > kLongAdvance && now_[Advance] < kOldAdvance) {
      tell("advance", false, {{"seconds", decimal(now_[Advance], 3)}, {"told", decimal(now_[Advance], 3)}});
    }
  }
  for (const Change& change : pending_) {  // a change that was taken back before any bead is none
    if (change.value == now_[change.setting] && changes_.size() < kMostChanges) changes_.push_back(change);
  }
  pending_.clear();
  if (layers_ == 1) {
    firstMm_ += move.length;
    if (fan_ >= kBlowing) {
      firstCooledMm_ += move.length;
      if (firstCooledLine_ == 0) {
        firstCooledLine_ = check_.lines;
        firstFan_ = fan_;
      }
    }
  } else if (layers_ > 2) {
    (fan_ > 0 ? cooledMm_ : uncooledMm_) += move.length;
  }
  if (tower_ || aside_) return;
  if (!ours_) noteFlow(move);
  if (box_.empty()) {
    boxZ_ = move.z;
    boxLine_ = check_.lines;
  }
  box_.add(move.from);
  box_.add(move.to);
  judgeHeight(move);
  judgeSpeed(move);
}

// Finds beads that are missing in another program's file, and ways there and back over the print, which no slicer
// makes.
void PrintRules::noteGap(const MachineMove& move) {
  if (!(move.e > 0)) {
    quiet_ = quiet_ && move.e == 0 && move.z == move.zFrom;
    if (way_ == 0) wayStart_ = move.from;
    way_ += move.length;
    wayToldF_ = wayToldF_ || toldF_;
    toldF_ = false;
    return;
  }
  if (way_ > 0 && !block()) {
    const bool told = wayToldF_ && toldF_;
    if (told) ++ways_;
    if (!told && quiet_ && way_ > kLeastGap && gaps_++ == 0) gapLine_ = check_.lines;
    const bool back = length(move.from - wayStart_) <= kSame;
    if (quiet_ && back && way_ > kLeastWay) tell("drags", false, {{"mm", whole(way_)}});
  }
  way_ = 0;
  toldF_ = wayToldF_ = false;
  quiet_ = true;
}

// Adds a bead's plastic to its layer, and the plastic that its marks ask for: a bead's section is a rectangle with
// round ends.
void PrintRules::noteFlow(const MachineMove& move) {
  if (!plain_ || !(width_ > 0) || !(pathHeight_ > 0)) return;
  const double section = pathHeight_ * (width_ - pathHeight_) + std::numbers::pi / 4 * pathHeight_ * pathHeight_;
  if (flows_.empty()) return;
  LayerFlow& flow = flows_.back();
  if (flow.line == 0) flow.line = check_.lines;
  flow.laid += move.e * area_;
  flow.told += section * move.length;
}

// Judges a bead's height by the mark of its layer, if there is one, else by the step from the layer before.
void PrintRules::judgeHeight(const MachineMove& move) {
  if (move.z != move.zFrom) {
    climbs_ = true;
    offLine_ = 0;
  }
  if (climbs_) return;  // the layer is a spiral, level only where heights are rounded
  tellOff();
  if (told_ >= 0) {
    if (ours_ || !(height_ > 0)) return;  // Rules judges our own files
    if (toldFirst_ < 0) toldFirst_ = told_;
    const double rise = told_ - toldBefore_;
    const bool twice = std::abs(rise) < kSame && told_ > toldFirst_ + kSame;
    if (!stepJudged_ && toldBefore_ >= 0 && (twice || rise > (1 + kHeightShare) * height_)) {
      tell("odd-step", false, {{"mm", decimal(rise, 3)}, {"told", decimal(height_, 3)}});
    }
    stepJudged_ = true;
    const double off = move.z - told_ - settings_.zOffset;
    if (!offsetKnown_) {
      offsetKnown_ = true;
      offset_ = std::abs(off) <= kFileOffset ? off : 0;
    }
    if (std::abs(off - offset_) <= kHeightShare * height_) return;
    offLine_ = check_.lines;
    offZ_ = move.z;
    offTop_ = told_ + settings_.zOffset;
    return;
  }
  if (stepJudged_) return;
  stepJudged_ = true;
  const double step = move.z - lastZ_;
  const bool known = usualStep_ > 0 && lastZ_ > 0 && layers_ > 2 && step > 0;
  if (known && std::abs(step - usualStep_) > kHeightShare * usualStep_) {
    tell("odd-step", false, {{"mm", decimal(step, 3)}, {"told", decimal(usualStep_, 3)}});
  }
  lastZ_ = move.z;
}

// Judges a bead's speed and flow by limits that only the file states: its own for a filament, else those of the profile
// of its machine.
void PrintRules::judgeSpeed(const MachineMove& move) {
  if (settings_.printer) return;
  const double speed = machine_.speed * now_[Speed] / 100;
  if (speed > fastest_) {
    fastest_ = speed;
    fastestLine_ = check_.lines;
  }
  const double own = mostFlowOf(settings_, machine_.tool);
  const double limit = own > 0 ? kForeignFlowSlack * own : profile_ ? kProfileFlowSlack * profile_->maxFlow : 0;
  const double flow = (move.e - 1e-5) * area_ / move.length * speed * std::max(1.0, now_[Flow] / 100);
  if (limit > 0 && flow > limit) {
    tell("flow-told", ours_ && flow > kFarFlow * limit,
         {{"flow", decimal(flow, 1)}, {"limit", decimal(own > 0 ? own : profile_->maxFlow, 1)}});
  }
}

// Reports the last bead that lies off its layer, unless judgeHeight has found since that the layer climbs.
void PrintRules::tellOff() {
  if (offLine_ == 0) return;
  const std::int64_t here = std::exchange(check_.lines, std::exchange(offLine_, 0));
  found("off-layer", true, {{"z", decimal(offZ_, 3)}, {"top", decimal(offTop_, 3)}});
  check_.lines = here;
}

// Ends the layer before: reports a shift against the one below, and resets what belongs to a layer.
void PrintRules::onLayer() {
  tellOff();
  if (told_ >= 0) toldBefore_ = told_;
  told_ = -1;
  quiet_ = false;
  if (flows_.size() < kMostLayers) flows_.emplace_back();
  height_ = 0;
  heightTold_ = stepJudged_ = climbs_ = false;
  if (box_.empty()) return;
  const double rise = boxZ_ - belowZ_;
  if (!below_.empty() && rise > 0 && rise < 2) {
    const Vec2 size = box_.size();
    const Vec2 change = size - below_.size();
    const Vec2 shift = 0.5 * (box_.min - below_.min + box_.max - below_.max);
    const bool same = std::abs(change.x) <= kSameSize && std::abs(change.y) <= kSameSize;
    if (same && std::min(size.x, size.y) >= kLeastShifted && length(shift) > kShift) {
      tell("shifted", ours_, {{"mm", decimal(length(shift), 2)}}, boxLine_);
    }
  }
  below_ = box_;
  belowZ_ = boxZ_;
  box_ = {};
}

// Judges a change of the nozzle's target by the nearest temperature that the file states.
void PrintRules::judgeHeat(const Change& change) {
  double nearest = atFirst_[Nozzle];
  for (const double told : temperatures_) {
    if (std::abs(told - change.value) < std::abs(nearest - change.value)) nearest = told;
  }
  const double off = std::abs(change.value - nearest);
  if (off <= (ours_ ? kSameHeat : kFarHeat)) return;
  tell("heat-changed", ours_, {{"degrees", whole(change.value)}, {"told", whole(atFirst_[Nozzle])}}, change.line);
}

// Judges a change in mid-print; in other programs' files only large ones count.
void PrintRules::judge(const Change& change) {
  const double value = change.value;
  const double first = atFirst_[change.setting];
  const double before = before_[change.setting];
  const std::string start = before < 0 ? "none" : decimal(before, 0);
  switch (change.setting) {
    case Nozzle:
      return judgeHeat(change);
    case Bed:
      if (first <= 0 || std::abs(value - first) <= (ours_ ? kSameHeat : value > 0 ? kFarBed : 0)) return;
      return tell("bed-changed", ours_, {{"degrees", whole(value)}, {"told", whole(first)}}, change.line);
    case Flow:
    case Speed: {
      const double share = first > 0 ? value / first - 1 : 0;
      const bool flow = change.setting == Flow;
      const bool much = flow ? std::abs(share) > kMostFlowChange - kSame : share > kHighSpeed - 1;
      if (ours_ ? std::abs(share) < kSame : !much && (!flow || std::abs(share) <= kSmallFlowChange)) return;
      return tell(flow ? "flow-changed" : "speed-changed", ours_ || (flow && much),
                  {{"percent", whole(value)}, {"told", whole(first)}}, change.line);
    }
    case Advance:
      if (!ours_ && (value <= kLongAdvance || value >= kOldAdvance)) return;
      return tell("advance", ours_, {{"seconds", decimal(value, 3)}, {"told", first < 0 ? "none" : decimal(first, 3)}},
                  change.line);
    case Acceleration:
      if (value <= before || (!ours_ && value < kHighAcceleration)) return;
      return tell("acceleration", ours_, {{"value", whole(value)}, {"told", start}}, change.line);
    case Corner:
      if (ours_ ? value <= before : value <= kHighCorner) return;
      return tell("corners", ours_ || value > kHighestCorner, {{"value", whole(value)}, {"told", start}}, change.line);
    case Tool: {
      const bool one = filaments_ == 1;
      if (!ours_ && (filaments_ == 0 || value < static_cast<double>(filaments_))) return;
      return tell("other-tool", true, {{"tool", whole(value)}, {"filaments", one ? "one" : std::to_string(filaments_)}},
                  change.line);
    }
    case kSettings:
      return;
  }
}

// Finds PLA that is never cooled, and a fan that blows on most of the first layer.
void PrintRules::judgeFan() {
  if (pla_ && uncooledMm_ > 0 && cooledMm_ == 0) tell("no-fan", false);
  if (startHeight_ <= 0 && layers_ > 1 && firstCooledMm_ > 0.5 * firstMm_) {
    tell("first-fan", false, {{"percent", whole(firstFan_)}}, firstCooledLine_);
  }
}

// Reports ways without a speed, which once were beads. Slicers state the speed of each way, unless it is the beads'
// own.
void PrintRules::judgeGaps() {
  if (gaps_ == 0 || kRarely * gaps_ > ways_) return;
  check_.findings.push_back(makeFinding("gap", false));
  check_.findings.back().line = gapLine_;
  check_.findings.back().count = gaps_;
}

// Finds layers whose share of the plastic that their marks ask for is off the median of all layers.
void PrintRules::judgeFlow() {
  std::vector<double> shares;
  for (const LayerFlow& flow : flows_) {
    if (flow.told >= kLeastPlastic) shares.push_back(flow.laid / flow.told);
  }
  if (shares.size() < 3 || filaments_ > 1) return;
  const auto middle = shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 2);
  std::nth_element(shares.begin(), middle, shares.end());
  for (const LayerFlow& flow : flows_) {
    if (flow.told < kLeastPlastic || std::abs(flow.laid / flow.told / *middle - 1) <= kOddFlow) continue;
    tell("odd-flow", false, {{"percent", whole(100 * flow.laid / flow.told)}, {"told", whole(100 * *middle)}},
         flow.line);
  }
}

// Judges what only the whole file shows: gaps, flow, speeds, changes and the fan.
void PrintRules::onFinish() {
  onLayer();
  judgeGaps();
  judgeFlow();
  if (mostPush_ > 0 && fastestPush_ > kFarPush * mostPush_) {
    tell("speed-told", false, {{"speed", whole(fastestPush_)}, {"limit", whole(mostPush_)}}, fastestPushLine_);
  }
  if (mostSpeed_ > 0 && fastest_ > 1.001 * mostSpeed_) {
    tell("speed-told", false, {{"speed", whole(fastest_)}, {"limit", whole(mostSpeed_)}}, fastestLine_);
  }
  for (const Change& change : changes_) judge(change);
  judgeFan();
}

}  // namespace sillon
