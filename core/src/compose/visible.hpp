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

/// Tells how much of each visible layer above the ground is seen.
/// \param placed  boxes, one per layer of the project.
std::vector<SeenLayer> seeLayers(const Project& project, const std::vector<PlacedLayer>& placed,
                                 const Composition& composition);

/// Notes and warnings about the layers of a composition.
struct LayersTold {
  std::vector<InputNote> notes;
  std::vector<Warning> warnings;
};

/// Collects the notes and warnings about layers.
/// \param page  size of the plate [mm].
/// \param spacing  tau [mm].
LayersTold toldOf(const std::vector<PlacedLayer>& placed, const std::vector<SeenLayer>& seen, Vec2 page,
                  double spacing);

}  // namespace sillon
