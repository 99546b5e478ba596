// Parts of the measures of a toolpath: docs/reference/metrics.md.
#pragma once

#include <cstdint>

#include "geometry/closed_curves.hpp"
#include "geometry/signed_distance.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "sillon/quality/metrics.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// Sums over pieces of beads, weighted by their length.
struct AlignmentSums {
  double length = 0;
  double along = 0;  ///< length times cos²

  void add(double size, double cos2) {
    length += size;
    along += size * cos2;
  }
  void add(const AlignmentSums& other) {
    length += other.length;
    along += other.along;
  }
  /// Alignment (Eq. 17): -1 perfect, -0.5 chance, 0 orthogonal or no beads.
  [[nodiscard]] double value() const { return length > 0 ? -along / length : 0; }
};

/// Alignment sums of all beads and of two selections.
struct Alignment {
  AlignmentSums all;
  AlignmentSums interior;     ///< places deeper than 1.05 tau
  AlignmentSums constrained;  ///< constrained cells inside all counted perimeters
};

/// Sums the alignment (Eq. 17) over pieces of at most tau/8, against the nearest texel of the map as stored. The result
/// is the same for any number of threads.
Alignment alignmentOf(const Toolpath& toolpath, const BorderIndex& border, const PlateInput& input,
                      const ToolpathParams& params, const RunContext& run);

/// Counts of pixels on a raster of tau/20, judged at their centres.
struct BeadArea {
  std::int64_t shape = 0;       ///< pixels inside the shape
  std::int64_t covered = 0;     ///< pixels inside the shape and below a bead
  std::int64_t spilled = 0;     ///< pixels below a bead, outside the shape by more than 1 um, the rounding of paths
  std::int64_t overlapped = 0;  ///< pixels passed over more than once
};

/// Counts the pixels below the beads. It takes most of a measurement, and reports up to 0.8 of the current stage. The
/// counts of a cancelled run mean nothing. \param border  border of the shape. \param box  around the toolpath's points
/// and the shape [mm].
BeadArea beadArea(const Toolpath& toolpath, const Shape& shape, const BorderIndex& border, const Bounds& box,
                  const RunContext& run);

/// Counts of sharp turns.
struct Turns {
  std::int64_t uTurns = 0;  ///< turns by 120° and more within one and a half spacings
  std::int64_t kinks = 0;   ///< turns by 60° and more within a quarter of a spacing
};

/// Counts turns; those that follow each other without a pause count once. \param spacing  [mm]
Turns countTurns(const ClosedCurves& curves, double spacing, const RunContext& run);

/// Measures the widths of beads, weighted by length. \param totalLength  length of all beads [mm]
WidthMeasures widthMeasures(const Toolpath& toolpath, const ToolpathParams& params, double totalLength);

/// Counts pairs of non-consecutive segments that share a point, exactly, on integers of 1 µm.
std::int64_t countCrossings(const Toolpath& toolpath);

}  // namespace sillon
