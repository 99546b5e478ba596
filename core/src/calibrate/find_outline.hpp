// Where a square plate's outline lies in a photograph.
#pragma once

#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"

namespace sillon {

/// Corners of the one thing that lies on a plain ground [pixels from the upper left], as the picture's y goes down:
/// clockwise to the eye. \return InvalidFile: no plain ground, nothing on it, cut off, or not of four sides.
Result<std::vector<Vec2>> findOutline(const Image& photograph);

}  // namespace sillon
