// Where a coupon lies in a photograph.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calibrate/coupon.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/look/tones.hpp"

namespace sillon {

/// A photograph and the map from the plate into it.
struct FoundCoupon {
  Eigen::Matrix3d map;  ///< plate [mm] to pixels from the picture's upper left, homogeneous
  double clarity = 0;   ///< 0..1, how clearly the turns of the spirals are seen

  [[nodiscard]] Vec2 pixelOf(Vec2 plate) const;
  [[nodiscard]] Vec2 plateAt(Vec2 pixel) const;
  /// Derivatives of the pixel by the place [pixels/mm].
  [[nodiscard]] Eigen::Matrix2d jacobianAt(Vec2 plate) const;
};

/// First the plate's outline, on a plain ground; then, of four ways round, the one in which its spirals show.
/// \param tones  luminance of `photograph`. \param spirals  all of the coupon.
Result<FoundCoupon> findCoupon(const Image& photograph, const Tones& tones, const std::vector<CouponSpiral>& spirals,
                               const RunContext& run);

}  // namespace sillon
