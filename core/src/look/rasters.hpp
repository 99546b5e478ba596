// Operations on rasters, and grey pictures as light: sRGB codes, levels, areas.
#pragma once

#include <vector>

#include "sillon/look/inversion.hpp"

namespace sillon {

/// Resamples like `resampled`, with means of the values themselves instead of their light.
Tones means(const Tones& values, int width, int height);

/// Blurs nearly like a Gaussian of `sigma` cells: two exponentials there and back along each axis.
/// \param sigma  >= 0.1
std::vector<float> blurred(std::vector<float> values, int width, int height, float sigma);

/// Converts an sRGB code to light (IEC 61966-2-1), within 1e-6.
/// \param code  0..1; other values are clamped.
float lightOfCode(float code);

/// Converts light to an sRGB code, the inverse of lightOfCode, within 1e-5.
float codeOfLight(float light);

/// Computes the luminance (Rec. 709) of the picture's sRGB colours, again as a code. Transparent
/// places show white paper.
Tones tonesOf(const Image& image);

/// Computes the luma of a picture from its codes, as they are mixed for JPEG. JPEG keeps luma sharp
/// and blurs the differences between colours.
Tones lumaOf(const Image& image);

/// Resamples tones to a new raster: by the means of light over its areas for pictures that shrink,
/// linearly between texels for those that grow.
Tones resampled(const Tones& tones, int width, int height);

/// Stretches tones so that the 1st and 99th percentile become 0 and 1. Values beyond them are
/// clamped; a picture of one tone, within half a step of 8 bits, becomes 0.5.
/// \param inside  tells of each value whether it counts for the percentiles; empty: all do.
Tones levelled(const Tones& tones, const std::vector<char>& inside = {});

}  // namespace sillon
