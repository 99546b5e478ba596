// Placement of plates that do not fit the bed where they lie.
#pragma once

#include "sillon/geometry/shape.hpp"
#include "sillon/job/plate.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// Turns a plate that does not fit in the middle of the bed, if that helps; otherwise shrinks it as far as needed, if
/// `placing` allows it. A plate that still does not fit stays as it is. \return true if the size has changed, so that
/// the input must be read again.
bool placeOnBed(Project& project, const Shape& shape, Placing placing);

}  // namespace sillon
