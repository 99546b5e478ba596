// What folded spirals show in the light of one lamp: the appearance model, and a camera's tone curve.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "calibrate/fit_spirals.hpp"

namespace sillon {

/// Slope that mirrors the lamp into a camera towards `eye`, and back.
Vec2 tiltAt(Vec3 lamp, Vec3 eye);
Vec3 lampOf(Vec2 tilt, Vec3 eye);

class SpiralModel {
 public:
  static constexpr std::size_t kRows = std::size_t{kAngles} * kPhases;
  using Rows = std::array<double, kRows>;
  using Basis = std::array<Vec3, kRows>;

  /// Keeps a reference to the spirals.
  SpiralModel(const std::vector<LitSpiral>& spirals, const SeenFrom& camera);

  struct Light {
    Rows weight, seen;
  };

  /// The light that a camera of this contrast has seen, weighted so that equal steps of codes count alike.
  [[nodiscard]] Light lightOf(std::size_t which, double contrast) const;
  /// That of the brightest bin.
  [[nodiscard]] double brightest(double contrast) const;

  static constexpr std::size_t kHarmonics = 6;  ///< of the pattern across a pitch; lenses leave no more
  struct Wave {
    double re = 0, im = 0;
  };
  using Pattern = std::array<Wave, kHarmonics>;

  /// What a spiral sends, before lens and shift. The globals for blur, contrast, sharpening and offset do not matter
  /// to it.
  struct Shape {
    double light = 1;                                       ///< by the distance of the lamp
    Pattern body{};                                         ///< at every angle
    std::array<Pattern, std::size_t{2} * kAngles> shine{};  ///< at two points of each angle
    std::array<Pattern, std::size_t{2} * kAngles> floor{};  ///< of loose spirals
  };
  [[nodiscard]] Shape shapeOf(std::size_t which, const Globals& g) const;

  /// What a spiral shows for a highlight of 1, for a body of 1, and for gaps of 1 between loose turns where
  /// no bead stands before the lamp or the camera.
  /// \param off  of the spiral from where it was folded about [mm].
  [[nodiscard]] Basis basisOf(std::size_t which, const Shape& shape, const Globals& g, Vec2 off) const;

  /// An unsharp mask over codes: it adds what a blur takes off them.
  struct Sharpened {
    Rows light;
    std::array<std::array<double, std::size_t{kPhases} * kPhases>, kAngles>
        by;  ///< derivatives, of each angle's phases
  };
  /// \param light  that falls onto the camera.
  [[nodiscard]] Sharpened sharpened(std::size_t which, const Rows& light, double contrast, double amount) const;

 private:
  const std::vector<LitSpiral>& spirals_;
  SeenFrom camera_;
  double profile_;
  std::vector<Rows> codes_;  // of the bins; below 0: none
  double brightest_ = 0;
};

}  // namespace sillon
