// Blocks of beads in a file, and what is told about them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gcode_reader/file_settings.hpp"
#include "gcode_reader/machine.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/rebrush/rebrush.hpp"

namespace sillon {

// Marks that slicers write about what they lay.

enum class MarkKind { None, Layer, Role, Width, Height, Z, Object };

/// The kind of the moves that follow.
enum class RoleKind { Other, Top, Bottom, FirstSolid, Skin, Ironing, Purge };

/// Content of a comment.
struct Mark {
  MarkKind kind = MarkKind::None;
  RoleKind role = RoleKind::Other;
  double value = 0;       ///< of Height and Z [mm]
  std::string_view name;  ///< of the object; of a layer, the comment
};

/// \param comment  without ';', trimmed.
Mark readMark(std::string_view comment);

/// The object that a command begins or ends, where it is one that slicers write: EXCLUDE_OBJECT_START, M486, M624,
/// M625.
std::optional<std::string> objectOf(std::string_view code);

/// "PrusaSlicer 2.5.0" and the slicer, if a comment tells it.
struct Program {
  Slicer slicer;
  std::string name;
};
std::optional<Program> programOf(std::string_view comment);

// Times of moves.

/// By the rule of Klipper's planner: trapezoids, corners by their square corner velocity. \param acceleration  where
/// the text begins [mm/s²]; M204 and SET_VELOCITY_LIMIT change it. \return [s].
double secondsOfMoves(std::string_view text, const MachineState& before, double acceleration);

/// The acceleration that a command sets for beads [mm/s²]; 0: it sets none.
double accelerationOf(std::string_view code);

// Comments and progress commands about a file's own duration.

/// Somewhere the print takes longer, or shorter.
struct TimeChange {
  std::size_t at = 0;  ///< behind it [bytes of the file as it was]
  double seconds = 0;
  bool firstLayer = false;
};

/// Changes the times of the file: "estimated printing time", "model printing time", "total estimated time", TIME,
/// TIME_ELAPSED, and P, R, Q, S of M73. Everything else keeps its bytes. \param edits  what else becomes of the file,
/// in its order, whole lines; receives the lines that change. \param changes  in the order of the file, none within an
/// edit. \return the number of lines that have changed.
std::int64_t changeTotals(std::string_view gcode, const std::vector<TimeChange>& changes, std::vector<Edit>& edits);

// The moves that lay a surface, with everything that must hold before and after them.

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
