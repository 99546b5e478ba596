// The motion of the nozzle along a bead.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "sillon/base/types.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// The motion along one path: widths that a printer can follow, feedrates, and time.

using PointUm = Vec2T<std::int64_t>;  ///< on the bed [µm], exactly as it is written

/// Length of a step in µm, in mm.
inline double lengthMm(PointUm d) { return length(wide(d)) / 1000; }

/// One path before its motion is planned. No two neighbouring points are equal.
struct BeadPath {
  std::vector<PointUm> points;
  std::vector<double> widths;        ///< one per point [mm], > 0
  bool closed = false;               ///< a segment leads from the last point back to the first
  std::vector<std::uint32_t> seams;  ///< points where a closed path may begin unseen; empty: any
  bool beginsUnseen = false;         ///< the first point is at the border
};

/// Limits that the layer and the printer set.
struct MotionLimits {
  GcodeFlavor flavor = GcodeFlavor::Marlin;
  double layerHeight = 0;  ///< [mm]
  double flow = 1;
  double filamentArea = 0;  ///< [mm²]
  double speed = 0;         ///< [mm/s]
  double acceleration = 0;  ///< [mm/s²]
  double cornerSpeed = 0;   ///< square corner velocity [mm/s]; Marlin's jerk, at which it starts, is twice this
  double maxFlow = 0;       ///< [mm³/s]
  double maxSegmentsPerSecond = 0;
  double curveAcceleration = 0;  ///< towards the middle of a curve [mm/s²]; 0: curves go as fast as straights
  double pressureAdvance = 0;    ///< [s]
  double evenFlow = 0;           ///< speed times width [mm²/s]; 0: the same speed for every width
  double leastBead = 0;          ///< narrower beads are threads across a gap, where widths may jump [mm]
  double coast = 0;              ///< [mm] without extrusion at the end of a closed path; 0 with a scarf
  double scarf = 0;              ///< [mm] over which both ends of a closed path overlap: addScarf

  bool operator==(const MotionLimits&) const = default;
};

/// One path in printing order. Segment i leads from point i to point i + 1.
struct Motion {
  std::vector<PointUm> points;          ///< a closed path ends on its first point, after a scarf on its overlap
  std::vector<double> widths;           ///< per point [mm]; slope within 0.75 w / (K v), except beside threads
  std::vector<double> lengths;          ///< per segment [mm]
  std::vector<double> areas;            ///< per segment, area that its plastic covers, seen from above [mm²]
  std::vector<std::int32_t> feedrates;  ///< per segment [mm/min]
  std::vector<double> seconds;          ///< per segment
  std::size_t beads = 0;                ///< number of segments that extrude; those behind them coast
  double totalSeconds = 0;
  double flowSlowedMm = 0;     ///< length slowed by maxFlow
  double segmentSlowedMm = 0;  ///< length slowed by maxSegmentsPerSecond, after moves were joined
  double curveSlowedMm = 0;    ///< length slowed by curveAcceleration, or to stay even beside a slower stretch
};

/// Plans a path from rest to rest. Its geometry stays as it is, except for moves that are joined for a slow board.
/// \param start  vertex at which a closed path begins; 0 for open ones.
Motion planMotion(const BeadPath& path, std::size_t start, const MotionLimits& limits);

/// Time of moves without plastic, from rest to rest [s]; neighbouring points must differ.
/// \param limits  only flavor, acceleration and cornerSpeed count.
double travelSeconds(const std::vector<PointUm>& points, double speed, const MotionLimits& limits);

// Limits of a slow board: fewer moves where they are dense, then speeds that change as little as possible.

/// Joins moves into longer ones where the path would otherwise be slowed by maxSegmentsPerSecond. Points left out lie
/// within 10 um of the line that replaces them, and their widths within 0.08 mm of the one that is written there; both
/// tolerances are as small as suffices. A joined move carries the plastic of its parts. Paths that a board can follow
/// stay as they are.
void joinMoves(Motion& motion, const MotionLimits& limits);

/// Speeds per segment [mm/s] such that no 8 moves in a row reach the board faster than it takes them. Sets
/// segmentSlowedMm of the motion.
std::vector<double> boardSpeeds(Motion& motion, const MotionLimits& limits);

// Cache of the longest motion that was planned.

/// Keeps the longest motion from the estimate, so that it need not be planned again when it is written: planning takes
/// a third of the time of writing.
class MotionPlans {
 public:
  /// Plans a path, or returns the kept plan. \return valid until the next call.
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

// The seam of a closed path as a scarf joint: two slanted ends that overlap.

/// Makes a scarf joint: the plastic of a closed path grows evenly from nothing over the first `length`, and the path
/// runs on over the same stretch at the end while the plastic fades out as evenly. Both passes together carry the
/// plastic that the path had there. \param motion  motion of a closed path without coasting, its areas and widths
/// final. \param speeds  per segment [mm/s]; extended like the segments. \param length  [mm]; at most a quarter of the
/// path is taken.
void addScarf(Motion& motion, std::vector<double>& speeds, double length);

}  // namespace sillon
