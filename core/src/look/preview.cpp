// Beads are rasterised once, on 2 x 2 samples per pixel, in bands of rows; both panels are shaded from the same
// samples.
#include "sillon/look/preview.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <new>
#include <numbers>
#include <string>

#include "base/parallel_for.hpp"
#include "base/simd.hpp"
#include "look/direction_colour.hpp"
#include "sillon/input/image_io.hpp"
#include "sillon/look/tones.hpp"
#include "toolpath/toolpath_check.hpp"

namespace sillon {
namespace {

constexpr int kSamples = 2;    // per pixel and axis
constexpr int kBandRows = 16;  // pixel rows that one task rasterises and shades

constexpr Rgb kBackground{38, 36, 34};  // warm grey, dark enough for both panels
constexpr Rgb kInk{168, 162, 154};      // ticks of the legend

// ---- layout ----

struct Box {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

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

/// \return width 0 if the picture would be beyond the limits.
Layout layOut(Vec2 page, int panelWidth) {
  Layout layout;
  const int margin = std::max(1, panelWidth / 14);
  const int pageWidth = panelWidth - 2 * margin;
  layout.pixelsPerMm = pageWidth / page.x;
  const double exactHeight = page.y * layout.pixelsPerMm;
  if (!(exactHeight <= kMaxImageSide)) return layout;
  const int pageHeight = std::max(1, static_cast<int>(std::ceil(exactHeight)));
  const int footer = std::max(2, panelWidth / 9);  // under each page, with the legend
  const int panelHeight = margin + pageHeight + footer;

  const auto strangeness = [](double w, double h) { return std::abs(std::log(w / h * 3 / 4)); };
  const bool stacked = strangeness(panelWidth, 2.0 * panelHeight) < strangeness(2.0 * panelWidth, panelHeight);
  const std::int64_t width = stacked ? panelWidth : 2 * panelWidth;
  const std::int64_t height = stacked ? 2 * panelHeight : panelHeight;
  if (width > kMaxImageSide || height > kMaxImageSide || width * height > kMaxImagePixels) return layout;

  layout.width = static_cast<int>(width);
  layout.height = static_cast<int>(height);
  layout.directions = {margin, margin, pageWidth, pageHeight};
  layout.look = layout.directions;
  (stacked ? layout.look.y : layout.look.x) += stacked ? panelHeight : panelWidth;
  layout.legendRadius = footer * 0.42;
  layout.legendX = margin + layout.legendRadius;
  layout.legendY = margin + pageHeight + footer * 0.78;
  layout.lampRadius = layout.legendRadius * 0.43;
  layout.lampX = layout.look.x + layout.lampRadius;
  layout.lampY = layout.look.y + layout.legendY - margin - layout.lampRadius;
  return layout;
}

/// The look alone in the middle of a picture of this size.
Layout layOutLook(Vec2 page, int width, int height) {
  constexpr double kFill = 0.92;
  Layout layout;
  layout.width = width;
  layout.height = height;
  layout.pixelsPerMm = kFill * std::min(width / page.x, height / page.y);
  layout.look.width = std::max(1, static_cast<int>(page.x * layout.pixelsPerMm));
  layout.look.height = std::max(1, static_cast<int>(page.y * layout.pixelsPerMm));
  layout.look.x = (width - layout.look.width) / 2;
  layout.look.y = (height - layout.look.height) / 2;
  return layout;
}

// ---- beads ----

/// One bead segment in samples, y down, with what shading needs at both ends.
struct Bead {
  Vec2f a, b;
  float radiusA = 0, radiusB = 0;
  Vec2f tangentA, tangentB;            // unit, y up
  float colourA = 0, colourDelta = 0;  // place among the direction colours; change towards b, the short way round
};

Vec2f unit(Vec2f v) {
  const float size = length(v);
  return size > 0 ? v * (1 / size) : Vec2f{1, 0};
}

/// Direction at the joint of two pieces: their mean, so that curves look round. A piece keeps its own direction at
/// sharp turns and where it is long against its width: a straight bead is straight up to its end, and a short neighbour
/// begins with its direction.
Vec2f jointTangent(Vec2f own, Vec2f other, float width) {
  constexpr float kLong = 4;  // [widths]
  const Vec2f ownUnit = unit(own), otherUnit = unit(other);
  if (dot(ownUnit, otherUnit) < 0.5f || length(own) > kLong * width) return ownUnit;
  return length(other) > kLong * width ? otherUnit : unit(ownUnit + otherUnit);
}

/// What of beads is wanted: where they lie, what the look needs besides, or what panel 1 needs too.
enum class Wanted { Outlines, Look, Directions };

/// \param scale  samples per mm.
std::vector<Bead> beadsOf(const Toolpath& toolpath, Vec2 page, double scale, Wanted wanted) {
  std::vector<Bead> beads;
  for (const Cycle& cycle : toolpath.cycles) {
    const std::size_t count = cycle.points.size();
    const auto at = [&](std::size_t k) { return cycle.points[k % count]; };
    const auto sampleAt = [&](std::size_t k) {
      return Vec2f{static_cast<float>(at(k).x * scale), static_cast<float>((page.y - at(k).y) * scale)};
    };
    const auto radiusAt = [&](std::size_t k) { return static_cast<float>(cycle.widths[k % count] * scale / 2); };
    for (std::size_t k = 0; k < count; ++k) {
      Bead& bead = beads.emplace_back();
      bead.a = sampleAt(k);
      bead.b = sampleAt(k + 1);
      bead.radiusA = radiusAt(k);
      bead.radiusB = radiusAt(k + 1);
      if (wanted == Wanted::Outlines) continue;
      const Vec2f own = at(k + 1) - at(k);
      bead.tangentA = jointTangent(own, at(k) - at(k + count - 1), cycle.widths[k]);
      bead.tangentB = jointTangent(own, at(k + 2) - at(k + 1), cycle.widths[(k + 1) % count]);
      if (wanted == Wanted::Look) continue;
      const double colourA = directionColourPlace(bead.tangentA.x, bead.tangentA.y);
      const double turned = (directionColourPlace(bead.tangentB.x, bead.tangentB.y) - colourA) / kDirectionColours;
      bead.colourA = static_cast<float>(colourA);
      bead.colourDelta = static_cast<float>((turned - std::floor(turned + 0.5)) * kDirectionColours);
    }
  }
  return beads;
}

/// Beads by the bands of rows they touch, in order of index, so that ties fall the same way everywhere.
struct Bands {
  int rows = 0;                    // sample rows per band
  std::vector<std::size_t> begin;  // per band, and one more
  std::vector<std::uint32_t> beads;
};

Bands sortIntoBands(const std::vector<Bead>& beads, int height, int rows) {
  const int bands = (height + rows - 1) / rows;
  Bands sorted{rows, std::vector<std::size_t>(static_cast<std::size_t>(bands) + 1, 0), {}};
  const auto forEachBand = [&](const Bead& bead, const auto& body) {
    const float reach = std::max(bead.radiusA, bead.radiusB) + 1;
    const float top = std::min(bead.a.y, bead.b.y) - reach, bottom = std::max(bead.a.y, bead.b.y) + reach;
    if (bottom < 0 || top >= static_cast<float>(height)) return;
    const int first = static_cast<int>(std::max(top, 0.0f)) / rows;
    const int last = static_cast<int>(std::min(bottom, static_cast<float>(height - 1))) / rows;
    for (int band = first; band <= last; ++band) body(static_cast<std::size_t>(band));
  };
  for (const Bead& bead : beads) forEachBand(bead, [&](std::size_t band) { ++sorted.begin[band + 1]; });
  for (std::size_t band = 0; band + 1 < sorted.begin.size(); ++band) sorted.begin[band + 1] += sorted.begin[band];
  sorted.beads.resize(sorted.begin.back());
  std::vector<std::size_t> next = sorted.begin;
  for (std::size_t k = 0; k < beads.size(); ++k) {
    forEachBand(beads[k], [&](std::size_t band) { sorted.beads[next[band]++] = static_cast<std::uint32_t>(k); });
  }
  return sorted;
}

/// What one sample sees: the bead whose axis is nearest in relation to its width.
struct Hit {
  float squaredOffset = 1;  // (distance / radius)²; 1: nothing
  std::uint32_t bead = 0;
};

/// Share of the way from a to b nearest to p.
float shareAlong(const Bead& bead, Vec2f p) {
  const Vec2f d = bead.b - bead.a;
  const float squared = dot(d, d);
  return squared > 0 ? std::clamp(dot(p - bead.a, d) / squared, 0.0f, 1.0f) : 0.0f;
}

/// Rasterises capsules with linearly varying width. \param hits  width * rows samples from sample row `firstRow` on.
void rasterise(const std::vector<Bead>& beads, const Bands& bands, std::size_t band, int firstRow, int rows, int width,
               std::vector<Hit>& hits) {
  hits.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(rows), {});
  for (std::size_t k = bands.begin[band]; k < bands.begin[band + 1]; ++k) {
    const std::uint32_t index = bands.beads[k];
    const Bead& bead = beads[index];
    const Vec2f d = bead.b - bead.a;
    const float squared = dot(d, d);
    const float perSquared = squared > 0 ? 1 / squared : 0;
    const float reach = std::max(bead.radiusA, bead.radiusB);
    const float top = std::min(bead.a.y, bead.b.y) - reach, bottom = std::max(bead.a.y, bead.b.y) + reach;
    const int rowBegin = std::max(firstRow, static_cast<int>(std::max(top - 0.5f, 0.0f)));
    const int rowEnd = std::min(firstRow + rows, static_cast<int>(std::min(bottom, 1e6f)) + 1);
    for (int row = rowBegin; row < rowEnd; ++row) {
      const float y = static_cast<float>(row) + 0.5f;
      // Only the part of the axis within reach of this row can colour it: keeps long slanted beads cheap.
      float t0 = 0, t1 = 1;
      if (std::abs(d.y) > reach) {
        const float u = (y - reach - bead.a.y) / d.y, v = (y + reach - bead.a.y) / d.y;
        t0 = std::clamp(std::min(u, v), 0.0f, 1.0f);
        t1 = std::clamp(std::max(u, v), 0.0f, 1.0f);
      }
      const float x0 = bead.a.x + t0 * d.x, x1 = bead.a.x + t1 * d.x;
      const float left = std::min(x0, x1) - reach, right = std::max(x0, x1) + reach;
      const int begin = static_cast<int>(std::clamp(left - 0.5f, 0.0f, static_cast<float>(width)));
      const int end = static_cast<int>(std::clamp(right + 1.5f, 0.0f, static_cast<float>(width)));
      Hit* line = &hits[static_cast<std::size_t>(row - firstRow) * static_cast<std::size_t>(width)];
      const F4 fromY = splat(y - bead.a.y);
      for (int column = begin; column < end; column += 4) {
        const F4 fromX = splat(static_cast<float>(column)) + F4{0.5f, 1.5f, 2.5f, 3.5f} - splat(bead.a.x);
        const F4 along = (fromX * splat(d.x) + fromY * splat(d.y)) * splat(perSquared);
        const F4 t = min4(max4(along, splat(0)), splat(1));
        const F4 offX = fromX - splat(d.x) * t;
        const F4 offY = fromY - splat(d.y) * t;
        const F4 radius = splat(bead.radiusA) + splat(bead.radiusB - bead.radiusA) * t;
        const F4 offset2 = offX * offX + offY * offY;
        const F4 radius2 = radius * radius;
        for (int lane = 0; lane < 4 && column + lane < end; ++lane) {
          Hit& hit = line[column + lane];
          if (offset2[lane] < hit.squaredOffset * radius2[lane]) hit = {offset2[lane] / radius2[lane], index};
        }
      }
    }
  }
}

/// How clearly single beads can be seen: 0 below 1.5 pixels of width, 1 above 3.5. In between their relief fades, which
/// keeps fine plates free of moiré.
float reliefOf(const Bead& bead) {
  const float pixels = (bead.radiusA + bead.radiusB) / kSamples;
  return std::clamp((pixels - 1.5f) / 2, 0.0f, 1.0f);
}

// ---- panel 1: directions ----

/// Brightness across a bead: full on its top, dark towards the furrow, with the same mean where beads are too fine to
/// see.
float furrow(float squaredOffset, float relief) {
  constexpr float kDepth = 0.66f, kMean = 0.88f;
  const float t = std::clamp((squaredOffset - 0.3f) / 0.7f, 0.0f, 1.0f);
  const float shade = 1 - kDepth * t * t * (3 - 2 * t);
  return kMean + (shade - kMean) * relief;
}

struct Colour {
  float red = 0, green = 0, blue = 0;

