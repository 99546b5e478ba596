// The appearance model, fitted to folded spirals.
#pragma once

#include <array>
#include <vector>

#include "calibrate/fold_spirals.hpp"
#include "calibrate/space.hpp"
#include "sillon/base/run_context.hpp"

namespace sillon {

enum class SpiralKind { Mark, Loose, Flow };

struct LitSpiral {
  CouponSpiral spiral;  ///< as it was asked for
  SpiralKind kind = SpiralKind::Mark;
  double flow = 1;    ///< asked for
  double width = 0;   ///< of a bead of flow 1 [mm]
  double height = 0;  ///< of a bead [mm]
  FoldedSpiral seen;
  Vec2 fromAxis;                  ///< from the picture's middle, in half widths and half heights
  Vec2 blurX{1, 0}, blurY{0, 1};  ///< steps of one pixel on the plate [mm]
};

struct SeenFrom {
  Vec3 place{0, 0, 1};         ///< of the camera, from the coupon's middle [mm]
  double distanceError = 0.5;  ///< of the log of its distance
  double directionError = 0;   ///< [radians]
  double strange = 0;          ///< how far the map is from any that a whole picture has, by the map's error
};

/// What is known of the lamp's elevation before [degrees].
struct Elevation {
  double value = 47;
  double error = 9;
};

// Tilt x, tilt y, log of both variances, log blur, closing, lone, log of the camera's distance by the given one,
// inverse distance of the lamp [1/m], contrast of the camera's tone curve, sharpening, and how far all spirals seem to
// lie off, as they shine on their lamp's side [mm].
inline constexpr std::size_t kGlobals = 13;
using Globals = std::array<double, kGlobals>;

struct SpiralFit {
  Vec2 tilt;                 ///< slope that mirrors the lamp into the camera, in the coupon's middle
  double alongVariance = 0;  ///< of slopes, the lamp's included
  double acrossVariance = 0;
  double blur = 0;                    ///< standard deviation [pixels]
  double closing = 0;                 ///< width of beads in discs and marks, by what their flow asks for
  double lone = 0;                    ///< width of lone beads, likewise
  std::array<double, 7> variances{};  ///< of the first globals
  struct Surety {
    double xx = 0, xy = 0, yy = 0;
  };
  std::vector<Surety> surety;         ///< of the offsets: inverse variances, up to a factor
  std::vector<Vec2> offsets;          ///< of the spirals from where they were folded about [mm]
  double misfit = 0;                  ///< RMS of what is left, by the brightest direction's light
  double contrast = 0;                ///< brightest direction's light by the darkest's, of what was seen
  Globals globals{};                  ///< to begin with again
  double diffuse = 0;                 ///< mean light of what every direction sends [photograph's]
  double veil = 0;                    ///< light that lies evenly over the picture, by the brightest beads'
  std::array<double, 3> veilTerms{};  ///< [photograph's]: even, and by fromAxis
  double sharpening = 0;              ///< share that an unsharp mask adds of what a blur takes off
};

/// \param before  a fit of the same spirals, folded about nearby places, to begin with; nullptr: none.
SpiralFit fitSpirals(const std::vector<LitSpiral>& spirals, const SeenFrom& camera, const Elevation& elevation,
                     const SpiralFit* before, const RunContext& run);

}  // namespace sillon
