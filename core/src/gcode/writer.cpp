#include "sillon/gcode/writer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/decimal_text.hpp"
#include "gcode/chunked_output.hpp"
#include "gcode/file_comments.hpp"
#include "gcode/layout.hpp"
#include "gcode/motion.hpp"
#include "gcode/plan.hpp"
#include "printer/bed.hpp"
#include "printer/dialect.hpp"

namespace sillon {
namespace {

constexpr double kWipeLength = 3;  // [mm]
constexpr double kLiftSpeed = 10;  // [mm/s], what Z axes take without complaint
constexpr double kFastest = 1.5;   // [speed], of narrow beads with constantFlow
constexpr double kManyMoves = 2e6;
constexpr double kManyBytes = 100e6;
constexpr double kSlowestPace = 5;   // [mm/s], slower nozzles drop more than they lay
constexpr double kSeamStep = 0.382;  // golden section: seams of neighbouring layers lie far apart

struct Role {
  const char* type;     // PrusaSlicer's word
  const char* feature;  // Orca's and Bambu Studio's
};
constexpr Role kSkirtRole{"Skirt/Brim", "Skirt"};
constexpr Role kBrimRole{"Skirt/Brim", "Brim"};
constexpr Role kBaseRole{"Solid infill", "Internal solid infill"};
constexpr Role kOrientedRole{"Top solid infill", "Top surface"};
constexpr Role kCustomRole{"Custom", "Custom"};

std::string whole(double value) { return fixed(value, 0); }

// One layer of one copy, bottom first.
struct Layer {
  int index = 0;
  int copy = 0;
  double top = 0;      // [mm]
  double height = 0;   // [mm]
  bool first = false;  // upon the bed itself: slower, hotter, without fan
  bool oriented = false;
  bool onBed = false;  // oriented, below the base
  int turn = 0;        // among its kind
};

// Layers that take the same time: the first of the first copy, those of others, base layers both ways, oriented layers
// above and below the base.
constexpr std::size_t kKinds = 6;
std::size_t kindOf(const Layer& layer) {
  if (layer.index == 0) return layer.copy == 0 ? 0 : 1;
  return layer.onBed ? 5 : layer.oriented ? 4 : static_cast<std::size_t>(2 + layer.turn % 2);
}

// What is known of a file before it is written.
struct Estimate {
  double seconds = 0;
  std::array<double, kKinds> pace{1, 1, 1, 1, 1, 1};  // share of its speed that each kind of layer runs at
};

Layer layerAt(const PrintParams& params, int copy, int index) {
  Layer layer;
  layer.index = index;
  layer.copy = copy;
  layer.top = layerTop(params, index);
  layer.height = index == 0 ? firstLayerHeight(params) : params.layerHeight;
  layer.first = index == 0 && beginsOnBed(params);
  layer.oriented = isOriented(params, index);
  layer.onBed = params.showSide == ShowSide::Both && index < params.layers;
  const int below = params.showSide == ShowSide::Up ? params.base : params.layers;  // where the other kind begins
  layer.turn = index < below ? index : index - below;
  return layer;
}

// Plans motions, and keeps the longest one: planned for the estimate, it is written without being planned again, which
// takes a third of the time of writing.
class Plans {
 public:
  /// \return valid until the next call.
  const Motion& of(const BeadPath& path, std::size_t start, const MotionLimits& limits) {
    if (path_ == &path && start_ == start && limits_ == limits) return longest_;
    Motion motion = planMotion(path, start, limits);
    if (motion.points.size() <= longest_.points.size()) return other_ = std::move(motion);
    path_ = &path;
    start_ = start;
    limits_ = limits;
    return longest_ = std::move(motion);
  }

 private:
  const BeadPath* path_ = nullptr;
  std::size_t start_ = 0;
  MotionLimits limits_;
  Motion longest_;
  Motion other_;
};

// Follows the nozzle through the layers: text, filament and time. All times are from rest to rest between paths.
class Writer {
 public:
  Writer(const GcodeJob& job, const Printer& printer, const PrintParams& params, Plans& plans, const GcodeSink* sink)
      : job_(job), printer_(printer), params_(params), plans_(plans), out_(sink), silent_(sink == nullptr) {}

  /// \param estimate  of the whole file; pace counts for layers that follow.
  void expect(const Estimate& estimate) {
    expected_ = estimate.seconds;
    pace_ = estimate.pace;
  }
  void header();
  void startBlock();
  [[nodiscard]] std::string place(std::size_t copy) const;
  void takeOver();
  void purge();
  void layer(const Layer& layer);
  void endBlock();
  void footer();
  GcodeSummary finish();

