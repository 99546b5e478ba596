// Brush strokes over the layers below.
#pragma once

#include <cstddef>
#include <optional>

#include "compose/content.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/compose/compose.hpp"

namespace sillon {

/// Replays strokes in order over the stack below, which an eraser restores.
/// \param number  index of the layer.
/// \return Cancelled, or nothing.
std::optional<Error> drawStrokes(const StrokesLayer& strokes, std::size_t number, const LayerPlate& plate,
                                 LayerStack& stack, const RunContext& run);

}  // namespace sillon
