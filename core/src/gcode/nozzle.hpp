// Follows the nozzle from move to move: text, place, filament and time. All times are from rest to rest between paths.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "gcode/chunked_output.hpp"
#include "gcode/motion.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

class Nozzle {
 public:
  /// \param sink  null: only the time counts, and nothing is written.
  Nozzle(const Printer& printer, const GcodeSink* sink)
      : printer_(printer), out_(sink), silent_(sink == nullptr), zOffset_(std::llround(printer.zOffset * 1000)) {}

  /// For commands that move nothing.
  ChunkedOutput& out() { return out_; }
  [[nodiscard]] const ChunkedOutput& out() const { return out_; }

  /// \param seconds  the whole print takes, of which progress is told.
  void expect(double seconds) { expectedSeconds_ = seconds; }
  /// M73. Beads tell it by themselves, at each percent.
  void progress();

  /// Straight up or down, to a height above the bed [mm]. The printer's zOffset is added only to what is written.
  void moveZ(double z);
  void travel(PointUm target, double speed);
  /// Over what stands in the way, down to a layer, with filament at the tip.
  /// \param way  of the first copy, up to where a bead begins. \param top  of the layer [mm].
  void approach(const std::vector<PointUm>& way, double top);
  /// One path of beads of the first copy, from its first point. \param height  of the layer [mm].
  void bead(const Motion& motion, double flow, double height);
  /// Retract, wipe back along the path, lift: the nozzle leaves the plate clean and never crosses it low.
  /// \param retractOnTheWay  draws back while it wipes: standing still it would leave a dot.
  void leave(const Motion& motion, double speed, double top, bool retractOnTheWay = false);
  /// Draws back what is missing to the printer's retraction: a start block may have drawn back already.
  void retract();
  void unretract();
  /// \param percent  of its speed; written when it changes.
  void fan(double percent);
  [[nodiscard]] double fanPercent() const { return fan_ * 100.0 / 255; }
  /// Axes that count from the start of the print go back to 0: firmwares count in 32 bit floats.
  void restartAxis();

  /// The next travel passes over plates of this height [mm].
  void passOver(double height) { clearance_ = height; }
  /// \param shift  from the first copy to the one that is printed.
  void standAt(PointUm shift) { shift_ = shift; }
  /// \param length  that is drawn back already [mm of filament].
  void isRetracted(double length) { retracted_ = length; }
  /// What follows begins without a residue of filament from rounding.
  void dropResidue() { filament_ = filamentMm(); }

  /// What the printer allows without beads.
  [[nodiscard]] MotionLimits machineLimits() const;
  /// Its place over the first copy, whichever is printed.
  [[nodiscard]] PointUm at() const { return at_ - shift_; }
  [[nodiscard]] double z() const { return static_cast<double>(z_) / 1000; }
  [[nodiscard]] double seconds() const { return seconds_; }
  [[nodiscard]] double filamentMm() const { return static_cast<double>(filamentWritten_) / 1e5; }
  [[nodiscard]] std::int64_t moves() const { return moves_; }

 private:
  void moveTo(PointUm target, double speed);
  void wipe(const std::vector<PointUm>& points, double speed, double retraction);
  void extrude(std::int64_t amount);
  void filamentMove(double length);
  void feedrate(std::int64_t mmPerMin);

  const Printer& printer_;
  ChunkedOutput out_;
  bool silent_;
  std::int64_t zOffset_;  // [µm]
  int fan_ = -1;          // [0..255] as written
  double expectedSeconds_ = 0;
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
};

}  // namespace sillon
