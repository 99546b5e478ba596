// Which pixels of a raster lie below a bead: row by row one run, four rows at a time.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/simd.hpp"
#include "sillon/base/types.hpp"

namespace sillon {

/// Pixels whose centres lie in the union of discs along a segment, the radius linear in between. Centres have whole
/// coordinates. The union is convex: each row meets it between the outermost points that it shares with the two discs
/// at the ends and with the two straight edges between them.
class CapsuleRows {
 public:
  /// \param ra, rb  radii at the ends, >= 0. All in pixels.
  CapsuleRows(Vec2f a, Vec2f b, float ra, float rb) : a_(a), b_(b), ra_(ra), rb_(rb) {
    const Vec2f d = b - a;
    const float size = length(d);
    if (!(size > std::abs(ra - rb))) return;  // one disc holds the other
    const Vec2f u = d * (1 / size);
    const float lean = (ra - rb) / size;
    const float across = std::sqrt(1 - lean * lean);
    for (std::size_t side = 0; side < 2; ++side) {
      const Vec2f normal = u * lean + Vec2f{-u.y, u.x} * (side == 0 ? across : -across);
      Vec2f low = a + normal * ra;
      Vec2f high = b + normal * rb;
      if (low.y > high.y) std::swap(low, high);
      if (high.y - low.y < kFlat) continue;
      edges_[side] = {low.y, high.y, low.x, (high.x - low.x) / (high.y - low.y)};
    }
  }

  /// The first row that may hold a pixel, and the one after the last, from 0 to `rows`.
  [[nodiscard]] int firstRow(int rows) const { return within(std::ceil(std::min(a_.y - ra_, b_.y - rb_)), rows); }
  [[nodiscard]] int endRow(int rows) const { return within(std::floor(std::max(a_.y + ra_, b_.y + rb_)) + 1, rows); }

  /// Of the rows y to y + 3 the pixels [begin, end), both from 0 to `columns`; none where end <= begin.
  void at(int y, int columns, I4& begin, I4& end) const {
    const F4 row = splat(static_cast<float>(y)) + F4{0, 1, 2, 3};
    F4 left = splat(kFar);
    F4 right = splat(-kFar);
    // Where a row meets nothing x is no number, which min4 and max4 pass over.
    const auto meet = [&](F4 from, F4 to) {
      left = min4(from, left);
      right = max4(to, right);
    };
    const auto meetDisc = [&](Vec2f centre, float radius) {
      const F4 dy = row - splat(centre.y);
      const F4 half = sqrt4(splat(radius * radius) - dy * dy);
      meet(splat(centre.x) - half, splat(centre.x) + half);
    };
    meetDisc(a_, ra_);
    meetDisc(b_, rb_);
    for (const Edge& edge : edges_) {
      const F4 rise = row - splat(edge.low);
      const F4 x = select4((rise > splat(0)) & (row < splat(edge.high)), splat(edge.x) + splat(edge.slope) * rise,
                           splat(std::numeric_limits<float>::quiet_NaN()));
      meet(x, x);
    }
    const F4 width = splat(static_cast<float>(columns));
    const F4 none = splat(0);
    begin = splatInt(columns) - toInt(width - min4(max4(left, none), width));
    end = toInt(min4(max4(right + splat(1), none), width));
  }

 private:
  static constexpr float kFar = 1e9f;
  static constexpr float kFlat = 0.01f;  ///< edges that rise less are left to the discs

  struct Edge {
    float low = 0;  ///< rows in between
    float high = 0;
    float x = 0;  ///< at low
    float slope = 0;
  };

  static int within(float row, int rows) {
    return row > 0 ? static_cast<int>(std::min(row, static_cast<float>(rows))) : 0;  // NaN too
  }

  Vec2f a_, b_;
  float ra_, rb_;
  std::array<Edge, 2> edges_{};
};

}  // namespace sillon
