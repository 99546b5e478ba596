// Ways to read directions from a picture, and their rasters.
#pragma once

#include "compose/lines.hpp"

namespace sillon {

/// Square cells over a box.
struct BoxCells {
  int width = 1;
  int height = 1;
  double cell = 1;  ///< side of a cell [mm]
};

/// Returns cells as fine as beads need, or larger ones if there would be more than `most` on a side.
BoxCells cellsOn(Vec2 box, double spacing, int most = kMostTexels);

LineAt edgeLines(const TonesLayer& tones, const LayerContent& content, const Placement& place, double spacing);
LineAt colourLines(const TonesLayer& tones, const LayerContent& content, const Placement& place, double spacing);

}  // namespace sillon
