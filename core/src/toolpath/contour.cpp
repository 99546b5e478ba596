#include "sillon/toolpath/contour.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/fast_math.hpp"
#include "base/parallel_for.hpp"

namespace sillon {
namespace {

// Positions stay off the nodes, so that vertices of touching edges never coincide, not even on 1 µm.
constexpr float kMinRoot = 0.03f;

float rootBetween(float a, float b, bool onPhase) {
  if (onPhase) {
    a = asinApprox(a);
    b = asinApprox(b);
  }
  if (std::abs(b - a) < 1e-4f) return 0.5f;
  return std::clamp(a / (a - b), kMinRoot, 1 - kMinRoot);
}

struct Lattice {
  const Grid& grid;
  const float* values;
  const float* distance;
  float inner;  ///< distances below this carry waves

  [[nodiscard]] bool positive(int x, int y) const { return values[grid.index(x, y)] >= 0; }
  [[nodiscard]] bool crossesRight(int x, int y) const { return positive(x, y) != positive(x + 1, y); }
  [[nodiscard]] bool crossesUp(int x, int y) const { return positive(x, y) != positive(x, y + 1); }

  [[nodiscard]] Vec2f vertex(int x0, int y0, int x1, int y1) const {
    const std::size_t i = grid.index(x0, y0);
    const std::size_t j = grid.index(x1, y1);
    const double u = rootBetween(values[i], values[j], distance[i] < inner && distance[j] < inner);
    const Vec2 a = grid.centre(x0, y0);
    const Vec2 b = grid.centre(x1, y1);
    return {static_cast<float>(a.x + u * (b.x - a.x)), static_cast<float>(a.y + u * (b.y - a.y))};
  }
};

// Vertices are numbered row by row: first the edges along the row, then those up to the next.
struct RowNumbers {
  std::vector<int> along;  ///< vertex on (x, y)-(x + 1, y)
  std::vector<int> up;     ///< vertex on (x, y)-(x, y + 1)
  int next = 0;

  explicit RowNumbers(int nx) : along(static_cast<std::size_t>(nx), -1), up(static_cast<std::size_t>(nx), -1) {}

  void number(const Lattice& lattice, int y, int first) {
    next = first;
    const int nx = lattice.grid.nx;
    for (int x = 0; x + 1 < nx; ++x) along[static_cast<std::size_t>(x)] = lattice.crossesRight(x, y) ? next++ : -1;
    if (y + 1 >= lattice.grid.ny) return;
    for (int x = 0; x < nx; ++x) up[static_cast<std::size_t>(x)] = lattice.crossesUp(x, y) ? next++ : -1;
  }
};

// Links the vertices of one square so that positive corners lie on the left. Going round counter-clockwise, a curve
// enters where the sign falls and leaves where it rises.
void linkSquare(const Lattice& lattice, int x, int y, int bottom, int right, int top, int left,
                std::vector<int>& next) {
  const auto link = [&](int from, int to) { next[static_cast<std::size_t>(from)] = to; };
  const bool bl = lattice.positive(x, y);
  if (bottom >= 0 && right >= 0 && top >= 0 && left >= 0) {
    const Grid& g = lattice.grid;
    const float mean = lattice.values[g.index(x, y)] + lattice.values[g.index(x + 1, y)] +
                       lattice.values[g.index(x, y + 1)] + lattice.values[g.index(x + 1, y + 1)];
    const bool joinsLowerLeft = (mean >= 0) == bl;
    if (bl) {
      link(bottom, joinsLowerLeft ? right : left);
      link(top, joinsLowerLeft ? left : right);
    } else {
      link(right, joinsLowerLeft ? bottom : top);
      link(left, joinsLowerLeft ? top : bottom);
    }
    return;
  }
  int from = -1;
  int to = -1;
  const bool br = lattice.positive(x + 1, y);
  const bool tl = lattice.positive(x, y + 1);
  if (bottom >= 0) (bl ? from : to) = bottom;
  if (right >= 0) (br ? from : to) = right;
  if (top >= 0) (tl ? to : from) = top;
  if (left >= 0) (bl ? to : from) = left;
  if (from >= 0) link(from, to);
}

}  // namespace

Result<ClosedCurves> contourCycles(const Grid& grid, const std::vector<float>& values,
                                   const std::vector<float>& distance, double spacing, const RunContext& run) {
  const Lattice lattice{grid, values.data(), distance.data(), static_cast<float>(-0.5 * spacing)};

  std::vector<std::int64_t> first(static_cast<std::size_t>(grid.ny) + 1, 0);
  const int grain = rowGrain(run, grid.ny, 6.0 * grid.nx);
  parallelFor(run, grid.ny, grain, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      std::int64_t count = 0;
      for (int x = 0; x + 1 < grid.nx; ++x) count += lattice.crossesRight(x, y) ? 1 : 0;
      if (y + 1 < grid.ny) {
        for (int x = 0; x < grid.nx; ++x) count += lattice.crossesUp(x, y) ? 1 : 0;
      }
      first[static_cast<std::size_t>(y) + 1] = count;
    }
  });
  for (std::size_t y = 1; y < first.size(); ++y) first[y] += first[y - 1];
  const std::int64_t total = first.back();
  if (total > INT32_MAX / 2) {
    return Error{ErrorCode::TooLarge, "the plate needs more than a thousand million path points; use a larger spacing"};
  }

  std::vector<Vec2f> vertices(static_cast<std::size_t>(total));
  std::vector<int> next(static_cast<std::size_t>(total), -1);
  parallelFor(run, grid.ny - 1, grain, [&](int begin, int end) {
    RowNumbers row(grid.nx);
    RowNumbers above(grid.nx);
    row.number(lattice, begin, static_cast<int>(first[static_cast<std::size_t>(begin)]));
    for (int y = begin; y < end; ++y) {
      above.number(lattice, y + 1, static_cast<int>(first[static_cast<std::size_t>(y) + 1]));
      for (int x = 0; x < grid.nx; ++x) {
        const std::size_t i = static_cast<std::size_t>(x);
        if (row.up[i] >= 0) vertices[static_cast<std::size_t>(row.up[i])] = lattice.vertex(x, y, x, y + 1);
        if (x + 1 == grid.nx) continue;
        if (row.along[i] >= 0) vertices[static_cast<std::size_t>(row.along[i])] = lattice.vertex(x, y, x + 1, y);
        if (row.along[i] >= 0 || row.up[i] >= 0 || above.along[i] >= 0) {
          linkSquare(lattice, x, y, row.along[i], row.up[i + 1], above.along[i], row.up[i], next);
        }
      }
      std::swap(row, above);
    }
  });
  if (run.cancelled()) return Error{ErrorCode::Cancelled, "the run was cancelled"};

  ClosedCurves cycles;
  cycles.points.reserve(vertices.size());
  for (std::size_t start = 0; start < next.size(); ++start) {
    if (next[start] < 0) continue;
    if (run.cancelled()) return Error{ErrorCode::Cancelled, "the run was cancelled"};
    cycles.begin.push_back(static_cast<int>(cycles.points.size()));
    for (std::size_t i = start; next[i] >= 0;) {
      cycles.points.push_back(vertices[i]);
      const int to = next[i];
      next[i] = -1;
      i = static_cast<std::size_t>(to);
    }
  }
  cycles.begin.push_back(static_cast<int>(cycles.points.size()));
  return cycles;
}

}  // namespace sillon
