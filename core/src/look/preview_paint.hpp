// Colours while a preview is computed, and how they get into the picture.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "look/direction_colour.hpp"
#include "sillon/look/preview.hpp"

namespace sillon {

inline constexpr Rgb kBackground{38, 36, 34};  ///< warm grey, dark enough for both panels
inline constexpr Rgb kInk{168, 162, 154};      ///< ticks of the legend

struct Colour {
  float red = 0;
  float green = 0;
  float blue = 0;

  friend Colour operator+(Colour a, Colour b) { return {a.red + b.red, a.green + b.green, a.blue + b.blue}; }
  friend Colour operator*(Colour a, Colour b) { return {a.red * b.red, a.green * b.green, a.blue * b.blue}; }
  friend Colour operator*(Colour a, float s) { return {a.red * s, a.green * s, a.blue * s}; }
};

inline Colour asColour(Rgb c) {
  return {static_cast<float>(c.red), static_cast<float>(c.green), static_cast<float>(c.blue)};
}

inline void put(RgbImage& image, int x, int y, Rgb colour) {
  std::uint8_t* p =
      &image.rgb[(static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)) *
                 3];
  p[0] = colour.red;
  p[1] = colour.green;
  p[2] = colour.blue;
}

inline Rgb at(const RgbImage& image, int x, int y) {
  const std::uint8_t* p =
      &image.rgb[(static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)) *
                 3];
  return {p[0], p[1], p[2]};
}

inline Rgb rounded(Colour c) {
  const auto byte = [](float v) { return static_cast<std::uint8_t>(std::clamp(v, 0.0f, 255.0f) + 0.5f); };
  return {byte(c.red), byte(c.green), byte(c.blue)};
}

}  // namespace sillon
