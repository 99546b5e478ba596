// Where a coupon lies in a photograph.
#pragma once

#include <vector>

#include "calibrate/coupon.hpp"
#include "calibrate/space.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/look/tones.hpp"

namespace sillon {

/// A photograph and the map from the plate into it.
struct FoundCoupon {
  Mat3 map;            ///< plate [mm] to pixels from the picture's upper left, homogeneous
  double clarity = 0;  ///< 0..1, how clearly the turns of the spirals are seen

  [[nodiscard]] Vec2 pixelOf(Vec2 plate) const;
  /// Derivatives of the pixel by the place's x and y [pixels/mm].
  struct Steps {
    Vec2 x, y;
  };
  [[nodiscard]] Steps stepsAt(Vec2 plate) const;
  [[nodiscard]] double scaleAt(Vec2 plate) const;  ///< [pixels/mm]
};

/// First the plate's outline, on a plain ground; then, of four ways round, the one in which its spirals show.
/// \param tones  luminance of `photograph`. \param spirals  all of the coupon.
Result<FoundCoupon> findCoupon(const Image& photograph, const Tones& tones, const std::vector<CouponSpiral>& spirals,
                               const RunContext& run);

}  // namespace sillon
