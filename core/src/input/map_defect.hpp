// Errors in pictures and maps whose sizes and values do not fit each other.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"

namespace sillon {

/// Refuses a picture, unless it has pixels, 1 to 4 channels and a sample for each. \param name  its name, or what it is
std::optional<Error> imageDefect(const Image& image, std::string_view name);

/// Refuses a map, unless it has at least one pixel and one value for each.
/// \param name  "directions", "modes" or "tones"
std::optional<Error> mapDefect(const char* name, int width, int height, std::size_t values);

}  // namespace sillon
