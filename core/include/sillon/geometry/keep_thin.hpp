// Places narrower than a bead, widened to one.
#pragma once

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

/// Adds to a shape a path that widens its thin places to one bead: where the shape is at least half a spacing wide and
/// narrower than one spacing, discs of one spacing along its middle (its medial axis) become part of it. Places of less
/// than tau²/4, such as the corners that no round bead fills, stay as they are. `Shape::kept` tells what was kept.
/// \param spacing  tau [mm], 0.05..20. \return the same shape where nothing is thin; InvalidArgument for another
///   spacing; as resolveOutline and buildBorderIndex, and Cancelled.
Result<Shape> keepThinPlaces(Shape shape, double spacing, const RunContext& run);

}  // namespace sillon
