// Plates that do not fit the bed where they lie.
#pragma once

#include "sillon/geometry/shape.hpp"
#include "sillon/job/plate.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// Turns a plate that does not fit the bed in its middle, if that helps; else, if it may, makes it as much smaller as
/// it must be. What still does not fit stays as it is. \return whether the size has changed, so that the input must be
/// read anew.
bool placeOnBed(Project& project, const Shape& shape, Placing placing);

}  // namespace sillon
