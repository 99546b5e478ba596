// Light that a bead sends to the eye under a lamp: the one model that previews, view files, the
// views' shaders, the inversion of pictures and their measures share. docs/internals/pictures.md
// has it.
#pragma once

#include <string>
#include <vector>

#include "sillon/base/types.hpp"

namespace sillon {

/// A lamp far away, seen from the plate.
struct Lamp {
  double azimuth = 60;    ///< degrees counter-clockwise from +x, -36000..36000
  double elevation = 45;  ///< degrees above the plate, 1..90
  /// Half its size as RMS slope of the surface that would blur a point as much, 0..2
  double slope = 0.1;

  friend bool operator==(const Lamp&, const Lamp&) = default;
};

/// RMS slopes of a bead's surface (Rdq of ISO 4287) as a profilometer prints them. Tab. 1 of the
/// paper names no unit: read as degrees, so that the slope is tan of the number. That is an
/// assumption; percent would make highlights 1.75 times narrower.
struct Roughness {
  double along = 8.93;   ///< [degrees], 0.1..45
  double across = 15.6;  ///< [degrees], 0.1..45

  friend bool operator==(const Roughness&, const Roughness&) = default;
};

/// Lobe of slopes of a bead under one lamp, the eye straight above: microfacets with Gaussian
/// slopes (anisotropic Beckmann, Heitz 2014), the lamp's size added to their variances, on a round
/// top whose slope runs from -profile to +profile. All slopes without unit.
struct Lobe {
  Vec2f tilt;                ///< slope that mirrors the lamp into the eye: (lx, ly) / (1 + lz)
  float alongVariance = 0;   ///< (tan along)² + slope²
  float acrossVariance = 0;  ///< (tan across)² + slope²
  float profile = 0;         ///< slope of the bead's top at its edge
  float diffuse = 0;    ///< share of the brightest direction's light that every direction sends
  float brightest = 1;  ///< highlight of the brightest direction
};

/// What is out of range, as a sentence; empty: nothing.
std::string invalidLamp(const Lamp& lamp);
std::string invalidRoughness(const Roughness& roughness);

/// \param lamp,  roughness  in range.
Lobe lobeOf(const Lamp& lamp, const Roughness& roughness);

/// Light of a surface element on a bead, in [0, 1/brightest]: exp(-a²/2va - (c - slope)²/2vc), a
/// and c the tilt along and across the bead.
/// \param direction  unit.
/// \param slope  of the bead's top there, across, positive to its left.
float highlightAt(const Lobe& lobe, Vec2f direction, float slope);

/// Mean over the bead's width.
float highlightOf(const Lobe& lobe, Vec2f direction);

/// Light of a bead relative to the brightest direction: diffuse + (1 - diffuse) highlight /
/// brightest, in [diffuse, 1].
float lightOf(const Lobe& lobe, Vec2f direction);

/// lightOf for `steps` directions: step k is k/steps of a half turn from +x.
std::vector<float> lightTable(const Lobe& lobe, int steps);

/// The brightest direction's light by the darkest's; 1: this lamp tells no directions apart.
double contrastOf(const Lobe& lobe);

/// Below this contrast people see pictures only faintly: between gold PLA under a softbox (4.7) and
/// the next duller measured spool (10.6).
inline constexpr double kWeakContrast = 5;

/// Slopes of lamps by name.
double bulbSlope();
double softboxSlope();
double windowSlope();

}  // namespace sillon
