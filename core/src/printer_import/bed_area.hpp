// What of a bed a plate may use, as Orca's settings tell it.
#pragma once

#include <string_view>

#include "sillon/base/types.hpp"

namespace sillon {

struct BedArea {
  Bounds bed;       ///< [mm]
  Bounds excluded;  ///< a box within it; empty: none
};

/// Of several nozzles: keeps what all of them reach. \param text  extruder_printable_area: corners of a box for each.
/// \return whether it could be read.
bool reachByAll(std::string_view text, BedArea& area);

/// Strips along whole edges, and an outline that runs along the edges, make the bed smaller; the box around all else is
/// excluded. \param text  bed_exclude_area: corners, four for each of several boxes. \return whether it could be read.
bool exclude(std::string_view text, BedArea& area);

}  // namespace sillon
