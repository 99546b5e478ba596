// Colours for bead directions: cyclic with a period of 180 degrees, because a bead has no sense of travel.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace sillon {

struct Rgb {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  friend bool operator==(const Rgb&, const Rgb&) = default;
};

inline constexpr int kDirectionColours = 256;

/// Colour of direction k * 180 / 256 degrees. Equal steps of direction look equally different: one turn of hue in OKLab
/// (Ottosson 2020) at constant lightness and nearly the largest chroma for which all hues exist in sRGB.
inline const std::array<Rgb, kDirectionColours>& directionColours() {
  static const std::array<Rgb, kDirectionColours> colours = [] {
    constexpr double kLightness = 0.74;
    constexpr double kChroma = 0.122;
    constexpr double kFirstHue = 0.13;  // [turns] of direction 0: amber; vertical beads are blue
    const auto toByte = [](double linear) {
      const double clamped = std::clamp(linear, 0.0, 1.0);
      const double encoded = clamped <= 0.0031308 ? 12.92 * clamped : 1.055 * std::pow(clamped, 1 / 2.4) - 0.055;
      return static_cast<std::uint8_t>(std::lround(encoded * 255));
    };
    std::array<Rgb, kDirectionColours> made;
    for (int k = 0; k < kDirectionColours; ++k) {
      const double hue = 2 * std::numbers::pi * (kFirstHue + static_cast<double>(k) / kDirectionColours);
      const double a = kChroma * std::cos(hue);
      const double b = kChroma * std::sin(hue);
      const double lRoot = kLightness + 0.3963377774 * a + 0.2158037573 * b;
      const double mRoot = kLightness - 0.1055613458 * a - 0.0638541728 * b;
      const double sRoot = kLightness - 0.0894841775 * a - 1.2914855480 * b;
      const double l = lRoot * lRoot * lRoot;
      const double m = mRoot * mRoot * mRoot;
      const double s = sRoot * sRoot * sRoot;
      made[k] = {toByte(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
                 toByte(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
                 toByte(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
    }
    return made;
  }();
  return colours;
}

/// Place of a direction among the colours, in [0, kDirectionColours]; both ends are the same colour. The same for
/// (x, y) and (-x, -y); 0 for the null vector.
inline double directionColourPlace(double x, double y) {
  const double halfTurns = std::atan2(y, x) / std::numbers::pi;
  return (halfTurns < 0 ? halfTurns + 1 : halfTurns) * kDirectionColours;
}

/// Colour at a place of any size, nearest of the table.
inline Rgb directionColourAt(double place) {
  const auto index = static_cast<int>(std::floor(place + 0.5));
  return directionColours()[index & (kDirectionColours - 1)];
}

}  // namespace sillon
