#include "look/rasters.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sillon {
namespace {

/// Samples of one axis that make one sample of another raster: their weights, from `first` on.
struct SampleWeights {
  int first = 0;
  std::vector<float> weights;
};

/// Weights from `from` samples to `to`: linear interpolation where there are more, box means where there are fewer.
std::vector<SampleWeights> spansOf(int from, int to) {
  std::vector<SampleWeights> spans(to);
  const double step = static_cast<double>(from) / to;
  for (int k = 0; k < to; ++k) {
    SampleWeights& span = spans[k];
    // Enlarging: between the two nearest centres, clamped at the ends.
    if (step <= 1) {
      const double place = std::clamp((k + 0.5) * step - 0.5, 0.0, from - 1.0);
      span.first = std::min(static_cast<int>(place), std::max(0, from - 2));
      const auto share = static_cast<float>(place - span.first);
      span.weights = {1 - share};
      if (from > 1) span.weights.push_back(share);
      continue;
    }
    // Reducing: the share of each source that the new sample covers.
    const double begin = k * step;
    const double end = std::min<double>(from, (k + 1) * step);
    span.first = static_cast<int>(begin);
    for (int i = span.first; i < from && i < end; ++i) {
      span.weights.push_back(
          static_cast<float>((std::min<double>(i + 1, end) - std::max<double>(i, begin)) / (end - begin)));
    }
  }
  return spans;
}

/// An exponential forwards and then backwards along one line, which makes it symmetric.
void blurLine(float* first, std::size_t step, std::size_t count, float share, std::vector<float>& line) {
  // Forwards into `line`, and back over it; each run begins at the value where it starts, so that edges stay as they
  // are.
  line.resize(count);
  float v = first[0];
  for (std::size_t k = 0; k < count; ++k) line[k] = v += share * (first[step * k] - v);
  for (std::size_t k = count; k-- > 0;) first[step * k] = v += share * (line[k] - v);
}

}  // namespace

// Two passes of symmetric exponentials along each axis are nearly Gaussian, and cost the same for every sigma.
std::vector<float> blurred(std::vector<float> values, int width, int height, float sigma) {
  // The share with which the four exponentials together have the variance of the Gaussian.
  const float share = 2 * (std::sqrt(1 + sigma * sigma) - 1) / (sigma * sigma);
  const std::size_t columns = width;
  const std::size_t rows = height;
  std::vector<float> line;
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t y = 0; y < rows; ++y) blurLine(&values[y * columns], 1, columns, share, line);
    for (std::size_t x = 0; x < columns; ++x) blurLine(&values[x], columns, rows, share, line);
  }
  return values;
}

// The two axes are separable: sums over rows first, then over columns.
Tones means(const Tones& values, int width, int height) {
  if (values.width == width && values.height == height) return values;
  const std::vector<SampleWeights> columns = spansOf(values.width, width), rows = spansOf(values.height, height);
  Tones out{width, height, {}};
  out.value.resize(cellCount(width, height));
  std::vector<float> line(values.width);
  for (int y = 0; y < height; ++y) {
    const SampleWeights& row = rows[y];
    std::fill(line.begin(), line.end(), 0.0f);
    for (std::size_t j = 0; j < row.weights.size(); ++j) {
      for (int x = 0; x < values.width; ++x) {
        line[x] += row.weights[j] * values.at(x, row.first + static_cast<int>(j));
      }
    }
    for (int x = 0; x < width; ++x) {
      const SampleWeights& column = columns[x];
      float sum = 0;
      for (std::size_t i = 0; i < column.weights.size(); ++i) {
        sum += column.weights[i] * line[column.first + i];
      }
      out.value[indexOf(x, y, width)] = sum;
    }
  }
  return out;
}

}  // namespace sillon
