// What is wrong with pictures and maps whose sizes and values do not fit each other.
#pragma once

#include <cstddef>
#include <string>

#include "sillon/base/types.hpp"

namespace sillon {

/// Empty where there are pixels, 1 to 4 channels and a sample for each.
std::string imageDefect(const Image& image);

/// Empty where there is a pixel at least and one value for each. \param name  of the map, for the sentence.
std::string mapDefect(const char* name, int width, int height, std::size_t values);

}  // namespace sillon
