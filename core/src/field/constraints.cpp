#include "field/fields.hpp"

#include "base/fast_math.hpp"
#include "base/parallel_for.hpp"

namespace sillon {
namespace {

constexpr float kNoAverage = 0.1f;  ///< an average of lines shorter than this means nothing

// Texels covered by [centre - reach, centre + reach] along one axis, with the share of each.
struct Footprint {
  int first = 0;
  std::vector<float> weight;
};

// Footprints of a row or column of cells: boxes as wide as a cell, or as a texel where texels are larger, so that the
// average becomes bilinear interpolation. The two axes are separable, so that one list for each is enough.
std::vector<Footprint> footprints(int count, double origin, double cell, double page, int texels, bool flipped) {
  std::vector<Footprint> all(count);
  const double scale = texels / page;
  const double reach = 0.5 * std::max(cell * scale, 1.0);
  for (int k = 0; k < count; ++k) {
    double centre = (origin + (k + 0.5) * cell) * scale;
    if (flipped) centre = texels - centre;
    // Clamp to the map; at its edge at least one texel remains.
    const double limit = static_cast<double>(texels);
    const double low = std::clamp(centre - reach, 0.0, limit - 1);
    const double high = std::clamp(centre + reach, 1.0, limit);
    Footprint& footprint = all[k];
    footprint.first = static_cast<int>(low);
    for (int texel = footprint.first; texel < high; ++texel) {
      footprint.weight.push_back(
          static_cast<float>(std::min(high, texel + 1.0) - std::max(low, static_cast<double>(texel))));
    }
  }
  return all;
}

}  // namespace

// A table of all angles saves a sine and a cosine for each texel under each cell.
std::vector<Vec2f> beadLines() {
  std::vector<Vec2f> lines;
  lines.reserve(65536);
  for (int angle = 0; angle < 65536; angle += 4) {
    // 2 (angle / 65535 pi - pi/2)
    const F4 four = toFloat(splatInt(angle) + I4{0, 1, 2, 3});
    const SinCos4 v = sinCos(four * splat(2 * kPi / 65535) - splat(kPi));
    for (int k = 0; k < 4; ++k) lines.push_back({v.cos[k], v.sin[k]});
  }
  return lines;
}

// Decides zone, mode and line of each cell that is not masked.
Result<CellConstraints> cellConstraints(const SignedDistanceField& sdf, const DirectionMap& directions,
                                        const ModeMap& modes, Vec2 page, const ToolpathParams& params,
                                        const RunContext& run) {
  const Grid& grid = sdf.grid;
  CellConstraints cells{grid, std::vector<Zone>(grid.size()), std::vector<DirectionMode>(grid.size()),
                        std::vector<Vec2f>(grid.size())};
  const float spacing = static_cast<float>(params.spacing);
  const float shellDepth = static_cast<float>(countedPerimeters(params)) * spacing;

  // Prepare what cells of a row or column share: lines by angle, footprints and columns of modes.
  std::vector<Vec2f> lineOf = beadLines();
  for (Vec2f& line : lineOf) line = acrossBead(line);
  // The page's y points up, rows of maps go down: rows are flipped.
  const auto columns = footprints(grid.nx, grid.origin.x, grid.cell, page.x, directions.width, false);
  const auto rows = footprints(grid.ny, grid.origin.y, grid.cell, page.y, directions.height, true);
  std::vector<int> modeColumn;
  for (int x = 0; x < grid.nx; ++x) modeColumn.push_back(texelColumn(grid.centre(x, 0).x, page.x, modes.width));
  const auto angles = [&](int x, int y) {  // angles of the texel and of those to the right of it
    return &directions.angle[indexOf(x, y, directions.width)];
  };

  parallelForEach(run, grid.ny, rowGrain(run, grid.ny, 40.0 * grid.nx), [&](int y) {
    const Footprint& row = rows[y];
    const DirectionMode* const modeRow =
        &modes.mode[indexOf(0, texelRow(grid.centre(0, y).y, page.y, modes.height), modes.width)];
    for (int x = 0; x < grid.nx; ++x) {
      const std::size_t i = grid.index(x, y);
      const float distance = sdf.distance[i];
      // Zones are bands of the exact distance (Sec. 4).
      cells.zone[i] = distance > -0.5f * spacing ? Zone::Masked
                      : distance > -spacing      ? Zone::Ring
                      : distance > -shellDepth   ? Zone::Shell
                                                 : Zone::Infill;
      if (cells.zone[i] == Zone::Masked) continue;
      cells.mode[i] = modeRow[modeColumn[x]];
      // Average z = e^{2i angle}, as d and -d are the same line: their z add up and do not cancel out.
      Vec2f sum{};
      float total = 0;
      if (params.mapFilter == MapFilter::Average) {
        const Footprint& column = columns[x];
        for (std::size_t v = 0; v < row.weight.size(); ++v) {
          const std::uint16_t* const angle = angles(column.first, row.first + static_cast<int>(v));
          for (std::size_t u = 0; u < column.weight.size(); ++u) {
            const float weight = row.weight[v] * column.weight[u];
            sum = sum + lineOf[angle[u]] * weight;
            total += weight;
          }
        }
      }
      const float size = length(sum);
      // Take the average if it is long enough to mean anything.
      if (size > kNoAverage * total) {
        cells.mapLine[i] = sum * (1 / size);
      } else {
        // No direction prevails: take the texel at the cell's centre.
        const TexelIndex t = texelAt(grid.centre(x, y), page, directions.width, directions.height);
        cells.mapLine[i] = lineOf[*angles(t.x, t.y)];
      }
    }
  });
  if (run.cancelled()) return cancelledRun();
  return cells;
}

}  // namespace sillon
