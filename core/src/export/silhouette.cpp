#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/refused.hpp"
#include "export/zones.hpp"
#include "sillon/export/export.hpp"

namespace sillon {

Result<Shape> silhouetteOf(const Mesh& body, Vec2& corner) {
  constexpr double kCells = 4e6;
  Bounds box;
  for (const auto& p : body.points) box.add({p[0], p[1]});
  const Vec2 size = box.size();
  if (!(size.x > 0 && size.y > 0)) return refused(ErrorCode::EmptyShape, "BodyFlat");
  const double cell = std::max(0.05, std::sqrt(size.x * size.y / kCells));
  Image mask;
  mask.width = static_cast<int>(std::ceil(size.x / cell));
  mask.height = static_cast<int>(std::ceil(size.y / cell));
  mask.channels = 1;
  // Difference array: number of triangles at each pixel less that at the pixel to its left, so that a triangle costs
  // two entries per row, however wide it is.
  const std::size_t stride = mask.width + 1;
  std::vector<std::int32_t> more(stride * mask.height, 0);
  const double pitch = size.x / mask.width;
  for (const auto& t : body.triangles) {
    std::array<Vec2, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = Vec2{body.points[t[k]][0], body.points[t[k]][1]} - box.min;
    const auto [low, high] = std::minmax({p[0].y, p[1].y, p[2].y});
    const int first = std::max(0, static_cast<int>(std::ceil(low / pitch - 0.5)));
    const int last = std::min(mask.height - 1, static_cast<int>(std::floor(high / pitch - 0.5)));
    for (int row = first; row <= last; ++row) {
      const double y = (row + 0.5) * pitch;
      double from = 1e30;
      double to = -1e30;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 a = p[k];
        const Vec2 b = p[(k + 1) % 3];
        if ((a.y > y) == (b.y > y)) continue;
        const double x = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
        from = std::min(from, x);
        to = std::max(to, x);
      }
      if (from > to) continue;  // the row meets a corner at most
      const int left = std::max(0, static_cast<int>(std::ceil(from / pitch - 0.5)));
      const int right = std::min(mask.width - 1, static_cast<int>(std::floor(to / pitch - 0.5)));
      if (left > right) continue;
      std::int32_t* const at = more.data() + (mask.height - 1 - row) * stride;
      ++at[left];
      --at[right + 1];
    }
  }
  mask.samples.reserve(cellCount(mask.width, mask.height));
  for (std::size_t row = 0; row < more.size(); row += stride) {
    std::int32_t here = 0;
    for (std::size_t x = 0; x + 1 < stride; ++x) {
      here += more[row + x];
      mask.samples.push_back(here > 0 ? 65535 : 0);
    }
  }
  corner = box.min;
  return shapeFromMask(mask, size.x);
}

}  // namespace sillon
