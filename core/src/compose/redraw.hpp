// Draws a composition once more.
#pragma once

#include <optional>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/compose/compose.hpp"

namespace sillon {

/// Draws the layers above the ground anew, with pictures solved for LayerPictures::solved.
/// \return the errors of compose().
std::optional<Error> redrawLayers(const Project& project, Composition& made, const ReadInput& read,
                                  const RunContext& run);

}  // namespace sillon