  friend Colour operator+(Colour a, Colour b) { return {a.red + b.red, a.green + b.green, a.blue + b.blue}; }
  friend Colour operator*(Colour a, Colour b) { return {a.red * b.red, a.green * b.green, a.blue * b.blue}; }
  friend Colour operator*(Colour a, float s) { return {a.red * s, a.green * s, a.blue * s}; }
};

Colour asColour(Rgb c) { return {static_cast<float>(c.red), static_cast<float>(c.green), static_cast<float>(c.blue)}; }

Colour directionShade(const Bead& bead, const Hit& hit, float t) {
  const Rgb colour = directionColourAt(bead.colourA + bead.colourDelta * t);
  return asColour(colour) * furrow(hit.squaredOffset, reliefOf(bead));
}

// ---- panel 2: the look ----

constexpr Colour kLampColour{1.00f, 0.97f, 0.92f};
constexpr float kExposure = 0.88f;  // of the brightest direction
constexpr float kMetal = 0.85f;     // how far highlights take the body's colour
constexpr int kProfileSamples = 8;

struct Look {
  Lobe lobe;
  Vec2f lampSide;        // the lamp's direction, its part along the plate
  float lampHeight = 1;  // and across it
  float perEye = 0;      // slope of the eye's direction per pixel from the page's middle; 0: straight above everywhere
  Colour highlight;      // of the brightest direction, linear
  Colour diffuse;        // as light as the highlight, in the body's own colour
};

float linearOf(std::uint8_t byte) { return lightOfCode(static_cast<float>(byte) * (1.0f / 255)); }

float luminance(Colour c) { return 0.2126f * c.red + 0.7152f * c.green + 0.0722f * c.blue; }

Look lookOf(const LookParams& params, int longerSide) {
  Look look;
  look.lobe = lobeOf(params.lamp, params.roughness);
  // l = 2 (h.n) h - n with the half vector h along (tilt, 1).
  const float squared = dot(look.lobe.tilt, look.lobe.tilt);
  look.lampSide = look.lobe.tilt * (2 / (1 + squared));
  look.lampHeight = 2 / (1 + squared) - 1;
  if (params.eyeDistance > 0)
    look.perEye = 1 / (static_cast<float>(params.eyeDistance) * static_cast<float>(longerSide));
  const Colour body{linearOf(params.colour[0]), linearOf(params.colour[1]), linearOf(params.colour[2])};
  const Colour metal = Colour{1, 1, 1} * (1 - kMetal) + body * kMetal;
  const Colour lit = metal * kLampColour;
  look.highlight = lit * (kExposure / std::max({lit.red, lit.green, lit.blue}));
  look.diffuse = body * (luminance(look.highlight) / std::max(luminance(body), 1e-4f));
  return look;
}

/// The lobe as an eye at `eye` (its direction's slopes) sees it.
Lobe lobeFrom(const Look& look, Vec2f eye) {
  Lobe lobe = look.lobe;
  if (!(look.perEye > 0)) return lobe;
  const float size = 1 / std::sqrt(dot(eye, eye) + 1);
  lobe.tilt = (look.lampSide + eye * size) * (1 / (look.lampHeight + size));
  return lobe;
}

/// Light that reaches the eye, linear. \param side  signed offset from the axis in radii, positive to its left.
Colour lookShade(const Bead& bead, float t, float side, const Lobe& lobe, const Look& look) {
  const Vec2f along = unit(bead.tangentA + (bead.tangentB - bead.tangentA) * t);
  const float relief = reliefOf(bead);
  // What of the round top is too fine to be seen counts as its mean.
  const int samples = relief < 1 ? kProfileSamples : 1;
  float highlight = 0;
  for (int k = 0; k < samples; ++k) {
    const float u = (2 * static_cast<float>(k) + 1) / static_cast<float>(samples) - 1;
    highlight += highlightAt(lobe, along, lobe.profile * (side * relief + u * (1 - relief)));
  }
  highlight *= (1 - lobe.diffuse) / (static_cast<float>(samples) * lobe.brightest);
  const float squared = side * side;
  const float open = 1 - relief * 0.5f * squared * squared;  // furrows see less of the room
  return (look.highlight * highlight + look.diffuse * lobe.diffuse) * open;
}

/// sRGB byte of linear light: as it is up to 0.8, with a soft shoulder above.
std::uint8_t toneMapped(float linear) {
  constexpr float kShoulder = 0.8f, kRoom = 1 - kShoulder;
  const float over = std::max(0.0f, linear - kShoulder);
  const float shown = std::min(linear, kShoulder) + kRoom * over / (kRoom + over);
  return static_cast<std::uint8_t>(codeOfLight(shown) * 255 + 0.5f);
}

/// Soft shadow of the plate, by a coarse mask and three box blurs (nearly Gaussian).
struct Shadow {
  int cell = 1;    // [pixels]
  int border = 0;  // cells around the page
  int width = 0;
  int height = 0;
  std::vector<float> dark;  // 0..1
};

void boxBlur(std::vector<float>& values, int width, int height, int radius) {
  std::vector<float> line;
  const auto blurLine = [&](std::size_t start, std::size_t step, int count) {
    line.resize(static_cast<std::size_t>(count));
    for (int k = 0; k < count; ++k)
      line[static_cast<std::size_t>(k)] = values[start + step * static_cast<std::size_t>(k)];
    float sum = 0;
    for (int k = -radius; k < count + radius; ++k) {
      if (k + radius < count && k + radius >= 0) sum += line[static_cast<std::size_t>(k + radius)];
      if (k - radius - 1 >= 0 && k - radius - 1 < count) sum -= line[static_cast<std::size_t>(k - radius - 1)];
      if (k >= 0 && k < count) {
        values[start + step * static_cast<std::size_t>(k)] = sum / static_cast<float>(2 * radius + 1);
      }
    }
  };
  for (int y = 0; y < height; ++y) blurLine(static_cast<std::size_t>(y) * static_cast<std::size_t>(width), 1, width);
  for (int x = 0; x < width; ++x) blurLine(static_cast<std::size_t>(x), static_cast<std::size_t>(width), height);
}

Shadow shadowOf(const Toolpath& toolpath, Vec2 page, const Layout& layout) {
  Shadow shadow;
  const int panelWidth = layout.look.width;
  shadow.cell = std::max(1, panelWidth / 400);
  const int blur = std::max(1, panelWidth / shadow.cell / 70);
  const int pageWidth = (layout.look.width + shadow.cell - 1) / shadow.cell;
  const int pageHeight = (layout.look.height + shadow.cell - 1) / shadow.cell;
  shadow.border = 4 * blur;
  shadow.width = pageWidth + 2 * shadow.border;
  shadow.height = pageHeight + 2 * shadow.border;
  shadow.dark.assign(static_cast<std::size_t>(shadow.width) * static_cast<std::size_t>(shadow.height), 0);

  const std::vector<Bead> beads = beadsOf(toolpath, page, layout.pixelsPerMm / shadow.cell, Wanted::Outlines);
  const Bands bands = sortIntoBands(beads, pageHeight, pageHeight);
  std::vector<Hit> hits;
  rasterise(beads, bands, 0, 0, pageHeight, pageWidth, hits);
  for (int y = 0; y < pageHeight; ++y) {
    for (int x = 0; x < pageWidth; ++x) {
      const Hit& hit =
          hits[static_cast<std::size_t>(y) * static_cast<std::size_t>(pageWidth) + static_cast<std::size_t>(x)];
      const std::size_t to = static_cast<std::size_t>(y + shadow.border) * static_cast<std::size_t>(shadow.width) +
                             static_cast<std::size_t>(x + shadow.border);
      shadow.dark[to] = hit.squaredOffset < 1 ? 1.0f : 0.0f;
    }
  }
  for (int pass = 0; pass < 3; ++pass) boxBlur(shadow.dark, shadow.width, shadow.height, blur);
  return shadow;
}

/// \param x  pixels from the page's left edge; y from its top. Bilinear.
float shadowAt(const Shadow& shadow, float x, float y) {
  const float u = x / static_cast<float>(shadow.cell) + static_cast<float>(shadow.border) - 0.5f;
  const float v = y / static_cast<float>(shadow.cell) + static_cast<float>(shadow.border) - 0.5f;
  if (!(u >= 0 && v >= 0 && u < static_cast<float>(shadow.width - 1) && v < static_cast<float>(shadow.height - 1)))
    return 0;
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const float fu = u - static_cast<float>(i), fv = v - static_cast<float>(j);
  const float* row =
      &shadow.dark[static_cast<std::size_t>(j) * static_cast<std::size_t>(shadow.width) + static_cast<std::size_t>(i)];
  const float* below = row + shadow.width;
  return (row[0] * (1 - fu) + row[1] * fu) * (1 - fv) + (below[0] * (1 - fu) + below[1] * fu) * fv;
}

// ---- drawing into the picture ----

void put(RgbImage& image, int x, int y, Rgb colour) {
  std::uint8_t* p =
      &image.rgb[(static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)) *
                 3];
  p[0] = colour.red;
  p[1] = colour.green;
  p[2] = colour.blue;
}

Rgb rounded(Colour c) {
  const auto byte = [](float v) { return static_cast<std::uint8_t>(std::clamp(v, 0.0f, 255.0f) + 0.5f); };
  return {byte(c.red), byte(c.green), byte(c.blue)};
}

/// Paints every pixel within `radius` of (cx, cy) by averaging 4 x 4 samples of colourAt(dx, dy), y up.
template <class ColourAt>
void paintAround(RgbImage& image, double cx, double cy, double radius, const ColourAt& colourAt) {
  constexpr int kFine = 4;
  const int x0 = std::max(0, static_cast<int>(cx - radius)),
            x1 = std::min(image.width, static_cast<int>(cx + radius) + 2);
  const int y0 = std::max(0, static_cast<int>(cy - radius)),
            y1 = std::min(image.height, static_cast<int>(cy + radius) + 2);
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      Colour sum;
      for (int k = 0; k < kFine * kFine; ++k) {
        const double dx = x + (k % kFine + 0.5) / kFine - cx, dy = cy - (y + (k / kFine + 0.5) / kFine);
        sum = sum + asColour(colourAt(dx, dy));
      }
      put(image, x, y, rounded(sum * (1.0f / (kFine * kFine))));
    }
  }
}

