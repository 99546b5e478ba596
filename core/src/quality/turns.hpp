// Where beads turn sharply.
#pragma once

#include <cstdint>

#include "geometry/closed_curves.hpp"
#include "sillon/base/run_context.hpp"

namespace sillon {

struct Turns {
  std::int64_t uTurns = 0;  ///< by 120° and more within one and a half spacings
  std::int64_t kinks = 0;   ///< by 60° and more within a quarter of a spacing
};

/// Turns that follow each other without a pause count once. \param spacing  [mm]
Turns countTurns(const ClosedCurves& curves, double spacing, const RunContext& run);

}  // namespace sillon
