#include "calibrate/photo.hpp"

#include <algorithm>
#include <string>

#include "base/numbers.hpp"
#include "base/parallel_for.hpp"
#include "base/refused.hpp"

namespace sillon {
namespace {

constexpr double kReach = 0.9;          // [mm] largest error of a spiral's place in the outline's map
constexpr double kClear = 0.11;         // least mean clarity of a coupon's spirals; glossy ones shine in few directions
constexpr double kClearer = 1.4;        // least ratio of the best orientation's clarity to the next best one's
constexpr double kMostResidual = 0.25;  // [mm] largest weighted RMS residual of the spirals' places
constexpr double kOutlineWeight = 0.02;  // weight of a corner of the outline; a spiral's weight is its clarity

}  // namespace

Vec2 FoundCoupon::pixelOf(Vec2 plate) const { return mapped(map, plate); }

FoundCoupon::Steps FoundCoupon::stepsAt(Vec2 plate) const {
  const Vec3 p = map * Vec3{plate.x, plate.y, 1};
  const auto step = [&](Vec3 by) { return Vec2{(by.x - p.x / p.z * by.z) / p.z, (by.y - p.y / p.z * by.z) / p.z}; };
  return {step(map.a), step(map.b)};
}

double FoundCoupon::scaleAt(Vec2 plate) const {
  const Steps steps = stepsAt(plate);
  return std::sqrt(std::abs(cross(steps.x, steps.y)));
}

Result<FoundCoupon> findCoupon(const Image& photograph, const Tones& tones, const std::vector<CouponSpiral>& spirals,
                               const RunContext& run) {
  const Result<std::vector<Vec2>> outline = findOutline(photograph);
  if (!outline) return outline.error();
  // The picture's y axis points down, so that a counter-clockwise ring there is clockwise on the plate.
  const Vec2 plate[] = {{0, 0}, {0, kCouponSide}, {kCouponSide, kCouponSide}, {kCouponSide, 0}};
  FoundCoupon best;
  std::vector<PointPair> corners;  // the outline's corners in the best orientation
  double next = 0;                 // clarity of the second best orientation
  for (std::size_t turn = 0; turn < 4; ++turn) {
    if (run.cancelled()) return cancelledRun();
    std::vector<PointPair> pairs;
    for (std::size_t k = 0; k < 4; ++k) pairs.push_back({plate[k], outline.value()[(k + turn) % 4], kOutlineWeight});
    FoundCoupon tried;
    tried.map = mapThrough(pairs, kCouponSide);
    tried.clarity = meanClarity(findSpirals(spirals, tried, tones, kReach, 2));
    next = std::max(next, std::min(tried.clarity, best.clarity));
    if (tried.clarity > best.clarity) best = tried, corners = pairs;
  }
  const bool clearer = best.clarity > kClearer * next;
  const double scale = best.scaleAt({kCouponSide / 2, kCouponSide / 2});
  const double pixels = scale * spirals.front().pitch;
  if (pixels < 4.5) {
    return refusedFile("BeadsTooSmall", {{"pixels", fixed(pixels, 1)}});
  }
  double residual = 0;
  for (const double reach : {kReach, 0.3, 0.3}) {
    if (run.cancelled()) return cancelledRun();
    const std::vector<SeenSpiral> seen = findSpirals(spirals, best, tones, reach, 1);
    best.clarity = meanClarity(seen);
    std::vector<PointPair> pairs = corners;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      // Loose spirals are seen most clearly, but their highlights lie farther off their beads' middles: they only help
      // in the first round.
      const bool loose = spirals[k].pitch > spirals.front().pitch;
      if (loose && reach < kReach) continue;
      pairs.push_back({spirals[k].centre, best.pixelOf(spirals[k].centre + seen[k].off), seen[k].clarity});
    }
    residual = fitMap(best.map, pairs, kCouponSide, scale);
  }
  if (!clearer || best.clarity < kClear || !(residual <= kMostResidual)) {
    return refusedFile("NoBeadsSeen");
  }
  return best;
}

}  // namespace sillon
