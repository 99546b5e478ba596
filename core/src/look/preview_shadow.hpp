// The soft shadow that a plate casts in its preview.
#pragma once

#include <cstdint>
#include <vector>

#include "look/preview_layout.hpp"

namespace sillon {

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

}  // namespace sillon
