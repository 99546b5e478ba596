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

/// Changes of the file that replace one block.
struct Replacement {
  std::vector<Edit> edits;  ///< in the order of the file, disjoint: the beads, then wipes
  double volumeMm3 = 0;
  double flow = 1;  ///< plastic of the new beads over their widths times height
  std::int64_t moves = 0;
  LeftBecause left = LeftBecause::None;  ///< reason if the surface is left; then there are no edits
};

/// Writes a cycle in place of a block's beads.
/// \param cycle  points and widths [mm]; a bead's section is its width times the layer's height. \param offset  offset
/// from the cycle's points to the bed [mm]. \param mostFlow  flow beyond which beads are laid more slowly [mm³/s];
/// 0: unknown.
Replacement replaceBeads(std::string_view gcode, const SurfaceBlock& block, const Cycle& cycle, Vec2 offset,
                         double filamentArea, double mostFlow);

/// Compares the machine after two texts, each from the block's first bead to behind the first travel. \return the part
/// of its state that differs; empty if place, height, modes, E, retraction, speed, tool, heat and filament are the
/// same.
std::string stateDifference(std::string_view before, std::string_view after, const SurfaceBlock& block);

}  // namespace sillon
