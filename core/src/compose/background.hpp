// Directions below the layers, resampled to the raster of the layers.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/exact_math.hpp"
#include "input/stored_angle.hpp"
#include "sillon/base/types.hpp"
#include "sillon/input/plate_input.hpp"

namespace sillon {

/// Samples a direction map on another raster: the mean line of the map's texels under a texel, or the nearest map texel
/// if these are larger.
class Background {
 public:
  Background(const DirectionMap& map, int width, int height)
      : map_(map), stepX_(static_cast<double>(map.width) / width), stepY_(static_cast<double>(map.height) / height) {}

  /// Returns the stored angle at a texel of the other raster.
  [[nodiscard]] std::uint16_t angleAt(int x, int y) const {
    const int left = first(x, stepX_, map_.width), right = last(x, stepX_, map_.width);
    const int top = first(y, stepY_, map_.height), bottom = last(y, stepY_, map_.height);
    if (right <= left + 1 && bottom <= top + 1)
      return at(nearest(x, stepX_, map_.width), nearest(y, stepY_, map_.height));
    Vec2 sum;
    for (int row = top; row < bottom; ++row) {
      for (int column = left; column < right; ++column) {
        const exact::SinCos turn = exact::sinCos(2 * angleOf(at(column, row)));
        sum = sum + Vec2{turn.cos, turn.sin};
      }
    }
    return storedAngle(exact::atan2(sum.y, sum.x) / (2 * std::numbers::pi));
  }

 private:
  static int nearest(int k, double step, int count) { return std::min(static_cast<int>((k + 0.5) * step), count - 1); }
  static int first(int k, double step, int count) {
    return std::min(static_cast<int>(std::lround(k * step)), count - 1);
  }
  static int last(int k, double step, int count) {
    return std::clamp(static_cast<int>(std::lround((k + 1) * step)), first(k, step, count) + 1, count);
  }
  [[nodiscard]] std::uint16_t at(int x, int y) const { return map_.angle[indexOf(x, y, map_.width)]; }

  const DirectionMap& map_;
  double stepX_;
  double stepY_;
};

}  // namespace sillon
