// Grey pictures as light: sRGB codes, levels, areas.
#pragma once

#include <cstdint>
#include <vector>

#include "sillon/base/types.hpp"

namespace sillon {

/// A grey picture, row 0 on top. Values are sRGB codes 0..1 unless a function says light.
struct Tones {
  int width = 0;
  int height = 0;
  std::vector<float> value;

  [[nodiscard]] float at(int x, int y) const {
    return value[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
  friend bool operator==(const Tones&, const Tones&) = default;
};

/// IEC 61966-2-1, within 1e-6. \param code  0..1; others are clamped.
float lightOfCode(float code);
/// Its inverse, within 1e-5.
float codeOfLight(float light);

/// Luminance (Rec. 709) of the picture's sRGB colours, again as a code; what is transparent shows white paper.
Tones tonesOf(const Image& image);

/// The same from codes as they are mixed for JPEG, which keeps this one sharp and blurs what colours differ by.
Tones lumaOf(const Image& image);

/// Means of light over the areas of a new raster: for pictures that shrink; linear between texels for those that grow.
Tones resampled(const Tones& tones, int width, int height);

/// Stretched so that the 1st and 99th percentile become 0 and 1; a picture of one tone, within half a step of 8 bits,
/// becomes 0.5. \param inside  of each value whether it counts; empty: all do. Others are clamped.
Tones levelled(const Tones& tones, const std::vector<char>& inside = {});

}  // namespace sillon
