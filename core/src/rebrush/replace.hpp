// Writes a cycle in the place of a slicer's beads.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "rebrush/blocks.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"

namespace sillon {

/// Bytes of the file that become others.
struct Edit {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
  std::string text;
};

struct Replacement {
  std::vector<Edit> edits;  ///< in the order of the file, disjoint: the beads, then wipes
  double volumeMm3 = 0;
  double flow = 1;  ///< of its beads over widths times height
  std::int64_t moves = 0;
  LeftBecause left = LeftBecause::None;  ///< then there are no edits
};

/// \param cycle  on the bed [mm], widths times the layer's height are its sections.
Replacement replaceBeads(std::string_view gcode, const SurfaceBlock& block, const Cycle& cycle, Vec2 offset,
                         double filamentArea);

/// The file with its edits, which are in its order and disjoint.
std::string applyEdits(std::string_view gcode, const std::vector<Edit>& edits);

/// The same, in the memory of the file, where its capacity suffices.
std::string withEdits(std::string gcode, const std::vector<Edit>& edits);

/// Runs both texts from the block's first bead to behind its first travel. Empty: place, E, retraction, modes, speed
/// and tool are the same; else what differs.
std::string stateDifference(std::string_view before, std::string_view after, const SurfaceBlock& block);

}  // namespace sillon
