// From pictures, each under its lamp, to the directions of beads that show them. Derived in
// docs/internals/pictures.md.
#pragma once

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

// Grey pictures as light: sRGB codes, levels, areas.

/// A grey picture, row 0 on top. Values are sRGB codes 0..1 unless a function says light.
struct Tones {
  int width = 0;
  int height = 0;
  std::vector<float> value;

  [[nodiscard]] float at(int x, int y) const {
    return value[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                 static_cast<std::size_t>(x)];
  }
  friend bool operator==(const Tones&, const Tones&) = default;
};

/// IEC 61966-2-1, within 1e-6.
/// \param code  0..1; others are clamped.
float lightOfCode(float code);
/// Its inverse, within 1e-5.
float codeOfLight(float light);

/// Luminance (Rec. 709) of the picture's sRGB colours, again as a code; what is transparent shows
/// white paper.
Tones tonesOf(const Image& image);

/// The same from codes as they are mixed for JPEG. It keeps this one sharp and blurs what colours
/// differ by.
Tones lumaOf(const Image& image);

/// Means of light over the areas of a new raster: for pictures that shrink; linear between texels
/// for those that grow.
Tones resampled(const Tones& tones, int width, int height);

/// Stretches tones so that the 1st and 99th percentile become 0 and 1. Others are clamped; a
/// picture of one tone, within half a step of 8 bits, becomes 0.5.
/// \param inside  of each value whether it counts; empty: all do. Others are clamped.
Tones levelled(const Tones& tones, const std::vector<char>& inside = {});

inline constexpr int kMaxPictures = 4;

/// A picture that shall be seen under a lamp.
struct LitPicture {
  Tones tones;  ///< any size; stretched over the page
  Lamp lamp;    ///< towards which the plate's +x is turned
  /// Take the azimuth that suits the picture, or the pictures together; lamp.azimuth is then where
  /// the first of several lamps stands
  bool chooseAzimuth = false;

  friend bool operator==(const LitPicture&, const LitPicture&) = default;
};

/// A picture and the lamp that shows it.
struct ShownPicture {
  std::string file;  ///< as the project names it
  Lamp lamp;
  Tones tones;  ///< what shall be seen, stretched over the page: after levels
};

struct InversionParams {
  /// Weight of changes of direction against squared errors of tone, 0.001..10: more means fewer
  /// U-turns and less detail; thrice as much for several pictures
  double smoothness = 0.02;
  /// Boost of details as fine as beads, for a single picture: they lose contrast when they become
  /// beads, 0..2
  double sharpness = 0.5;
  /// Boost of differences within a tenth of the page, 0..2: readable faces, but other tones than
  /// the picture has
  double localContrast = 0;
  /// Light of white against the brightest direction, 0.05..1; 0: 1 for one picture, chosen for
  /// several: less leaves room for the tones of the others
  double level = 0;

  friend bool operator==(const InversionParams&, const InversionParams&) = default;
};

/// Tells which cells of a raster lie in the shape, row 0 on top. Of a raster without any outside:
/// nothing.
using InsideCells = std::function<std::vector<char>(int width, int height)>;

/// The page over which pictures are stretched.
struct PicturePage {
  Vec2 size;       ///< [mm]
  double spacing;  ///< tau [mm]
  /// Cells outside of the shape count neither for levels nor for tones; unset: all are inside
  InsideCells inside = {};
};

struct SolvedDirections {
  DirectionMap directions;  ///< cells of half a spacing, at most 4096 on a side
  std::vector<Lamp> lamps;  ///< one per picture, as given or chosen
  /// Other azimuths of a single lamp that was chosen, which may suit the picture as well [degrees],
  /// best first; plates tell
  std::vector<double> azimuths;
  double level = 1;  ///< as given or chosen
  /// The pictures after levels, on the raster of the directions: what is to be seen
  std::vector<Tones> shown;
};

/// Finds the directions that show pictures under their lamps. It minimises, on a hierarchy of
/// grids, the squared errors of the tones (sRGB codes of lightOf, levels at the 1st and 99th
/// percentile, laid between the darkest and the brightest direction) plus `smoothness` times the
/// squared divergence of the beads' direction, which forces U-turns, and a little of its squared
/// gradient. The same bytes for any number of threads.
/// \return InvalidArgument (no pictures or too many, a lamp or parameter out of range, a lamp that
/// tells no directions apart) or Cancelled.
Result<SolvedDirections> solveDirections(std::span<const LitPicture> pictures,
                                         const Roughness& roughness, const PicturePage& page,
                                         const InversionParams& params, const RunContext& run);

}  // namespace sillon
