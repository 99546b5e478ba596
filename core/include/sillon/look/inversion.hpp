// Finds the directions of beads that show pictures, each under its lamp. docs/internals/pictures.md
// derives the method.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/input/plate_input.hpp"
#include "sillon/look/appearance.hpp"

namespace sillon {

/// A grey picture, row 0 on top. Values are sRGB codes 0..1 unless a function says light.
struct Tones {
  int width = 0;
  int height = 0;
  std::vector<float> value;

  [[nodiscard]] float at(int x, int y) const {
    return value[indexOf(x, y, width)];
  }
  friend bool operator==(const Tones&, const Tones&) = default;
};

/// A picture that shall be seen under a lamp.
struct LitPicture {
  Tones tones;  ///< tones of any size; stretched over the page
  Lamp lamp;    ///< lamp under which the picture shall be seen
  /// Choose the azimuth that suits the picture, or the pictures together; lamp.azimuth is then the
  /// place of the first of several lamps
  bool chooseAzimuth = false;

  friend bool operator==(const LitPicture&, const LitPicture&) = default;
};

/// A picture and the lamp that shows it.
struct ShownPicture {
  std::string file;  ///< name of the file in the project
  Lamp lamp;
  Tones tones;  ///< tones that shall be seen, after levels, stretched over the page
};

/// Parameters of the inversion.
struct InversionParams {
  /// Weight of changes of direction against squared errors of tone, 0.001..10; tripled for several
  /// pictures. Larger: fewer U-turns and less detail.
  double smoothness = 0.02;
  /// Boost of details as fine as beads, for a single picture, 0..2: such details lose contrast when
  /// they become beads
  double sharpness = 0.5;
  /// Boost of differences within a tenth of the page, 0..2. It makes faces readable, but the tones
  /// are no longer the picture's.
  double localContrast = 0;
  /// Light of white relative to the brightest direction, 0.05..1; 0: 1 for one picture, chosen for
  /// several. A lower level leaves room for the tones of the other pictures.
  double level = 0;

  friend bool operator==(const InversionParams&, const InversionParams&) = default;
};

/// Tells which cells of a raster lie in the shape, row 0 on top. The list is empty for a raster
/// without any outside.
using InsideCells = std::function<std::vector<char>(int width, int height)>;

/// The page over which pictures are stretched.
struct PicturePage {
  Vec2 size;       ///< [mm]
  double spacing;  ///< tau [mm]
  /// Cells in the shape; the others count neither for levels nor for tones; unset: all are inside
  InsideCells inside = {};
};

/// Directions that show pictures, and what was chosen for them.
struct SolvedDirections {
  DirectionMap directions;  ///< map with cells of half a spacing, at most 4096 on a side
  std::vector<Lamp> lamps;  ///< lamps as given or chosen, one per picture
  /// Other azimuths of a single lamp that was chosen [degrees], best first. They may suit the
  /// picture as well; only plates tell.
  std::vector<double> azimuths;
  double level = 1;  ///< level as given or chosen
  /// Pictures to be seen, after levels, on the raster of the directions
  std::vector<Tones> shown;
};

/// Finds the directions that show pictures under their lamps. It minimises, on a hierarchy of
/// grids, the squared errors of the tones, plus `smoothness` times the squared divergence of the
/// beads' direction, which forces U-turns, and a little of its squared gradient. Tones are sRGB
/// codes of lightOf, levelled at the 1st and 99th percentile and laid between the darkest and the
/// brightest direction. The bytes are the same for any number of threads.
/// \return InvalidArgument (no pictures or too many, a lamp or parameter out of range, a lamp that
/// tells no directions apart) or Cancelled.
Result<SolvedDirections> solveDirections(std::span<const LitPicture> pictures,
                                         const Roughness& roughness, const PicturePage& page,
                                         const InversionParams& params, const RunContext& run);

// Conflicts between pictures on one plate: one direction per place cannot show every set of
// tones.

/// Conflicts in the cells of the directions, row 0 on top.
struct PictureConflict {
  int width = 0;
  int height = 0;
  /// Light that is missing, per picture and cell: the tone asked for minus the tone that the
  /// direction shows under the picture's lamp. Tones are sRGB codes, scaled to 1 from the darkest
  /// direction to white at `level`; the difference is cut off at -1 and 1. Above 0 light is
  /// missing, below 0 there is too much.
  std::vector<std::vector<float>> missing;
};

/// Measures conflicts by directions alone, without the changes that beads and their ends make.
/// \param shown  at least one picture; stretched over the page of the directions.
/// \param roughness  roughness in range.
/// \param level  light of white, as solveDirections returned it.
/// \return nothing where the sizes of maps and their values do not fit each other.
PictureConflict conflictOf(const DirectionMap& directions, std::span<const ShownPicture> shown,
                           const Roughness& roughness, double level);

/// Draws a conflict: the picture in pale greys, orange where it stays too dark, blue where it
/// becomes too bright; the greater the difference, the fuller the colour. Each cell is a square of
/// at least one pixel, as large as fits into `side`.
/// \param picture  index of the picture.
/// \param tones  tones of that picture, stretched over the page.
/// \param side  most pixels of the longer side.
RgbImage conflictImage(const PictureConflict& conflict, std::size_t picture, const Tones& tones,
                       int side);

}  // namespace sillon