/// Half wheel: a direction has the colour at its angle. Ticks at 0, 45, 90, 135 and 180 degrees.
void drawLegend(RgbImage& image, const Layout& layout) {
  const double radius = layout.legendRadius;
  const double outer = 0.86 * radius, inner = 0.46 * radius, tick = 0.91 * radius, half = std::max(0.5, radius * 0.008);
  paintAround(image, layout.legendX, layout.legendY, radius + 1, [&](double dx, double dy) {
    const double distance = std::sqrt(dx * dx + dy * dy);
    if (dy >= 0 && distance >= inner && distance <= outer) return directionColourAt(directionColourPlace(dx, dy));
    if (distance < tick || distance > radius || dy < -half) return kBackground;
    const double diagonal = std::abs(std::abs(dx) - dy) * std::sqrt(0.5);
    return std::abs(dy) <= half || std::abs(dx) <= half || diagonal <= half ? kInk : kBackground;
  });
}

/// A ring with a dot: where the light stands, seen from above.
void drawLamp(RgbImage& image, const Layout& layout, const PreviewParams& params) {
  const double radius = layout.lampRadius, half = std::max(0.5, radius * 0.02), dot = radius * 0.16;
  const double azimuth = params.look.lamp.azimuth * std::numbers::pi / 180;
  const double reach = radius * std::cos(params.look.lamp.elevation * std::numbers::pi / 180);
  const double lampX = reach * std::cos(azimuth), lampY = reach * std::sin(azimuth);
  paintAround(image, layout.lampX, layout.lampY, radius + dot + 2, [&](double dx, double dy) {
    const double toLamp = (dx - lampX) * (dx - lampX) + (dy - lampY) * (dy - lampY);
    if (toLamp <= dot * dot) return Rgb{255, 236, 200};
    return std::abs(std::sqrt(dx * dx + dy * dy) - radius) <= half ? kInk : kBackground;
  });
}

