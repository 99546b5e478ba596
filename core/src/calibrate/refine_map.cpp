#include "base/exact_math.hpp"
#include "calibrate/photo.hpp"

#include <algorithm>
#include <utility>

namespace sillon {
namespace {

constexpr double kFits = 0.02;   // [mm] residual below which all spirals are in their places
constexpr double kBetter = 0.6;  // largest share of the residual that moved spirals may leave

/// RMS residual of a map that is fitted to all pairs alike [pixels].
double leftBy(const std::vector<PointPair>& pairs) {
  const Mat3 map = mapThrough(pairs, kCouponSide);
  double sum = 0;
  for (const PointPair& p : pairs) sum += exact::square(leftOf(p, map));
  return std::sqrt(sum / static_cast<double>(pairs.size()));
}

}  // namespace

void refineMap(FoundCoupon& found, const std::vector<LitSpiral>& spirals, const SpiralFit& fit) {
  const double scale = found.scaleAt({kCouponSide / 2, kCouponSide / 2});
  const Vec2 way = (1 / std::max(1e-6, length(fit.tilt))) * fit.tilt;
  std::vector<PointPair> pairs;
  double sum = 0;
  for (std::size_t k = 0; k < spirals.size(); ++k) {
    const LitSpiral& s = spirals[k];
    const Vec2 middle = s.spiral.centre;
    PointPair pair{middle, found.pixelOf(middle + fit.offsets[k])};
    // A turn shows its place only across itself, so a spiral's place is surer in one direction than in another. The
    // Cholesky factor of the fit's information matrix gives the vectors that are measured, weighted accordingly.
    const SpiralFit::Surety& sure = fit.surety[k];
    const double xx = std::sqrt(std::max(1e-12, sure.xx)), xy = sure.xy / xx;
    const double yy = std::sqrt(std::max(1e-12, sure.yy - xy * xy));
    const Vec2 x{s.blurX.x, s.blurY.x}, y{s.blurX.y, s.blurY.y};  // gradients of the place's x and y over the picture
    pair.first = xx * x + xy * y, pair.second = yy * y;
    sum += dot(pair.first, pair.first) + dot(pair.second, pair.second);
    pairs.push_back(pair);
  }
  // Scales all vectors to an RMS length of 1, so that residuals are in pixels.
  const double even = std::sqrt(2 * static_cast<double>(pairs.size()) / sum);
  for (PointPair& p : pairs) p.first = even * p.first, p.second = even * p.second;
  // Spirals are moved by one turn, one after the other, as long as the residual shrinks. The moves are kept only if
  // it has shrunk much.
  const double before = leftBy(pairs);
  std::vector<PointPair> moved = pairs;
  double least = before;
  for (std::size_t round = 0; round < spirals.size() && least > kFits * scale; ++round) {
    std::vector<PointPair> best;
    for (std::size_t k = 0; k < spirals.size(); ++k) {
      if (spirals[k].kind == SpiralKind::Loose) continue;
      for (const double turn : {-1.0, 1.0}) {
        std::vector<PointPair> tried = moved;
        const Vec2 at = spirals[k].spiral.centre + fit.offsets[k] + turn * spirals[k].spiral.pitch * way;
        tried[k].pixel = found.pixelOf(at);
        const double now = leftBy(tried);
        if (now < least) least = now, best = std::move(tried);
      }
    }
    if (best.empty()) break;
    moved = std::move(best);
  }
  if (least < kBetter * before) pairs = std::move(moved);
  fitMap(found.map, pairs, kCouponSide, scale);
}

}  // namespace sillon
