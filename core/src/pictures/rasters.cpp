#include "pictures/parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sillon/geometry/outline.hpp"
#include "sillon/look/conflict.hpp"

namespace sillon {

InsideCells insideOf(const Shape& shape) {
  return [&shape](int width, int height) {
    const double stepX = shape.page.x / width, stepY = shape.page.y / height;
    std::vector<char> inside(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
    const auto rows = insideIntervals(shape, 0.5 * stepY, stepY, height);
    for (int y = 0; y < height; ++y) {
      char* const row = &inside[static_cast<std::size_t>(height - 1 - y) * static_cast<std::size_t>(width)];
      for (const Interval& span : rows[y]) {
        const int first = std::max(0, static_cast<int>(std::ceil(span.begin / stepX - 0.5)));
        const int end = std::min(width, static_cast<int>(std::ceil(span.end / stepX - 0.5)));
        std::fill(row + first, row + std::max(first, end), char{1});
      }
    }
    const bool none = std::find(inside.begin(), inside.end(), 1) == inside.end();
    const bool all = std::find(inside.begin(), inside.end(), 0) == inside.end();
    return none || all ? std::vector<char>() : inside;
  };
}

std::vector<Tones> shownTones(const PlatePictures& pictures, const DirectionMap& directions, int width, int height) {
  const PictureConflict conflict = conflictOf(directions, pictures.shown, pictures.roughness, pictures.level);
  std::vector<Tones> out;
  for (std::size_t k = 0; k < pictures.shown.size(); ++k) {
    Tones shown = pictures.shown[k].tones;
    for (std::size_t c = 0; c < shown.value.size(); ++c) shown.value[c] -= conflict.missing[k][c];
    out.push_back(resampled(shown, width, height));
  }
  return out;
}

}  // namespace sillon
