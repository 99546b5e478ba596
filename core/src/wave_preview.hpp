// A picture of the waves at the resolution of a screen.
#pragma once

#include "sillon/phase_field.hpp"
#include "sillon/preview.hpp"

namespace sillon {

/// Every pixel shows the wave of its cell: bright where it is 0, where a bead will lie; black outside of all cells.
/// \param page  [mm]. \param width  [pixels]. \return TooLarge, Cancelled.
Result<RgbImage> drawWaves(const SineField& field, Vec2 page, int width, const RunContext& run);

}  // namespace sillon
