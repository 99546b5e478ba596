#include "sillon/export/export.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/parallel_for.hpp"
#include "base/refused.hpp"
#include "export/zone_parts.hpp"
#include "export/zones.hpp"
#include "geometry/outline.hpp"
#include "input/map_defect.hpp"
#include "toolpath/path.hpp"

namespace sillon {
namespace {

constexpr double kFinest = 0.15;    // [mm], smallest side of a cell
constexpr double kMostCells = 1e6;  // cells of a page at most
constexpr double kBorder = 1;       // [mm] beyond the page

// Samples a map of directions on the cells of a page.
DirectionPicture rastered(const Shape& shape, const DirectionMap& map) {
  DirectionPicture picture;
  Grid& grid = picture.grid;
  const Vec2 size = shape.page + Vec2{2 * kBorder, 2 * kBorder};
  grid.cell = std::max(kFinest, std::sqrt(size.x * size.y / kMostCells));
  grid.nx = std::max(1, static_cast<int>(std::ceil(size.x / grid.cell)));
  grid.ny = std::max(1, static_cast<int>(std::ceil(size.y / grid.cell)));
  grid.origin = 0.5 * shape.page - 0.5 * grid.cell * Vec2{static_cast<double>(grid.nx), static_cast<double>(grid.ny)};
  picture.inside.assign(grid.size(), 0);
  picture.degrees.assign(grid.size(), 0);
  const auto rows = insideIntervals(shape, grid.centre(0, 0).y, grid.cell, grid.ny);
  for (int y = 0; y < grid.ny; ++y) {
    for (const Interval& span : rows[y]) {
      for (int x = 0; x < grid.nx; ++x) {
        const Vec2 p = grid.centre(x, y);
        if (p.x < span.begin || p.x >= span.end) continue;
        picture.inside[grid.index(x, y)] = 1;
        const auto texel = [](double share, int count) {
          return static_cast<int>(std::clamp(share * count, 0.0, count - 1.0));
        };
        const int row = texel(1 - p.y / shape.page.y, map.height);
        const int column = texel(p.x / shape.page.x, map.width);
        const double angle = map.angle[indexOf(column, row, map.width)] / 65535.0 * 180 - 90;
        picture.degrees[grid.index(x, y)] = static_cast<float>(angle < 0 ? angle + 180 : angle);
      }
    }
  }
  return picture;
}

}  // namespace

Result<DirectionZones> directionZones(const Shape& shape, const DirectionMap& directions, const ZoneParams& params,
                                      const RunContext& run) {
  if (params.most < 2 || params.most > 12) return outOfRange("zones", params.most, 2, 12, "");
  if (!(params.least >= 0.5 && params.least <= 100)) return outOfRange("leastZone", params.least, 0.5, 100, "mm");
  if (auto bad = mapDefect("directions", directions.width, directions.height, directions.angle.size())) return *bad;
  if (auto bad = pageDefect(shape.page)) return *bad;
  run.beginJob();
  run.beginStage("zones", 0, 1);
  const DirectionPicture picture = rastered(shape, directions);
  if (std::none_of(picture.inside.begin(), picture.inside.end(), [](char in) { return in != 0; })) {
    return refused(ErrorCode::EmptyShape, "ZonesTooSmall", {{"cell", picture.grid.cell}});
  }
  const std::vector<double> chosen = zoneDirections(picture, params.most);
  if (run.cancelled()) return cancelledRun();
  std::vector<std::int32_t> label = zoneLabels(picture, chosen, params.least, run);
  if (run.cancelled()) return cancelledRun();
  spreadLabels(label, std::vector<char>(label.size(), 1), picture.grid);
  DirectionZones out;
  out.found = static_cast<int>(chosen.size());
  std::vector<double> areas(chosen.size(), 0);
  double all = 0;
  for (std::size_t k = 0; k < label.size(); ++k) {
    if (picture.inside[k] == 0) continue;
    const std::size_t zone = label[k];
    areas[zone] += picture.grid.cell * picture.grid.cell;
    out.error += angleBetween(static_cast<double>(picture.degrees[k]), chosen[zone]);
    all += 1;
  }
  out.error /= std::max(1.0, all);
  std::vector<std::vector<Ring>> rings = zoneOutlines(std::move(label), static_cast<int>(chosen.size()), picture.grid);
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    if (!rings[k].empty() && areas[k] > 0) out.zones.push_back({chosen[k], areas[k], std::move(rings[k])});
  }
  return out;
}

}  // namespace sillon
