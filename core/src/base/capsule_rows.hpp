// Finds the pixels of a raster below a bead, one run per row.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "sillon/base/types.hpp"

namespace sillon {

/// Runs of pixels [begin, end) of consecutive rows; empty where end <= begin.
struct PixelRuns {
  static constexpr int kMostRows = 32;
  std::int32_t begin[kMostRows];
  std::int32_t end[kMostRows];
};

/// Pixels whose centres lie in the union of discs along a segment; the radius is linear in between. Pixel centres have
/// integer coordinates. The union is convex: each row meets it between the outermost points that it shares with the two
/// discs at the ends and with the two straight edges between them.
struct Capsule {
  /// \param firstRadius, lastRadius  radii at the ends, >= 0. All lengths are in pixels.
  Capsule(Vec2f a, Vec2f b, float firstRadius, float lastRadius) : discs{{a, firstRadius}, {b, lastRadius}} {
    const Vec2f d = b - a;
    const float size = length(d);
    if (!(size > std::abs(firstRadius - lastRadius))) return;  // one disc contains the other
    const Vec2f u = d * (1 / size);
    const float lean = (firstRadius - lastRadius) / size;
    const float across = std::sqrt(1 - lean * lean);
    for (std::size_t side = 0; side < 2; ++side) {
      const Vec2f normal = u * lean + Vec2f{-u.y, u.x} * (side == 0 ? across : -across);
      Vec2f low = a + normal * firstRadius;
      Vec2f high = b + normal * lastRadius;
      if (low.y > high.y) std::swap(low, high);
      if (high.y - low.y < kFlat) continue;
      edges[side] = {low.y, high.y, low.x, (high.x - low.x) / (high.y - low.y)};
    }
  }

  /// Returns the first row that may contain a pixel, from 0 to `rows`; endRow() is one past the last.
  [[nodiscard]] int firstRow(int rows) const {
    return within(std::ceil(std::min(bottom(discs[0]), bottom(discs[1]))), rows);
  }
  [[nodiscard]] int endRow(int rows) const {
    return within(std::floor(std::max(top(discs[0]), top(discs[1]))) + 1, rows);
  }

  struct Disc {
    Vec2f centre;
    float radius;
  };
  struct Edge {
    float low = 0;  ///< the edge spans the rows from low to high
    float high = 0;
    float x = 0;  ///< x at low
    float slope = 0;
  };
  Disc discs[2];
  Edge edges[2]{};

 private:
  static constexpr float kFlat = 0.01f;  ///< edges that rise less are ignored, because the discs cover them

  static float bottom(const Disc& disc) { return disc.centre.y - disc.radius; }
  static float top(const Disc& disc) { return disc.centre.y + disc.radius; }
  static int within(float row, int rows) {
    return row > 0 ? static_cast<int>(std::min(row, static_cast<float>(rows))) : 0;  // 0 for NaN, too
  }
};

/// Computes the runs of the rows y to y + count - 1, within 0 to `columns`.
/// \param count  1 to PixelRuns::kMostRows
void pixelsOf(const Capsule& capsule, int y, int count, int columns, PixelRuns& runs);

}  // namespace sillon
