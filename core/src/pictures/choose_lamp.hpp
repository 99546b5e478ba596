// The lamp of a single picture, where none is given.
#pragma once

#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/look/inversion.hpp"
#include "sillon/pictures/pictures.hpp"

namespace sillon {

/// The azimuth, of three that force few beads to end, whose plate shows the picture best [degrees]: forced ends say
/// little of what they spoil. Plates for this have the usual settings and as many beads on any page, so that whoever
/// changes a setting keeps the lamp. \param lit  one picture. \return the errors of solveDirections and seePlate.
Result<double> chosenAzimuth(std::vector<LitPicture> lit, const Roughness& roughness, const Shape& shape,
                             const InversionParams& inversion, const RunContext& run, const OnTrial& onTrial);

}  // namespace sillon
