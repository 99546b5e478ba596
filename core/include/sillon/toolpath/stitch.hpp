// Joins the contour's cycles into one per connected part (Sec. 5.5, Eq. 14, Alg. 2).
#pragma once

#include <cstdint>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/field/line_field.hpp"
#include "sillon/geometry/connected_parts.hpp"
#include "sillon/geometry/signed_distance.hpp"
#include "sillon/settings/toolpath_params.hpp"

namespace sillon {

struct Stitched {
  ClosedCurves curves;      ///< in order of their parts' lowest cells
  int parts = 0;            ///< connected parts that hold a curve
  double longestJoint = 0;  ///< [mm]
  int gapJoints = 0;        ///< joints that lie outside the shape for a part of their length
  std::vector<Vec2>
      apart;              ///< middles of the boxes of curves that could not be joined to the longest of their part [mm]
  std::int64_t work = 0;  ///< joints looked at, each counted as its length in spacings, at least 1

  /// Curves that could not be joined to the others of their part.
  [[nodiscard]] int unjoined() const { return curves.count() - parts; }
};

/// Joins two curves by taking a piece about one spacing long out of each and closing the gap with two new edges. All
/// places where different curves run side by side are candidates; they are taken in order of cost (a minimal spanning
/// tree: n log n), unless a new edge, or the line between the pieces' middles, meets another, leaves the shape, or
/// touches a used piece. The cost is 0.65 times the added length (Eq. 14) plus `stitchAlignment` times the misaligned
/// length added.
/// Only where a part is not one curve then do joints cross gaps: first between neighbours, as far as `bridge` says;
/// then wherever points of two curves face each other with nothing between them, those that leave the shape least
/// first, each edge for at most eight spacings, or about two and a half bridges where these are more. No edge gets
/// farther from the shape than half a bridge and half a bead. Where points are used up, the paths made so far are
/// curves again, and are joined once more, a few times. What is not joined then stays a curve of its own. The work is
/// bounded: a constant number of rounds, each of n log n in the points and cells. \param curves  equally spaced points,
/// tau/4 apart, neighbours in opposite senses.
Result<Stitched> stitchCycles(const ClosedCurves& curves, const LineField& lines, const BorderIndex& border,
                              const Parts& parts, const ToolpathParams& params, const RunContext& run);

}  // namespace sillon
