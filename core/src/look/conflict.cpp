#include "sillon/look/inversion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "input/map_defect.hpp"
#include "look/rasters.hpp"

namespace sillon {
namespace {

constexpr int kSteps = 1024;  // directions in the table; angles between them are interpolated
// Greys in which the image shows black and white [codes].
constexpr float kPalest = 0.78f;
constexpr float kBrightest = 0.97f;
constexpr std::array<float, 3> kDark{0.88f, 0.36f, 0.0f};  // orange and blue, which all eyes tell apart
constexpr std::array<float, 3> kBright{0.0f, 0.34f, 0.8f};

// Brings tones to a raster of this size; `made` holds the result where it is not the same already.
const Tones& onRaster(const Tones& tones, int width, int height, Tones& made) {
  if (tones.width == width && tones.height == height) return tones;
  made = resampled(tones, width, height);
  return made;
}

}  // namespace

// Subtracts, for each picture and cell, the tone that the direction shows under the picture's lamp from the tone asked
// for. The darkest direction counts as 0, and white at `level` as 1.
PictureConflict conflictOf(const DirectionMap& directions, std::span<const ShownPicture> shown,
                           const Roughness& roughness, double level) {
  PictureConflict conflict{directions.width, directions.height, {}};
  // Maps may come from outside: a map whose values do not match its size gives no conflict.
  if (mapDefect("directions", directions.width, directions.height, directions.angle.size())) return {};
  for (const ShownPicture& picture : shown) {
    const Tones& tones = picture.tones;
    if (mapDefect("tones", tones.width, tones.height, tones.value.size())) return {};
  }
  for (const ShownPicture& picture : shown) {
    // Codes by direction under this lamp, and the range that counts as 0 to 1.
    std::vector<float> code = lightTable(lobeOf(picture.lamp, roughness), kSteps);
    for (float& v : code) v = codeOfLight(v);
    const float low = *std::min_element(code.begin(), code.end());
    const float range = std::max(1e-3f, codeOfLight(static_cast<float>(level)) - low);
    Tones made;
    const Tones& asked = onRaster(picture.tones, directions.width, directions.height, made);
    std::vector<float> missing;
    missing.reserve(directions.angle.size());
    for (std::size_t k = 0; k < directions.angle.size(); ++k) {
      // Angles of maps begin at -90 degrees; the table begins at 0.
      const float step = (static_cast<float>(directions.angle[k]) / 65535.0f + 0.5f) * kSteps;
      const std::size_t before = toSize(step);
      const float share = step - static_cast<float>(before);
      const float seen = code[before % kSteps] * (1 - share) + code[(before + 1) % kSteps] * share;
      missing.push_back(std::clamp(asked.value[k] - (seen - low) / range, -1.0f, 1.0f));
    }
    conflict.missing.push_back(std::move(missing));
  }
  return conflict;
}

// Draws the picture in pale greys and the missing tone over it in orange (too dark) or blue (too bright).
RgbImage conflictImage(const PictureConflict& conflict, std::size_t picture, const Tones& tones, int side) {
  const int scale = std::max(1, side / std::max({1, conflict.width, conflict.height}));
  RgbImage image{conflict.width * scale, conflict.height * scale, {}};
  image.rgb.reserve(3 * cellCount(image.width, image.height));
  Tones made;
  const Tones& greys = onRaster(tones, conflict.width, conflict.height, made);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::size_t cell = indexOf(x / scale, y / scale, conflict.width);
      // Ink over the grey, the more of it the more is missing.
      const float grey = kPalest + (kBrightest - kPalest) * greys.value[cell];
      const float off = conflict.missing[picture][cell];
      const float full = std::abs(off);
      for (const float ink : off > 0 ? kDark : kBright) {
        image.rgb.push_back(static_cast<std::uint8_t>((grey + full * (ink - grey)) * 255 + 0.5f));
      }
    }
  }
  return image;
}

}  // namespace sillon
