// Shapes and shown tones on rasters of the page.
#pragma once

#include <vector>

#include "sillon/geometry/shape.hpp"
#include "sillon/input/direction_map.hpp"
#include "sillon/look/inversion.hpp"
#include "sillon/look/tones.hpp"
#include "sillon/pictures/pictures.hpp"

namespace sillon {

/// \param shape  outlives what is returned.
InsideCells insideOf(const Shape& shape);

/// Each picture as the directions alone show it, on another raster. Tones that pictures take from each other are
/// missing from it: no correction brings them back.
std::vector<Tones> shownTones(const PlatePictures& pictures, const DirectionMap& directions, int width, int height);

}  // namespace sillon
