// What folded spirals show in the light of one lamp: the appearance model, and a camera's tone curve.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "calibrate/fit_spirals.hpp"

namespace sillon {

// Tilt x, tilt y, log of both variances, log blur, closing, lone, log of the camera's distance by the given one,
// inverse distance of the lamp [1/m], contrast of the camera's tone curve, and how far all spirals seem to lie off, as
// they shine on their lamp's side [mm].
inline constexpr int kGlobals = 12;
using Globals = Eigen::Matrix<double, kGlobals, 1>;

/// Slope that mirrors the lamp into a camera towards `eye`, and back.
Eigen::Vector2d tiltAt(const Eigen::Vector3d& lamp, const Eigen::Vector3d& eye);
Eigen::Vector3d lampOf(const Eigen::Vector2d& tilt, const Eigen::Vector3d& eye);

class SpiralModel {
 public:
  static constexpr int kRows = kAngles * kPhases;
  using Rows = Eigen::Matrix<double, kRows, 1>;
  using Basis = Eigen::Matrix<double, kRows, 3>;

  /// Keeps a reference to the spirals.
  SpiralModel(const std::vector<LitSpiral>& spirals, const SeenFrom& camera);

  struct Light {
    Rows weight, seen;
  };

  /// The light that a camera of this contrast has seen, weighted so that equal steps of codes count alike.
  [[nodiscard]] Light lightOf(std::size_t which, double contrast) const;

  static constexpr int kHarmonics = 4;  ///< of the pattern across a pitch; lenses leave no more
  struct Wave {
    double re = 0, im = 0;
  };
  using Pattern = std::array<Wave, kHarmonics>;

  /// What a spiral sends, before lens and shift. The globals for blur, contrast and offset do not matter to it.
  struct Shape {
    double light = 1;                        ///< by the distance of the lamp
    Pattern body;                            ///< at every angle
    std::array<Pattern, 2 * kAngles> shine;  ///< at two points of each angle
    std::array<Pattern, 2 * kAngles> floor;  ///< of loose spirals
  };
  [[nodiscard]] Shape shapeOf(std::size_t which, const Globals& g) const;

  /// What a spiral shows for a highlight of 1, for a body of 1, and for gaps of 1 between loose turns where
  /// no bead stands before the lamp or the camera.
  /// \param off  of the spiral from where it was folded about [mm]. \param weights  that rows are multiplied by.
  [[nodiscard]] Basis basisOf(std::size_t which, const Shape& shape, const Globals& g, const Eigen::Vector2d& off,
                              const Rows& weights) const;

 private:
  const std::vector<LitSpiral>& spirals_;
  SeenFrom camera_;
  double profile_;
  std::vector<Rows> codes_;  // of the bins; below 0: none
  double brightest_ = 0;
};

}  // namespace sillon
