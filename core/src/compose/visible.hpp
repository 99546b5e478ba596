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

/// Measures a layer's ink by its place, also beyond the page.
/// \param region  region of the layer on the plate's raster.
LayerInk inkOf(std::size_t number, const LayerContent& content, const Placement& place, const LayerPlate& plate,
               const Region& region, const LayerStack& stack);

/// Tells how ink stands out from the ground around it, or from the layer that it is drawn over.
/// \param texel  texel before the ink is drawn.
/// \param line  line of the ink; none: across the direction that is there.
LayerStack::Ink inkOver(const LayerStack::Texel& texel, std::optional<Vec2f> line, std::optional<Vec2f> ground);

}  // namespace sillon
