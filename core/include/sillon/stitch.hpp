// Joins the contour's cycles into one per connected part (Sec. 5.5, Eq. 14, Alg. 2).
#pragma once

#include "sillon/line_field.hpp"
#include "sillon/params.hpp"
#include "sillon/parts.hpp"
#include "sillon/result.hpp"
#include "sillon/run_context.hpp"
#include "sillon/sdf.hpp"
#include "sillon/types.hpp"

namespace sillon {

struct Stitched {
  ClosedCurves curves;      ///< in order of their parts' lowest cells
  int parts = 0;            ///< connected parts that hold a curve
  double longestJoint = 0;  ///< [mm]
  int gapJoints = 0;        ///< joints that lie outside the shape for a part of their length
};

/// Joins two curves by taking a piece about one spacing long out of each and closing the gap with two new edges. All
/// places where different curves run side by side are candidates; they are taken in order of cost (a minimal spanning
/// tree: n log n), unless a new edge, or the way between the pieces' middles, meets another, leaves the shape, or
/// touches a used piece. Only where a part does not hang together otherwise do joints cross gaps: `bridge` at first,
/// wider where beads cannot come near it. Where that fails too, the paths made so far are curves again, their joints
/// and used pieces with them, and are joined once more. The cost is 0.65 times the added length (Eq. 14) plus
/// `stitchAlignment` times the misaligned length added.
/// \param curves  equally spaced points, tau/4 apart, neighbours in opposite senses.
Result<Stitched> stitchCycles(const ClosedCurves& curves, const LineField& lines, const BorderIndex& border,
                              const Parts& parts, const ToolpathParams& params, const RunContext& run);

}  // namespace sillon
