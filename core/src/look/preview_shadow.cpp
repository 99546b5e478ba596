#include "look/preview_shadow.hpp"

#include <algorithm>
#include <cstddef>

#include "look/preview_beads.hpp"

namespace sillon {
namespace {

void boxBlur(std::vector<float>& values, int width, int height, int radius) {
  std::vector<float> line;
  const auto blurLine = [&](std::size_t start, std::size_t step, int count) {
    line.resize(static_cast<std::size_t>(count));
    for (int k = 0; k < count; ++k)
      line[static_cast<std::size_t>(k)] = values[start + step * static_cast<std::size_t>(k)];
    float sum = 0;
    for (int k = -radius; k < count + radius; ++k) {
      if (k + radius < count && k + radius >= 0) sum += line[static_cast<std::size_t>(k + radius)];
      if (k - radius - 1 >= 0 && k - radius - 1 < count) sum -= line[static_cast<std::size_t>(k - radius - 1)];
      if (k >= 0 && k < count) {
        values[start + step * static_cast<std::size_t>(k)] = sum / static_cast<float>(2 * radius + 1);
      }
    }
  };
  for (int y = 0; y < height; ++y) blurLine(static_cast<std::size_t>(y) * static_cast<std::size_t>(width), 1, width);
  for (int x = 0; x < width; ++x) blurLine(static_cast<std::size_t>(x), static_cast<std::size_t>(width), height);
}

}  // namespace

Shadow shadowOf(const Toolpath& toolpath, Vec2 page, const Layout& layout) {
  Shadow shadow;
  const int panelWidth = layout.look.width;
  shadow.cell = std::max(1, panelWidth / 400);
  const int blur = std::max(1, panelWidth / shadow.cell / 70);
  const int pageWidth = (layout.look.width + shadow.cell - 1) / shadow.cell;
  const int pageHeight = (layout.look.height + shadow.cell - 1) / shadow.cell;
  shadow.border = 4 * blur;
  shadow.width = pageWidth + 2 * shadow.border;
  shadow.height = pageHeight + 2 * shadow.border;
  shadow.dark.assign(static_cast<std::size_t>(shadow.width) * static_cast<std::size_t>(shadow.height), 0);

  const std::vector<Bead> beads = beadsOf(toolpath, page, layout.pixelsPerMm / shadow.cell, Wanted::Outlines);
  Hits hits;
  hits.clear(pageWidth, pageHeight);
  for (const Bead& bead : beads) rasterise(bead, 0, 0, pageHeight, pageWidth, hits);
  for (int y = 0; y < pageHeight; ++y) {
    for (int x = 0; x < pageWidth; ++x) {
      const std::size_t from =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(pageWidth) + static_cast<std::size_t>(x);
      const std::size_t to = static_cast<std::size_t>(y + shadow.border) * static_cast<std::size_t>(shadow.width) +
                             static_cast<std::size_t>(x + shadow.border);
      shadow.dark[to] = hits.squaredOffset[from] < 1 ? 1.0f : 0.0f;
    }
  }
  for (int pass = 0; pass < 3; ++pass) boxBlur(shadow.dark, shadow.width, shadow.height, blur);
  return shadow;
}

float shadowAt(const Shadow& shadow, float x, float y) {
  const float u = x / static_cast<float>(shadow.cell) + static_cast<float>(shadow.border) - 0.5f;
  const float v = y / static_cast<float>(shadow.cell) + static_cast<float>(shadow.border) - 0.5f;
  if (!(u >= 0 && v >= 0 && u < static_cast<float>(shadow.width - 1) && v < static_cast<float>(shadow.height - 1)))
    return 0;
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const float fu = u - static_cast<float>(i), fv = v - static_cast<float>(j);
  const float* row =
      &shadow.dark[static_cast<std::size_t>(j) * static_cast<std::size_t>(shadow.width) + static_cast<std::size_t>(i)];
  const float* below = row + shadow.width;
  return (row[0] * (1 - fu) + row[1] * fu) * (1 - fv) + (below[0] * (1 - fu) + below[1] * fu) * fv;
}

}  // namespace sillon
