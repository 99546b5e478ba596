// Renders a drawing in its colours to pixels.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "geometry/outline.hpp"
#include "input/svg.hpp"

namespace sillon {
namespace {

constexpr double kMostCrossings = 2e7;  // crossings of outlines with rows of pixels; each takes memory and time
constexpr double kMostPaint = 2e8;      // painted pixels, including those that later paths cover

/// Chooses the resolution [pixels/mm]: `most`, or less if the drawing would take too much time.
double pixelsPerMm(const Shape& shape, double most) {
  double climb = 1e-6;   // sum of all vertical ways along outlines [mm]
  double boxes = 1e-12;  // area of the paths' boxes [mm²]
  for (const FilledPath& path : shape.paths) {
    Bounds box;
    for (const Ring& ring : path.rings) {
      Vec2 last = ring.empty() ? Vec2{} : ring.back();
      for (const Vec2 point : ring) {
        climb += std::abs(point.y - last.y);
        box.add(point);
        last = point;
      }
    }
    boxes += box.size().x * box.size().y;
  }
  return std::min({most, kMostCrossings / climb, std::sqrt(kMostPaint / boxes)});
}

/// Blends a paint over a pixel.
void layPaint(const PathPaint& paint, std::uint16_t* pixel) {
  const double below = pixel[3] / 65535.0 * (1 - paint.alpha), cover = paint.alpha + below;
  for (int part = 0; part < 3; ++part) {
    const double own = (paint.colour >> (16 - 8 * part) & 255) * 257.0;
    const double mixed = below > 0 ? (paint.alpha * own + below * pixel[part]) / cover : own;
    pixel[part] = static_cast<std::uint16_t>(mixed + 0.5);
  }
  pixel[3] = static_cast<std::uint16_t>(65535 * cover + 0.5);
}

}  // namespace

Image paintedPicture(const SvgPainting& painting, int longest) {
  const Vec2 page = painting.shape.page;
  const double scale = pixelsPerMm(painting.shape, longest / std::max(page.x, page.y));
  const auto pixels = [&](double side) { return std::max(1, static_cast<int>(std::lround(scale * side))); };
  Image image{pixels(page.x), pixels(page.y), 4, {}};
  const std::size_t stride = 4 * image.width;
  image.samples.resize(stride * image.height);
  const Vec2 step{page.x / image.width, page.y / image.height};
  for (std::size_t k = 0; k < painting.paints.size(); ++k) {
    Shape one;
    one.page = page;
    one.paths = {painting.shape.paths[k]};
    const Bounds box = bounds(one);
    if (box.empty()) continue;
    const auto rowAt = [&](double y) { return static_cast<int>(std::clamp(y / step.y, 0.0, image.height - 1.0)); };
    const int first = rowAt(box.min.y);
    const auto spans = insideIntervals(one, (first + 0.5) * step.y, step.y, rowAt(box.max.y) - first + 1);
    for (std::size_t up = 0; up < spans.size(); ++up) {
      const std::size_t row = image.height - 1 - first - up;
      for (const Interval& span : spans[up]) {
        const CellRange cells = cellsWithin(span, step.x, image.width);
        for (int x = cells.begin; x < cells.end; ++x) {
          layPaint(painting.paints[k], &image.samples[row * stride + 4 * x]);
        }
      }
    }
  }
  return image;
}

}  // namespace sillon
