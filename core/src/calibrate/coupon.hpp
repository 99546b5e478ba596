// The coupon: all of one spool on a card, and where it has what a photograph of it is read from.
#pragma once

#include <vector>

#include "sillon/base/types.hpp"

namespace sillon {

inline constexpr double kCouponSide = 54;  ///< [mm]

/// One bead round and round. A spiral has every direction, so that some of it shines under any lamp.
struct CouponSpiral {
  Vec2 centre;        ///< from the lower left [mm]
  double radius = 0;  ///< [mm]
  double pitch = 0;   ///< from one turn to the next [mm]
};

/// Corner marks, counter-clockwise from the lower left: closed spirals.
std::vector<CouponSpiral> couponMarks(double nozzle);

/// Spirals whose turns lie two nozzles apart: their beads are as wide as the printer makes them.
std::vector<CouponSpiral> looseSpirals(double nozzle);

/// Disc `k` of flow, from the top.
CouponSpiral flowDisc(int k, double nozzle);

class PlateBuilder;

/// Star on the upper left, discs on the right, loose spirals and wedge below, ruler and corner marks along the edges.
void layCoupon(PlateBuilder& plate);

}  // namespace sillon
