// The moves that lay a surface, with everything that must hold before and after them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gcode_reader/file_settings.hpp"
#include "gcode_reader/machine.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/rebrush/surfaces.hpp"

namespace sillon {

/// A wipe after the last bead: a move that pulls filament while it goes back over beads that will no longer be there,
/// or a short one straight on that pushes nothing (Cura).
struct WipeMove {
  std::size_t begin = 0;  ///< of its line [bytes]
  std::size_t end = 0;
  double length = 0;  ///< [mm]
};

struct SurfaceBlock {
  SlicedSurface surface;
  MachineState before;         ///< its first bead
  MachineState after;          ///< its last bead
  double acceleration = 1000;  ///< at its first bead [mm/s²], as the file says
  double travelSpeed = 0;      ///< of travels near it [mm/s]; 0: not told
  double mostFlow =
      0;  ///< that the file allows its tool, or that tool's beads have if that is more [mm³/s]; 0: unknown
  /// Lines to repeat behind the new beads: what was set within the block and holds on, the last of each kind, in their
  /// order. Empty ones stand where a later one has taken over.
  std::vector<std::string> kept;
  std::vector<WipeMove> wipes;
  std::optional<Vec2> next;  ///< where the first travel after the block goes
  std::size_t nextEnd = 0;   ///< of that travel's line [bytes]
  bool tightBefore = false;  ///< that travel is retracted, by a wipe or standing
  std::string lineEnd = "\n";
};

struct SlicedBlocks {
  SlicedFile file;  ///< without its surfaces
  std::vector<SurfaceBlock> blocks;
  double filamentArea = 0;  ///< section of the filament that E counts [mm²]
  FileSettings settings;
};

/// See readSlicedFile.
Result<SlicedBlocks> readBlocks(std::string_view gcode, const RunContext& run = RunContext());

}  // namespace sillon
