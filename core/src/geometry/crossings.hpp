// Exact crossings of closed curves.
#pragma once

#include <utility>
#include <vector>

#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"

namespace sillon {

/// Whether the segments ab and cd share a point, exact on coordinates rounded to 1 µm.
bool segmentsMeet(Vec2f a, Vec2f b, Vec2f c, Vec2f d);

/// All pairs of non-consecutive segments that share a point, exact on coordinates rounded to 1 µm, each pair once in
/// ascending order. A segment is named by its first point. Segments that vanish in rounding are passed over.
/// \param among  if not empty, only segments with a marked end (1 per point) are looked at.
std::vector<std::pair<int, int>> findCrossings(const ClosedCurves& curves, const RunContext& run,
                                               const std::vector<char>& among = {});

}  // namespace sillon
