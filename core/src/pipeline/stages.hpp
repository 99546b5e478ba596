// Intermediate results between the shape and the toolpath, for pictures, tests and study.
#pragma once

#include <vector>

#include "field/fields.hpp"
#include "geometry/parts.hpp"
#include "geometry/signed_distance.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "toolpath/path.hpp"

namespace sillon {

/// Results of the stages, in the order of Alg. 1. Each is the input of the next stage.
struct Stages {
  // From the shape (Sec. 4).
  Outline outline;
  BorderIndex border;
  SignedDistanceField sdf;
  Parts parts;
  // From the directions (Sec. 5.1 to 5.3).
  CellConstraints cells;
  LineField lines;
  std::vector<float> frequency;  ///< result of spacingField, before directions are relaxed
  SineField waves;
  // Curves (Sec. 5.4 and 5.5).
  std::vector<float> nodeDistance;  ///< distances at the nodes of nodeLattice(lines.grid)
  std::vector<float> nodeValues;    ///< sine field at these nodes (Eq. 13)
  ClosedCurves contour;
  ClosedCurves cycles;  ///< contour in equal steps, with small cycles made round
  Stitched stitched;
  // The path (Sec. 5.6).
  Relaxed relaxed;
  BeadWidths widths;
  ToolpathResult result;
};

/// Makes a toolpath as generateToolpath, and keeps all intermediate results. This takes the memory of all stages at
/// once, some 300 bytes per cell.
Result<Stages> generateStages(const PlateInput& input, const ToolpathParams& params, const RunContext& run);

}  // namespace sillon
