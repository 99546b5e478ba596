#include "calibrate/prints.hpp"

#include <cmath>

namespace sillon {

// The cosines of 0, 15, ..., 90 degrees in closed form make the star's angles exact.
Vec2 spoke(int k) {
  const double root2 = std::sqrt(2.0);
  const double root3 = std::sqrt(3.0);
  const double root6 = std::sqrt(6.0);
  const double cosines[] = {1, (root6 + root2) / 4, root3 / 2, root2 / 2, 0.5, (root6 - root2) / 4, 0};
  const int quarter = k / 6 % 4;
  const int rest = k % 6;
  const Vec2 first{cosines[rest], cosines[6 - rest]};
  return quarter == 0   ? first
         : quarter == 1 ? Vec2{-first.y, first.x}
         : quarter == 2 ? Vec2{-first.x, -first.y}
                        : Vec2{first.y, -first.x};
}
void layStar(PlateBuilder& plate, Vec2 centre, double inner, double outer, bool tell) {
  constexpr double kTangent = 0.13165249758739583;  // tangent of half a sector, 7.5 degrees
  constexpr double kGap = 0.15;                     // [mm] gap between a sector's beads and each of its sides
  const double apex = kGap / kTangent;
  for (int k = 0; k < 24; ++k) {
    const Vec2 along = spoke(k);
    const Vec2 across{-along.y, along.x};
    const auto at = [&](double u, double side) { return centre + u * along + side * (u - apex) * kTangent * across; };
    if (tell) plate.value(15 * k, std::to_string(15 * k), centre + 0.5 * (inner + outer) * along);
    plate.patch(filled({at(inner, -1), at(outer, -1), at(outer, 1), at(inner, 1)}, along, plate.width()));
  }
}

}  // namespace sillon
