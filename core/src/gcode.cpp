#include "sillon/gcode.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bed.hpp"
#include "chunked_output.hpp"
#include "dialect.hpp"
#include "gcode_job.hpp"
#include "motion.hpp"
#include "sillon/version.hpp"
#include "text.hpp"

namespace sillon {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kWipeLength = 3;  // [mm]
constexpr double kLiftSpeed = 10;  // [mm/s], what Z axes take without complaint
constexpr double kFastest = 1.5;   // [speed], of narrow beads with constantFlow
constexpr double kManyMoves = 2e6;
constexpr double kManyBytes = 100e6;
constexpr double kSeamStep = 0.382;  // golden section: seams of neighbouring layers lie far apart

double filamentArea(double diameter) { return kPi * diameter * diameter / 4; }

struct Role {
  const char* type;     // PrusaSlicer's word
  const char* feature;  // Orca's and Bambu Studio's
};
constexpr Role kSkirtRole{"Skirt/Brim", "Skirt"};
constexpr Role kBrimRole{"Skirt/Brim", "Brim"};
constexpr Role kBaseRole{"Solid infill", "Internal solid infill"};
constexpr Role kOrientedRole{"Top solid infill", "Top surface"};
constexpr Role kCustomRole{"Custom", "Custom"};

// User's text on one line of printable ASCII.
std::string plain(std::string text) {
  for (char& c : text) {
    if (c < ' ' || c > '~') c = c == '\n' || c == '\r' || c == '\t' ? ' ' : '?';
  }
  return text;
}

std::string whole(double value) { return fixed(value, 0); }

std::string duration(double seconds) {
  std::int64_t rest = std::llround(seconds);
  std::string text;
  const auto add = [&](std::int64_t unit, const char* letter) {
    if (rest >= unit || !text.empty()) text += std::to_string(rest / unit) + letter + " ";
    rest %= unit;
  };
  add(86400, "d");
  add(3600, "h");
  add(60, "m");
  return text + std::to_string(rest) + "s";
}

// The bed's corners; those of a 24-gon for a round one.
std::string bedShape(const Printer& printer) {
  const Vec2 lo = printer.bedMin;
  const Vec2 hi = printer.bedMax;
  std::vector<Vec2> corners{lo, {hi.x, lo.y}, hi, {lo.x, hi.y}};
  if (printer.roundBed) {
    constexpr double kCos = 0.96592582628906829;  // of 15 degrees
    constexpr double kSin = 0.25881904510252076;
    const Bed bed(printer);
    corners.clear();
    Vec2 spoke{bed.radius(), 0};
    for (int k = 0; k < 24; ++k) {
      corners.push_back(bed.centre() + spoke);
      spoke = {kCos * spoke.x - kSin * spoke.y, kSin * spoke.x + kCos * spoke.y};
    }
  }
  std::string text;
  for (const Vec2 p : corners) {
    if (!text.empty()) text += ",";
    text += decimal(p.x, 3) + "x" + decimal(p.y, 3);
  }
  return text;
}

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

  void header(double estimate);
  void thumbnail(const Thumbnail& thumbnail);
  void startBlock();
  void layer(const Layer& layer);
  void endBlock();
  void footer();
  GcodeSummary finish();

  [[nodiscard]] bool failed() const { return out_.failed(); }
  [[nodiscard]] double seconds() const { return seconds_; }

 private:
  /// Layers of all copies, each of which has its mark in the file.
  [[nodiscard]] int marks() const { return layerCount(params_) * static_cast<int>(job_.copies.size()); }
  void role(const Role& role);
  void beginObject(int copy);
  void endObject(int copy);
  void paths(const std::vector<BeadPath>& paths, const Role& role, double flow, const Layer& layer);
  void bead(const Motion& motion, double flow, double height);
  void approach(PointUm target, double top);
  void leave(const Motion& motion, double speed, double top);
  void extrude(std::int64_t amount);
  void filamentMove(double length);
  void moveZ(double z);
  void travel(PointUm target, double speed);
  void moveTo(PointUm target, double speed);
  [[nodiscard]] MotionLimits machineLimits() const;
  void feedrate(std::int64_t mmPerMin);
  void progress();

