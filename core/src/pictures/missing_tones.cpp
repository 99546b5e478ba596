#include "look/rasters.hpp"
#include "pictures/parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sillon {
namespace {

constexpr float kShare = 0.25f;  // share that is added; more overshoots, as beads end elsewhere the next time
constexpr int kSteps = 360;      // directions among which the darkest one is sought

/// Blurs along one axis by a Gaussian of half a cell; beyond the border nothing is counted.
void blurLines(std::vector<float>& values, std::size_t lines, std::size_t lineStep, int count, std::size_t step) {
  constexpr float kWeights[] = {1, 0.135f};
  constexpr int kRadius = 1;
  std::vector<float> line(count);
  for (std::size_t j = 0; j < lines; ++j) {
    float* first = values.data() + j * lineStep;
    for (int k = 0; k < count; ++k) {
      float sum = 0, weight = 0;
      for (int d = std::max(-kRadius, -k); d <= std::min(kRadius, count - 1 - k); ++d) {
        const float w = kWeights[std::abs(d)];
        sum += w * first[(k + d) * step];
        weight += w;
      }
      line[k] = sum / weight;
    }
    for (int k = 0; k < count; ++k) first[k * step] = line[k];
  }
}

/// Place of a texel between two cells, for linear interpolation: both indices and the share of the right one.
struct Between {
  int left = 0;
  int right = 0;
  float share = 0;
};

Between cellsAt(int texel, int texels, int cells) {
  const float place =
      (static_cast<float>(texel) + 0.5f) * static_cast<float>(cells) / static_cast<float>(texels) - 0.5f;
  const float inside = std::clamp(place, 0.0f, static_cast<float>(cells - 1));
  const int left = static_cast<int>(inside);
  return {left, std::min(left + 1, cells - 1), inside - static_cast<float>(left)};
}

}  // namespace

void addMissingTones(std::span<const float> light, const Tones& asked, const Lobe& lobe, double level, Tones& next) {
  const std::vector<float> table = lightTable(lobe, kSteps);
  const float low = codeOfLight(*std::min_element(table.begin(), table.end()));
  const float range = std::max(1e-3f, codeOfLight(static_cast<float>(level)) - low);
  std::vector<float> missing(light.size(), 0);
  for (std::size_t k = 0; k < light.size(); ++k) {
    if (light[k] >= 0) missing[k] = asked.value[k] - (codeOfLight(light[k]) - low) / range;
  }
  const std::size_t columns = asked.width, rows = asked.height;
  blurLines(missing, rows, columns, asked.width, 1);
  blurLines(missing, columns, 1, asked.height, columns);
  const auto at = [&](int x, int y) { return missing[y * columns + x]; };
  for (int y = 0; y < next.height; ++y) {
    const Between row = cellsAt(y, next.height, asked.height);
    for (int x = 0; x < next.width; ++x) {
      const Between column = cellsAt(x, next.width, asked.width);
      const float above = at(column.left, row.left) * (1 - column.share) + at(column.right, row.left) * column.share;
      const float below = at(column.left, row.right) * (1 - column.share) + at(column.right, row.right) * column.share;
      float& tone = next.value[indexOf(x, y, next.width)];
      tone = std::clamp(tone + kShare * (above * (1 - row.share) + below * row.share), 0.0f, 1.0f);
    }
  }
}

}  // namespace sillon
