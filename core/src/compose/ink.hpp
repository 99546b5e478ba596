// Draws a layer as directions and cover on a raster.
#pragma once

#include <cstddef>
#include <optional>

#include "compose/content.hpp"
#include "compose/placement.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/compose/compose.hpp"

namespace sillon {

/// Draws a layer over those below it, and fills LayerStack::pictures and LayerStack::inks.
/// \param number  index of the layer.
/// \return the errors of solveDirections(), or Cancelled.
std::optional<Error> drawLayer(std::size_t number, const LayerContent& content, const Placement& place,
                               const LayerPlate& plate, LayerStack& stack, const RunContext& run);

/// Blends a line over a texel. \param line  none: across the direction that is there.
void blend(LayerStack::Texel& texel, std::optional<Vec2f> line, float cover);

/// Returns the share of a shape that is narrower than two beads: the loss from an opening by a disc of one bead's
/// radius, apart from corners.
double thinShare(const Shape& shape, double spacing);

}  // namespace sillon
