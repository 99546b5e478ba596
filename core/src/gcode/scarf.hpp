// The seam of a closed path as a scarf joint: two slanted ends that overlap.
#pragma once

#include <vector>

#include "gcode/motion.hpp"

namespace sillon {

/// Lets the plastic of a closed path grow evenly from nothing over the first `length`, and runs on over the same
/// stretch at the end while it goes out as evenly. Both together are what the path had there, so that the volume stays.
/// \param motion  of a closed path without coasting; its areas and widths are final. \param speeds  per segment [mm/s],
/// continued likewise. \param length  [mm]; at most a quarter of the path is taken.
void addScarf(Motion& motion, std::vector<double>& speeds, double length);

}  // namespace sillon
