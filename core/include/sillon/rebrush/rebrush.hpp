// Replaces the beads of top surfaces in a file from another slicer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/compose/compose.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/input/plate_input.hpp"
#include "sillon/look/appearance.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// The top and bottom surfaces of a sliced file, found by the slicer's own marks and measured from
// its moves.

/// Slicers whose marks are known.
enum class Slicer { PrusaSlicer, SuperSlicer, OrcaSlicer, BambuStudio, Cura };

/// Returns a slicer's name as its makers write it.
const char* slicerName(Slicer slicer);

enum class SurfaceSide { Top, Bottom };

/// Reasons why a surface is left as it is. surfaceReason() has their sentences.
enum class LeftBecause {
  None,         ///< it can be replaced
  Narrow,       ///< narrower than three beads
  Small,        ///< its area is below that of ten squares of one bead spacing
  Covered,      ///< the next layer lies on part of it (Cura marks tops and inner skins alike)
  Bridge,       ///< hardly any plastic lies below it (Cura marks bridges as skins, too)
  Ironed,       ///< the slicer irons it afterwards
  Interleaved,  ///< the slicer goes to and fro between it and another surface
  Command,      ///< a command inside it would be lost
  Object,       ///< another object begins inside it
  Height,       ///< its moves rise or fall
  Modes,        ///< inches, relative coordinates, E in mm³ or arcs by their radius
  Flow,         ///< its flow is not that of one layer
  Travel,       ///< the next move needs the nozzle where the slicer's last bead ended
  Cut,          ///< the file ends inside it
  // Reasons that are known once beads are laid:
  Path,      ///< no single path can be laid in it
  Coverage,  ///< the new beads would leave too much of it free
  Spill,     ///< they would reach over it
  After,     ///< the moves that follow would find another state of the machine
};

/// Returns the sentence of a reason for people, without a full stop.
const char* surfaceReason(LeftBecause reason);

/// Returns the name of a reason as it stands above; empty for None.
const char* surfaceReasonName(LeftBecause reason);

/// Returns the sentence of each reason but None.
std::span<const Sentence> surfaceSentences();

/// One connected surface of one layer. Lengths mm, places on the bed.
struct SlicedSurface {
  SurfaceSide side = SurfaceSide::Top;
  int layer = 0;  ///< number of its layer, from 1
  double z = 0;
  double height = 0;
  std::string object;  ///< name that the slicer gives it; may be empty
  int tool = 0;
  Shape region;  ///< its page is the box of the region
  Vec2 corner;   ///< lower left corner of that page on the bed
  double areaMm2 = 0;
  double width = 0;    ///< width of its beads
  double spacing = 0;  ///< distance of neighbouring beads
  /// Plastic of a bead divided by spacing x height: the slicer's flow ratio, for most filaments
  /// near 1
  double flow = 1;
  double volumeMm3 = 0;
  double speed = 0;            ///< median speed of its beads by length [mm/s]
  Vec2 entry;                  ///< point at which the slicer begins
  Vec2 exit;                   ///< point at which it ends
  std::int64_t firstLine = 0;  ///< first line of the moves that lay it, from 1
  std::int64_t lastLine = 0;
  std::size_t begin = 0;  ///< offset of those lines in the file [bytes]
  std::size_t end = 0;
  LeftBecause left = LeftBecause::None;
};

struct SlicedBlocks;

/// A file of a slicer, with the surfaces that were found in it.
struct SlicedFile {
  Slicer slicer = Slicer::PrusaSlicer;
  std::string program;  ///< name and version as the file gives them: "PrusaSlicer 2.5.0"
  int layers = 0;
  std::int64_t lines = 0;
  double nozzle = 0.4;  ///< diameter [mm]; 0.4, as most have, where the file does not say
  std::vector<SlicedSurface> surfaces;         ///< surfaces in the order of the file
  std::shared_ptr<const SlicedBlocks> blocks;  ///< moves of each surface, for rebrush
};

/// Finds the surfaces of a file by PrusaSlicer, SuperSlicer, OrcaSlicer, Bambu Studio or Cura.
/// Bottoms are those that lie on the bed. Besides the text, this takes memory for one layer of
/// moves and for the regions.
/// \return InvalidFile, whose message names the fault: no marks of a known slicer, line numbers,
/// binary G-code; Cancelled.
Result<SlicedFile> readSlicedFile(std::string_view gcode, const RunContext& run = RunContext());

// A text with some of its bytes changed and all others kept.

/// A replacement of some bytes of a text by others.
struct Edit {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::string text;
};

/// Returns the text with its edits, in parts that point into both, so that a large text need not be
/// held twice.
/// \param edits  disjoint edits in the order of the text.
std::vector<std::string_view> partsOf(std::string_view text, const std::vector<Edit>& edits);

/// Returns the text with its edits as one string.
std::string withEdits(std::string_view text, const std::vector<Edit>& edits);

