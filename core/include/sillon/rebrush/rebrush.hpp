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
#include "sillon/base/sentence.hpp"
#include "sillon/base/types.hpp"
#include "sillon/compose/compose.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/input/read_input.hpp"
#include "sillon/look/spools.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// The top and bottom surfaces of a sliced file, found by the slicer's own marks and measured from
// its moves.

enum class Slicer { PrusaSlicer, SuperSlicer, OrcaSlicer, BambuStudio, Cura };

/// Its name as its makers write it.
const char* slicerName(Slicer slicer);

enum class SurfaceSide { Top, Bottom };

/// Why a surface is left as it is. Sentences: surfaceReason().
enum class LeftBecause {
  None,         ///< it can be replaced
  Narrow,       ///< narrower than three beads
  Small,        ///< less than ten beads' squares
  Covered,      ///< the next layer lies on part of it (Cura marks tops and inner skins alike)
  Bridge,       ///< hardly any plastic lies below it (Cura marks bridges as skins, too)
  Ironed,       ///< the slicer irons it afterwards
  Interleaved,  ///< the slicer goes to and fro between it and another surface
  Command,      ///< a command inside it that would be lost
  Object,       ///< another object begins inside it
  Height,       ///< its moves rise or fall
  Modes,        ///< inches, relative coordinates, E in mm³ or arcs by their radius
  Flow,         ///< its flow is not that of one layer
  Travel,       ///< what follows needs the nozzle where the slicer's last bead ended
  Cut,          ///< the file ends inside it
  // Known once beads are laid:
  Path,      ///< no single path can be laid in it
  Coverage,  ///< the new beads would leave too much of it free
  Spill,     ///< they would reach over it
  After,     ///< the moves that follow would find another state of the machine
};

/// The sentence for people, without a full stop.
const char* surfaceReason(LeftBecause reason);

/// The name of the reason as it stands above; empty for None.
const char* surfaceReasonName(LeftBecause reason);

/// The sentence of each reason but None.
std::span<const Sentence> surfaceSentences();

/// One connected surface of one layer. Lengths mm, places on the bed.
struct SlicedSurface {
  SurfaceSide side = SurfaceSide::Top;
  int layer = 0;  ///< from 1
  double z = 0;
  double height = 0;
  std::string object;  ///< as the slicer names it; may be empty
  int tool = 0;
  Shape region;  ///< its page is the box of the region
  Vec2 corner;   ///< of that page on the bed
  double areaMm2 = 0;
  double width = 0;    ///< of its beads
  double spacing = 0;  ///< of neighbouring beads
  /// Plastic of a bead over spacing x height: the slicer's flow ratio, for most filaments near 1
  double flow = 1;
  double volumeMm3 = 0;
  double speed = 0;            ///< of most of its length [mm/s]
  Vec2 entry;                  ///< where the slicer begins
  Vec2 exit;                   ///< where it ends
  std::int64_t firstLine = 0;  ///< of the moves that lay it, from 1
  std::int64_t lastLine = 0;
  std::size_t begin = 0;  ///< of those lines [bytes]
  std::size_t end = 0;
  LeftBecause left = LeftBecause::None;
};

struct SlicedBlocks;

struct SlicedFile {
  Slicer slicer = Slicer::PrusaSlicer;
  std::string program;  ///< as the file says: "PrusaSlicer 2.5.0"
  int layers = 0;
  std::int64_t lines = 0;
  double nozzle = 0.4;                         ///< [mm], as most have where the file does not say
  std::vector<SlicedSurface> surfaces;         ///< in the order of the file
  std::shared_ptr<const SlicedBlocks> blocks;  ///< the moves of each, for rebrush
};

/// Finds the surfaces of a file by PrusaSlicer, SuperSlicer, OrcaSlicer, Bambu Studio or Cura.
/// Bottoms are those that lie on the bed. Memory: one layer of moves and the regions, beside the
/// text.
/// \return InvalidFile with what is missing: no marks of a known slicer, line numbers, binary
/// G-code; Cancelled.
Result<SlicedFile> readSlicedFile(std::string_view gcode, const RunContext& run = RunContext());

// A text with some of its bytes changed and all others kept.

/// Bytes of a text that become others.
struct Edit {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::string text;
};

/// The text with its edits, in parts that point into both: a large one need not be held twice.
/// \param edits  in the order of the text, disjoint.
std::vector<std::string_view> partsOf(std::string_view text, const std::vector<Edit>& edits);

/// The same at once.
std::string withEdits(std::string_view text, const std::vector<Edit>& edits);

// Lays other beads on the top of somebody's print: replaces surfaces of a sliced file by oriented
// cycles, and nothing else.

