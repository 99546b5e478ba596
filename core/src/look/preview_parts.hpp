// The parts of a preview: its layout, its colours, the beads on their samples, their shadow, and the signs beside them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "look/direction_colour.hpp"
#include "sillon/base/types.hpp"
#include "sillon/look/preview.hpp"

namespace sillon {

struct Box {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

inline bool holds(const Box& box, int x, int y) {
  return x >= box.x && x < box.x + box.width && y >= box.y && y < box.y + box.height;
}

struct Layout {
  int width = 0;
  int height = 0;
  Box directions;  // the page in panel 1 [pixels]; no width: only the look is drawn
  Box look;        // the page in panel 2
  double pixelsPerMm = 0;
  double legendX = 0;  // centre of the half wheel's base
  double legendY = 0;
  double legendRadius = 0;
  double lampX = 0;  // centre of the small ring that shows where the light is
  double lampY = 0;
  double lampRadius = 0;
};

/// Both panels, beside or above each other. \return width 0 if the picture would be beyond the limits.
Layout layOut(Vec2 page, int panelWidth);

/// The look alone in the middle of a picture of this size.
Layout layOutLook(Vec2 page, int width, int height);

/// One bead segment in samples, y down, with what shading needs at both ends.
struct Bead {
  Vec2f a;
  Vec2f b;
  float radiusA = 0;
  float radiusB = 0;
  // Unit directions, y up.
  Vec2f tangentA;
  Vec2f tangentB;
  // The place among the direction colours, and how it changes towards b, the short way round.
  float colourA = 0;
  float colourDelta = 0;
};

inline Vec2f unit(Vec2f v) {
  const float size = length(v);
  return size > 0 ? v * (1 / size) : Vec2f{1, 0};
}

/// \param scale  samples per mm. \param colours  whether those of their directions are wanted too.
std::vector<Bead> beadsOf(const Toolpath& toolpath, Vec2 page, double scale, bool colours);

/// Beads by the bands of rows they touch, in order of index, so that ties fall the same way everywhere.
struct Bands {
  int rows = 0;                    // sample rows per band
  std::vector<std::size_t> begin;  // per band, and one more
  std::vector<std::uint32_t> beads;
};

/// \param height  of all samples. \param rows  of a band.
Bands sortIntoBands(const std::vector<Bead>& beads, int height, int rows);

/// Each sample sees the bead whose axis is nearest in relation to its width.
struct Hits {
  std::vector<float>
      squaredOffset;  ///< (distance / radius)²; 1: nothing. Four at a time may be written, so it is padded
  std::vector<std::uint32_t> bead;

  /// Nothing at all.
  void clear(int width, int rows) {
    const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(rows) + 4;
    squaredOffset.assign(count, 1);
    bead.assign(count, 0);
  }
};

/// Share of the way from a to b nearest to p.
inline float shareAlong(const Bead& bead, Vec2f p) {
  const Vec2f d = bead.b - bead.a;
  const float squared = dot(d, d);
  return squared > 0 ? std::clamp(dot(p - bead.a, d) / squared, 0.0f, 1.0f) : 0.0f;
}

/// Rasterises one capsule with linearly varying width: what it hides is replaced. \param hits  width * rows samples
/// from sample row `firstRow` on.
void rasterise(const Bead& bead, std::uint32_t index, int firstRow, int rows, int width, Hits& hits);

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

/// A coarse mask of the plate, blurred.
struct Shadow {
  int cell = 1;    // [pixels]
  int border = 0;  // cells around the page
  int width = 0;
  int height = 0;
  std::vector<float> dark;  // 0..1
};

/// By three box blurs, which are nearly Gaussian.
/// \param covered  for each pixel of the page how many of its samples the plate covers. \param samples  of a pixel.
Shadow shadowOf(const std::vector<std::uint8_t>& covered, int samples, const Box& page);

/// \param x  pixels from the page's left edge. \param y  from its top. \return 0..1, bilinear.
float shadowAt(const Shadow& shadow, float x, float y);

/// Half wheel: a direction has the colour at its angle. Ticks at 0, 45, 90, 135 and 180 degrees.
void drawLegend(RgbImage& image, const Layout& layout);

/// A ring with a dot: where the lamp stands, seen from above.
void drawLamp(RgbImage& image, const Layout& layout, const Lamp& lamp);

}  // namespace sillon