/// Everything the bands read.
struct Scene {
  const Layout& layout;
  const std::vector<Bead>& beads;
  const Bands& bands;
  const Shadow& shadow;
  Look look;
};

/// Background of the look panel: darker where the plate stands between it and the light.
Colour shadowed(const Scene& scene, int x, int y) {
  const float away = static_cast<float>(scene.layout.look.width) / 90;  // the shadow falls away from the light
  const float sx = static_cast<float>(x) + 0.5f + scene.look.lampSide.x * away,
              sy = static_cast<float>(y) + 0.5f - scene.look.lampSide.y * away;
  return asColour(kBackground) * (1 - 0.72f * shadowAt(scene.shadow, sx, sy));
}

/// Both panels of the page, rows of one band.
void drawBand(const Scene& scene, std::size_t band, RgbImage& image) {
  const Layout& layout = scene.layout;
  const int pageWidth = layout.look.width, pageHeight = layout.look.height;
  const int top = static_cast<int>(band) * kBandRows;
  const int rows = std::min(kBandRows, pageHeight - top);
  const int width = pageWidth * kSamples;
  const bool directions = layout.directions.width > 0;
  std::vector<Hit> hits;
  rasterise(scene.beads, scene.bands, band, top * kSamples, rows * kSamples, width, hits);

  // A near eye makes highlights move across the plate as they do in the hand.
  const float perEye = scene.look.perEye;
  constexpr float kShare = 1.0f / (kSamples * kSamples);
  for (int y = top; y < top + rows; ++y) {
    for (int x = 0; x < pageWidth; ++x) {
      const Vec2f eye{(static_cast<float>(pageWidth) / 2 - static_cast<float>(x)) * perEye,
                      (static_cast<float>(y) - static_cast<float>(pageHeight) / 2) * perEye};
      const Lobe lobe = lobeFrom(scene.look, eye);
      Colour direction, look;
      int covered = 0;
      for (int k = 0; k < kSamples * kSamples; ++k) {
        const int column = x * kSamples + k % kSamples, row = y * kSamples + k / kSamples;
        const Hit& hit = hits[static_cast<std::size_t>(row - top * kSamples) * static_cast<std::size_t>(width) +
                              static_cast<std::size_t>(column)];
        if (!(hit.squaredOffset < 1)) continue;
        ++covered;
        const Bead& bead = scene.beads[hit.bead];
        const Vec2f p{static_cast<float>(column) + 0.5f, static_cast<float>(row) + 0.5f};
        const float t = shareAlong(bead, p);
        const float left = cross(bead.b - bead.a, p - bead.a) < 0 ? 1.0f : -1.0f;  // samples run y down
        if (directions) direction = direction + directionShade(bead, hit, t);
        look = look + lookShade(bead, t, left * std::sqrt(hit.squaredOffset), lobe, scene.look);
      }
      const float empty = static_cast<float>(kSamples * kSamples - covered) * kShare;
      if (directions) {
        put(image, layout.directions.x + x, layout.directions.y + y,
            rounded(direction * kShare + asColour(kBackground) * empty));
      }
      // Mixed after tone mapping: edges stay smooth against the dark page.
      Colour shown = shadowed(scene, x, y) * empty;
      if (covered > 0) {
        const Colour mean = look * (1 / static_cast<float>(covered));
        const Rgb plate{toneMapped(mean.red), toneMapped(mean.green), toneMapped(mean.blue)};
        shown = shown + asColour(plate) * (1 - empty);
      }
      put(image, layout.look.x + x, layout.look.y + y, rounded(shown));
    }
  }
}

