#include "gcode/nozzle.hpp"

#include <algorithm>
#include <string>

#include "base/numbers.hpp"
#include "gcode/job.hpp"

namespace sillon {
namespace {

constexpr double kWipeLength = 3;  // [mm], length of a wipe
constexpr double kLiftSpeed = 10;  // [mm/s]; every Z axis takes this speed

}  // namespace

void Nozzle::moveZ(double z) {
  const std::int64_t target = std::llround(z * 1000);
  if (target == z_) return;
  if (z_ >= 0) seconds_ += std::abs(static_cast<double>(target - z_)) / 1000 / kLiftSpeed;
  z_ = target;
  out_ << "G1 Z";
  out_.scaled(target + zOffset_, 3);
  endMove(static_cast<std::int64_t>(kLiftSpeed * 60));
}

void Nozzle::travel(PointUm target, double speed) {
  if (target != at_) seconds_ += travelSeconds({at_, target}, speed, machineLimits());
  moveTo(target, speed);
}

void Nozzle::moveTo(PointUm target, double speed) {
  at_ = target;
  out_ << "G1 X";
  out_.scaled(target.x, 3) << " Y";
  out_.scaled(target.y, 3);
  endMove(std::llround(speed * 60));
}

MotionLimits Nozzle::machineLimits() const {
  MotionLimits limits;
  limits.flavor = printer_.flavor;
  limits.acceleration = printer_.acceleration;
  limits.cornerSpeed = printer_.cornerSpeed;
  return limits;
}

// Writes the number after E, absolute or relative. \param amount  [0.00001 mm]
void Nozzle::writeE(std::int64_t amount) {
  e_ += amount;
  out_.scaled(printer_.absoluteE ? e_ : amount, 5);
}

// Moves filament alone, without the nozzle. \param length  below 0 to draw back [mm].
void Nozzle::filamentMove(double length) {
  const std::int64_t amount = std::llround(length * 1e5);
  if (amount == 0) return;
  seconds_ += std::abs(length) / printer_.retractSpeed;
  out_ << "G1 E";
  writeE(amount);
  endMove(std::llround(printer_.retractSpeed * 60));
}

void Nozzle::retract() {
  const double missing = printer_.retractLength - retracted_;
  if (missing < 1e-4) return;
  filamentMove(-missing);
  retracted_ = printer_.retractLength;
}

void Nozzle::unretract() {
  if (retracted_ > 0) filamentMove(retracted_);
  retracted_ = 0;
}

void Nozzle::approach(const std::vector<PointUm>& way, double top) {
  moveZ(std::max(top, clearance_) + printer_.lift);
  std::vector<PointUm> points{at_};
  for (const PointUm point : way) {
    if (point + shift_ != points.back()) points.push_back(point + shift_);
  }
  if (points.size() > 1) seconds_ += travelSeconds(points, printer_.travelSpeed, machineLimits());
  if (points.size() == 1) points.push_back(at_);  // a travel to the same place shows hosts where the bead begins
  for (std::size_t k = 1; k < points.size(); ++k) moveTo(points[k], printer_.travelSpeed);
  moveZ(top);
  clearance_ = 0;
  unretract();
}

void Nozzle::leave(const Motion& motion, double speed, double top, bool retractOnTheWay) {
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
  retract();  // draws back here if the path was too short to wipe
  moveZ(top + printer_.lift);
}

// Wipes along points, beginning where the nozzle stands, and retracts evenly on the way. It slows down if the extruder
// could not keep up. \param retraction  [mm of filament].
void Nozzle::wipe(const std::vector<PointUm>& points, double speed, double retraction) {
  std::vector<double> along{0};
  for (std::size_t i = 1; i < points.size(); ++i) {
    const PointUm d = points[i] - points[i - 1];
    along.push_back(along.back() + lengthMm(d));
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
    writeE(drawn - due);
    drawn = due;
    endMove(std::llround(speed * 60));
  }
  if (draws) retracted_ = printer_.retractLength;
  seconds_ += travelSeconds(points, speed, machineLimits());
}

// E carries its rounding error over to the next move. Every move brings at least one step of E: threads across gaps
// need less, but a move without filament would be read as a travel inside the path.
void Nozzle::bead(const Motion& motion, double flow, double height) {
  const double perArea = flow * height / filamentArea(printer_.filamentDiameter);
  for (std::size_t i = 0; i < motion.beads; ++i) {
    filament_ += perArea * motion.areas[i];
    if (silent_) continue;
    const std::int64_t due = std::max(toWhole(filament_ * 1e5), filamentWritten_ + 1);
    const PointUm to = motion.points[i + 1] + shift_;
    out_ << "G1 X";
    out_.scaled(to.x, 3) << " Y";
    out_.scaled(to.y, 3) << " E";
    writeE(due - filamentWritten_);
    filamentWritten_ = due;
    endMove(motion.feedrates[i]);
    seconds_ += motion.seconds[i];
    if (seconds_ >= nextProgress_) progress();
    if (out_.failed()) return;
  }
  for (std::size_t i = motion.beads; i < motion.lengths.size() && !silent_; ++i) {
    const PointUm to = motion.points[i + 1] + shift_;
    out_ << "G1 X";
    out_.scaled(to.x, 3) << " Y";
    out_.scaled(to.y, 3);
    endMove(motion.feedrates[i]);
    seconds_ += motion.seconds[i];
  }
  if (silent_) seconds_ += motion.totalSeconds;
  at_ = motion.points.back() + shift_;
}

void Nozzle::fan(double percent) {
  const auto value = static_cast<int>(std::lround(percent * 255 / 100));
  if (value == fan_) return;
  fan_ = value;
  out_ << "M106 S" << std::to_string(value) << "\n";
}

// F is modal, so it is written only when it changes.
void Nozzle::endMove(std::int64_t mmPerMin) {
  if (mmPerMin != feedrate_) {
    feedrate_ = mmPerMin;
    out_ << " F";
    out_.scaled(mmPerMin, 0);
  }
  out_ << "\n";
  ++moves_;
}

void Nozzle::progress() {
  const double total = std::max(expectedSeconds_, 1.0);
  const int percent = std::min(99, static_cast<int>(100 * seconds_ / total));
  out_ << "M73 P" << std::to_string(percent) << " R" << fixed(std::max(0.0, total - seconds_) / 60, 0) << "\n";
  nextProgress_ = percent < 99 ? (percent + 1) * total / 100 : 1e30;
}

void Nozzle::restartAxis() {
  if (!printer_.absoluteE) return;
  e_ = 0;
  out_ << "G92 E0\n";
}

}  // namespace sillon
