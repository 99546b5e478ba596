// A composition drawn once more.
#pragma once

#include <optional>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/compose/compose.hpp"

namespace sillon {

/// Draws the layers above the ground anew, with pictures for which LayerPictures::solved is solved.
/// \return as compose.
std::optional<Error> redrawLayers(const Project& project, Composition& made, const ReadInput& read,
                                  const RunContext& run);

}  // namespace sillon
