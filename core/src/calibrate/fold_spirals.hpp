// A photograph's pixels of the coupon's spirals, sorted by the direction of the bead and the place across it.
#pragma once

#include <array>
#include <vector>

#include "calibrate/find_coupon.hpp"

namespace sillon {

inline constexpr int kAngles = 36;  ///< around a spiral's middle
inline constexpr int kPhases = 10;  ///< from the middle of one turn to the next

struct FoldedSpiral {
  struct Bin {
    double light = 0;  ///< mean, as sRGB codes have it, 0..1
    int count = 0;     ///< of pixels; 0 where too many are burnt
    int burnt = 0;     ///< of these
  };
  std::array<std::array<Bin, kPhases>, kAngles> bins;
  double meanInverseRadius = 0;  ///< [1/mm], of the pixels
  int pixels = 0;
  int burnt = 0;  ///< with a channel at its upper end
};

/// Angle k is at (k + 0.5) / kAngles of a turn from +x, phase k at (k + 0.5) / kPhases of the pitch outward.
FoldedSpiral foldSpiral(const CouponSpiral& spiral, const FoundCoupon& found, const Image& photograph,
                        const Tones& tones);

}  // namespace sillon
