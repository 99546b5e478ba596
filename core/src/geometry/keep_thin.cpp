#include "geometry/parts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/refused.hpp"
#include "base/sort_key.hpp"
#include "geometry/bead_room.hpp"
#include "geometry/shape_points.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {
namespace {

constexpr double kThinnest = 0.5;   // width from which on a place is kept [tau]
constexpr double kOpposite = -0.5;  // largest cosine between the walls' normals: parallel within 60 degrees
// Radius of the discs [tau]: a tenth more than half a spacing, so that a bead that runs there and back need not be
// narrower than allowed. Discs one sample apart meet at that width.
constexpr double kRadius = 0.5535;
constexpr double kInside = 32767.5;  // grey level of a mask's outline, half of 65535

struct Middle {
  Vec2 at;
  double radius = 0;  ///< radius of the largest disc there [mm]
};

/// Returns the largest disc that touches the border at the point nearest to a sample (an atom of the medial axis).
/// Nothing if the place is too thin, wide enough for a bead, or a corner.
std::optional<Middle> middleAt(const BorderIndex& border, Vec2 sample, double depth, double spacing) {
  const TouchingDiscs discs(border, sample, spacing);
  const double bead = 0.5 * spacing;
  if (depth >= bead || discs.fits(bead)) return std::nullopt;
  const double radius = discs.largest(depth, bead, 20);
  if (radius < 0.5 * kThinnest * spacing - 1e-4 * spacing) return std::nullopt;
  if (discs.facing(radius + 1e-3 * spacing) > kOpposite) return std::nullopt;
  return Middle{discs.centre(radius), radius};
}

/// A mask whose outline encloses discs. Its grey falls from inside to outside over four samples with the distance from
/// the nearest centre.
class DiscMask {
 public:
  DiscMask(const Grid& grid, double radius) : grid_(grid), radius_(radius) {
    mask_.width = grid.nx;
    mask_.height = grid.ny;
    mask_.channels = 1;
    mask_.samples.assign(grid.size(), 0);
  }

  /// Adds a disc.
  void add(Vec2 centre) {
    const double reach = radius_ + 2 * grid_.cell;
    const auto first = [&](double at, double low) { return static_cast<int>((at - reach - low) / grid_.cell); };
    const auto last = [&](double at, double low) { return static_cast<int>((at + reach - low) / grid_.cell); };
    for (int y = std::max(0, first(centre.y, grid_.origin.y));
         y <= std::min(grid_.ny - 1, last(centre.y, grid_.origin.y)); ++y) {
      for (int x = std::max(0, first(centre.x, grid_.origin.x));
           x <= std::min(grid_.nx - 1, last(centre.x, grid_.origin.x)); ++x) {
        const double depth = (radius_ - length(grid_.centre(x, y) - centre)) / (2 * grid_.cell);  // only -1..1 matters
        const double level = std::round(kInside * (1 + std::clamp(depth, -1.0, 1.0)));
        std::uint16_t& sample = mask_.samples[index(x, y)];
        sample = std::max(sample, static_cast<std::uint16_t>(level));
      }
    }
  }
  [[nodiscard]] bool covers(std::size_t sample) const {
    const std::size_t nx = grid_.nx;
    return mask_.samples[index(static_cast<int>(sample % nx), static_cast<int>(sample / nx))] > kInside;
  }
  [[nodiscard]] Result<Shape> outline() const { return shapeFromMask(mask_, grid_.nx * grid_.cell); }

 private:
  [[nodiscard]] std::size_t index(int x, int y) const { return grid_.index(x, grid_.ny - 1 - y); }  // row 0 on top

  const Grid& grid_;
  double radius_;
  Image mask_;
};

}  // namespace

Result<Shape> keepThinPlaces(Shape shape, double spacing, const RunContext& run) {
  if (!(spacing >= 0.05 && spacing <= 20)) {  // false for NaN
    return outOfRange("toolpath.spacing", spacing, 0.05, 20, "mm");
  }
  const Result<Outline> outline = resolveOutline(shape);
  if (!outline) return outline.error();
  const Result<BorderIndex> border = buildBorderIndex(outline.value(), makeGrid(outline.value().bounds, spacing), run);
  if (!border) return border.error();
  const Result<LostCells> found = lostCells(shape, border.value(), outline.value().bounds, spacing, run);
  if (!found) return found.error();
  const LostCells& cells = found.value();
  if (cells.places.empty()) return shape;

  DiscMask discs(cells.grid, kRadius * spacing);
  std::vector<ThinPlace> kept;
  for (const std::vector<std::size_t>& place : cells.places) {
    ThinPlace widest;
    for (const std::size_t sample : place) {
      // Each middle has a sample nearer than half a cell's diagonal.
      const double depth = -static_cast<double>(cells.distance[sample]);
      if (depth < 0.5 * kThinnest * spacing - 0.75 * cells.grid.cell) continue;
      const std::optional<Middle> middle = middleAt(border.value(), cells.at(sample), depth, spacing);
      if (!middle) continue;
      discs.add(middle->at);
      if (2 * middle->radius > widest.width) widest = {middle->at, 0, 2 * middle->radius};
    }
    if (widest.width == 0) continue;
    const auto covered = std::count_if(place.begin(), place.end(), [&](std::size_t k) { return discs.covers(k); });
    widest.areaMm2 = static_cast<double>(covered) * cells.grid.cell * cells.grid.cell;
    kept.push_back(widest);
  }
  if (kept.empty()) return shape;
  Result<Shape> added = discs.outline();
  if (!added) return added.error();
  movePoints(added.value(), [&](Vec2 p) { return p + cells.grid.origin; });
  for (FilledPath& path : added.value().paths) shape.paths.push_back(std::move(path));
  sortBy(kept, [](const ThinPlace& place) { return -place.areaMm2; });
  shape.kept = std::move(kept);
  return shape;
}

}  // namespace sillon
