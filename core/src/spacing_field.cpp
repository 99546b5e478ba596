#include "sillon/spacing_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "lines.hpp"
#include "parallel_for.hpp"

namespace sillon {
namespace {

constexpr int kCoarsening = 4;               ///< cells of the line field per cell of this one's grid
constexpr int kSweeps = 24;                  ///< of Gauss-Seidel; the solution reaches 8 spacings = 4 of these cells
constexpr float kReach = 8;                  ///< over which u is held to 0 [tau]
constexpr float kMaxDivergence = 0.5f;       ///< of lines that are taken seriously [1/tau]
constexpr float kAlike = 0.7f;               ///< lines that agree less than this are no neighbours
constexpr float kCell = 0.5f * kCoarsening;  ///< side of a coarse cell [tau]

struct CoarseCell {
  Vec2f direction;   ///< d; (0, 0) where masked
  Vec2f divergence;  ///< kappa t, the same for d and -d [1/tau]
};

struct CoarseGrid {
  int nx;
  int ny;
  std::vector<CoarseCell> cells;

  [[nodiscard]] const CoarseCell& at(int x, int y) const {
    static const CoarseCell kOutside{};
    const bool inside = x >= 0 && y >= 0 && x < nx && y < ny;
    return inside ? cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(x)]
                  : kOutside;
  }
};

bool masked(const CoarseCell& cell) { return cell.direction == Vec2f{}; }

CoarseGrid coarseLines(const LineField& lines, const CellConstraints& cells, bool ring) {
  const Grid& grid = lines.grid;
  CoarseGrid coarse{(grid.nx - 1) / kCoarsening + 1, (grid.ny - 1) / kCoarsening + 1, {}};
  coarse.cells.resize(static_cast<std::size_t>(coarse.nx) * static_cast<std::size_t>(coarse.ny));
  for (int cy = 0; cy < coarse.ny; ++cy) {
    for (int cx = 0; cx < coarse.nx; ++cx) {
      Vec2f z{};
      int count = 0;
      for (int y = cy * kCoarsening; y < std::min((cy + 1) * kCoarsening, grid.ny); ++y) {
        for (int x = cx * kCoarsening; x < std::min((cx + 1) * kCoarsening, grid.nx); ++x) {
          const std::size_t i = grid.index(x, y);
          const Vec2f d = lines.direction[i];
          if (d == Vec2f{} || (ring && cells.zone[i] == Zone::Ring)) continue;
          z = z + lineOf(d);
          ++count;
        }
      }
      const float size = length(z);
      if (size <= 0.1f * static_cast<float>(count)) continue;  // empty, or lines of all directions
      coarse.cells[static_cast<std::size_t>(cy) * static_cast<std::size_t>(coarse.nx) + static_cast<std::size_t>(cx)]
          .direction = directionOf(z * (1 / size));
    }
  }
  // kappa = -curl d by differences, neighbours' signs matched.
  for (int y = 0; y < coarse.ny; ++y) {
    for (int x = 0; x < coarse.nx; ++x) {
      CoarseCell& cell =
          coarse.cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(coarse.nx) + static_cast<std::size_t>(x)];
      const Vec2f d = cell.direction;
      if (masked(cell)) continue;
      const auto slope = [&](int dx, int dy) {  // of d along (dx, dy)
        Vec2f sum{};
        float span = 0;
        for (const int side : {-1, 1}) {
          const Vec2f n = coarse.at(x + side * dx, y + side * dy).direction;
          const float along = dot(n, d);
          if (std::abs(along) < kAlike) continue;
          sum = sum + (n * (along < 0 ? -1.0f : 1.0f) - d) * static_cast<float>(side);
          span += kCell;
        }
        return span > 0 ? sum * (1 / span) : Vec2f{};
      };
      const float kappa = std::clamp(slope(0, 1).x - slope(1, 0).y, -kMaxDivergence, kMaxDivergence);
      cell.divergence = Vec2f{d.y, -d.x} * kappa;
    }
  }
  return coarse;
}

// What one neighbour asks of a cell: u there less the target, with a weight.
struct Link {
  std::int32_t from;
  float weight;
  float target;
};

// The links of every cell, one after the other; they stay as they are over all sweeps (four times as fast as anew).
struct Links {
  std::vector<Link> all;
  std::vector<std::int32_t> begin;  ///< of each cell's, and their end
  std::vector<float> weight;        ///< of all that acts on the cell
};

