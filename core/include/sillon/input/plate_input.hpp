// The decoded inputs of one plate.
#pragma once

#include "sillon/geometry/shape.hpp"
#include "sillon/input/direction_map.hpp"

namespace sillon {

struct PlateInput {
  Shape shape;
  DirectionMap directions;
  ModeMap modes;
  bool showsPictures = false;  ///< tones depend on the directions: beads keep to them more closely than to even gaps
};

}  // namespace sillon