/// Background, with the plate's shadow around the page of the look panel.
void drawBackground(const Scene& scene, RgbImage& image) {
  const Layout& layout = scene.layout;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) put(image, x, y, kBackground);
  }
  const int reach = scene.shadow.border * scene.shadow.cell + layout.look.width / 90;
  const int x0 = std::max(0, layout.look.x - reach),
            x1 = std::min(image.width, layout.look.x + layout.look.width + reach);
  const int y0 = std::max(0, layout.look.y - reach),
            y1 = std::min(image.height, layout.look.y + layout.look.height + reach);
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      put(image, x, y, rounded(shadowed(scene, x - layout.look.x, y - layout.look.y)));
    }
  }
}

std::string lookDefect(const LookParams& look) {
  if (std::string defect = invalidLamp(look.lamp); !defect.empty()) return defect;
  if (std::string defect = invalidRoughness(look.roughness); !defect.empty()) return defect;
  const bool near = look.eyeDistance >= 0.1 && look.eyeDistance <= 1000;
  return near || look.eyeDistance == 0 ? "" : "the eye's distance is outside its range of 0.1 to 1000 page sides, or 0";
}

std::string defectOf(const Toolpath& toolpath, Vec2 page, const PreviewParams& params) {
  const auto within = [](double v, double low, double high) { return v >= low && v <= high; };
  if (!within(params.width, 16, 16384)) {
    return "preview width is " + std::to_string(params.width) + " pixels; it must be 16 to 16384";
  }
  if (std::string defect = lookDefect(params.look); !defect.empty()) return defect;
  return toolpathDefect(toolpath, page);
}

