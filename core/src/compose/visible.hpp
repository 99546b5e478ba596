// Visibility of layers: the shares of their ink that nothing hides, and that stand out.
#pragma once

#include <cstddef>
#include <optional>

#include "compose/content.hpp"
#include "compose/placement.hpp"
#include "compose/region.hpp"
#include "sillon/compose/compose.hpp"

namespace sillon {

/// Marks the texels that lie on the plate, and those that its rim hides.
void markPlate(const LayerPlate& plate, LayerStack& stack);

/// Measures a layer's ink where it lies, also beyond the page.
/// \param region  of the layer on the plate's raster.
LayerInk inkOf(std::size_t number, const LayerContent& content, const Placement& place, const LayerPlate& plate,
               const Region& region, const LayerStack& stack);

/// Tells how ink meets what it stands out from: the ground around it, or what it is drawn over.
/// \param texel  before the ink is drawn.
/// \param line  of the ink; none: it lies across what is there.
LayerStack::Ink inkOver(const LayerStack::Texel& texel, std::optional<Vec2f> line, std::optional<Vec2f> ground);

}  // namespace sillon
