#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/refused.hpp"
#include "geometry/shape_points.hpp"
#include "geometry/signed_distance.hpp"
#include "geometry/straightened.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {
namespace {

constexpr double kFinest = 0.02;   // smallest side of the samples' cells [mm]
constexpr double kCoarsest = 0.1;  // largest side, except for the largest shapes [mm]
constexpr double kMostSamples = 4e6;
constexpr double kTolerance = 0.0005;  // largest distance of omitted points from the outline [mm]
constexpr double kLongest = 1e5;       // limit on straight pieces, practically none [mm]
constexpr int kMargin = 3;             // margin around the new outline [cells]

/// Returns the samples that cover the new outline, a margin included.
Grid samplesAround(const Bounds& box, double offset) {
  const double grow = std::max(0.0, offset);
  const Vec2 size = box.size() + Vec2{2 * grow, 2 * grow};
  Grid grid;
  grid.cell = std::clamp(std::abs(offset) / 8, kFinest, kCoarsest);
  grid.cell = std::max(grid.cell, std::sqrt(size.x * size.y / kMostSamples));
  grid.nx = static_cast<int>(size.x / grid.cell) + 2 * kMargin + 1;
  grid.ny = static_cast<int>(size.y / grid.cell) + 2 * kMargin + 1;
  grid.origin = box.min - Vec2{grow + kMargin * grid.cell, grow + kMargin * grid.cell};
  return grid;
}

/// Makes a mask whose outline lies at the distance `offset`; its grey falls over four samples with the distance.
Image levelMask(const Grid& grid, const std::vector<float>& distance, double offset) {
  constexpr double kHalf = 32767.5;
  Image mask;
  mask.width = grid.nx;
  mask.height = grid.ny;
  mask.channels = 1;
  mask.samples.resize(grid.size());
  for (int y = 0; y < grid.ny; ++y) {
    for (int x = 0; x < grid.nx; ++x) {
      const double depth = (offset - static_cast<double>(distance[grid.index(x, y)])) / (2 * grid.cell);
      mask.samples[grid.index(x, grid.ny - 1 - y)] =  // a mask has row 0 on top
          static_cast<std::uint16_t>(std::round(kHalf * (1 + std::clamp(depth, -1.0, 1.0))));
    }
  }
  return mask;
}

/// Makes the error for an offset that leaves nothing. \param distance  distances of samples, whose lowest tells the
/// shape's depth.
Error nothingLeft(double offset, const std::vector<float>& distance) {
  const double deepest = -static_cast<double>(*std::min_element(distance.begin(), distance.end()));
  return refused(ErrorCode::EmptyShape, "OffsetTooDeep",
                 {{"offset", offset}, {"depth", std::ceil(10 * deepest - 1e-3) / 10}});
}

}  // namespace

Result<Shape> offsetShape(Shape shape, double offset, const RunContext& run) {
  if (!(offset >= -20 && offset <= 50)) {  // false for NaN
    return outOfRange("shape.offset", offset, -20, 50, "mm");
  }
  if (offset == 0) return shape;
  const Result<Outline> outline = resolveOutline(shape);
  if (!outline) return outline.error();
  const Grid grid = samplesAround(outline.value().bounds, offset);
  // The index has blocks twice as large as the samples' grid would give: fewer blocks take less time with a detailed
  // border.
  const Grid coarse{grid.origin, 2 * grid.cell, grid.nx / 2 + 1, grid.ny / 2 + 1};
  const Result<BorderIndex> border = buildBorderIndex(outline.value(), coarse, run);
  if (!border) return border.error();
  const auto band = static_cast<float>(std::abs(offset) + 3 * grid.cell);
  const Result<std::vector<float>> distance = bandDistance(shape, border.value(), grid, band, run);
  if (!distance) return distance.error();

  const double width = grid.nx * grid.cell;
  Result<Shape> traced = shapeFromMask(levelMask(grid, distance.value(), offset), width);
  if (!traced && traced.error().code == ErrorCode::EmptyShape) return nothingLeft(offset, distance.value());
  if (!traced) return traced.error();
  const double grow = std::max(0.0, offset);
  const Vec2 shift = grid.origin + Vec2{grow, grow};
  FilledPath path;
  for (const FilledPath& one : traced.value().paths) {
    for (const Ring& ring : one.rings) {
      Ring points = straightened(ring, kTolerance, kLongest);
      for (Vec2& p : points) p = snapped(p + shift);
      dropRepeatedPoints(points);
      if (points.size() >= 3) path.rings.push_back(std::move(points));
    }
  }
  shape.paths = {std::move(path)};
  shape.page = snapped(shape.page + Vec2{2 * grow, 2 * grow});
  return shape;
}

}  // namespace sillon
