// From pictures, each under its lamp, to the directions of beads that show them. Derived in
// docs/internals/pictures.md.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/input/direction_map.hpp"
#include "sillon/look/appearance.hpp"
#include "sillon/look/tones.hpp"

namespace sillon {

inline constexpr int kMaxPictures = 4;

/// A picture that shall be seen under a lamp.
struct LitPicture {
  Tones tones;                 ///< any size; stretched over the page
  Lamp lamp;                   ///< towards which the plate's +x is turned
  bool chooseAzimuth = false;  ///< take the azimuth that suits the picture, or the pictures together; lamp.azimuth is
                               ///< then where the first of several lamps stands

  friend bool operator==(const LitPicture&, const LitPicture&) = default;
};

/// A picture and the lamp that shows it.
struct ShownPicture {
  std::string file;  ///< as the project names it
  Lamp lamp;
  Tones tones;  ///< what shall be seen, stretched over the page: after levels
};

struct InversionParams {
  double smoothness = 0.02;  ///< weight of changes of direction against squared errors of tone, 0.001..10: more means
                             ///< fewer U-turns and less detail; thrice as much for several pictures
  double sharpness = 0.5;    ///< of a single picture: how far details as fine as beads are raised, which lose contrast
                             ///< when they become beads, 0..2
  double localContrast = 0;  ///< how far differences within a tenth of the page are raised, 0..2: readable faces, but
                             ///< other tones than the picture has
  double level = 0;          ///< light of white against the brightest direction, 0.05..1; 0: 1 for one picture, chosen
                             ///< for several: less leaves room for the tones of the others

  friend bool operator==(const InversionParams&, const InversionParams&) = default;
};

/// Which cells of a raster of this size lie in the shape, row 0 on top; of a raster without any outside: nothing.
using InsideCells = std::function<std::vector<char>(int width, int height)>;

/// The page over which pictures are stretched.
struct PicturePage {
  Vec2 size;       ///< [mm]
  double spacing;  ///< tau [mm]
  InsideCells inside =
      {};  ///< cells outside of the shape count neither for levels nor for tones; unset: all are inside
};

struct SolvedDirections {
  DirectionMap directions;       ///< cells of half a spacing, at most 4096 on a side
  std::vector<Lamp> lamps;       ///< one per picture, as given or chosen
  std::vector<double> azimuths;  ///< of a single lamp that was chosen: others that may suit the picture as well
                                 ///< [degrees], best first; plates tell
  double level = 1;              ///< as given or chosen
  std::vector<Tones> shown;      ///< the pictures after levels, on the raster of the directions: what is to be seen
};

/// Minimises, over directions on a hierarchy of grids, the squared errors of the tones (sRGB codes of lightOf, levels
/// at the 1st and 99th percentile, laid between the darkest and the brightest direction) plus `smoothness` times the
/// squared divergence of the beads' direction, which forces U-turns, and a little of its squared gradient. The same
/// bytes for any number of threads. \return InvalidArgument (no pictures or too many, a lamp or parameter out of range,
/// a lamp that tells no directions apart) or Cancelled.
Result<SolvedDirections> solveDirections(std::span<const LitPicture> pictures, const Roughness& roughness,
                                         const PicturePage& page, const InversionParams& params, const RunContext& run);

}  // namespace sillon