  const GcodeJob& job_;
  const Printer& printer_;
  const PrintParams& params_;
  Plans& plans_;
  ChunkedOutput out_;
  bool silent_;
  double expected_ = 0;  // [s], for the progress
  double seconds_ = 0;
  double nextProgress_ = 0;  // [s]
  PointUm at_;
  PointUm shift_;              // of the copy that is printed
  double clearance_ = 0;       // [mm], height of the plates that the next travel passes over
  std::int64_t z_ = -1;        // [µm]; -1: not known yet
  std::int64_t feedrate_ = 0;  // [mm/min]
  bool retracted_ = false;
  double filament_ = 0;               // [mm], exact
  std::int64_t filamentWritten_ = 0;  // [0.00001 mm]
  std::int64_t e_ = 0;                // where the file's E axis stands [0.00001 mm]
  std::int64_t moves_ = 0;
  double orientedMm_ = 0;
  double flowSlowedMm_ = 0;
  double segmentSlowedMm_ = 0;
  double curveSlowedMm_ = 0;
};

void Writer::header(double estimate) {
  const double shown = job_.spacing + params_.layerHeight * (1 - kPi / 4);  // slicers' width of the same bead
  const int layers = layerCount(params_);
  out_ << "; generated by Sillon " << kVersion << " on " << params_.date << "\n\n";
  for (const Thumbnail& thumbnail : params_.thumbnails) this->thumbnail(thumbnail);
  out_ << "; plate = " << fixed(job_.plate.x, 1) << "x" << fixed(job_.plate.y, 1)
       << " mm, spacing = " << fixed(job_.spacing, 2) << ", oriented layers = " << std::to_string(params_.layers)
       << ", base layers = " << std::to_string(params_.base) << ", flow = " << fixed(params_.flow, 2)
       << ", fill ratio = " << fixed(job_.fillRatio, 3) << ", copies = " << std::to_string(job_.copies.size()) << "\n";
  for (const std::string& note : params_.notes) out_ << "; " << plain(note) << "\n";
  if (!beginsOnBed(params_)) {
    out_ << "; start height = " << decimal(params_.startHeight, 3)
         << " mm, of a print on the bed that homing and probing (G28, G29) must not touch\n";
  }
  out_ << "; external perimeters extrusion width = " << fixed(shown, 2) << "mm\n";
  out_ << "; max_z_height: " << fixed(layerTop(params_, layers - 1), 2) << "\n";
  out_ << "; total layer number: " << std::to_string(marks()) << "\n\n";
  expected_ = estimate;
  progress();
}

// Hosts drop a picture whose length differs from what its first line says.
void Writer::thumbnail(const Thumbnail& thumbnail) {
  constexpr std::size_t kRow = 78;
  const char* tag = thumbnail.format == ThumbnailFormat::Qoi ? "thumbnail_QOI" : "thumbnail";
  const std::string text = base64(thumbnail.bytes);
  out_ << "; " << tag << " begin " << std::to_string(thumbnail.width) << "x" << std::to_string(thumbnail.height) << " "
       << std::to_string(text.size()) << "\n";
  for (std::size_t at = 0; at < text.size(); at += kRow)
    out_ << "; " << std::string_view(text).substr(at, kRow) << "\n";
  out_ << "; " << tag << " end\n\n";
}

