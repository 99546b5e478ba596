// The appearance model, fitted to folded spirals.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calibrate/fold_spirals.hpp"
#include "sillon/base/run_context.hpp"

namespace sillon {

enum class SpiralKind { Mark, Loose, Flow };

inline constexpr int kLooseSpirals = 2;

struct LitSpiral {
  CouponSpiral spiral;  ///< as it was asked for
  SpiralKind kind = SpiralKind::Mark;
  double flow = 1;    ///< asked for
  double width = 0;   ///< of a bead of flow 1 [mm]
  double height = 0;  ///< of a bead [mm]
  int gap = 0;        ///< which of the loose ones it is
  FoldedSpiral seen;
  double fromAxis = 0;  ///< square of its distance from the picture's middle, in half widths
  Eigen::Matrix2d blurShape = Eigen::Matrix2d::Identity();  ///< of one pixel's blur on the plate [mm²]
};

struct SeenFrom {
  Eigen::Vector3d place{0, 0, 1};  ///< of the camera, from the coupon's middle [mm]
  double distanceError = 0.5;      ///< of the log of its distance
  double directionError = 0;       ///< [radians]
};

/// What is known of the lamp's elevation before [degrees].
struct Elevation {
  double value = 47;
  double error = 9;
};

struct SpiralFit {
  Eigen::Vector2d tilt;      ///< slope that mirrors the lamp into the camera, in the coupon's middle
  double alongVariance = 0;  ///< of slopes, the lamp's included
  double acrossVariance = 0;
  double blur = 0;                         ///< standard deviation [pixels]
  double closing = 0;                      ///< width of beads in discs and marks, by what their flow asks for
  double lone = 0;                         ///< width of lone beads, likewise
  Eigen::Matrix<double, 7, 7> covariance;  ///< of tilt (2), log of both variances, blur, closing, lone
  std::vector<Eigen::Vector2d> offsets;    ///< of the spirals from where they were folded about [mm]
  double misfit = 0;                       ///< RMS of what is left, by the brightest direction's light
  double contrast = 0;                     ///< brightest direction's light by the darkest's, of what was seen
  double gain = 0;                         ///< mean light of the highlight [photograph's]
  Eigen::Matrix<double, 12, 1> globals;    ///< to begin with again
  double diffuse = 0;                      ///< mean light of what every direction sends [photograph's]
};

/// \param before  a fit of the same spirals, folded about nearby places, to begin with; nullptr: none.
SpiralFit fitSpirals(const std::vector<LitSpiral>& spirals, const SeenFrom& camera, const Elevation& elevation,
                     const SpiralFit* before, const RunContext& run);

}  // namespace sillon
