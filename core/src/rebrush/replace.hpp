// Writes a cycle in the place of a slicer's beads.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "rebrush/blocks.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/rebrush/rebrush.hpp"

namespace sillon {

struct Replacement {
  std::vector<Edit> edits;  ///< in the order of the file, disjoint: the beads, then wipes
  double volumeMm3 = 0;
  double flow = 1;  ///< of its beads over widths times height
  std::int64_t moves = 0;
  LeftBecause left = LeftBecause::None;  ///< then there are no edits
};

/// \param cycle  on the bed [mm], widths times the layer's height are its sections. \param mostFlow  for which wider
/// beads are laid more slowly [mm³/s]; 0: not known
Replacement replaceBeads(std::string_view gcode, const SurfaceBlock& block, const Cycle& cycle, Vec2 offset,
                         double filamentArea, double mostFlow);

/// Runs both texts from the block's first bead to behind its first travel. Empty: place, E, retraction, modes, speed
/// and tool are the same; else what differs.
std::string stateDifference(std::string_view before, std::string_view after, const SurfaceBlock& block);

}  // namespace sillon
