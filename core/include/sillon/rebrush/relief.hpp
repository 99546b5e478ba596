// A sliced print as it looks from above, for people who choose among its surfaces.
#pragma once

#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"

namespace sillon {

/// Heights of the highest beads, round on top, at the middle of each cell; row 0 on top.
struct PrintRelief {
  Vec2 corner;      ///< lower left on the bed [mm]
  double cell = 0;  ///< [mm], at least 0.05
  int columns = 0;
  int rows = 0;
  std::vector<float> heights;  ///< above the bed [mm]; 0: nothing lies there
};

/// Draws all beads from the first layer mark on. What lies more than 1 mm beside the box around all higher beads is
/// left out: purge lines, skirts, brims. \param side  most cells of the longer side, 16 to 4096. \return
/// InvalidArgument for another side; InvalidFile if there is no bead, or one lies where no bed reaches; Cancelled.
Result<PrintRelief> printRelief(std::string_view gcode, int side, const RunContext& run = RunContext());

}  // namespace sillon