Result<RgbImage> render(const Toolpath& toolpath, Vec2 page, const Layout& layout, const PreviewParams& params,
                        const RunContext& run) {
  RgbImage image{layout.width, layout.height, {}};
  image.rgb.resize(static_cast<std::size_t>(layout.width) * static_cast<std::size_t>(layout.height) * 3);

  const bool directions = layout.directions.width > 0;
  const std::vector<Bead> beads =
      beadsOf(toolpath, page, layout.pixelsPerMm * kSamples, directions ? Wanted::Directions : Wanted::Look);
  const Bands bands = sortIntoBands(beads, layout.look.height * kSamples, kBandRows * kSamples);
  const Shadow shadow = shadowOf(toolpath, page, layout);
  const Scene scene{layout, beads, bands, shadow, lookOf(params.look, std::max(layout.look.width, layout.look.height))};

  drawBackground(scene, image);
  if (directions) {
    drawLegend(image, layout);
    drawLamp(image, layout, params);
  }
  parallelFor(run, static_cast<int>(bands.begin.size()) - 1, 1, [&](int begin, int end) {
    for (int band = begin; band < end; ++band) drawBand(scene, static_cast<std::size_t>(band), image);
  });
  if (run.cancelled()) return Error{ErrorCode::Cancelled, "preview was cancelled"};
  return image;
}

}  // namespace

