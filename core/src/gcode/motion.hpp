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

inline double lengthMm(PointUm d) { return length(wide(d)) / 1000; }

/// One path before its motion is planned. No two neighbouring points are equal.
struct BeadPath {
  std::vector<PointUm> points;
  std::vector<double> widths;        ///< one per point [mm], > 0
  bool closed = false;               ///< a segment leads from the last point back to the first
  std::vector<std::uint32_t> seams;  ///< points where a closed path may begin unseen; empty: any
  bool beginsUnseen = false;         ///< the first point is at the border
};

/// What the layer and the printer allow.
struct MotionLimits {
  GcodeFlavor flavor = GcodeFlavor::Marlin;
  double layerHeight = 0;  ///< [mm]
  double flow = 1;
  double filamentArea = 0;  ///< [mm²]
  double speed = 0;         ///< [mm/s]
  double acceleration = 0;  ///< [mm/s²]
  double cornerSpeed = 0;   ///< square corner velocity [mm/s]; Marlin's jerk is twice this, and so fast it sets off
  double maxFlow = 0;       ///< [mm³/s]
  double maxSegmentsPerSecond = 0;
  double curveAcceleration = 0;  ///< towards the middle of a curve [mm/s²]; 0: curves go as fast as straights
  double pressureAdvance = 0;    ///< [s]
  double evenFlow = 0;           ///< speed times width [mm²/s]; 0: the same speed for every width
  double leastBead = 0;          ///< what is narrower is a thread across a gap: widths may jump there [mm]
  double coast = 0;              ///< [mm] at the end of a closed path without extrusion; not beside a scarf
  double scarf = 0;              ///< [mm] over which both ends of a closed path overlap: addScarf

  bool operator==(const MotionLimits&) const = default;
};

/// One path in printing order. Segment i leads from point i to point i + 1.
struct Motion {
  std::vector<PointUm> points;          ///< a closed path repeats its first point at the end, and what a scarf overlaps
  std::vector<double> widths;           ///< per point [mm]; slope within 0.75 w / (K v), but beside threads
  std::vector<double> lengths;          ///< per segment [mm]
  std::vector<double> areas;            ///< per segment, seen from above: what its plastic covers [mm²]
  std::vector<std::int32_t> feedrates;  ///< per segment [mm/min]
  std::vector<double> seconds;          ///< per segment
  std::size_t beads = 0;                ///< segments that extrude: the rest, at the end, coasts
  double totalSeconds = 0;
  double flowSlowedMm = 0;     ///< length slowed by maxFlow
  double segmentSlowedMm = 0;  ///< length slowed by maxSegmentsPerSecond, moves being joined already
  double curveSlowedMm = 0;    ///< length slowed by curveAcceleration, or to stay even beside a slower stretch
};

/// Plans a path from rest to rest. Geometry stays as it is, but for moves that a slow board takes joined.
/// \param start  vertex a closed path begins at; 0 for open ones.
Motion planMotion(const BeadPath& path, std::size_t start, const MotionLimits& limits);

/// Time for moves without plastic along points that all differ from their neighbours, from rest to rest [s].
/// \param limits  of which flavor, acceleration and cornerSpeed count.
double travelSeconds(const std::vector<PointUm>& points, double speed, const MotionLimits& limits);

// Limits of a slow board: fewer moves where they come thick, then speeds that change as little as they may.

/// Joins moves to longer ones where the path would otherwise be slowed by maxSegmentsPerSecond. Points left out lie
/// within 10 um of the line that replaces them, and widths within 0.08 mm of the one that is written there: both as
/// little as it takes. The plastic of what is joined is the sum of its parts. Paths that a board can follow stay as
/// they are.
void joinMoves(Motion& motion, const MotionLimits& limits);

/// Speed per segment that no 8 moves in a row pass the board faster than it takes. \return counts what is slowed.
std::vector<double> boardSpeeds(Motion& motion, const MotionLimits& limits);

// Keeps the longest motion that was planned.

/// Planned for the estimate, the longest motion is written without being planned again, which takes a third of the time
/// of writing.
class MotionPlans {
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

// The seam of a closed path as a scarf joint: two slanted ends that overlap.

/// Lets the plastic of a closed path grow evenly from nothing over the first `length`, and runs on over the same
/// stretch at the end while it goes out as evenly. Both together are what the path had there, so that the volume stays.
/// \param motion  of a closed path without coasting; its areas and widths are final. \param speeds  per segment [mm/s],
/// continued likewise. \param length  [mm]; at most a quarter of the path is taken.
void addScarf(Motion& motion, std::vector<double>& speeds, double length);

}  // namespace sillon
