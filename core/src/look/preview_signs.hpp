// What stands beside the panels of a preview.
#pragma once

#include "look/preview_layout.hpp"
#include "sillon/base/types.hpp"
#include "sillon/look/preview.hpp"

namespace sillon {

/// Half wheel: a direction has the colour at its angle. Ticks at 0, 45, 90, 135 and 180 degrees.
void drawLegend(RgbImage& image, const Layout& layout);

/// A ring with a dot: where the lamp stands, seen from above.
void drawLamp(RgbImage& image, const Layout& layout, const Lamp& lamp);

}  // namespace sillon