  [[nodiscard]] bool failed() const { return out_.failed(); }
  [[nodiscard]] double seconds() const { return seconds_; }

 private:
  void role(const Role& role);
  void beginObject(int copy);
  void endObject(int copy);
  [[nodiscard]] MotionLimits layerLimits(const Layer& layer, double flow) const;
  void evenFlow(MotionLimits& limits, double spacing) const;
  void lay(const BeadPath& path, std::size_t start, const MotionLimits& limits, const Layer& layer, double top);
  void paths(const std::vector<BeadPath>& paths, const Role& role, double flow, const Layer& layer);
  void patches(const Layer& layer);
  void heat(double degrees);
  void bead(const Motion& motion, double flow, double height);
  void retract();
  void unretract();
  void approach(PointUm target, double top);
  void leave(const Motion& motion, double speed, double top, bool retractOnTheWay = false);
  void wipe(const std::vector<PointUm>& points, double speed, double retraction);
  void extrude(std::int64_t amount);
  void filamentMove(double length);
  void moveZ(double z);
  void travel(PointUm target, double speed);
  void moveTo(PointUm target, double speed);
  [[nodiscard]] MotionLimits machineLimits() const;
  void fan(double percent);
  [[nodiscard]] double firstAcceleration() const;
  void feedrate(std::int64_t mmPerMin);
  void progress();