/// The page that the layers lie on. All but Face let one picture run across
/// several surfaces.
enum class PictureFit {
  Face,    ///< each surface by itself
  Object,  ///< the box around the chosen surfaces of one object, as the slicer names them
  Bed,     ///< the printer's bed, as the file tells it
  All,     ///< the box around all chosen surfaces
};

struct RebrushOptions {
  /// Its layers are laid on the surfaces. Pictures and toolpath count, too, but the spacing, which
  /// is each surface's own; a spool of one's own is `ownSpool`.
  Project project;
  ReadInput read;                   ///< hands over the files that the layers name
  const Spool* ownSpool = nullptr;  ///< instead of the project's; outlives the call
  PictureFit fit = PictureFit::Face;
  bool tops = true;
  bool bottoms = false;
  /// Indices of SlicedFile::surfaces, whatever their side; empty: all that are asked for
  std::vector<std::size_t> only;
  /// Called before each surface is made, for what tells progress: the context's begins anew with
  /// each.
  std::function<void(std::size_t done, std::size_t all)> onSurface;
};

/// What became of one surface.
struct RebrushedSurface {
  std::size_t surface = 0;  ///< of SlicedFile::surfaces
  bool replaced = false;
  std::string why;  ///< it was left: a sentence without a full stop
  LeftBecause because = LeftBecause::None;
  double volumeMm3 = 0;  ///< of the new beads
  double alignment = 0;  ///< -1 is perfect
  double coverage = 0;   ///< of the region [%]
  double spill = 0;      ///< of beads, beyond the region [% of its area]
  double beyond = 0;     ///< how far a bead reaches over the region at most [mm]
  std::int64_t moves = 0;
  double seconds = 0;  ///< by which its moves take longer than the slicer's, as estimated
  /// Likeness of each picture, and its lamp; for bottoms as it stands when the print is turned
  /// over
  std::vector<JudgedPicture> pictures;
  std::vector<double> leftOut;  ///< share of each picture of the lowest layer that is cut off, 0..1
  Toolpath toolpath;            ///< one cycle on the page of the surface's region
};

struct Rebrushed {
  std::vector<Edit> edits;                 ///< of the file, for withEdits: all that becomes other
  double seconds = 0;                      ///< by which the print takes longer, as estimated
  std::int64_t totals = 0;                 ///< lines of times and progress that tell it
  SlicedFile file;                         ///< as it was given
  std::vector<RebrushedSurface> surfaces;  ///< those that were asked for, in the order of the file
};

/// Replaces the beads of every chosen surface by one closed cycle along the directions of the
/// layers. The cycle begins and ends at the point nearest to where the slicer enters, or to where
/// it leaves if it travels on without retraction; it takes the slicer's line spacing, speed and
/// volume, and lays beads more slowly that would be beyond the file's flow
/// (SlicedBlocks::mostFlow). Every byte outside the replaced lines, and the wipes behind them,
/// stays; place after the next travel, E, retraction, modes, speed and what the block set are as
/// before. Times and progress that the file tells of itself (see rebrush/totals.hpp) change by the
/// estimated difference; filament stays as it is. A surface that cannot be replaced so is left,
/// with the reason. \param file  readSlicedFile's of this text. \return InvalidArgument if no
/// surface is left to replace, one is chosen that the file does not have, or a parameter is out of
/// its range; Cancelled.
Result<Rebrushed> rebrush(std::string_view gcode, SlicedFile file, const RebrushOptions& options,
                          const RunContext& run);

/// Reads the file first.
/// \return also InvalidFile, as readSlicedFile.
Result<Rebrushed> rebrush(std::string_view gcode, const RebrushOptions& options,
                          const RunContext& run);

// A sliced print as it looks from above, for people who choose among its surfaces.

/// Heights of the highest beads, round on top, at the middle of each cell; row 0 on top.
struct PrintRelief {
  Vec2 corner;      ///< lower left on the bed [mm]
  double cell = 0;  ///< [mm], at least 0.05
  int columns = 0;
  int rows = 0;
  std::vector<float> heights;  ///< above the bed [mm]; 0: nothing lies there
};

/// Draws all beads from the first layer mark on. What lies more than 1 mm beside the box around all
/// higher beads is left out: purge lines, skirts, brims.
/// \param side  most cells of the longer side, 16 to 4096.
/// \return InvalidArgument for another side; InvalidFile if there is no bead, or one lies where no
/// bed reaches; Cancelled.
Result<PrintRelief> printRelief(std::string_view gcode, int side,
                                const RunContext& run = RunContext());

}  // namespace sillon