void Writer::startBlock() {
  role(kCustomRole);
  if (job_.startBlock.empty()) {
    const std::string bed = whole(printer_.bedTemperature);
    if (printer_.flavor == GcodeFlavor::RepRap) out_ << "T0\n";
    out_ << "M140 S" << bed << "\nM104 S150\nG28\nM190 S" << bed << "\nM109 S"
         << whole(printer_.firstLayerNozzleTemperature) << "\n";
  } else {
    out_ << job_.startBlock;
  }
  if (printer_.flavor == GcodeFlavor::Klipper) {
    out_ << "SET_PRINT_STATS_INFO TOTAL_LAYER=" << std::to_string(marks()) << "\n";
  }
  if (job_.copies.size() > 1 && printer_.flavor == GcodeFlavor::Klipper) {
    for (std::size_t k = 0; k < job_.copies.size(); ++k) {
      out_ << "EXCLUDE_OBJECT_DEFINE NAME=PLATE_" << std::to_string(k) << "\n";
    }
  }
  if (printer_.machineAcceleration > 0) out_ << accelerationCommand(printer_.flavor, printer_.acceleration);
  if (printer_.machineCornerSpeed > 0) out_ << cornerSpeedCommand(printer_.flavor, printer_.cornerSpeed);
  if (printer_.setPressureAdvance) out_ << pressureAdvanceCommand(printer_.flavor, printer_.pressureAdvance);
  out_ << "G21\nG90\n" << (printer_.absoluteE ? "M82" : "M83") << "\nG92 E0\n";
}

void Writer::role(const Role& role) { out_ << ";TYPE:" << role.type << "\n; FEATURE: " << role.feature << "\n"; }

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

void Writer::approach(PointUm target, double top) {
  moveZ(std::max(top, clearance_) + printer_.lift);
  travel(target, printer_.travelSpeed);
  moveZ(top);
  clearance_ = 0;
  if (retracted_) filamentMove(printer_.retractLength);
  retracted_ = false;
}

// Retract, wipe back along the path, lift: the nozzle leaves the plate clean and never crosses it low.
void Writer::leave(const Motion& motion, double speed, double top) {
  filamentMove(-printer_.retractLength);
  retracted_ = true;
  double left = kWipeLength;
  std::vector<PointUm> wipe{at_};
  for (std::size_t i = motion.lengths.size(); i-- > 0 && left > 0;) {
    PointUm target = motion.points[i] + shift_;
    if (motion.lengths[i] > left) {
      const PointUm from = motion.points[i + 1] + shift_;
      const double share = left / motion.lengths[i];
      target = {from.x + std::llround(share * static_cast<double>(target.x - from.x)),
                from.y + std::llround(share * static_cast<double>(target.y - from.y))};
    }
    left -= motion.lengths[i];
    if (target == at_) continue;
    moveTo(target, speed);
    wipe.push_back(target);
  }
  seconds_ += travelSeconds(wipe, speed, machineLimits());
  moveZ(top + printer_.lift);
}

