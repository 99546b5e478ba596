// Light that a bead sends to the eye under a lamp. Previews, view files, the views' shaders, the
// inversion of pictures and their measures share this one model; docs/internals/pictures.md
// describes it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// A lamp far away, seen from the plate.
struct Lamp {
  double azimuth = 60;    ///< azimuth [degrees] counter-clockwise from +x, -36000..36000
  double elevation = 45;  ///< elevation [degrees] above the plate, 1..90
  /// Half the lamp's size, as the RMS slope of a surface that would blur a point lamp as much, 0..2
  double slope = 0.1;

  friend bool operator==(const Lamp&, const Lamp&) = default;
};

/// RMS slopes of a bead's surface (Rdq of ISO 4287) as a profilometer prints them. Tab. 1 of the
/// paper names no unit; its numbers are read as degrees, so that the slope is the tangent of the
/// number. That is an assumption; percent would make highlights 1.75 times narrower.
struct Roughness {
  double along = 8.93;   ///< slope along the bead [degrees], 0.1..45
  double across = 15.6;  ///< slope across the bead [degrees], 0.1..45

  friend bool operator==(const Roughness&, const Roughness&) = default;
};

/// Lobe of slopes of a bead under one lamp, with the eye straight above. Its microfacets have
/// Gaussian slopes (anisotropic Beckmann, Heitz 2014), with the lamp's size added to their
/// variances, on a round top whose slope runs from -profile to +profile. All slopes are without
/// unit.
struct Lobe {
  Vec2f tilt;                ///< slope that mirrors the lamp into the eye: (lx, ly) / (1 + lz)
  float alongVariance = 0;   ///< (tan along)² + slope²
  float acrossVariance = 0;  ///< (tan across)² + slope²
  float profile = 0;         ///< slope of the bead's top at its edge
  float diffuse = 0;    ///< share of the brightest direction's light that every direction sends
  float brightest = 1;  ///< highlight of the brightest direction
};

/// Refuses a value that is out of range; nothing where none is.
std::optional<Error> invalidLamp(const Lamp& lamp);
std::optional<Error> invalidRoughness(const Roughness& roughness);

/// Computes the lobe of a bead under a lamp.
/// \param lamp,  roughness  in range.
Lobe lobeOf(const Lamp& lamp, const Roughness& roughness);

/// Computes the light of a surface element on a bead, in [0, 1/brightest]: exp(-a²/2va - (c -
/// slope)²/2vc), where a and c are the tilt along and across the bead, and va and vc the variances.
/// \param direction  unit vector along the bead.
/// \param slope  slope of the bead's top there, across the bead, positive to its left.
float highlightAt(const Lobe& lobe, Vec2f direction, float slope);

/// Computes the mean of highlightAt over the bead's width.
float highlightOf(const Lobe& lobe, Vec2f direction);

/// Computes the light of a bead relative to the brightest direction: diffuse + (1 - diffuse)
/// highlight / brightest, in [diffuse, 1].
float lightOf(const Lobe& lobe, Vec2f direction);

/// Tabulates lightOf for `steps` directions: step k is k/steps of a half turn from +x.
std::vector<float> lightTable(const Lobe& lobe, int steps);

/// Divides the brightest direction's light by the darkest's; 1: this lamp tells no directions
/// apart.
double contrastOf(const Lobe& lobe);

/// Contrast below which people see pictures only faintly. It lies between gold PLA under a softbox
/// (4.7) and the next duller measured spool (10.6).
inline constexpr double kWeakContrast = 5;

/// Return the slopes of a bulb, a softbox and a window as lamps (Lamp::slope).
double bulbSlope();
double softboxSlope();
double windowSlope();

// Filaments as they look: their colour, and their roughness as measured in Tab. 1 of the paper.

/// Roughness of both sides of a layer.
struct SideRoughness {
  Roughness nozzleSide;  ///< roughness of the side that the nozzle passed over
  Roughness bedSide;     ///< roughness of the side that lay on the bed
};

// Nozzles of the measured prints [mm].
inline constexpr double kFineNozzle = 0.4;
inline constexpr double kWideNozzle = 0.8;

/// A filament as it looks.
struct Spool {
  std::string key;                       ///< name in files: "bluePla"
  std::array<std::uint8_t, 3> colour{};  ///< colour of the body, sRGB
  SideRoughness fine;                    ///< roughness when printed with a nozzle of kFineNozzle
  SideRoughness wide;                    ///< roughness when printed with a nozzle of kWideNozzle
};

/// Returns all measured spools, sorted by key.
const std::vector<Spool>& spools();

/// Finds a measured spool.
/// \return nullptr for a key that none of them has.
const Spool* findSpool(std::string_view key);

/// Returns the measured spool of a name.
const Spool& spoolOf(SpoolName name);

/// Reads a person's own spools, sorted by key, from a file as docs/reference/spools.md describes
/// it.
/// \return InvalidFile (which spool, which of its values, the allowed range) or TooLarge (beyond 1
/// MiB).
Result<std::vector<Spool>> readSpools(std::string_view text);

/// Returns the roughness of a spool on one side of a layer.
/// \param nozzle  diameter [mm]. Between the measured nozzles the slopes are interpolated linearly,
/// beyond them they are those of the nearer one.
Roughness roughnessOf(const Spool& spool, double nozzle, bool bedSide);

}  // namespace sillon
