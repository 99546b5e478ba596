// Errors in pictures and maps whose sizes and values do not fit each other.
#pragma once

#include <cstddef>
#include <string>

#include "sillon/base/types.hpp"

namespace sillon {

/// Describes the defect of a picture; empty if it has pixels, 1 to 4 channels and a sample for each.
std::string imageDefect(const Image& image);

/// Describes the defect of a map; empty if it has at least one pixel and one value for each.
/// \param name  name of the map, for the sentence.
std::string mapDefect(const char* name, int width, int height, std::size_t values);

}  // namespace sillon
