#include "calibrate/prints.hpp"

#include <algorithm>

namespace sillon {

std::vector<CouponSpiral> couponMarks(double nozzle) {
  constexpr double kRadius = 2.6;
  // Marks keep 1 mm off the edges.
  constexpr double kNear = 1 + kRadius;
  constexpr double kFar = kCouponSide - kNear;
  std::vector<CouponSpiral> marks;
  for (const Vec2 centre : {Vec2{kNear, kNear}, {kFar, kNear}, {kFar, kFar}, {kNear, kFar}}) {
    marks.push_back({centre, kRadius, nozzle});
  }
  return marks;
}

std::vector<CouponSpiral> looseSpirals(double nozzle) {
  return {{{6.5, 17.2}, 3.4, 2 * nozzle}, {{27.5, 17.2}, 3.4, 2 * nozzle}};
}

CouponSpiral flowDisc(int k, double nozzle) { return {{46, 43.5 - 8.2 * k}, 3.7, nozzle}; }

void layCoupon(PlateBuilder& plate) {
  constexpr double kEdge = 1;
  constexpr double kSmall = 0.45;  // [mm] unit of small writing: capitals of 2.7 mm
  const double width = plate.width();
  plate.base(box({0, 0}, {kCouponSide, kCouponSide}));

  for (const CouponSpiral& mark : couponMarks(width))
    plate.patch({spiral(mark.centre, mark.radius, width, mark.pitch)});
  for (const CouponSpiral& loose : looseSpirals(width)) {
    plate.patch({spiral(loose.centre, loose.radius, width, loose.pitch)});
  }

  // A ruler with one tick per millimetre, longer ones every 5 and 10.
  for (int mm = 0; mm <= 30; ++mm) {
    const double x = 13 + mm;
    const double length = mm % 10 == 0 ? 3 : mm % 5 == 0 ? 2.2 : 1.5;
    plate.draw({stroke({x, kEdge}, {x, kEdge + length}, std::clamp(0.45, kLeastWidth * width, width))});
  }

  const Vec2 middle{15.5, 34};
  // Ticks on the star at 0 and 90 degrees.
  for (const int k : {0, 6}) {
    plate.draw({stroke(middle + 13.6 * spoke(k), middle + 14.8 * spoke(k), width)});
  }
  plate.labelAt("0", middle + 16.6 * spoke(0), kSmall);
  plate.labelAt("90", middle + 17 * spoke(6), kSmall);

  for (std::size_t k = 0; k < plate.values().size(); ++k) {
    const double value = plate.values()[k];
    const CouponSpiral disc = flowDisc(static_cast<int>(k), width);
    const std::string label = written(value, 2);
    plate.labelAt(label, disc.centre - Vec2{4.4 + kSmall * textWidth(label) / 2 + width, 0}, kSmall);
    plate.value(value, label, disc.centre);
    plate.patch({spiral(disc.centre, disc.radius, width, disc.pitch)}).flow = value;
  }

  const double least = kLeastWidth * width;
  const double most = kMostWidth * width;
  const int lines = std::max(2, static_cast<int>(6.4 / most));
  plate.patch({wedge({6, 9.2}, 42, lines, least, most)});
  layStar(plate, middle, 3.5, 13, false);
}

}  // namespace sillon
