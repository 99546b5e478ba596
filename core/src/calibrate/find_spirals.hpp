// Where spirals lie in a photograph, by the pattern of their turns.
#pragma once

#include <vector>

#include "calibrate/coupon.hpp"
#include "calibrate/find_coupon.hpp"
#include "sillon/look/tones.hpp"

namespace sillon {

struct SeenSpiral {
  Vec2 off;            ///< of the spiral from where the map has it [mm]
  double clarity = 0;  ///< 1: nothing but a wave along its turns
};

/// For each spiral, where its turns answer most to those that it should have.
/// \param reach  how far off they may lie [mm]. \param stride  1: every place, and between them; 2: every other one.
std::vector<SeenSpiral> findSpirals(const std::vector<CouponSpiral>& spirals, const FoundCoupon& found,
                                    const Tones& tones, double reach, int stride);

double meanClarity(const std::vector<SeenSpiral>& seen);

}  // namespace sillon
