// A picture of the waves at the resolution of a screen.
#pragma once

#include "sillon/phase_field.hpp"
#include "sillon/preview.hpp"
#include "sillon/sdf.hpp"

namespace sillon {

/// Every pixel shows the wave of its cell: bright where it is 0, where a bead will lie; black where no cell has a wave.
/// \param field  of any depth of the pyramid. \param sdf  on the finest grid: says which of its cells have waves.
/// \param page  [mm]. \param width  [pixels]. \return TooLarge, Cancelled.
Result<RgbImage> drawWaves(const SineField& field, const SignedDistanceField& sdf, Vec2 page, int width,
                           const RunContext& run);

}  // namespace sillon
