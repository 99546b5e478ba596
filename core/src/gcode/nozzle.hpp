// Writes the moves of the nozzle as G-code, and tracks its place, filament and time. Each path starts and ends at rest.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "gcode/chunked_output.hpp"
#include "gcode/motion.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// The nozzle of a job. It writes moves, and sums up their time and filament.
class Nozzle {
 public:
  /// \param sink  null: the time is summed, and nothing is written.
  Nozzle(const Printer& printer, const GcodeSink* sink)
      : printer_(printer), out_(sink), silent_(sink == nullptr), zOffset_(std::llround(printer.zOffset * 1000)) {}

  /// Output for commands that move nothing.
  ChunkedOutput& out() { return out_; }
  [[nodiscard]] const ChunkedOutput& out() const { return out_; }

  /// \param seconds  time of the whole print, for progress().
  void expect(double seconds) { expectedSeconds_ = seconds; }
  /// Writes the progress (M73). bead() does so by itself at each percent.
  void progress();

  /// Moves straight up or down to a height above the bed [mm]. The printer's zOffset is added in the text only.
  void moveZ(double z);
  /// Moves at the present height without filament. \param speed  [mm/s].
  void travel(PointUm target, double speed);
  /// Travels above all that stands in the way, goes down to a layer and brings the filament back to the tip.
  /// \param way  places on the first copy, the last one where a bead begins. \param top  top of the layer [mm].
  void approach(const std::vector<PointUm>& way, double top);
  /// Lays a path and moves to its end.
  /// \param motion  path in the coordinates of the first copy; the nozzle prints it shifted to the chosen copy.
  /// \param height  height of the layer [mm].
  void bead(const Motion& motion, double flow, double height);
  /// Retracts, wipes back along the path and lifts, so that the nozzle leaves the plate clean and never crosses it low.
  /// \param retractOnTheWay  true: retracts while wiping, because a nozzle that stood still to retract would leave a
  /// dot.
  void leave(const Motion& motion, double speed, double top, bool retractOnTheWay = false);
  /// Retracts by what is missing from the printer's retraction; a start block may have drawn back some already.
  void retract();
  void unretract();
  /// Sets the fan; written only when it changes. \param percent  share of its full speed.
  void fan(double percent);
  [[nodiscard]] double fanPercent() const { return fan_ * 100.0 / 255; }
  /// Sets an absolute E axis back to 0, because firmwares count it in 32-bit floats, which lose digits as it grows.
  void restartAxis();

  /// Makes the next approach() stay above this height [mm]; approach() adds the lift. travel() ignores it.
  void clearNextApproach(double height) { clearance_ = height; }
  /// Chooses the copy that is printed. \param shift  from the first copy to that one.
  void standAt(PointUm shift) { shift_ = shift; }
  /// Notes that filament is drawn back already. \param length  [mm of filament].
  void noteRetracted(double length) { retracted_ = length; }
  /// Drops the residue of filament that rounding left, so that what follows begins without it.
  void dropResidue() { filament_ = filamentMm(); }

  /// Limits of moves without beads.
  [[nodiscard]] MotionLimits machineLimits() const;
  /// Place of the nozzle, moved back to the first copy.
  [[nodiscard]] PointUm at() const { return at_ - shift_; }
  [[nodiscard]] double z() const { return static_cast<double>(z_) / 1000; }
  [[nodiscard]] double seconds() const { return seconds_; }
  [[nodiscard]] double filamentMm() const { return static_cast<double>(filamentWritten_) / 1e5; }
  [[nodiscard]] std::int64_t moves() const { return moves_; }

 private:
  void moveTo(PointUm target, double speed);
  void wipe(const std::vector<PointUm>& points, double speed, double retraction);
  void writeE(std::int64_t amount);
  void filamentMove(double length);
  /// Writes F if it changed, ends the line and counts the move.
  void endMove(std::int64_t mmPerMin);

  const Printer& printer_;
  ChunkedOutput out_;
  bool silent_;
  std::int64_t zOffset_;  // [µm]
  int fan_ = -1;          // last written value of M106 [0..255]; -1: none yet
  double expectedSeconds_ = 0;
  double seconds_ = 0;
  double nextProgress_ = 0;  // time of the next M73 [s]
  PointUm at_;
  PointUm shift_;                     // offset of the printed copy from the first one
  double clearance_ = 0;              // height above which the next approach() stays [mm]
  std::int64_t z_ = -1;               // [µm]; -1: not known yet
  std::int64_t feedrate_ = 0;         // [mm/min]
  double retracted_ = 0;              // filament drawn back [mm]
  double filament_ = 0;               // filament extruded, exact [mm]
  std::int64_t filamentWritten_ = 0;  // filament extruded, as written [0.00001 mm]
  std::int64_t e_ = 0;                // value of the file's E axis [0.00001 mm]
  std::int64_t moves_ = 0;
};

}  // namespace sillon
