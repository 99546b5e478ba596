#include "look/inversion_parts.hpp"

#include <cmath>

namespace sillon {
namespace {

/// First index of the middle `wanted` out of `count`.
int middle(int count, int wanted) { return (count - wanted) / 2; }

/// Rounds to a whole number of pixels, at least one and at most all.
int clamped(double wanted, int count) { return std::clamp(static_cast<int>(std::lround(wanted)), 1, count); }

}  // namespace

Tones pageTones(Tones tones, Vec2 page, PictureProportions proportions, double& leftOut) {
  leftOut = 0;
  if (proportions == PictureProportions::Stretch || !(page.x > 0 && page.y > 0)) return tones;
  // Keep the longest part of each side that fits the page's proportions.
  const int width = clamped(std::min<double>(tones.width, tones.height * page.x / page.y), tones.width);
  const int height = clamped(std::min<double>(tones.height, tones.width * page.y / page.x), tones.height);
  if (width == tones.width && height == tones.height) return tones;
  Tones cut{width, height, {}};
  cut.value.reserve(cellCount(width, height));
  // Cut as much on either side.
  const int left = middle(tones.width, width);
  const int top = middle(tones.height, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) cut.value.push_back(tones.at(left + x, top + y));
  }
  leftOut = 1 - static_cast<double>(cut.value.size()) / static_cast<double>(tones.value.size());
  return cut;
}

}  // namespace sillon
