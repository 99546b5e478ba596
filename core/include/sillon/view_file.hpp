// The finished plate as a small picture of directions, from which web pages draw its shimmer: docs/view.md.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sillon/result.hpp"
#include "sillon/types.hpp"

namespace sillon {

/// The filament that the plate is shown in.
struct ViewParams {
  std::array<std::uint8_t, 3> colour{201, 148, 46};  ///< of the body, sRGB; gold PLA
  double slopeAlong = 8.93;                          ///< RMS slope of the surface along the bead [degrees], 0.1..45
  double slopeAcross = 15.6;                         ///< and across it [degrees], 0.1..45
};

/// PNG, at most 200 KiB: per texel the beads' mean direction, the share that is covered, and the beads' mean width.
/// \param page  [mm], 0.001..100000 per side.
/// \return the same bytes for the same toolpath; InvalidArgument, TooLarge.
Result<std::vector<std::uint8_t>> viewFile(const Toolpath& toolpath, Vec2 page, const ViewParams& params);

}  // namespace sillon
