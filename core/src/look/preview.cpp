// Draws previews. Beads are rasterised once, on 2 x 2 samples per pixel, in bands of rows; both panels are shaded from
// the same samples, and samples without a bead show the background with the plate's shadow.
#include "sillon/look/preview.hpp"
#include "base/refused.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <new>
#include <string>

#include "base/parallel_for.hpp"
#include "look/inversion_parts.hpp"
#include "look/preview_parts.hpp"
#include "look/rasters.hpp"
#include "sillon/input/image_io.hpp"
#include "sillon/look/inversion.hpp"
#include "toolpath/path.hpp"

namespace sillon {
namespace {

constexpr int kSamples = 2;    // samples per pixel and axis
constexpr int kBandRows = 16;  // pixel rows that one task rasterises and shades

/// Tells how clearly single beads can be seen: 0 below 1.5 pixels of width, 1 above 3.5. In between their relief fades,
/// which keeps fine plates free of moiré.
float reliefOf(const ShadedBead& bead) {
  const float pixels = (bead.radiusA + bead.radiusB) / kSamples;
  return std::clamp((pixels - 1.5f) / 2, 0.0f, 1.0f);
}

// ---- panel 1: directions ----

/// Brightness across a bead: full on its top, dark towards the furrow. Beads too fine to see get the mean.
float furrow(float squaredOffset, float relief) {
  constexpr float kDepth = 0.66f;
  constexpr float kMean = 0.88f;
  const float t = std::clamp((squaredOffset - 0.3f) / 0.7f, 0.0f, 1.0f);
  const float shade = 1 - kDepth * t * t * (3 - 2 * t);
  return kMean + (shade - kMean) * relief;
}

/// Colour of a place on a bead in the first panel, from the direction there.
Colour directionShade(const ShadedBead& bead, float squaredOffset, float t) {
  const Rgb colour = directionColourAt(bead.colourA + bead.colourDelta * t);
  return asColour(colour) * furrow(squaredOffset, reliefOf(bead));
}

// ---- panel 2: the look ----

constexpr Colour kLampColour{1.00f, 0.97f, 0.92f};
constexpr float kExposure = 0.88f;  // brightness of the brightest direction
constexpr float kMetal = 0.85f;     // share of the body's colour in highlights
constexpr int kProfileSamples = 8;

/// All that the shading of the second panel needs besides the beads.
struct Look {
  Lobe lobe;
  Vec2f lampSide;        // part of the lamp's direction along the plate
  float lampHeight = 1;  // part of it upwards
  float perEye = 0;      // slope of the eye's direction per pixel from the page's middle; 0: straight above everywhere
  Colour highlight;      // colour of the brightest direction, linear
  Colour diffuse;        // the body's own colour, as light as the highlight
};

// Linear light of an sRGB byte.
float linearOf(std::uint8_t byte) { return lightOfCode(static_cast<float>(byte) * (1.0f / 255)); }

// Luminance by the weights of sRGB's primaries (Rec. 709).
float luminance(Colour c) { return 0.2126f * c.red + 0.7152f * c.green + 0.0722f * c.blue; }

/// Prepares colours and directions that are the same for all pixels.
Look lookOf(const LookParams& params, int longerSide) {
  Look look;
  look.lobe = lobeOf(params.lamp, params.roughness);
  // The lamp's direction from the half vector h along (tilt, 1): l = 2 (h.n) h - n.
  const float squared = dot(look.lobe.tilt, look.lobe.tilt);
  look.lampSide = look.lobe.tilt * (2 / (1 + squared));
  look.lampHeight = 2 / (1 + squared) - 1;
  if (params.eyeDistance > 0)
    look.perEye = 1 / (static_cast<float>(params.eyeDistance) * static_cast<float>(longerSide));
  // Highlights take most of the body's colour, and all of the lamp's.
  const Colour body{linearOf(params.colour[0]), linearOf(params.colour[1]), linearOf(params.colour[2])};
  const Colour metal = Colour{1, 1, 1} * (1 - kMetal) + body * kMetal;
  const Colour lit = metal * kLampColour;
  look.highlight = lit * (kExposure / std::max({lit.red, lit.green, lit.blue}));
  look.diffuse = body * (luminance(look.highlight) / std::max(luminance(body), 1e-4f));
  return look;
}

/// The lobe as an eye at `eye` (slopes of its direction) sees it.
Lobe lobeFrom(const Look& look, Vec2f eye) {
  Lobe lobe = look.lobe;
  if (!(look.perEye > 0)) return lobe;
  const float size = 1 / std::sqrt(dot(eye, eye) + 1);
  lobe.tilt = (look.lampSide + eye * size) * (1 / (look.lampHeight + size));
  return lobe;
}

/// Sums highlightAt over kProfileSamples samples of the part of a bead's round top that is too fine to be seen, four at
/// a time.
float fineHighlights(const Lobe& lobe, Vec2f along, float side, float relief) {
  static_assert(kProfileSamples == 8);
  const float ahead = dot(lobe.tilt, along);
  const F4 aheadTerm = splat(ahead * ahead / (2 * lobe.alongVariance));
  const auto four = [&](F4 u) {
    const F4 slope = splat(lobe.profile) * (splat(side * relief) + u * splat(1 - relief));
    const F4 across = splat(cross(along, lobe.tilt)) - slope;
    return decay(aheadTerm + across * across / splat(2 * lobe.acrossVariance));
  };
  const F4 low = four(F4{-0.875f, -0.625f, -0.375f, -0.125f});
  const F4 high = four(F4{0.125f, 0.375f, 0.625f, 0.875f});
  float sum = 0;
  for (const F4& values : {low, high}) {
    for (int k = 0; k < 4; ++k) sum += values[k];
  }
  return sum;
}

/// Light that reaches the eye from a place on a bead, linear. \param side  signed offset from the axis in radii,
/// positive to its left.
Colour lookShade(const ShadedBead& bead, float t, float side, const Lobe& lobe, const Look& look) {
  const Vec2f along = unit(bead.tangentA + (bead.tangentB - bead.tangentA) * t);
  const float relief = reliefOf(bead);
  // The part of the round top that is too fine to be seen counts with its mean.
  const int samples = relief < 1 ? kProfileSamples : 1;
  float highlight = samples > 1 ? fineHighlights(lobe, along, side, relief)
                                : highlightAt(lobe, along, lobe.profile * (side * relief));
  highlight *= (1 - lobe.diffuse) / (static_cast<float>(samples) * lobe.brightest);
  const float squared = side * side;
  const float open = 1 - relief * 0.5f * squared * squared;  // furrows see less of the room
  return (look.highlight * highlight + look.diffuse * lobe.diffuse) * open;
}

/// sRGB byte of linear light: unchanged up to 0.8, with a soft shoulder above, so that highlights do not clip.
std::uint8_t toneMapped(float linear) {
  constexpr float kShoulder = 0.8f;
  constexpr float kRoom = 1 - kShoulder;
  const float over = std::max(0.0f, linear - kShoulder);
  const float shown = std::min(linear, kShoulder) + kRoom * over / (kRoom + over);
  return static_cast<std::uint8_t>(codeOfLight(shown) * 255 + 0.5f);
}

// ---- both, row by row ----

/// Everything that the bands read.
struct BandDrawing {
  const Layout& layout;
  const std::vector<ShadedBead>& beads;
  const Bands& bands;
  Look look;
};

/// Draws one band of the plate in both panels. \param covered  receives, per pixel of the page, the number of samples
/// that show the plate.
void drawBand(const BandDrawing& drawing, std::size_t band, RgbImage& image, std::vector<std::uint8_t>& covered) {
  const Layout& layout = drawing.layout;
  const int pageWidth = layout.look.width;
  const int pageHeight = layout.look.height;
  const int top = static_cast<int>(band) * kBandRows;
  const int rows = std::min(kBandRows, pageHeight - top);
  const int width = pageWidth * kSamples;
  const bool directions = layout.directions.width > 0;
  // 1. Rasterise the beads that touch the band: each sample keeps the nearest.
  Hits hits;
  hits.clear(width, rows * kSamples);
  for (std::size_t k = drawing.bands.begin[band]; k < drawing.bands.begin[band + 1]; ++k) {
    const std::uint32_t index = drawing.bands.beads[k];
    rasterise(drawing.beads[index], index, top * kSamples, rows * kSamples, width, hits);
  }

  // 2. Shade each pixel as the mean of its samples. A near eye makes highlights move across the plate as they do in the
  // hand.
  const float perEye = drawing.look.perEye;
  constexpr float kShare = 1.0f / (kSamples * kSamples);
  for (int y = top; y < top + rows; ++y) {
    for (int x = 0; x < pageWidth; ++x) {
      const Vec2f eye{(static_cast<float>(pageWidth) / 2 - static_cast<float>(x)) * perEye,
                      (static_cast<float>(y) - static_cast<float>(pageHeight) / 2) * perEye};
      const Lobe lobe = lobeFrom(drawing.look, eye);
      Colour direction, look;
      int count = 0;
      for (int k = 0; k < kSamples * kSamples; ++k) {
        const int column = x * kSamples + k % kSamples;
        const int row = y * kSamples + k / kSamples;
        const std::size_t at = indexOf(column, row - top * kSamples, width);
        const float squaredOffset = hits.squaredOffset[at];
        if (!(squaredOffset < 1)) continue;
        ++count;
        const ShadedBead& bead = drawing.beads[hits.bead[at]];
        const Vec2f p{static_cast<float>(column) + 0.5f, static_cast<float>(row) + 0.5f};
        const float t = shareAlong(bead, p);
        const float left = cross(bead.b - bead.a, p - bead.a) < 0 ? 1.0f : -1.0f;  // samples run y down
        if (directions) direction = direction + directionShade(bead, squaredOffset, t);
        look = look + lookShade(bead, t, left * std::sqrt(squaredOffset), lobe, drawing.look);
      }
      if (directions) {
        const float empty = static_cast<float>(kSamples * kSamples - count) * kShare;
        // The first panel has no shadow: samples without a bead are background at once.
        put(image, layout.directions.x + x, layout.directions.y + y,
            rounded(direction * kShare + asColour(kBackground) * empty));
      }
      covered[indexOf(x, y, pageWidth)] = static_cast<std::uint8_t>(count);
      // The second panel stores the mean of the covered samples; drawBackground mixes in the rest.
      if (count == 0) continue;
      const Colour mean = look * (1 / static_cast<float>(count));
      put(image, layout.look.x + x, layout.look.y + y,
          {toneMapped(mean.red), toneMapped(mean.green), toneMapped(mean.blue)});
    }
  }
}

/// Draws the background around the pages and where the look leaves samples free: darker where the plate stands between
/// it and the light. It is mixed in after tone mapping, so that edges stay smooth against the dark page.
void drawBackground(const BandDrawing& drawing, const Shadow& shadow, const std::vector<std::uint8_t>& covered, int y,
                    RgbImage& image) {
  const PixelBox& page = drawing.layout.look;
  const float away = static_cast<float>(page.width) / 90;  // the shadow falls away from the light
  const Vec2f from{0.5f + drawing.look.lampSide.x * away, 0.5f - drawing.look.lampSide.y * away};
  for (int x = 0; x < image.width; ++x) {
    if (holds(drawing.layout.directions, x, y)) continue;
    const int column = x - page.x;
    const int row = y - page.y;
    int free = kSamples * kSamples;
    if (holds(page, x, y)) {
      free -= covered[indexOf(column, row, page.width)];
    }
    if (free == 0) continue;
    const float dark = shadowAt(shadow, static_cast<float>(column) + from.x, static_cast<float>(row) + from.y);
    const float share = static_cast<float>(free) / (kSamples * kSamples);
    const Colour shown = asColour(kBackground) * ((1 - 0.72f * dark) * share);
    put(image, x, y, rounded(shown + asColour(at(image, x, y)) * (1 - share)));
  }
}

/// Tells why a look cannot be drawn; nothing if it can.
std::optional<Error> defectOf(const Toolpath& toolpath, Vec2 page, const LookParams& look) {
  if (auto defect = invalidLamp(look.lamp)) return defect;
  if (auto defect = invalidRoughness(look.roughness)) return defect;
  const bool near = look.eyeDistance >= 0.1 && look.eyeDistance <= 1000;
  if (!near && look.eyeDistance != 0) return outOfRange("eyeDistance", look.eyeDistance, 0.1, 1000, "");
  return toolpathDefect(toolpath, page);
}

/// Draws a checked toolpath: the plate band by band, then background and shadow, then the signs beside it.
Result<RgbImage> render(const Toolpath& toolpath, Vec2 page, const Layout& layout, const PreviewParams& params,
                        const RunContext& run) {
  RgbImage image{layout.width, layout.height, {}};
  image.rgb.resize(cellCount(layout.width, layout.height) * 3);

  const bool directions = layout.directions.width > 0;
  const std::vector<ShadedBead> beads = beadsOf(toolpath, page, layout.pixelsPerMm * kSamples, directions);
  const Bands bands = sortIntoBands(beads, layout.look.height * kSamples, kBandRows * kSamples);
  const BandDrawing drawing{layout, beads, bands, lookOf(params.look, std::max(layout.look.width, layout.look.height))};
  std::vector<std::uint8_t> covered(cellCount(layout.look.width, layout.look.height));
  parallelForEach(run, static_cast<int>(bands.begin.size()) - 1, 1,
                  [&](int band) { drawBand(drawing, toSize(band), image, covered); });
  // The shadow needs the whole plate, so that the background comes after all bands.
  const Shadow shadow = shadowOf(covered, kSamples * kSamples, layout.look);
  parallelForEach(run, image.height, kBandRows, [&](int y) { drawBackground(drawing, shadow, covered, y, image); });
  if (directions) {
    drawLegend(image, layout);
    drawLamp(image, layout, params.look.lamp);
  }
  if (run.cancelled()) return cancelledRun();
  return image;
}

}  // namespace

Result<RgbImage> renderPreview(const Toolpath& toolpath, Vec2 page, const PreviewParams& params,
                               const RunContext& run) {
  if (params.width < 16 || params.width > 16384) return outOfRange("width", params.width, 16, 16384, "");
  if (auto defect = defectOf(toolpath, page, params.look)) return *std::move(defect);
  const Layout layout = layOut(page, params.width);
  if (layout.width == 0) {
    return refused(ErrorCode::TooLarge, "PreviewTooLarge", {{"width", params.width}, {"most", kMaxImageSide}});
  }
  try {
    return render(toolpath, page, layout, params, run);
  } catch (const std::bad_alloc&) {
    return needsMoreMemory();
  }
}

Result<RgbImage> renderLook(const Toolpath& toolpath, Vec2 page, int width, int height, const LookParams& look,
                            const RunContext& run) {
  constexpr int kMaxSide = 1024;
  for (const int side : {width, height}) {
    if (side < 16 || side > kMaxSide) return outOfRange("width, height", side, 16, kMaxSide, "");
  }
  if (auto defect = defectOf(toolpath, page, look)) return *std::move(defect);
  try {
    return render(toolpath, page, layOutLook(page, width, height), {kMaxSide, look}, run);
  } catch (const std::bad_alloc&) {
    return needsMoreMemory();
  }
}

}  // namespace sillon
