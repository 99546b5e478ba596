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

/// What the directions alone show of each picture, on another raster. What pictures take from each other is missing
/// from it: no correction brings that back.
std::vector<Tones> shownTones(const PlatePictures& pictures, const DirectionMap& directions, int width, int height);

}  // namespace sillon
