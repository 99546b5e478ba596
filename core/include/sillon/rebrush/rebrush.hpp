// Lays other beads on the top of somebody's print: replaces surfaces of a sliced file by oriented cycles, and nothing
// else.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/input/direction_map.hpp"
#include "sillon/look/inversion.hpp"
#include "sillon/look/spools.hpp"
#include "sillon/quality/picture_measures.hpp"
#include "sillon/rebrush/edits.hpp"
#include "sillon/rebrush/surfaces.hpp"
#include "sillon/settings/toolpath_params.hpp"

namespace sillon {

/// What pictures and maps are stretched over. All but Face let one picture run across several surfaces.
enum class PictureFit {
  Face,    ///< each surface by itself
  Object,  ///< the box around the chosen surfaces of one object, as the slicer names them
  Bed,     ///< the printer's bed, as the file tells it
  All,     ///< the box around all chosen surfaces
};

struct RebrushOptions {
  ToolpathParams toolpath;  ///< its spacing is taken from each surface
  DirectionMap directions;
  ModeMap modes;
  std::vector<LitPicture> pictures;  ///< to be seen under lamps, at most 4: then `directions` do not count
  InversionParams inversion;
  std::string spool = "bluePla";    ///< how the filament looks: a key of spools()
  const Spool* ownSpool = nullptr;  ///< instead of it; outlives the call
  PictureFit fit = PictureFit::Face;
  PictureProportions proportions = PictureProportions::Keep;  ///< of `pictures`, over what `fit` says
  bool tops = true;
  bool bottoms = false;
  std::vector<std::size_t> only;  ///< of SlicedFile::surfaces, whatever their side; empty: all that are asked for
  /// Called before each surface is made, for what tells progress: the context's begins anew with each.
  std::function<void(std::size_t done, std::size_t all)> onSurface;
};

/// What became of one surface.
struct RebrushedSurface {
  std::size_t surface = 0;  ///< of SlicedFile::surfaces
  bool replaced = false;
  std::string why;       ///< it was left: a sentence without a full stop
  double volumeMm3 = 0;  ///< of the new beads
  double alignment = 0;  ///< -1 is perfect
  double coverage = 0;   ///< of the region [%]
  double spill = 0;      ///< of beads, beyond the region [% of its area]
  double beyond = 0;     ///< how far a bead reaches over the region at most [mm]
  std::int64_t moves = 0;
  double seconds = 0;                     ///< by which its moves take longer than the slicer's, as estimated
  std::vector<Lamp> lamps;                ///< of each picture; of bottoms as they stand when the print is turned over
  std::vector<PictureMeasures> pictures;  ///< how well they are seen
  std::vector<double> leftOut;            ///< share of each that is cut off to keep its proportions, 0..1
  Toolpath toolpath;                      ///< one cycle on the page of the surface's region
};

struct Rebrushed {
  std::vector<Edit> edits;                 ///< of the file, for withEdits: all that becomes other
  double seconds = 0;                      ///< by which the print takes longer, as estimated
  std::int64_t totals = 0;                 ///< lines of times and progress that tell it
  SlicedFile file;                         ///< as it was given
  std::vector<RebrushedSurface> surfaces;  ///< those that were asked for, in the order of the file
};

/// Replaces the beads of every chosen surface by one closed cycle along the wanted directions. The cycle begins and
/// ends at the point nearest to where the slicer enters, or to where it leaves if it travels on without retraction;
/// it takes the slicer's line spacing, speed and volume, and lays beads more slowly that would be beyond the file's
/// flow (SlicedBlocks::mostFlow). Every byte outside the replaced lines, and the wipes behind them, stays; place after
/// the next travel, E, retraction, modes, speed and what the block set are as before. Times and progress that the file
/// tells of itself (see rebrush/totals.hpp) change by the estimated difference; filament stays as it is. A surface that
/// cannot be replaced so is left, with the reason. \param file readSlicedFile's of this text. \return InvalidArgument
/// if no surface is left to replace, one is chosen that the file does not have, or a parameter is out of its range;
/// Cancelled.
Result<Rebrushed> rebrush(std::string_view gcode, SlicedFile file, const RebrushOptions& options,
                          const RunContext& run);

/// Reads the file first. \return also InvalidFile, as readSlicedFile.
Result<Rebrushed> rebrush(std::string_view gcode, const RebrushOptions& options, const RunContext& run);

}  // namespace sillon
