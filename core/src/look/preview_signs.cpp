#include "look/preview_parts.hpp"

namespace sillon {
namespace {

/// Paints every pixel within `radius` of (cx, cy) by averaging 4 x 4 samples of colourAt(dx, dy), y up.
template <class ColourAt>
void paintAround(RgbImage& image, double cx, double cy, double radius, const ColourAt& colourAt) {
  constexpr int kFine = 4;
  const int x0 = std::max(0, static_cast<int>(cx - radius)),
            x1 = std::min(image.width, static_cast<int>(cx + radius) + 2);
  const int y0 = std::max(0, static_cast<int>(cy - radius)),
            y1 = std::min(image.height, static_cast<int>(cy + radius) + 2);
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      Colour sum;
      for (int k = 0; k < kFine * kFine; ++k) {
        const double dx = x + (k % kFine + 0.5) / kFine - cx;
        const double dy = cy - (y + (k / kFine + 0.5) / kFine);
        sum = sum + asColour(colourAt(dx, dy));
      }
      put(image, x, y, rounded(sum * (1.0f / (kFine * kFine))));
    }
  }
}

}  // namespace

// The half wheel is a half ring of colours with ticks on its outside.
void drawLegend(RgbImage& image, const Layout& layout) {
  const double radius = layout.legendRadius;
  const double outer = 0.86 * radius;
  const double inner = 0.46 * radius;
  const double tick = 0.91 * radius;
  const double half = std::max(0.5, radius * 0.008);
  paintAround(image, layout.legendX, layout.legendY, radius + 1, [&](double dx, double dy) {
    const double distance = std::sqrt(dx * dx + dy * dy);
    if (dy >= 0 && distance >= inner && distance <= outer) return directionColourAt(directionColourPlace(dx, dy));
    // Outside of both rings, and below the base, there is background.
    if (distance < tick || distance > radius || dy < -half) return kBackground;
    // Distance from the nearer diagonal, for the ticks at 45 and 135 degrees.
    const double diagonal = std::abs(std::abs(dx) - dy) * std::sqrt(0.5);
    return std::abs(dy) <= half || std::abs(dx) <= half || diagonal <= half ? kInk : kBackground;
  });
}

// Seen from above, the lamp's elevation is its distance from the middle: a high lamp is near to it.
void drawLamp(RgbImage& image, const Layout& layout, const Lamp& lamp) {
  const double radius = layout.lampRadius;
  const double half = std::max(0.5, radius * 0.02);
  const double dot = radius * 0.16;
  const double azimuth = lamp.azimuth * std::numbers::pi / 180;
  const double reach = radius * std::cos(lamp.elevation * std::numbers::pi / 180);
  const double lampX = reach * std::cos(azimuth);
  const double lampY = reach * std::sin(azimuth);
  paintAround(image, layout.lampX, layout.lampY, radius + dot + 2, [&](double dx, double dy) {
    const double toLamp = (dx - lampX) * (dx - lampX) + (dy - lampY) * (dy - lampY);
    if (toLamp <= dot * dot) return Rgb{255, 236, 200};
    return std::abs(std::sqrt(dx * dx + dy * dy) - radius) <= half ? kInk : kBackground;
  });
}

}  // namespace sillon
