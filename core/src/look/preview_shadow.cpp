#include "look/preview_parts.hpp"

namespace sillon {
namespace {

// Mean over 2 * radius + 1 cells along both axes, as a running sum: the radius costs nothing.
void boxBlur(std::vector<float>& values, int width, int height, int radius) {
  std::vector<float> line;  // a copy of one line with zeros before and after it
  const auto blurLine = [&](float* first, std::ptrdiff_t step, int count) {
    line.assign(count + 2 * radius, 0);
    float* const middle = line.data() + radius;
    for (int k = 0; k < count; ++k) middle[k] = first[step * k];
    const float share = 1 / static_cast<float>(2 * radius + 1);
    // Each step takes one value in and leaves one out.
    float sum = 0;
    for (int k = -radius; k < radius; ++k) sum += middle[k];
    for (int k = 0; k < count; ++k) {
      sum += middle[k + radius];
      first[step * k] = sum * share;
      sum -= middle[k - radius];
    }
  };
  for (int y = 0; y < height; ++y) blurLine(&values[indexOf(0, y, width)], 1, width);
  for (int x = 0; x < width; ++x) blurLine(&values[x], width, height);
}

}  // namespace

// Counts the covered samples of each coarse cell, and blurs three times.
Shadow shadowOf(const std::vector<std::uint8_t>& covered, int samples, const PixelBox& page) {
  Shadow shadow;
  // Coarse cells, 400 to 800 across a large page, are enough, as the shadow is soft.
  shadow.cell = std::max(1, page.width / 400);
  const int blur = std::max(1, page.width / shadow.cell / 70);
  // Three blurs reach three radii beyond the page.
  shadow.border = 4 * blur;
  shadow.width = (page.width - 1) / shadow.cell + 1 + 2 * shadow.border;
  shadow.height = (page.height - 1) / shadow.cell + 1 + 2 * shadow.border;
  shadow.dark.assign(cellCount(shadow.width, shadow.height), 0);
  const float share = 1 / static_cast<float>(shadow.cell * shadow.cell * samples);
  const std::uint8_t* pixel = covered.data();
  // Each pixel adds the share of its samples that the plate covers.
  for (int y = 0; y < page.height; ++y) {
    float* const row = &shadow.dark[indexOf(shadow.border, y / shadow.cell + shadow.border, shadow.width)];
    for (int x = 0; x < page.width; ++x) row[x / shadow.cell] += static_cast<float>(*pixel++) * share;
  }
  for (int pass = 0; pass < 3; ++pass) boxBlur(shadow.dark, shadow.width, shadow.height, blur);
  return shadow;
}

// Bilinear between cell centres; nothing beyond the border.
float shadowAt(const Shadow& shadow, float x, float y) {
  const float u = x / static_cast<float>(shadow.cell) + static_cast<float>(shadow.border) - 0.5f;
  const float v = y / static_cast<float>(shadow.cell) + static_cast<float>(shadow.border) - 0.5f;
  if (!(u >= 0 && v >= 0 && u < static_cast<float>(shadow.width - 1) && v < static_cast<float>(shadow.height - 1)))
    return 0;
  const int i = static_cast<int>(u);
  const int j = static_cast<int>(v);
  const float fu = u - static_cast<float>(i);
  const float fv = v - static_cast<float>(j);
  const float* row = &shadow.dark[indexOf(i, j, shadow.width)];
  const float* below = row + shadow.width;
  return (row[0] * (1 - fu) + row[1] * fu) * (1 - fv) + (below[0] * (1 - fu) + below[1] * fu) * fv;
}

}  // namespace sillon
