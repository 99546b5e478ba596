// Computes directions along the edges of a picture: main directions of its structure tensor, spread from strong edges
// into flat areas.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "compose/kinds/tones.hpp"
#include "look/rasters.hpp"

namespace sillon {
namespace {

constexpr int kMostEdgeCells = 512;  // on the longer side; the field is smooth, finer cells only take longer
constexpr float kNoiseBlur = 1;      // blur before slopes are taken [cells]
constexpr float kFlat = 1e-9F;       // squared slope up to which an area counts as flat; rounding causes as much
constexpr int kSweeps = 4;
constexpr int kSmallestSide = 2;

/// Field of lines as e^(2i angle) of any length, with the weight of each.
struct WeightedLines {
  Tones x, y;
  Tones weight;
};

/// Computes the directions of steepest ascent; the length of each vector is the squared slope.
WeightedLines slopesOf(const Tones& tones, float tall) {
  WeightedLines slopes{tones, tones, tones};
  const int width = tones.width, height = tones.height;
  for (int row = 0; row < height; ++row) {
    const int above = std::max(0, row - 1), below = std::min(height - 1, row + 1);
    for (int column = 0; column < width; ++column) {
      const int before = std::max(0, column - 1), after = std::min(width - 1, column + 1);
      const float run = static_cast<float>(std::max(1, after - before));
      const float rise = static_cast<float>(std::max(1, below - above)) * tall;
      const float right = (tones.at(after, row) - tones.at(before, row)) / run;
      const float up = (tones.at(column, above) - tones.at(column, below)) / rise;
      const std::size_t k = indexOf(column, row, width);
      slopes.x.value[k] = right * right - up * up;
      slopes.y.value[k] = 2 * right * up;
    }
  }
  return slopes;
}

/// Turns slopes into unit lines along the edges, weighted by their steepness relative to the mean.
void weigh(WeightedLines& field) {
  std::vector<float>&x = field.x.value, &y = field.y.value;
  std::vector<float> steep(x.size());
  double sum = 0;
  for (std::size_t k = 0; k < x.size(); ++k) sum += steep[k] = std::sqrt(x[k] * x[k] + y[k] * y[k]);
  const auto mean = static_cast<float>(sum / static_cast<double>(x.size()));
  for (std::size_t k = 0; k < x.size(); ++k) {
    field.weight.value[k] = 0;
    if (steep[k] <= kFlat) continue;
    field.weight.value[k] = steep[k] * steep[k] / (steep[k] * steep[k] + mean * mean);
    x[k] /= -steep[k];  // an edge is at 90 degrees to its slope: doubled, the opposite
    y[k] /= -steep[k];
  }
}

/// Shrinks a field to fewer cells by weighted means.
WeightedLines shrunk(const WeightedLines& field, int width, int height) {
  WeightedLines small;
  small.weight = means(field.weight, width, height);
  const auto mean = [&](Tones values) {
    for (std::size_t k = 0; k < values.value.size(); ++k) values.value[k] *= field.weight.value[k];
    values = means(values, width, height);
    for (std::size_t k = 0; k < values.value.size(); ++k) {
      const float weight = small.weight.value[k];
      values.value[k] = weight > 0 ? values.value[k] / weight : 0;
    }
    return values;
  };
  small.x = mean(field.x);
  small.y = mean(field.y);
  return small;
}

/// Moves each cell to the mean of its neighbours and, by its weight, of its given value: one Gauss-Seidel sweep.
void sweep(Tones& values, const Tones& told, const Tones& weight) {
  const int width = values.width, height = values.height;
  for (int y = 0; y < height; ++y) {
    const std::size_t row = indexOf(0, y, width);
    for (int x = 0; x < width; ++x) {
      const float around = values.at(x, std::max(0, y - 1)) + values.at(x, std::min(height - 1, y + 1)) +
                           values.at(std::max(0, x - 1), y) + values.at(std::min(width - 1, x + 1), y);
      const std::size_t k = row + x;
      const float pull = 8 * weight.value[k];
      values.value[k] = (around + pull * told.value[k]) / (4 + pull);
    }
  }
}

/// Spreads vectors over cells without weight, from coarse levels to fine ones. Each level is smoothed and
/// pulled towards the given values.
void spread(WeightedLines& field) {
  const WeightedLines told = field;
  const int width = told.x.width, height = told.x.height;
  if (std::max(width, height) > kSmallestSide) {
    field = shrunk(told, (width + 1) / 2, (height + 1) / 2);
    spread(field);
  }
  const auto settle = [&](Tones& values, const Tones& wanted) {
    values = means(values, width, height);
    for (std::size_t k = 0; k < values.value.size(); ++k) {
      const float certain = std::min(1.0F, told.weight.value[k]);
      values.value[k] += (wanted.value[k] - values.value[k]) * certain;
    }
    for (int round = 0; round < kSweeps; ++round) sweep(values, wanted, told.weight);
  };
  settle(field.x, told.x);
  settle(field.y, told.y);
}

/// Interpolates bilinearly between the middles of the four cells around a place.
/// \param x  cells from the left edge
/// \param y  cells from the top
float between(const Tones& values, double x, double y) {
  const auto inside = [](double place, int count) { return std::clamp(place - 0.5, 0.0, count - 1.0); };
  const double left = inside(x, values.width), top = inside(y, values.height);
  const int column = static_cast<int>(left), row = static_cast<int>(top);
  const int next = std::min(column + 1, values.width - 1), below = std::min(row + 1, values.height - 1);
  const auto across = static_cast<float>(left - column), down = static_cast<float>(top - row);
  const float upper = values.at(column, row) * (1 - across) + values.at(next, row) * across;
  const float lower = values.at(column, below) * (1 - across) + values.at(next, below) * across;
  return upper * (1 - down) + lower * down;
}

}  // namespace

LineAt edgeLines(const TonesLayer& tones, const LayerContent& content, const Placement& place, double spacing) {
  const BoxCells cells = cellsOn(content.size, spacing, kMostEdgeCells);
  const auto blur = [&](Tones& values, double sigma) {
    if (sigma > 0.1) {
      values.value = blurred(std::move(values.value), values.width, values.height, static_cast<float>(sigma));
    }
  };
  Tones read = means(tonesOf(*content.picture), cells.width, cells.height);
  blur(read, kNoiseBlur);
  // The box has whole numbers of cells, which are therefore only nearly square.
  WeightedLines field =
      slopesOf(read, static_cast<float>(content.size.y / cells.height * cells.width / content.size.x));
  blur(field.x, tones.smoothing / cells.cell);
  blur(field.y, tones.smoothing / cells.cell);
  weigh(field);
  spread(field);
  field.weight = {};
  const Vec2f turn = lineOf(place.rotation() + tones.angle * kDegree);
  return [kept = std::make_shared<const WeightedLines>(std::move(field)), place, box = content.size, turn](Vec2 at) {
    const Vec2 own = place.toOwn(at);
    const double x = (own.x / box.x + 0.5) * kept->x.width, y = (0.5 - own.y / box.y) * kept->x.height;
    const Vec2f line{between(kept->x, x, y), between(kept->y, x, y) * (place.mirror() ? -1.0F : 1.0F)};
    const float square = dot(line, line);
    if (!(square > 0)) return turn;
    const Vec2f unit = line * (1 / std::sqrt(square));
    return Vec2f{unit.x * turn.x - unit.y * turn.y, unit.x * turn.y + unit.y * turn.x};
  };
}

}  // namespace sillon
