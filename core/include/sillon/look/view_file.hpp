// The finished plate as a small picture of directions, from which web pages draw its shimmer:
// docs/reference/view.md.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/look/appearance.hpp"

namespace sillon {

/// The filament that the plate is shown in.
struct ViewParams {
  std::array<std::uint8_t, 3> colour{201, 148, 46};  ///< colour of the body, sRGB; gold PLA
  Roughness roughness;
};

/// Makes a PNG of at most 200 KiB: per texel the beads' mean direction, the share that is covered,
/// and the beads' mean width.
/// \param page  size [mm], 0.001..100000 per side.
/// \return the same bytes for the same toolpath; InvalidArgument, TooLarge.
Result<std::vector<std::uint8_t>> viewFile(const Toolpath& toolpath, Vec2 page,
                                           const ViewParams& params);

}  // namespace sillon
