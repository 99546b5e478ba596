// Operations on rasters, whatever their values stand for.
#pragma once

#include <vector>

#include "sillon/look/inversion.hpp"

namespace sillon {

/// Resamples like `resampled`, with means of the values themselves instead of their light.
Tones means(const Tones& values, int width, int height);

/// Blurs nearly like a Gaussian of `sigma` cells: two exponentials there and back along each axis.
/// \param sigma  >= 0.1
std::vector<float> blurred(std::vector<float> values, int width, int height, float sigma);

}  // namespace sillon
