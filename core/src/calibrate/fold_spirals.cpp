#include "base/exact_math.hpp"
#include "calibrate/photo.hpp"
#include "look/rasters.hpp"

#include <algorithm>

namespace sillon {
namespace {

constexpr double kMostBurnt = 0.1;  // largest share of burnt pixels in a bin that is used

}  // namespace

FoldedSpiral foldSpiral(const CouponSpiral& spiral, const FoundCoupon& found, const Image& photograph,
                        const Tones& tones) {
  constexpr std::uint16_t kFull = 65535 / 255 * 253;  // least sample that counts as burnt: 253 of 255
  const double inner = std::max(0.8, 1.25 * spiral.pitch), outer = spiral.radius - 0.6 * spiral.pitch;
  FoldedSpiral out;
  Bounds box;
  for (int k = 0; k < 16; ++k) {
    const double a = 2 * std::numbers::pi * k / 16;
    box.add(found.pixelOf(spiral.centre + 1.05 * spiral.radius * Vec2{exact::cos(a), exact::sin(a)}));
  }
  const int x0 = std::max(0, static_cast<int>(box.min.x)), x1 = std::min(tones.width - 1, static_cast<int>(box.max.x));
  const int y0 = std::max(0, static_cast<int>(box.min.y)), y1 = std::min(tones.height - 1, static_cast<int>(box.max.y));
  const Mat3 back = found.map.inverse();
  const int colours = photograph.channels >= 3 ? 3 : 1;
  double inverse = 0;
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const Vec2 p = mapped(back, {x + 0.5, y + 0.5}) - spiral.centre;
      const double r = length(p);
      if (r < inner || r > outer) continue;
      double turn = exact::atan2(p.y, p.x) / (2 * std::numbers::pi);
      turn -= std::floor(turn);
      double phase = r / spiral.pitch - turn;
      phase -= std::floor(phase);
      FoldedSpiral::Bin& bin = out.bins[std::min(kAngles - 1, static_cast<int>(turn * kAngles))]
                                       [std::min(kPhases - 1, static_cast<int>(phase * kPhases))];
      const double light = static_cast<double>(lightOfCode(tones.at(x, y)));
      bin.light += light;
      ++bin.count;
      ++out.pixels;
      inverse += 1 / r;
      bool burnt = false;
      for (int c = 0; c < colours; ++c) burnt = burnt || photograph.at(x, y, c) >= kFull;
      out.burnt += burnt ? 1 : 0;
      bin.burnt += burnt ? 1 : 0;
    }
  }
  for (auto& row : out.bins) {
    for (FoldedSpiral::Bin& bin : row) {
      if (bin.count == 0) continue;
      if (bin.burnt > kMostBurnt * bin.count) {  // its true brightness is unknown
        bin = {};
        continue;
      }
      bin.light /= bin.count;
    }
  }
  out.meanInverseRadius = out.pixels > 0 ? inverse / out.pixels : 1;
  return out;
}

}  // namespace sillon