Links linksOf(const CoarseGrid& grid) {
  Links links;
  links.begin.push_back(0);
  for (int y = 0; y < grid.ny; ++y) {
    for (int x = 0; x < grid.nx; ++x) {
      const CoarseCell& cell = grid.at(x, y);
      float weights = 1 / (kReach * kReach);
      for (int dy = -1; dy <= 1 && !masked(cell); ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const CoarseCell& other = grid.at(x + dx, y + dy);
          if ((dx == 0 && dy == 0) || masked(other) || std::abs(dot(cell.direction, other.direction)) < kAlike)
            continue;
          const float size = std::sqrt(static_cast<float>(dx * dx + dy * dy));
          const Vec2f e = Vec2f{static_cast<float>(dx), static_cast<float>(dy)} * (1 / size);
          const float span = size * kCell;
          const float across = dot(cell.direction, e);
          const float along2 = 1 - across * across;  // (t . e)²
          const float weight = along2 * along2 / (span * span);
          links.all.push_back(
              {(y + dy) * grid.nx + x + dx, weight, 0.5f * span * dot(cell.divergence + other.divergence, e)});
          weights += weight;
        }
      }
      links.begin.push_back(static_cast<std::int32_t>(links.all.size()));
      links.weight.push_back(weights);
    }
  }
  return links;
}

// u by Gauss-Seidel in row order, forward and back in turn; on one thread, as the grid is small.
std::vector<float> logFrequency(const CoarseGrid& grid, float limit, const RunContext& run) {
  const Links links = linksOf(grid);
  std::vector<float> u(grid.cells.size(), 0.0f);
  const auto relax = [&](std::size_t i) {
    float sum = 0;
    for (std::int32_t k = links.begin[i]; k < links.begin[i + 1]; ++k) {
      const Link& link = links.all[static_cast<std::size_t>(k)];
      sum += link.weight * (u[static_cast<std::size_t>(link.from)] - link.target);
    }
    u[i] = std::clamp(sum / links.weight[i], -limit, limit);
  };
  for (int sweep = 0; sweep < kSweeps && !run.cancelled(); ++sweep) {
    for (std::size_t k = 0; k < u.size(); ++k) relax(sweep % 2 == 1 ? u.size() - 1 - k : k);
  }
  return u;
}

}  // namespace

Result<std::vector<float>> spacingField(const LineField& lines, const CellConstraints& cells,
                                        const ToolpathParams& params, const RunContext& run) {
  const Grid& grid = lines.grid;
  std::vector<float> frequency(grid.size(), 1.0f);
  if (params.spacingBend == 0) return frequency;
  const bool ring = params.perimeterMode == PerimeterMode::Count && params.perimeters >= 1;
  const CoarseGrid coarse = coarseLines(lines, cells, ring);
  const std::vector<float> u = logFrequency(coarse, static_cast<float>(params.spacingBend), run);

  // Bilinear between the unmasked coarse cells; e^u by its series, |u| <= 1/2.
  parallelFor(run, grid.ny, rowGrain(run, grid.ny, 20.0 * grid.nx), [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < grid.nx; ++x) {
        const std::size_t i = grid.index(x, y);
        const Vec2f d = lines.direction[i];
        if (d == Vec2f{} || (ring && cells.zone[i] == Zone::Ring)) continue;
        const float gx = (static_cast<float>(x) + 0.5f) / kCoarsening - 0.5f;
        const float gy = (static_cast<float>(y) + 0.5f) / kCoarsening - 0.5f;
        const int x0 = static_cast<int>(std::floor(gx));
        const int y0 = static_cast<int>(std::floor(gy));
        float sum = 0;
        float weights = 0;
        for (int k = 0; k < 4; ++k) {
          const int cx = x0 + (k & 1);
          const int cy = y0 + (k >> 1);
          const CoarseCell& cell = coarse.at(cx, cy);
          const float agreement = dot(cell.direction, d);
          if (agreement * agreement < kAlike * kAlike) continue;
          const float weight =
              (1 - std::abs(gx - static_cast<float>(cx))) * (1 - std::abs(gy - static_cast<float>(cy)));
          sum += weight *
                 u[static_cast<std::size_t>(cy) * static_cast<std::size_t>(coarse.nx) + static_cast<std::size_t>(cx)];
          weights += weight;
        }
        if (weights <= 0) continue;
        const float v = sum / weights;
        frequency[i] = 1 + v * (1 + v / 2 * (1 + v / 3 * (1 + v / 4 * (1 + v / 5))));
      }
    }
  });
  if (run.cancelled()) return Error{ErrorCode::Cancelled, "the run was cancelled"};
  return frequency;
}

}  // namespace sillon
