// Turns the pieces of a path towards the lines that were asked for, as far as their neighbours along it allow.
#pragma once

#include <vector>

#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/field/line_field.hpp"

namespace sillon {

/// Moves that minimise, along each curve, the squared differences between its segments and segments as long in the
/// direction asked for, plus `pull` times the squared moves. Ends of segments that run more than 37 degrees off, as in
/// U-turns and joints, stay. \param pull  above 0; what moves one point is felt over 1/sqrt(pull) points.
/// \return per point, at most half a spacing [mm].
std::vector<Vec2f> movesToLines(const ClosedCurves& curves, const LineField& lines, double spacing, float pull,
                                const RunContext& run);

}  // namespace sillon