  const GcodeJob& job_;
  const Printer& printer_;
  const PrintParams& params_;
  Plans& plans_;
  ChunkedOutput out_;
  bool silent_;
  double expected_ = 0;  // [s], for the progress
  std::array<double, kKinds> pace_{1, 1, 1, 1, 1, 1};
  int fan_ = -1;          // [0..255] as written
  double advance_ = -1;   // [s], of patches
  double patchHeat_ = 0;  // [degrees Celsius] that a patch asked for; 0: the layer's
  double seconds_ = 0;
  double nextProgress_ = 0;  // [s]
  PointUm at_;
  PointUm shift_;                     // of the copy that is printed
  double clearance_ = 0;              // [mm], height of the plates that the next travel passes over
  std::int64_t z_ = -1;               // [µm]; -1: not known yet
  std::int64_t feedrate_ = 0;         // [mm/min]
  double retracted_ = 0;              // [mm]
  double filament_ = 0;               // [mm], exact
  std::int64_t filamentWritten_ = 0;  // [0.00001 mm]
  std::int64_t e_ = 0;                // where the file's E axis stands [0.00001 mm]
  std::int64_t moves_ = 0;
  double orientedMm_ = 0;
  double flowSlowedMm_ = 0;
  double segmentSlowedMm_ = 0;
  double curveSlowedMm_ = 0;
};

void Writer::header() {
  writeHeader(out_, job_, printer_, params_, expected_);
  progress();
}

void Writer::startBlock() {
  role(kCustomRole);
  out_ << job_.startBlock;
  takeOver();
  if (printer_.flavor == GcodeFlavor::Klipper) {
    out_ << "SET_PRINT_STATS_INFO TOTAL_LAYER=" << std::to_string(fileLayers(job_, params_)) << "\n";
  }
  if (job_.copies.size() > 1 && printer_.flavor == GcodeFlavor::Klipper) {
    for (std::size_t k = 0; k < job_.copies.size(); ++k) {
      out_ << "EXCLUDE_OBJECT_DEFINE NAME=PLATE_" << std::to_string(k) << place(k) << "\n";
    }
  }
  if (printer_.machineAcceleration > 0) out_ << accelerationCommand(printer_.flavor, printer_.acceleration);
  if (printer_.machineCornerSpeed > 0) out_ << cornerSpeedCommand(printer_.flavor, printer_.cornerSpeed);
  if (printer_.setPressureAdvance) out_ << pressureAdvanceCommand(printer_.flavor, printer_.pressureAdvance);
  purge();
}

// From whatever a start block leaves to a hot nozzle that stands aside, above all that may be on the bed. It draws back
// what is given back before the first bead, so that no thread is drawn and no bead lacks filament, whether or not the
// block drew back itself. Waiting again costs nothing where the block has waited for the same.
void Writer::takeOver() {
  out_ << "G21\nG90\n" << (printer_.absoluteE ? "M82" : "M83") << "\nG92 E0\nM220 S100\nM221 S100\n";
  retracted_ = job_.startRetracted;
  if (job_.hotStart) retract();
  clearance_ = safeHeight(printer_, params_) - printer_.lift;
  moveZ(safeHeight(printer_, params_));
  if (job_.ownStart || !job_.purge.points.empty()) travel(job_.aside, printer_.travelSpeed);
  const std::string bed = whole(printer_.bedTemperature);
  out_ << (printer_.bedTemperature > 0 ? "M190 S" : "M140 S") << bed << "\nM109 S"
       << whole(printer_.firstLayerNozzleTemperature) << "\n";
  if (job_.purge.points.empty()) retract();
}

void Writer::purge() {
  if (job_.purge.points.empty()) return;
  MotionLimits limits = machineLimits();
  limits.layerHeight = job_.purgeHeight;
  limits.filamentArea = filamentArea(printer_.filamentDiameter);
  limits.speed = std::min(printer_.firstLayerSpeed, printer_.speed);
  limits.maxFlow = printer_.maxFlow;
  limits.maxSegmentsPerSecond = printer_.maxSegmentsPerSecond;
  const Motion motion = planMotion(job_.purge, 0, limits);
  moveZ(job_.purgeHeight);
  unretract();
  bead(motion, 1, job_.purgeHeight);
  filament_ = static_cast<double>(filamentWritten_) / 1e5;  // the plate begins without a residue
  leave(motion, limits.speed, job_.purgeHeight);
  clearance_ = safeHeight(printer_, params_) - printer_.lift;
}

// Where a copy stands, for maps of the bed.
std::string Writer::place(std::size_t copy) const {
  const Vec2 lo = job_.firstPlate.min + mm(job_.copies[copy]);
  const Vec2 hi = job_.firstPlate.max + mm(job_.copies[copy]);
  const auto at = [](Vec2 p) { return fixed(p.x, 2) + "," + fixed(p.y, 2); };
  std::string corners;
  for (const Vec2 p : {lo, Vec2{hi.x, lo.y}, hi, Vec2{lo.x, hi.y}})
    corners += (corners.empty() ? "[" : ",[") + at(p) + "]";
  return " CENTER=" + at(0.5 * (lo + hi)) + " POLYGON=[" + corners + "]";
}

void Writer::role(const Role& role) { out_ << ";TYPE:" << role.type << "\n; FEATURE: " << role.feature << "\n"; }

void Writer::fan(double percent) {
  const auto value = static_cast<int>(std::lround(percent * 255 / 100));
  if (value == fan_) return;
  fan_ = value;
  out_ << "M106 S" << std::to_string(value) << "\n";
}

double Writer::firstAcceleration() const {
  const bool own = printer_.firstLayerAcceleration > 0 && printer_.firstLayerAcceleration < printer_.acceleration;
  return own ? printer_.firstLayerAcceleration : printer_.acceleration;
}

// F is modal: written only when it changes, at the end of a move.
void Writer::feedrate(std::int64_t mmPerMin) {
  if (mmPerMin != feedrate_) {
    feedrate_ = mmPerMin;
    out_ << " F";
    out_.scaled(mmPerMin, 0);
  }
  out_ << "\n";
  ++moves_;
}

void Writer::progress() {
  const double total = std::max(expected_, 1.0);
  const int percent = std::min(99, static_cast<int>(100 * seconds_ / total));
  out_ << "M73 P" << std::to_string(percent) << " R" << whole(std::max(0.0, total - seconds_) / 60) << "\n";
  nextProgress_ = percent < 99 ? (percent + 1) * total / 100 : 1e30;
}

void Writer::moveZ(double z) {
  const std::int64_t target = std::llround(z * 1000);
  if (target == z_) return;
  if (z_ >= 0) seconds_ += std::abs(static_cast<double>(target - z_)) / 1000 / kLiftSpeed;
  z_ = target;
  out_ << "G1 Z";
  out_.scaled(target, 3);
  feedrate(static_cast<std::int64_t>(kLiftSpeed * 60));
}

void Writer::travel(PointUm target, double speed) {
  if (target != at_) seconds_ += travelSeconds({at_, target}, speed, machineLimits());
  moveTo(target, speed);
}

void Writer::moveTo(PointUm target, double speed) {
  at_ = target;
  out_ << "G1 X";
  out_.scaled(target.x, 3) << " Y";
  out_.scaled(target.y, 3);
  feedrate(std::llround(speed * 60));
}

MotionLimits Writer::machineLimits() const {
  MotionLimits limits;
  limits.flavor = printer_.flavor;
  limits.acceleration = printer_.acceleration;
  limits.cornerSpeed = printer_.cornerSpeed;
  return limits;
}

// The number after E. \param amount  [0.00001 mm]
void Writer::extrude(std::int64_t amount) {
  e_ += amount;
  out_.scaled(printer_.absoluteE ? e_ : amount, 5);
}

void Writer::filamentMove(double length) {
  const std::int64_t amount = std::llround(length * 1e5);
  if (amount == 0) return;
  seconds_ += std::abs(length) / printer_.retractSpeed;
  out_ << "G1 E";
  extrude(amount);
  feedrate(std::llround(printer_.retractSpeed * 60));
}

// Draws back what is missing to the printer's retraction: a start block may have drawn back already.
void Writer::retract() {
  const double missing = printer_.retractLength - retracted_;
  if (missing < 1e-4) return;
  filamentMove(-missing);
  retracted_ = printer_.retractLength;
}

void Writer::unretract() {
  if (retracted_ > 0) filamentMove(retracted_);
  retracted_ = 0;
}

void Writer::approach(PointUm target, double top) {
  moveZ(std::max(top, clearance_) + printer_.lift);
  travel(target, printer_.travelSpeed);
  moveZ(top);
  clearance_ = 0;
  unretract();
}

// Retract, wipe back along the path, lift: the nozzle leaves the plate clean and never crosses it low. On the way, it
// draws back while it wipes: standing still it would leave a dot.
void Writer::leave(const Motion& motion, double speed, double top, bool retractOnTheWay) {
  if (!retractOnTheWay) retract();
  double left = kWipeLength;
  std::vector<PointUm> points{at_};
  for (std::size_t i = motion.lengths.size(); i-- > 0 && left > 0;) {
    PointUm target = motion.points[i] + shift_;
    if (motion.lengths[i] > left) {
      const PointUm from = motion.points[i + 1] + shift_;
      const double share = left / motion.lengths[i];
      target = {from.x + std::llround(share * static_cast<double>(target.x - from.x)),
                from.y + std::llround(share * static_cast<double>(target.y - from.y))};
    }
    left -= motion.lengths[i];
    if (target != points.back()) points.push_back(target);
  }
  wipe(points, speed, std::max(0.0, printer_.retractLength - retracted_));
  retract();  // what a path of no length has left
  moveZ(top + printer_.lift);
}

// \param points  from where the nozzle stands. \param retraction  drawn back evenly along them [mm of filament].
void Writer::wipe(const std::vector<PointUm>& points, double speed, double retraction) {
  std::vector<double> along{0};
  for (std::size_t i = 1; i < points.size(); ++i) {
    const PointUm d = points[i] - points[i - 1];
    along.push_back(along.back() + length(Vec2{static_cast<double>(d.x), static_cast<double>(d.y)}) / 1000);
  }
  const double total = along.back();
  const bool draws = retraction >= 1e-4 && total > 0;
  if (draws) speed = std::min(speed, total * printer_.retractSpeed / retraction);
  std::int64_t drawn = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (!draws) {
      moveTo(points[i], speed);
      continue;
    }
    const std::int64_t due = std::llround(retraction * along[i] / total * 1e5);
    at_ = points[i];
    out_ << "G1 X";
    out_.scaled(at_.x, 3) << " Y";
    out_.scaled(at_.y, 3) << " E";
    extrude(drawn - due);
    drawn = due;
    feedrate(std::llround(speed * 60));
  }
  if (draws) retracted_ = printer_.retractLength;
  seconds_ += travelSeconds(points, speed, machineLimits());
}

// One path of beads. What rounding takes from one E the next one brings.
void Writer::bead(const Motion& motion, double flow, double height) {
  const double perArea = flow * height / filamentArea(printer_.filamentDiameter);
  for (std::size_t i = 0; i < motion.beads; ++i) {
    filament_ += perArea * motion.areas[i];
    if (silent_) continue;
    const std::int64_t due = std::llround(filament_ * 1e5);
    const PointUm to = motion.points[i + 1] + shift_;
    out_ << "G1 X";
    out_.scaled(to.x, 3) << " Y";
    out_.scaled(to.y, 3) << " E";
    extrude(due - filamentWritten_);
    filamentWritten_ = due;
    feedrate(motion.feedrates[i]);
    seconds_ += motion.seconds[i];
    if (seconds_ >= nextProgress_) progress();
    if (out_.failed()) return;
  }
  for (std::size_t i = motion.beads; i < motion.lengths.size() && !silent_; ++i) {
    const PointUm to = motion.points[i + 1] + shift_;
    out_ << "G1 X";
    out_.scaled(to.x, 3) << " Y";
    out_.scaled(to.y, 3);
    feedrate(motion.feedrates[i]);
    seconds_ += motion.seconds[i];
  }
  if (silent_) seconds_ += motion.totalSeconds;
  at_ = motion.points.back() + shift_;
}

MotionLimits Writer::layerLimits(const Layer& layer, double flow) const {
  MotionLimits limits = machineLimits();
  limits.layerHeight = layer.height;
  limits.flow = flow;
  limits.filamentArea = filamentArea(printer_.filamentDiameter);
  limits.speed = layer.oriented ? job_.showSpeed : printer_.baseSpeed > 0 ? printer_.baseSpeed : printer_.speed;
  if (layer.first) limits.speed = std::min(printer_.firstLayerSpeed, limits.speed);
  if (layer.first) limits.acceleration = firstAcceleration();
  limits.maxFlow = printer_.maxFlow;
  limits.maxSegmentsPerSecond = printer_.maxSegmentsPerSecond;
  limits.pressureAdvance = printer_.pressureAdvance;
  limits.curveAcceleration = job_.knowsAdvance ? printer_.curveAcceleration : 0;
  limits.leastBead = kLeastBead * printer_.nozzle;
  return limits;
}

void Writer::evenFlow(MotionLimits& limits, double spacing) const {
  limits.evenFlow = limits.speed * spacing;
  limits.speed *= kFastest;
  if (printer_.machineSpeed > 0) limits.speed = std::min(limits.speed, printer_.machineSpeed);
}

// Goes there, lays the bead, leaves it. \param top  where the nozzle runs [mm].
void Writer::lay(const BeadPath& path, std::size_t start, const MotionLimits& limits, const Layer& layer, double top) {
  const Motion& motion = plans_.of(path, start, limits);
  approach(motion.points.front() + shift_, top);
  bead(motion, limits.flow, layer.height);
  if (out_.failed()) return;
  leave(motion, limits.speed, top, limits.scarf > 0 && path.closed);
  if (!layer.oriented) return;
  for (const double piece : motion.lengths) orientedMm_ += piece;
  flowSlowedMm_ += motion.flowSlowedMm;
  segmentSlowedMm_ += motion.segmentSlowedMm;
  curveSlowedMm_ += motion.curveSlowedMm;
}

void Writer::paths(const std::vector<BeadPath>& paths, const Role& role, double flow, const Layer& layer) {
  if (paths.empty()) return;
  MotionLimits limits = layerLimits(layer, flow);
  limits.speed = std::max(limits.speed * pace_[kindOf(layer)], std::min(limits.speed, kSlowestPace));
  if (params_.constantFlow && layer.oriented && !layer.first) evenFlow(limits, job_.spacing);
  limits.coast = layer.oriented ? params_.coast : 0;
  limits.scarf = layer.oriented ? params_.scarf : 0;

  this->role(role);
  for (const BeadPath& path : paths) {
    std::size_t start = 0;
    if (path.closed) {
      const std::size_t count = path.seams.empty() ? path.points.size() : path.seams.size();
      const auto step = static_cast<std::size_t>(kSeamStep * static_cast<double>(count));
      const std::size_t chosen = static_cast<std::size_t>(layer.turn) * step % count;
      start = path.seams.empty() ? chosen : path.seams[chosen];
    }
    lay(path, start, limits, layer, layer.top);
    if (out_.failed()) return;
  }
}

// Away from the plate, where what drips harms nothing.
void Writer::heat(double degrees) {
  clearance_ = safeHeight(printer_, params_) - printer_.lift;
  moveZ(safeHeight(printer_, params_));
  travel(job_.aside, printer_.travelSpeed);
  out_ << waitForNozzle(printer_.flavor, degrees);
}

void Writer::patches(const Layer& layer) {
  role(kBaseRole);
  const double layerFan = fan_ * 100.0 / 255;
  for (const PlacedPatch& patch : job_.patches) {
    if (patch.how.layer != layer.index) continue;
    if (patch.how.temperature != patchHeat_) {
      patchHeat_ = patch.how.temperature;
      const double usual = layer.first ? printer_.firstLayerNozzleTemperature : printer_.nozzleTemperature;
      heat(patchHeat_ > 0 ? patchHeat_ : usual);
    }
    fan(patch.how.fan < 0 ? layerFan : patch.how.fan);
    if (patch.how.advance >= 0 && patch.how.advance != advance_) {
      advance_ = patch.how.advance;
      out_ << pressureAdvanceCommand(printer_.flavor, advance_);
    }
    MotionLimits limits = layerLimits(layer, patch.how.flow);
    if (patch.how.speed > 0) limits.speed = patch.how.speed;
    if (patch.how.constantFlow) evenFlow(limits, patch.how.spacing);
    for (const BeadPath& path : patch.paths) {
      lay(path, 0, limits, layer, layer.top + patch.how.lift);
      if (out_.failed()) return;
    }
  }
}

void Writer::layer(const Layer& layer) {
  const std::string top = decimal(layer.top, 3);
  out_ << ";BEFORE_LAYER_CHANGE\n;" << top << "\n;LAYER_CHANGE\n;Z:" << top << "\n;HEIGHT:" << decimal(layer.height, 3)
       << "\n";
  if (printer_.flavor == GcodeFlavor::Klipper) {
    out_ << "SET_PRINT_STATS_INFO CURRENT_LAYER=" << std::to_string(layer.copy * layerCount(params_) + layer.index + 1)
         << "\n";
  }
  if (printer_.flavor == GcodeFlavor::Bambu) {
    out_ << "; CHANGE_LAYER\n; Z_HEIGHT: " << top << "\n; LAYER_HEIGHT: " << decimal(layer.height, 3) << "\n";
    const int count = layer.copy * layerCount(params_) + layer.index;  // the printer's screen shows it
    out_ << "M73 L" << std::to_string(count + 1) << "\nM991 S0 P" << std::to_string(count) << "\n";
  }
  if (printer_.absoluteE) {  // firmwares count in 32 bit floats
    e_ = 0;
    out_ << "G92 E0\n";
  }
  if (layer.index == 0) {
    beginObject(layer.copy);
    shift_ = job_.copies[static_cast<std::size_t>(layer.copy)];
    if (layer.copy > 0) clearance_ = layerTop(params_, layerCount(params_) - 1);
  }
  if (layer.first) {
    fan(printer_.firstLayerFan);
    if (printer_.machineAcceleration > 0 && firstAcceleration() != printer_.acceleration) {
      out_ << accelerationCommand(printer_.flavor, firstAcceleration());
    }
    if (layer.copy > 0) out_ << "M104 S" << whole(printer_.firstLayerNozzleTemperature) << "\n";
  }
  if (!layer.first) {
    // PLA wants all the air it can get, PETG and its kin lose their bond between layers then.
    const double usual = printer_.filamentType == "PLA" ? 100 : 50;
    const double asked = layer.oriented ? printer_.showFan : printer_.baseFan;
    fan(asked < 0 ? usual : asked);
  }
  if (layer.index == (beginsOnBed(params_) ? 1 : 0)) {
    if (beginsOnBed(params_) && printer_.machineAcceleration > 0 && firstAcceleration() != printer_.acceleration) {
      out_ << accelerationCommand(printer_.flavor, printer_.acceleration);
    }
    out_ << "M104 S" << whole(printer_.nozzleTemperature) << "\n";
    patchHeat_ = 0;
  }
  if (layer.index == 0) {
    if (layer.copy == 0) paths(job_.skirt, kSkirtRole, params_.baseFlow, layer);
    paths(job_.brim, kBrimRole, params_.baseFlow, layer);
  }
  if (layer.oriented && !job_.patches.empty()) {
    patches(layer);
  } else if (layer.oriented) {
    paths(layer.onBed ? job_.bedCycles : job_.cycles, kOrientedRole,
          layer.first && params_.showSide != ShowSide::Up ? params_.bedFlow : params_.flow, layer);
  } else if (params_.basePattern == BasePattern::Same) {
    paths(job_.cycles, kBaseRole, params_.baseFlow, layer);
  } else if (layer.index == 0 && !job_.firstBase.empty()) {
    paths(job_.firstBase, kBaseRole, params_.baseFlow, layer);
  } else {
    paths(job_.bases[static_cast<std::size_t>(layer.turn % 2)], kBaseRole, params_.baseFlow, layer);
  }
}

// Hosts can leave out one of several plates by its name.
void Writer::beginObject(int copy) {
  if (job_.copies.size() < 2) return;
  const bool klipper = printer_.flavor == GcodeFlavor::Klipper;
  if (copy > 0) endObject(copy - 1);
  out_ << (klipper ? "EXCLUDE_OBJECT_START NAME=PLATE_" : "M486 S") << std::to_string(copy) << "\n";
}

void Writer::endObject(int copy) {
  if (printer_.flavor == GcodeFlavor::Klipper) {
    out_ << "EXCLUDE_OBJECT_END NAME=PLATE_" << std::to_string(copy) << "\n";
  } else {
    out_ << "M486 S-1\n";
  }
}

void Writer::endBlock() {
  if (job_.copies.size() > 1) endObject(static_cast<int>(job_.copies.size()) - 1);
  // Some hosts read only the last MiB, and would take the lift for the height of the plate.
  out_ << ";BEFORE_LAYER_CHANGE\n;" << decimal(layerTop(params_, layerCount(params_) - 1), 3) << "\n";
  role(kCustomRole);
  moveZ(std::min(printer_.maxZ, static_cast<double>(z_) / 1000 + kParkLift));
  // Klipper knows no cap and keeps what it is told: nothing is raised there above what was set at the start.
  const bool capped = printer_.flavor != GcodeFlavor::Klipper;
  if (printer_.setPressureAdvance && capped) {
    out_ << pressureAdvanceCommand(printer_.flavor, 0);
  } else if (advance_ >= 0) {  // the last patch's value is nobody's
    out_ << pressureAdvanceCommand(printer_.flavor, capped ? 0 : printer_.pressureAdvance);
  }
  if (printer_.machineAcceleration > 0 && capped) {
    out_ << accelerationCommand(printer_.flavor, printer_.machineAcceleration);
  }
  if (printer_.machineCornerSpeed > 0 && capped) {
    out_ << cornerSpeedCommand(printer_.flavor, printer_.machineCornerSpeed);
  }
  if (!job_.endBlock.empty()) {
    if (printer_.absoluteE) out_ << "G92 E0\n";  // a block's "G1 E-2" draws back 2 mm, wherever the axis stood
    out_ << job_.endBlock << "M73 P100 R0\n";
    return;
  }
  Vec2 park{std::ceil(printer_.bedMin.x * 1000), std::floor(printer_.bedMax.y * 1000)};
  if (printer_.roundBed) {
    const Bed bed(printer_);
    park = 1000.0 * (bed.centre() + Vec2{0, 0.95 * bed.radius()});
  }
  travel({std::llround(park.x), std::llround(park.y)}, printer_.travelSpeed);
  out_ << "M104 S0\nM140 S0\nM107\nM84\nM73 P100 R0\n";
}

void Writer::footer() {
  writeFooter(out_, {static_cast<double>(filamentWritten_) / 1e5, seconds_}, job_, printer_, params_);
}

GcodeSummary Writer::finish() {
  out_.flush();
  GcodeSummary summary;
  summary.filamentMm = static_cast<double>(filamentWritten_) / 1e5;
  summary.filamentCm3 = summary.filamentMm * filamentArea(printer_.filamentDiameter) / 1000;
  summary.filamentGrams = summary.filamentCm3 * printer_.filamentDensity;
  summary.seconds = seconds_;
  summary.moves = moves_;
  summary.bytes = out_.bytes();
  summary.clampedLengthMm = job_.clampedMm * params_.layers * static_cast<double>(job_.copies.size()) *
                            (params_.showSide == ShowSide::Both ? 2 : 1);
  summary.curveSlowedMm = curveSlowedMm_;
  summary.warnings = job_.warnings;
  const auto warn = [&](WarningCode code, const char* name, double value) {
    summary.warnings.push_back({code, {{name, value}}});
  };
  const auto slowed = [&](WarningCode code, double mm) {
    if (mm > 0.1 * orientedMm_) warn(code, "percent", percent(mm / orientedMm_));
  };
  slowed(WarningCode::MaxFlowSlows, flowSlowedMm_);
  slowed(WarningCode::SegmentsSlow, segmentSlowedMm_);
  const auto moves = static_cast<double>(moves_);
  if (moves > kManyMoves) warn(WarningCode::ManyMoves, "n", moves);
  const auto bytes = static_cast<double>(summary.bytes);
  if (bytes > kManyBytes) warn(WarningCode::ManyBytes, "mb", std::floor(bytes / 1e6));
  return summary;
}

// Time for all copies without writing them. Layers of one kind differ by the seam only, so one of each is planned, and
// those that are too short for the plastic to set are slowed.
Estimate estimateFile(const GcodeJob& job, const Printer& printer, const PrintParams& params, Plans& plans) {
  std::array<double, kKinds> known{-1, -1, -1, -1, -1, -1};
  Writer silent(job, printer, params, plans, nullptr);
  silent.startBlock();
  Estimate estimate{silent.seconds()};
  const auto timeOf = [&](const Layer& layer) {
    silent.expect(estimate);
    const double before = silent.seconds();
    silent.layer(layer);
    return silent.seconds() - before;
  };
  for (int copy = 0; copy < static_cast<int>(job.copies.size()); ++copy) {
    for (int i = 0; i < layerCount(params); ++i) {
      const Layer layer = layerAt(params, copy, i);
      const std::size_t kind = kindOf(layer);
      double& seconds = known[kind];
      if (layer.oriented && !job.patches.empty()) {  // each layer its own, at the speeds it asks for
        estimate.seconds += timeOf(layer);
        continue;
      }
      if (seconds < 0) {
        seconds = timeOf(layer);
        for (int round = 0; round < 3 && seconds < printer.minLayerTime * 0.98; ++round) {
          estimate.pace[kind] *= seconds / printer.minLayerTime;
          seconds = timeOf(layer);
        }
      }
      estimate.seconds += seconds;
    }
  }
  return estimate;
}

}  // namespace