// Lays other beads on the top of somebody's print: replaces surfaces of a sliced file by oriented
// cycles, and nothing else.

/// The page that the layers lie on. All but Face let one picture run across several surfaces.
enum class PictureFit {
  Face,    ///< each surface by itself
  Object,  ///< the box around the chosen surfaces of one object, as the slicer names them
  Bed,     ///< the printer's bed, as the file tells it
  All,     ///< the box around all chosen surfaces
};

/// Choices about a re-brushing.
struct RebrushOptions {
  /// Project whose layers are laid on the surfaces. Its pictures and toolpath count, too, except
  /// for the spacing, which is each surface's own; a spool of one's own is `ownSpool`.
  Project project;
  ReadInput read;                   ///< hands over the files that the layers name
  const Spool* ownSpool = nullptr;  ///< spool instead of the project's; outlives the call
  PictureFit fit = PictureFit::Face;
  bool tops = true;
  bool bottoms = false;
  /// Indices of SlicedFile::surfaces, whatever their side; empty: all that are asked for
  std::vector<std::size_t> only;
  /// Called before each surface is made, for callers that tell progress: the context's progress
  /// begins anew with each.
  std::function<void(std::size_t done, std::size_t all)> onSurface;
};

/// The result for one surface.
struct RebrushedSurface {
  std::size_t surface = 0;  ///< index in SlicedFile::surfaces
  bool replaced = false;
  std::string why;  ///< reason why it was left: a sentence without a full stop
  LeftBecause because = LeftBecause::None;
  double volumeMm3 = 0;  ///< plastic of the new beads
  double alignment = 0;  ///< -1 is perfect
  double coverage = 0;   ///< share of the region under the new beads [%]
  double spill = 0;      ///< area of beads beyond the region [% of its area]
  double beyond = 0;     ///< greatest reach of a bead over the region [mm]
  std::int64_t moves = 0;
  double seconds = 0;  ///< estimated time by which its moves take longer than the slicer's
  /// Likeness of each picture, and its lamp; for bottoms as seen when the print is turned over
  std::vector<JudgedPicture> pictures;
  std::vector<double> leftOut;  ///< share of each picture of the lowest layer that is cut off, 0..1
  Toolpath toolpath;            ///< one cycle on the page of the surface's region
};

/// The edits that re-brush a file, with the result for each surface.
struct Rebrushed {
  std::vector<Edit> edits;  ///< edits of the file for withEdits; all other bytes stay
  double seconds = 0;       ///< estimated time by which the print takes longer
  std::int64_t totals = 0;  ///< number of lines with times and progress that were changed
  SlicedFile file;          ///< the file as it was given
  /// The surfaces that were asked for, in the order of the file
  std::vector<RebrushedSurface> surfaces;
};

/// Replaces the beads of every chosen surface by one closed cycle along the directions of the
/// layers. The cycle begins and ends at the point nearest to where the slicer enters, or to where
/// it leaves if it travels on without retraction. It takes the slicer's line spacing, speed and
/// volume; beads that would exceed the file's flow (SlicedBlocks::mostFlow) are laid more slowly.
///
/// Every byte outside the replaced lines, and the wipes behind them, stays. Place after the next
/// travel, E, retraction, modes, speed and what the block set are as before. Times and progress
/// that the file tells of itself (see rebrush/totals.cpp) change by the estimated difference;
/// filament stays as it is. A surface that cannot be replaced in this way is left, with the reason.
/// \param file  readSlicedFile's result for this text.
/// \return InvalidArgument if no surface is left to replace, one is chosen that the file does not
/// have, or a parameter is out of its range; Cancelled.
Result<Rebrushed> rebrush(std::string_view gcode, SlicedFile file, const RebrushOptions& options,
                          const RunContext& run);

/// Reads the file first, then re-brushes it.
/// \return the errors of readSlicedFile, too.
Result<Rebrushed> rebrush(std::string_view gcode, const RebrushOptions& options,
                          const RunContext& run);

// A sliced print as it looks from above, for people who choose among its surfaces.

/// Heights of the highest beads, round on top, at the middle of each cell; row 0 on top.
struct PrintRelief {
  Vec2 corner;      ///< lower left corner on the bed [mm]
  double cell = 0;  ///< side of a cell [mm], at least 0.05
  int columns = 0;
  int rows = 0;
  std::vector<float> heights;  ///< heights above the bed [mm]; 0: nothing lies there
};

/// Draws all beads from the first layer mark on. Purge lines, skirts and brims, that is, beads more
/// than 1 mm beside the box around all higher beads, are left out.
/// \param side  most cells of the longer side, 16 to 4096.
/// \return InvalidArgument for another side; InvalidFile if there is no bead, or one lies where no
/// bed reaches; Cancelled.
Result<PrintRelief> printRelief(std::string_view gcode, int side,
                                const RunContext& run = RunContext());

}  // namespace sillon
