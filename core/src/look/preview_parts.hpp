// The parts of a preview: its layout, its colours, the beads on their samples, their shadow, and the signs beside them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "sillon/base/types.hpp"
#include "sillon/look/preview.hpp"

namespace sillon {

// Colours for bead directions: cyclic with a period of 180 degrees, because a bead has no sense of travel.

/// An sRGB colour.
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
    constexpr double kFirstHue = 0.13;  // hue of direction 0 [turns]: amber; vertical beads are blue
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

/// Place of a direction among the colours, in [0, kDirectionColours]; both ends are the same colour. A direction and
/// its opposite have the same place; the null vector has 0.
inline double directionColourPlace(double x, double y) {
  const double halfTurns = std::atan2(y, x) / std::numbers::pi;
  return (halfTurns < 0 ? halfTurns + 1 : halfTurns) * kDirectionColours;
}

/// Colour at a place of any size: the nearest of the table.
inline Rgb directionColourAt(double place) {
  const auto index = static_cast<int>(std::floor(place + 0.5));
  return directionColours()[index & (kDirectionColours - 1)];
}

/// A rectangle of pixels.
struct PixelBox {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

inline bool holds(const PixelBox& box, int x, int y) {
  return x >= box.x && x < box.x + box.width && y >= box.y && y < box.y + box.height;
}

/// Places of the panels and signs in the picture [pixels].
struct Layout {
  int width = 0;
  int height = 0;
  PixelBox directions;  // the page in panel 1 [pixels]; no width: only the look is drawn
  PixelBox look;        // the page in panel 2
  double pixelsPerMm = 0;
  double legendX = 0;  // centre of the half wheel's base
  double legendY = 0;
  double legendRadius = 0;
  double lampX = 0;  // centre of the small ring that shows where the light is
  double lampY = 0;
  double lampRadius = 0;
};

/// Lays out both panels, beside or above each other. \return width 0 if the picture would be beyond the limits.
Layout layOut(Vec2 page, int panelWidth);

/// Lays out the look alone in the middle of a picture of this size.
Layout layOutLook(Vec2 page, int width, int height);

/// One bead segment in samples, y down, with all that shading needs at both ends.
struct ShadedBead {
  Vec2f a;
  Vec2f b;
  float radiusA = 0;
  float radiusB = 0;
  // Unit directions, y up.
  Vec2f tangentA;
  Vec2f tangentB;
  // Place among the direction colours, and its change towards b, the short way round.
  float colourA = 0;
  float colourDelta = 0;
};

inline Vec2f unit(Vec2f v) {
  const float size = length(v);
  return size > 0 ? v * (1 / size) : Vec2f{1, 0};
}

/// Makes the beads of a toolpath. \param scale  samples per mm. \param colours  tells whether the colours of directions
/// are wanted, too.
std::vector<ShadedBead> beadsOf(const Toolpath& toolpath, Vec2 page, double scale, bool colours);

/// Beads by the bands of rows that they touch, in order of index, so that ties fall the same way everywhere.
struct Bands {
  int rows = 0;                    // sample rows per band
  std::vector<std::size_t> begin;  // first bead per band, and one more
  std::vector<std::uint32_t> beads;
};

/// Sorts beads into bands. \param height  rows of all samples. \param rows  rows of a band.
Bands sortIntoBands(const std::vector<ShadedBead>& beads, int height, int rows);

/// The bead that each sample sees: the one whose axis is nearest in relation to its width.
struct Hits {
  std::vector<float> squaredOffset;  ///< (distance / radius)²; 1: no bead. Padded, as four at a time may be written
  std::vector<std::uint32_t> bead;

  /// Makes all samples see nothing.
  void clear(int width, int rows) {
    const std::size_t count = cellCount(width, rows) + 4;
    squaredOffset.assign(count, 1);
    bead.assign(count, 0);
  }
};

/// Share of the way from a to b at which the axis is nearest to p.
inline float shareAlong(const ShadedBead& bead, Vec2f p) {
  const Vec2f d = bead.b - bead.a;
  const float squared = dot(d, d);
  return squared > 0 ? std::clamp(dot(p - bead.a, d) / squared, 0.0f, 1.0f) : 0.0f;
}

/// Rasterises one capsule with linearly varying width: samples that see it keep it instead of the bead before.
/// \param hits  width * rows samples from sample row `firstRow` on.
void rasterise(const ShadedBead& bead, std::uint32_t index, int firstRow, int rows, int width, Hits& hits);

inline constexpr Rgb kBackground{38, 36, 34};  ///< warm grey, dark enough for both panels
inline constexpr Rgb kInk{168, 162, 154};      ///< ticks of the legend

/// A colour to calculate with; linear or 0..255, as the place says.
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
  std::uint8_t* p = &image.rgb[indexOf(x, y, image.width) * 3];
  p[0] = colour.red;
  p[1] = colour.green;
  p[2] = colour.blue;
}

inline Rgb at(const RgbImage& image, int x, int y) {
  const std::uint8_t* p = &image.rgb[indexOf(x, y, image.width) * 3];
  return {p[0], p[1], p[2]};
}

inline Rgb rounded(Colour c) {
  const auto byte = [](float v) { return static_cast<std::uint8_t>(std::clamp(v, 0.0f, 255.0f) + 0.5f); };
  return {byte(c.red), byte(c.green), byte(c.blue)};
}

/// The plate's shadow: a coarse mask of the plate, blurred.
struct Shadow {
  int cell = 1;    // side of a cell [pixels]
  int border = 0;  // cells around the page
  int width = 0;
  int height = 0;
  std::vector<float> dark;  // 0..1
};

/// Makes the shadow by three box blurs, which are nearly Gaussian.
/// \param covered  samples that the plate covers, for each pixel of the page. \param samples  samples of a pixel.
Shadow shadowOf(const std::vector<std::uint8_t>& covered, int samples, const PixelBox& page);

/// Darkness of the shadow at a place, bilinear. \param x  pixels from the page's left edge. \param y  pixels from its
/// top. \return 0..1.
float shadowAt(const Shadow& shadow, float x, float y);

/// Draws a half wheel on which each direction has its colour, with ticks at 0, 45, 90, 135 and 180 degrees.
void drawLegend(RgbImage& image, const Layout& layout);

/// Draws a ring with a dot that shows where the lamp stands, seen from above.
void drawLamp(RgbImage& image, const Layout& layout, const Lamp& lamp);

// The "Quite OK" picture format (qoiformat.org), which Prusa's printers show.

/// Encodes a picture as QOI. \param rgb  width * height * 3 bytes, row 0 on top; both sides > 0.
std::vector<std::uint8_t> encodeQoi(int width, int height, std::span<const std::uint8_t> rgb);

}  // namespace sillon