Result<RgbImage> renderPreview(const Toolpath& toolpath, Vec2 page, const PreviewParams& params,
                               const RunContext& run) {
  if (const std::string defect = defectOf(toolpath, page, params); !defect.empty()) {
    return Error{ErrorCode::InvalidArgument, defect};
  }
  const Layout layout = layOut(page, params.width);
  if (layout.width == 0) {
    return Error{ErrorCode::TooLarge, "preview of panels " + std::to_string(params.width) +
                                          " pixels wide would be beyond " + std::to_string(kMaxImageSide) +
                                          " pixels per side or 100 million in all; choose fewer"};
  }
  try {
    return render(toolpath, page, layout, params, run);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::TooLarge, "preview needs more memory than there is; choose a smaller width"};
  }
}

Result<RgbImage> renderLook(const Toolpath& toolpath, Vec2 page, int width, int height, const LookParams& look,
                            const RunContext& run) {
  constexpr int kMaxSide = 1024;
  if (width < 16 || width > kMaxSide || height < 16 || height > kMaxSide) {
    return Error{ErrorCode::InvalidArgument, "the look's size is " + std::to_string(width) + " x " +
                                                 std::to_string(height) + " pixels; each must be 16 to 1024"};
  }
  const PreviewParams params{kMaxSide, look};
  if (const std::string defect = defectOf(toolpath, page, params); !defect.empty()) {
    return Error{ErrorCode::InvalidArgument, defect};
  }
  try {
    return render(toolpath, page, layOutLook(page, width, height), params, run);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::TooLarge, "the look needs more memory than there is; choose a smaller size"};
  }
}

}  // namespace sillon