// One path of beads. What rounding takes from one E the next one brings.
void Writer::bead(const Motion& motion, double flow, double height) {
  const double perMm = flow * height / filamentArea(printer_.filamentDiameter) / 2;
  for (std::size_t i = 0; i < motion.beads; ++i) {
    filament_ += perMm * (motion.widths[i] + motion.widths[i + 1]) * motion.lengths[i];
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

void Writer::paths(const std::vector<BeadPath>& paths, const Role& role, double flow, const Layer& layer) {
  if (paths.empty()) return;
  MotionLimits limits = machineLimits();
  limits.layerHeight = layer.height;
  limits.flow = flow;
  limits.filamentArea = filamentArea(printer_.filamentDiameter);
  limits.speed = layer.first ? std::min(printer_.firstLayerSpeed, printer_.speed) : printer_.speed;
  limits.maxFlow = printer_.maxFlow;
  limits.maxSegmentsPerSecond = printer_.maxSegmentsPerSecond;
  limits.pressureAdvance = printer_.pressureAdvance;
  limits.curveAcceleration = printer_.curveAcceleration;
  if (params_.constantFlow && layer.oriented && !layer.first) {
    limits.evenFlow = limits.speed * job_.spacing;
    limits.speed *= kFastest;
    if (printer_.machineSpeed > 0) limits.speed = std::min(limits.speed, printer_.machineSpeed);
  }
  limits.coast = layer.oriented ? params_.coast : 0;
  limits.leastBead = kLeastBead * printer_.nozzle;

  this->role(role);
  for (const BeadPath& path : paths) {
    std::size_t start = 0;
    if (path.closed) {
      const std::size_t count = path.seams.empty() ? path.points.size() : path.seams.size();
      const auto step = static_cast<std::size_t>(kSeamStep * static_cast<double>(count));
      const std::size_t chosen = static_cast<std::size_t>(layer.turn) * step % count;
      start = path.seams.empty() ? chosen : path.seams[chosen];
    }
    const Motion& motion = plans_.of(path, start, limits);
    approach(motion.points.front() + shift_, layer.top);
    bead(motion, flow, layer.height);
    if (out_.failed()) return;
    leave(motion, limits.speed, layer.top);
    if (layer.oriented) {
      for (const double piece : motion.lengths) orientedMm_ += piece;
      flowSlowedMm_ += motion.flowSlowedMm;
      segmentSlowedMm_ += motion.segmentSlowedMm;
      curveSlowedMm_ += motion.curveSlowedMm;
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
    out_ << "M106 S0\n";
    if (layer.copy > 0) out_ << "M104 S" << whole(printer_.firstLayerNozzleTemperature) << "\n";
  }
  if (layer.index == (beginsOnBed(params_) ? 1 : 0)) {
    // PLA wants all the air it can get, PETG and its kin lose their bond between layers then.
    out_ << (printer_.filamentType == "PLA" ? "M106 S255\n" : "M106 S128\n");
    out_ << "M104 S" << whole(printer_.nozzleTemperature) << "\n";
  }
  if (layer.index == 0) {
    if (layer.copy == 0) paths(job_.skirt, kSkirtRole, params_.baseFlow, layer);
    paths(job_.brim, kBrimRole, params_.baseFlow, layer);
  }
  if (layer.oriented) {
    paths(layer.onBed ? job_.bedCycles : job_.cycles, kOrientedRole, params_.flow, layer);
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
  role(kCustomRole);
  moveZ(std::min(printer_.maxZ, static_cast<double>(z_) / 1000 + kParkLift));
  if (printer_.setPressureAdvance) out_ << pressureAdvanceCommand(printer_.flavor, 0);
  if (printer_.machineAcceleration > 0) out_ << accelerationCommand(printer_.flavor, printer_.machineAcceleration);
  if (printer_.machineCornerSpeed > 0) out_ << cornerSpeedCommand(printer_.flavor, printer_.machineCornerSpeed);
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
  const double mm = static_cast<double>(filamentWritten_) / 1e5;
  const double cm3 = mm * filamentArea(printer_.filamentDiameter) / 1000;
  const double grams = cm3 * printer_.filamentDensity;
  out_ << "; filament used [mm] = " << fixed(mm, 2) << "\n; filament used [cm3] = " << fixed(cm3, 2)
       << "\n; filament used [g] = " << fixed(grams, 2) << "\n; total filament used [g] = " << fixed(grams, 2)
       << "\n; total layers count = " << std::to_string(marks())
       << "\n; estimated printing time (normal mode) = " << duration(seconds_) << "\n";
  const std::pair<const char*, std::string> settings[] = {
      {"layer_height", decimal(params_.layerHeight, 3)},
      {"first_layer_height", decimal(firstLayerHeight(params_), 3)},
      {"nozzle_diameter", decimal(printer_.nozzle, 3)},
      {"filament_diameter", decimal(printer_.filamentDiameter, 3)},
      {"filament_density", decimal(printer_.filamentDensity, 3)},
      {"filament_type", plain(printer_.filamentType)},
      {"temperature", whole(printer_.nozzleTemperature)},
      {"first_layer_temperature", whole(printer_.firstLayerNozzleTemperature)},
      {"bed_temperature", whole(printer_.bedTemperature)},
      {"first_layer_bed_temperature", whole(printer_.bedTemperature)},
      {"bed_shape", bedShape(printer_)},
      {"max_print_height", decimal(printer_.maxZ, 3)},
      {"printer_model", plain(printer_.name)},
      {"filament_colour", "#808080"},
      {"gcode_flavor", dialectName(printer_.flavor)},
  };
  for (const auto& [key, value] : settings) out_ << "; " << key << " = " << value << "\n";
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
  const auto slowed = [&](double mm, const char* limit) {
    if (mm <= 0.1 * orientedMm_) return;
    summary.warnings.push_back(std::string(limit) + " slows " + fixed(100 * mm / orientedMm_, 0) + " % of the path");
  };
  slowed(flowSlowedMm_, "maxFlow");
  slowed(segmentSlowedMm_, "maxSegmentsPerSecond");
  if (static_cast<double>(moves_) > kManyMoves) {
    summary.warnings.push_back("the file has " + std::to_string(moves_) + " moves; hosts get slow above 2 million");
  }
  if (static_cast<double>(summary.bytes) > kManyBytes) {
    summary.warnings.push_back("the file has " + std::to_string(summary.bytes / 1'000'000) +
                               " MB; hosts get slow above 100");
  }
  return summary;
}

// Time for all copies without writing them. Layers of one kind differ by the seam only, so one of each is planned: the
// first layer of the first copy and of others, further base layers in both directions, oriented layers.
double estimateSeconds(const GcodeJob& job, const Printer& printer, const PrintParams& params, Plans& plans) {
  std::array<double, 6> known{-1, -1, -1, -1, -1, -1};
  Writer silent(job, printer, params, plans, nullptr);
  double total = 0;
  for (int copy = 0; copy < static_cast<int>(job.copies.size()); ++copy) {
    for (int i = 0; i < layerCount(params); ++i) {
      const Layer layer = layerAt(params, copy, i);
      const int kind = i == 0 ? (copy == 0 ? 0 : 1) : layer.onBed ? 5 : layer.oriented ? 4 : 2 + layer.turn % 2;
      double& seconds = known[static_cast<std::size_t>(kind)];
      if (seconds < 0) {
        const double before = silent.seconds();
        silent.layer(layer);
        seconds = silent.seconds() - before;
      }
      total += seconds;
    }
  }
  return total;
}

}  // namespace

double extrusion(double layerHeight, double width, double length, double filamentDiameter, double flow) {
  return flow * layerHeight * width * length / filamentArea(filamentDiameter);
}

Result<GcodeSummary> writeGcode(const Toolpath& toolpath, const Shape& shape, const Printer& given,
                                const PrintParams& params, const GcodeSink& sink) {
  if (!sink) return Error{ErrorCode::InvalidArgument, "no sink was given to write to"};
  Printer printer = given;
  std::vector<std::string> held;
  const auto hold = [&](const char* name, double& speed) {
    if (!(given.machineSpeed > 0 && speed > given.machineSpeed)) return;
    held.push_back(std::string(name) + " is " + decimal(speed, 3) + " mm/s; it is held at machineSpeed, " +
                   decimal(given.machineSpeed, 3));
    speed = given.machineSpeed;
  };
  const bool tooFast = given.machineAcceleration > 0 && given.acceleration > given.machineAcceleration;
  if (tooFast) printer.acceleration = given.machineAcceleration;
  if (!beginsOnBed(params)) printer.firstLayerNozzleTemperature = printer.nozzleTemperature;
  Result<GcodeJob> prepared = prepareGcodeJob(toolpath, shape, printer, params);
  if (!prepared) return prepared.error();
  const GcodeJob& job = prepared.value();
  hold("speed", printer.speed);
  hold("firstLayerSpeed", printer.firstLayerSpeed);
  hold("travelSpeed", printer.travelSpeed);

  Plans plans;
  Writer writer(job, printer, params, plans, &sink);
  writer.header(estimateSeconds(job, printer, params, plans));
  writer.startBlock();
  for (int copy = 0; copy < static_cast<int>(job.copies.size()); ++copy) {
    for (int i = 0; i < layerCount(params) && !writer.failed(); ++i) writer.layer(layerAt(params, copy, i));
  }
  writer.endBlock();
  writer.footer();
  GcodeSummary summary = writer.finish();
  if (tooFast) {
    summary.warnings.push_back("acceleration is " + whole(given.acceleration) +
                               " mm/s2; it is held at machineAcceleration, " + whole(given.machineAcceleration));
  }
  summary.warnings.insert(summary.warnings.end(), held.begin(), held.end());
  if (writer.failed()) return Error{ErrorCode::Cancelled, "writing was stopped before the file was complete"};
  return summary;
}

}  // namespace sillon
