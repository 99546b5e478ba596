// How far beads follow the directions that were asked for (paper, Eq. 17).
#pragma once

#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/signed_distance.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "sillon/settings/toolpath_params.hpp"

namespace sillon {

/// Of pieces of beads, weighed by their length.
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
  /// Eq. 17: -1 perfect, -0.5 chance, 0 orthogonal or nothing.
  [[nodiscard]] double value() const { return length > 0 ? -along / length : 0; }
};

struct Alignment {
  AlignmentSums all;
  AlignmentSums interior;     ///< deeper than 1.05 tau
  AlignmentSums constrained;  ///< of constrained cells inside all counted perimeters
};

/// Eq. 17 over pieces of at most tau/8, against the nearest texel of the map as stored. The same for any thread count.
Alignment alignmentOf(const Toolpath& toolpath, const BorderIndex& border, const PlateInput& input,
                      const ToolpathParams& params, const RunContext& run);

}  // namespace sillon
