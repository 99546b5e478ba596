// Lines: initialisation and smoothing (Sec. 5.1, Eq. 1-5).
#pragma once

#include <cstdint>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/field/constraints.hpp"
#include "sillon/geometry/signed_distance.hpp"
#include "sillon/settings/toolpath_params.hpp"

namespace sillon {

/// The direction d of greatest variation per cell, d = -d; beads run across it.
struct LineField {
  Grid grid;
  std::vector<Vec2f> direction;     ///< unit representatives; (0, 0) where masked
  std::vector<std::uint8_t> fixed;  ///< 1 where asked for, 0 where smoothing decided
};

/// Ring cells take the border's normal (mode Count), constrained cells the map, parallel and orthogonal cells the base
/// line (the normal of the ring diffused over the whole shape) or its perpendicular; smoothest cells end as the average
/// of their neighbours. Cells where the average vanishes keep their old line.
Result<LineField> lineField(const SignedDistanceField& sdf, const CellConstraints& cells, const ToolpathParams& params,
                            const RunContext& run);

}  // namespace sillon
