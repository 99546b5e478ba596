// One layer as directions and cover on a raster.
#pragma once

#include <vector>

#include "compose/content.hpp"
#include "compose/placement.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/compose/compose.hpp"
#include "sillon/look/appearance.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// The plate that layers lie on.
struct LayerPlate {
  const Project& project;
  const Shape& shape;
  int width = 0;  ///< of the raster
  int height = 0;
};

/// Draws a layer over those below it, and fills LayerStack::pictures.
/// \param number  of the layer.
/// \return the errors of solveDirections, or Cancelled.
std::optional<Error> drawLayer(std::size_t number, const LayerContent& content, const Placement& place,
                               const LayerPlate& plate, LayerStack& stack, const RunContext& run);

/// Share of a shape that is narrower than two beads: what an opening by a disc of one bead's radius takes from it, less
/// what it takes from corners.
double thinShare(const Shape& shape, double spacing);

}  // namespace sillon
