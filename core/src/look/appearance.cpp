#include "sillon/look/appearance.hpp"

#include <algorithm>

#include "base/fast_math.hpp"
#include "base/refused.hpp"
#include "look/appearance_data.hpp"
#include "look/inversion_parts.hpp"

namespace sillon {
namespace {

// Samples over the round top of a bead.
constexpr int kProfileSamples = 16;
constexpr int kSteps = 360;  // directions among which the brightest and the darkest are looked for

float radians(double degrees) {
  // Whole turns are taken off first, as sinCos is most exact near zero.
  const double turns = degrees / 360;
  return static_cast<float>((turns - std::floor(turns + 0.5)) * 2 * 3.14159265358979323846);
}

// Slope variance of a roughness given in degrees, as profilometers give it: sigma = tan(degrees).
float squaredSlope(double degrees) {
  const SinCos v = sinCos(radians(degrees));
  return v.sin * v.sin / (v.cos * v.cos);
}

// Directions over half a turn: d and -d are the same bead.
Vec2f directionAt(int step, int steps) {
  const SinCos v = sinCos(kPi * static_cast<float>(step) / static_cast<float>(steps));
  return {v.cos, v.sin};
}

bool within(double v, double low, double high) { return v >= low && v <= high; }  // false for NaN

}  // namespace

std::optional<Error> invalidLamp(const Lamp& lamp) {
  if (!within(lamp.azimuth, -36000, 36000)) return outOfRange("lamp.azimuth", lamp.azimuth, -36000, 36000, "degrees");
  if (!within(lamp.elevation, 1, 90)) return outOfRange("lamp.elevation", lamp.elevation, 1, 90, "degrees");
  if (!within(lamp.slope, 0, 2)) return outOfRange("lamp.size", lamp.slope, 0, 2, "");
  return std::nullopt;
}

std::optional<Error> invalidRoughness(const Roughness& roughness) {
  for (const double slope : {roughness.along, roughness.across}) {
    if (!within(slope, 0.1, 45)) return outOfRange("slopes", slope, 0.1, 45, "degrees");
  }
  return std::nullopt;
}

// The model of docs/internals/pictures.md: anisotropic Beckmann slopes (Heitz 2014) and an eye straight above.
Lobe lobeOf(const Lamp& lamp, const Roughness& roughness) {
  const SinCos azimuth = sinCos(radians(lamp.azimuth)), elevation = sinCos(radians(lamp.elevation));
  const auto lampVariance = static_cast<float>(lamp.slope * lamp.slope);
  Lobe lobe;
  // The slope that mirrors the lamp into the eye: m = (lx, ly) / (1 + lz).
  lobe.tilt = Vec2f{azimuth.cos, azimuth.sin} * (elevation.cos / (1 + elevation.sin));
  // The lamp's size adds to the roughness as one more Gaussian.
  lobe.alongVariance = squaredSlope(roughness.along) + lampVariance;
  lobe.acrossVariance = squaredSlope(roughness.across) + lampVariance;
  lobe.profile = static_cast<float>(kProfileSlopeData);
  lobe.diffuse = static_cast<float>(kDiffuseData);
  lobe.brightest = 0;
  // Light is relative to the brightest direction.
  for (int k = 0; k < kSteps; ++k) {
    lobe.brightest = std::max(lobe.brightest, highlightOf(lobe, directionAt(k, kSteps)));
  }
  lobe.brightest = std::max(lobe.brightest, 1e-12f);
  return lobe;
}

// Highlight of one place on the round top, whose slope across the bead is `slope`.
float highlightAt(const Lobe& lobe, Vec2f direction, float slope) {
  const float along = dot(lobe.tilt, direction);
  const float across = cross(direction, lobe.tilt) - slope;
  return decay(along * along / (2 * lobe.alongVariance) + across * across / (2 * lobe.acrossVariance));
}

// Mean over the round top, whose slopes go from -profile to profile.
float highlightOf(const Lobe& lobe, Vec2f direction) {
  float sum = 0;
  for (int k = 0; k < kProfileSamples; ++k) {
    const float side = (static_cast<float>(k) + 0.5f) * (2.0f / kProfileSamples) - 1;
    sum += highlightAt(lobe, direction, lobe.profile * side);
  }
  return sum / kProfileSamples;
}

float lightOf(const Lobe& lobe, Vec2f direction) {
  return lobe.diffuse + (1 - lobe.diffuse) * std::min(1.0f, highlightOf(lobe, direction) / lobe.brightest);
}

std::vector<float> lightTable(const Lobe& lobe, int steps) {
  std::vector<float> table;
  for (int k = 0; k < steps; ++k) table.push_back(lightOf(lobe, directionAt(k, steps)));
  return table;
}

// Ratio of the white to the black that directions can show.
double contrastOf(const Lobe& lobe) {
  const std::vector<float> table = lightTable(lobe, kSteps);
  const auto [least, most] = std::minmax_element(table.begin(), table.end());
  return static_cast<double>(*most) / static_cast<double>(*least);
}

double bulbSlope() { return kBulbData; }
double softboxSlope() { return kSoftboxData; }
double windowSlope() { return kWindowData; }

}  // namespace sillon