double extrusion(double layerHeight, double width, double length, double filamentDiameter, double flow) {
  return flow * layerHeight * width * length / filamentArea(filamentDiameter);
}

namespace {

using Prepare = std::function<Result<GcodeJob>(const Printer&)>;

Result<GcodeSummary> write(const Prepare& prepare, const Printer& given, const PrintParams& params,
                           const GcodeSink& sink) {
  if (!sink) return Error{ErrorCode::InvalidArgument, "no sink was given to write to"};
  Printer printer = given;
  std::vector<GcodeWarning> held;
  const auto hold = [&](const std::string& field, double& speed) {
    if (!(given.machineSpeed > 0 && speed > given.machineSpeed)) return;
    held.push_back({WarningCode::SpeedHeld, {{"field", field}, {"asked", speed}, {"held", given.machineSpeed}}});
    speed = given.machineSpeed;
  };
  const bool tooFast = given.machineAcceleration > 0 && given.acceleration > given.machineAcceleration;
  if (tooFast) printer.acceleration = given.machineAcceleration;
  if (!beginsOnBed(params)) printer.firstLayerNozzleTemperature = printer.nozzleTemperature;
  Result<GcodeJob> prepared = prepare(printer);
  if (!prepared) return prepared.error();
  GcodeJob& job = prepared.value();
  hold("speed", printer.speed);
  hold("showSpeed", job.showSpeed);
  hold("baseSpeed", printer.baseSpeed);
  hold("firstLayerSpeed", printer.firstLayerSpeed);
  hold("travelSpeed", printer.travelSpeed);

  Plans plans;
  Writer writer(job, printer, params, plans, &sink);
  writer.expect(estimateFile(job, printer, params, plans));
  writer.header();
  writer.startBlock();
  for (int copy = 0; copy < static_cast<int>(job.copies.size()); ++copy) {
    for (int i = 0; i < layerCount(params) && !writer.failed(); ++i) writer.layer(layerAt(params, copy, i));
  }
  writer.endBlock();
  writer.footer();
  GcodeSummary summary = writer.finish();
  if (tooFast) {
    summary.warnings.push_back(
        {WarningCode::AccelerationHeld, {{"asked", given.acceleration}, {"held", given.machineAcceleration}}});
  }
  summary.warnings.insert(summary.warnings.end(), held.begin(), held.end());
  if (writer.failed()) return Error{ErrorCode::Cancelled, "writing was stopped before the file was complete"};
  return summary;
}

}  // namespace

Result<GcodeSummary> writeGcode(const Toolpath& toolpath, const Shape& shape, const Printer& printer,
                                const PrintParams& params, const GcodeSink& sink) {
  const auto prepare = [&](const Printer& held) { return prepareGcodeJob(toolpath, shape, held, params); };
  return write(prepare, printer, params, sink);
}

Result<GcodeSummary> writePatches(const PatchPlate& plate, const Printer& printer, const PrintParams& params,
                                  const GcodeSink& sink) {
  const auto prepare = [&](const Printer& held) { return preparePatchJob(plate, held, params); };
  return write(prepare, printer, params, sink);
}

}  // namespace sillon
