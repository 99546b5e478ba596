// Blocks of beads in a file, and the marks and times that the file gives for them.
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

// Marks by which slicers name what they lay.

enum class MarkKind { None, Layer, Role, Width, Height, Z, Object };

/// Role of the moves behind a mark.
enum class RoleKind { Other, Top, Bottom, FirstSolid, Skin, Ironing, Purge };

/// Content of a comment.
struct Mark {
  MarkKind kind = MarkKind::None;
  RoleKind role = RoleKind::Other;
  double value = 0;       ///< width, height or Z [mm]
  std::string_view name;  ///< name of the object; for a layer, the whole comment
};

/// Reads a slicer's mark. \param comment  text of a comment without ';', trimmed.
Mark readMark(std::string_view comment);

/// Finds the name of the object that a command begins; it is empty if the command ends one. Known are the commands
/// that slicers write: EXCLUDE_OBJECT_START and EXCLUDE_OBJECT_END, M486, M624 and M625. \return nothing for others.
std::optional<std::string> objectOf(std::string_view code);

/// A slicer, and its name with the version as the file gives it: "PrusaSlicer 2.5.0".
struct Program {
  Slicer slicer;
  std::string name;
};
/// Reads the program from a comment. \return nothing if the comment names no known slicer.
std::optional<Program> programOf(std::string_view comment);

// Times of moves.

/// Estimates the time of moves by the rule of Klipper's planner: speeds are trapezoids, and corners are limited by the
/// square corner velocity. \param acceleration  acceleration at the beginning of the text [mm/s²]; M204 and
/// SET_VELOCITY_LIMIT change it. \return time [s].
double secondsOfMoves(std::string_view text, const MachineState& before, double acceleration);

/// Acceleration that a command sets for beads [mm/s²]; 0: it sets none.
double accelerationOf(std::string_view code);

// Comments and progress commands with the duration of the print.

/// A place of the file at which the print takes longer or shorter than before.
struct TimeChange {
  std::size_t at = 0;       ///< end of that place [bytes of the file as it was]
  double seconds = 0;       ///< time that is added; below 0: time that is saved
  bool firstLayer = false;  ///< true if the place lies in the first layer
};

/// Changes the times of a file: "estimated printing time", "model printing time", "total estimated time", TIME,
/// TIME_ELAPSED, and P, R, Q, S of M73. Everything else keeps its bytes.
/// \param changes  in the order of the file, none within an edit. \param edits  other edits of the file, in its order,
/// of whole lines; receives the lines that change. \return the number of lines that have changed.
std::int64_t changeTotals(std::string_view gcode, const std::vector<TimeChange>& changes, std::vector<Edit>& edits);

// The moves that lay a surface, with everything that must hold before and after them.

/// A wipe after the last bead: a move that pulls filament while it goes back over beads, which will no longer be there,
/// or a short move straight on that pushes nothing (Cura).
struct WipeMove {
  std::size_t begin = 0;  ///< beginning of its line [bytes]
  std::size_t end = 0;    ///< end of its line [bytes]
  double length = 0;      ///< [mm]
};

/// A surface with the lines that lay it.
struct SurfaceBlock {
  SlicedSurface surface;
  MachineState before;         ///< state before its first bead
  MachineState after;          ///< state after its last bead
  double acceleration = 1000;  ///< acceleration at its first bead [mm/s²], as the file says
  double travelSpeed = 0;      ///< speed of travels near it [mm/s]; 0: unknown
  /// Largest flow that the file allows its tool, or that this tool's beads have if that is more [mm³/s]; 0: unknown
  double mostFlow = 0;
  /// Lines to repeat behind the new beads, in their order: settings from within the block that hold on, the last one of
  /// each kind. A line is empty if a later one has replaced it.
  std::vector<std::string> kept;
  std::vector<WipeMove> wipes;
  std::optional<Vec2> next;  ///< target of the first travel after the block
  std::size_t nextEnd = 0;   ///< end of that travel's line [bytes]
  bool tightBefore = false;  ///< true if filament is retracted before that travel, with or without a wipe
  std::string lineEnd = "\n";
};

/// A file's surfaces with the lines that lay them.
struct SlicedBlocks {
  SlicedFile file;  ///< without its surfaces
  std::vector<SurfaceBlock> blocks;
  double filamentArea = 0;  ///< section of the filament whose length E counts [mm²]
  FileSettings settings;
};

/// Reads the blocks of a file; for the errors see readSlicedFile.
Result<SlicedBlocks> readBlocks(std::string_view gcode, const RunContext& run = RunContext());

}  // namespace sillon
