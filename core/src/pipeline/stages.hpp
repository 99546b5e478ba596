// Everything that is made on the way from the shape to the toolpath, for pictures, tests and study.
#pragma once

#include <vector>

#include "field/fields.hpp"
#include "geometry/parts.hpp"
#include "geometry/signed_distance.hpp"
#include "sillon/geometry/outline.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "toolpath/path.hpp"

namespace sillon {

/// Results of the stages, in the order of Alg. 1. Each is what the next stage was given.
struct Stages {
  // From the shape (Sec. 4).
  Outline outline;
  BorderIndex border;
  SignedDistanceField sdf;
  Parts parts;
  // From the directions (Sec. 5.1 to 5.3).
  CellConstraints cells;
  LineField lines;
  std::vector<float> frequency;  ///< from spacingField, before directions are relaxed
  SineField waves;
  // Curves (Sec. 5.4 and 5.5).
  std::vector<float> nodeDistance;  ///< on nodeLattice(lines.grid)
  std::vector<float> nodeValues;    ///< the sine field there (Eq. 13)
  ClosedCurves contour;
  ClosedCurves cycles;  ///< the contour in equal steps, small cycles made round
  Stitched stitched;
  // The path (Sec. 5.6).
  Relaxed relaxed;
  BeadWidths widths;
  ToolpathResult result;
};

/// generateToolpath, with all that was made on the way: it takes the memory of all stages at once, some 300 bytes a
/// cell.
Result<Stages> generateStages(const PlateInput& input, const ToolpathParams& params, const RunContext& run);

}  // namespace sillon
