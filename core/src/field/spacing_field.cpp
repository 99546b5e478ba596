#include "field/fields.hpp"

#include <cmath>

#include "base/parallel_for.hpp"
#include "base/simd.hpp"
#include "field/hierarchy.hpp"

namespace sillon {
namespace {

constexpr int kCoarsening = 4;  ///< cells of the line field along a cell of the coarse grid, which is 2 tau wide
constexpr int kSweeps = 24;     ///< sweeps of Gauss-Seidel; the solution reaches 8 spacings = 4 coarse cells
constexpr float kReach = 8;     ///< length over which u is held to 0 [tau]
constexpr float kMaxDivergence = 0.5f;       ///< highest divergence of lines that counts [1/tau]
constexpr float kAlike = 0.7f;               ///< cosine below which two lines are no neighbours
constexpr float kCell = 0.5f * kCoarsening;  ///< side of a coarse cell [tau]

// The line of a coarse cell and how fast lines fan out there.
struct CoarseCell {
  Vec2f direction;   ///< d; (0, 0) where masked
  Vec2f divergence;  ///< divergence kappa times t, the same for d and -d [1/tau]
};

struct CoarseGrid {
  int nx;
  int ny;
  std::vector<CoarseCell> cells;

  [[nodiscard]] const CoarseCell& at(int x, int y) const {
    static const CoarseCell kOutside{};
    const bool inside = x >= 0 && y >= 0 && x < nx && y < ny;
    return inside ? cells[indexOf(x, y, nx)] : kOutside;
  }
};

bool masked(const CoarseCell& cell) { return cell.direction == Vec2f{}; }

// Averages lines over coarse cells, and takes their divergence by differences.
CoarseGrid coarseLines(const LineField& lines, const CellConstraints& cells, bool ring, const RunContext& run) {
  const Grid& grid = lines.grid;
  CoarseGrid coarse{(grid.nx - 1) / kCoarsening + 1, (grid.ny - 1) / kCoarsening + 1, {}};
  coarse.cells.resize(cellCount(coarse.nx, coarse.ny));
  const auto forRows = [&](const auto& row) {
    parallelForEach(run, coarse.ny, rowGrain(run, coarse.ny, 100.0 * coarse.nx), [&](int y) { row(y); });
  };
  forRows([&](int cy) {
    for (int cx = 0; cx < coarse.nx; ++cx) {
      // Lines add up as z, without the ring, whose beads follow the border in any case.
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
      if (size <= 0.1f * static_cast<float>(count)) continue;  // the cell is empty, or holds lines of all directions
      coarse.cells[indexOf(cx, cy, coarse.nx)].direction = directionOf(z * (1 / size));
    }
  });
  // The divergence kappa = -curl d by differences; d and -d are the same line, so that neighbours' signs are matched.
  forRows([&](int y) {
    for (int x = 0; x < coarse.nx; ++x) {
      CoarseCell& cell = coarse.cells[indexOf(x, y, coarse.nx)];
      const Vec2f d = cell.direction;
      if (masked(cell)) continue;
      const auto slope = [&](int dx, int dy) {  // slope of d along (dx, dy)
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
  });
  return coarse;
}

// Layout for Gauss-Seidel on vectors. Rows are taken four by four: lane l of the vector at step s of a band is the cell
// in column s - 2 l of row 4 band + l. Where a cell is updated after its neighbours to the left and in the row below it
// in the order of rows, all four lanes can be updated together: the cells that lane l reads of lane l - 1 were written
// one step ago. The other way round, from the last step to the first, holds as well. (Measured on 497,000 cells of the
// lines, interpolation by vectors included: 7 ms instead of 28, same bits.)
struct SkewedRows {
  int bands;
  int steps;
  std::size_t pitch;  ///< steps of a band and of the padding that is read beside it

  explicit SkewedRows(const CoarseGrid& grid)
      : bands((grid.ny + 3) / 4), steps(grid.nx + 6), pitch(steps + 2 * kBeside) {}

  static constexpr int kBeside = 7;
  [[nodiscard]] std::size_t size() const { return (bands + 2) * pitch; }  // [vectors]
  [[nodiscard]] std::size_t at(int band, int step) const { return (band + 1) * pitch + (step + kBeside); }
};

// The wishes of the 8 neighbours of four cells: each asks for u at its own place minus the target, with a weight;
// weight 0 is no neighbour.
struct Links {
  F4 weight[8];
  F4 target[8];
  F4 weights;  ///< sum of all weights that act on the cell
};

constexpr int kNeighbourX[8] = {-1, 0, 1, -1, 1, -1, 0, 1};
constexpr int kNeighbourY[8] = {-1, -1, -1, 0, 0, 1, 1, 1};

// Sets up the least-squares problem: for two neighbours, u should change along the beads by the divergence between
// them. The pull to 0 with weight 1 / kReach² keeps the solution local.
std::vector<Links> linksOf(const CoarseGrid& grid, const SkewedRows& rows, const RunContext& run) {
  std::vector<Links> links(rows.size());
  parallelForEach(run, rows.bands, 1, [&](int band) {
    for (int step = 0; step < rows.steps; ++step) {
      Links& link = links[rows.at(band, step)];
      link.weights = splat(1 / (kReach * kReach));
      for (int lane = 0; lane < 4; ++lane) {
        const int x = step - 2 * lane;
        const int y = 4 * band + lane;
        const CoarseCell& cell = grid.at(x, y);
        for (std::size_t k = 0; k < 8 && !masked(cell); ++k) {
          const CoarseCell& other = grid.at(x + kNeighbourX[k], y + kNeighbourY[k]);
          if (masked(other) || std::abs(dot(cell.direction, other.direction)) < kAlike) continue;
          const Vec2f to{static_cast<float>(kNeighbourX[k]), static_cast<float>(kNeighbourY[k])};
          const float size = length(to);
          const Vec2f e = to * (1 / size);
          const float span = size * kCell;
          // The equation holds along the bead t only: a neighbour across the bead asks for nothing.
          const float across = dot(cell.direction, e);
          const float along2 = 1 - across * across;  // (t . e)²
          const float weight = along2 * along2 / (span * span);
          link.weight[k][lane] = weight;
          link.target[k][lane] = 0.5f * span * dot(cell.divergence + other.divergence, e);
          link.weights[lane] += weight;
        }
      }
    }
  });
  return links;
}

// Solves for u by Gauss-Seidel in row order, forward and back in turn; on one thread, as the grid is small.
std::vector<float> logFrequency(const CoarseGrid& grid, float limit, const RunContext& run) {
  const SkewedRows rows(grid);
  const std::vector<Links> links = linksOf(grid, rows, run);
  // The band is padded on all sides with u = 0 and weight 0, so that no access needs a test.
  std::vector<F4> u(rows.size(), splat(0));
  const auto relax = [&](int band, int step) {
    const std::size_t at = rows.at(band, step);
    const Links& link = links[at];
    F4 sum = splat(0);
    for (std::size_t k = 0; k < 8; ++k) {
      const std::size_t beside = at + kNeighbourX[k];
      // Neighbours in the rows below and above lie in the other lanes, two steps away; the outermost ones in the next
      // band.
      F4 from = u[beside];
      if (kNeighbourY[k] < 0) {
        const F4 same = u[beside - 2];
        from = F4{u[beside + 6 - rows.pitch][3], same[0], same[1], same[2]};
      } else if (kNeighbourY[k] > 0) {
        const F4 same = u[beside + 2];
        from = F4{same[1], same[2], same[3], u[beside - 6 + rows.pitch][0]};
      }
      sum = sum + link.weight[k] * (from - link.target[k]);
    }
    // Projected Gauss-Seidel: the limit of u is kept in every step.
    u[at] = min4(max4(sum / link.weights, splat(-limit)), splat(limit));
  };
  for (int sweep = 0; sweep < kSweeps && !run.cancelled(); ++sweep) {
    if (sweep % 2 == 0) {
      for (int band = 0; band < rows.bands; ++band) {
        for (int step = 0; step < rows.steps; ++step) relax(band, step);
      }
    } else {
      for (int band = rows.bands - 1; band >= 0; --band) {
        for (int step = rows.steps - 1; step >= 0; --step) relax(band, step);
      }
    }
  }
  // Back from the skewed layout to rows.
  std::vector<float> cells(grid.cells.size());
  for (int y = 0; y < grid.ny; ++y) {
    for (int x = 0; x < grid.nx; ++x) {
      cells[indexOf(x, y, grid.nx)] = u[rows.at(y / 4, x + 2 * (y % 4))][y % 4];
    }
  }
  return cells;
}

}  // namespace

Result<std::vector<float>> spacingField(const LineField& lines, const CellConstraints& cells,
                                        const ToolpathParams& params, const RunContext& run) {
  const Grid& grid = lines.grid;
  std::vector<float> frequency(grid.size(), 1.0f);
  // Without variation all waves have the length of the paper's (Eq. 6).
  if (params.spacingVariation == 0) return frequency;
  // Solve on the coarse grid, then interpolate.
  const bool ring = countedPerimeters(params) >= 1;
  const CoarseGrid coarse = coarseLines(lines, cells, ring, run);
  const std::vector<float> u = logFrequency(coarse, static_cast<float>(params.spacingVariation), run);

  // Bilinear interpolation of u between the unmasked coarse cells, the same four for each four cells of a row; then e^u
  // by its series, as |u| <= 1/2.
  parallelForEach(run, grid.ny, rowGrain(run, grid.ny, 8.0 * grid.nx), [&](int y) {
    const int y0 = (y + kCoarsening / 2) / kCoarsening - 1;
    const float gy = (static_cast<float>(y) + 0.5f) / kCoarsening - 0.5f;
    for (int x = -kCoarsening / 2; x < grid.nx; x += kCoarsening) {
      const int x0 = (x + kCoarsening / 2) / kCoarsening - 1;
      Vec2f d[kCoarsening] = {};
      F4 dx = splat(0);
      F4 dy = splat(0);
      F4 gx = splat(0);
      for (int k = 0; k < kCoarsening; ++k) {
        gx[k] = (static_cast<float>(x + k) + 0.5f) / kCoarsening - 0.5f;
        if (x + k < 0 || x + k >= grid.nx) continue;
        d[k] = lines.direction[grid.index(x + k, y)];
        dx[k] = d[k].x;
        dy[k] = d[k].y;
      }
      // Coarse cells whose line disagrees with a cell's have no say in it.
      F4 sum = splat(0);
      F4 weights = splat(0);
      for (int k = 0; k < 4; ++k) {
        const int cx = x0 + (k & 1);
        const int cy = y0 + (k >> 1);
        const CoarseCell& cell = coarse.at(cx, cy);
        if (masked(cell)) continue;
        const F4 agreement = splat(cell.direction.x) * dx + splat(cell.direction.y) * dy;
        const F4 near =
            (splat(1) - abs4(gx - splat(static_cast<float>(cx)))) * splat(1 - std::abs(gy - static_cast<float>(cy)));
        const F4 weight = select4(agreement * agreement < splat(kAlike * kAlike), splat(0), near);
        sum = sum + weight * splat(u[indexOf(cx, cy, coarse.nx)]);
        weights = weights + weight;
      }
      const F4 v = sum / weights;
      // Horner's scheme; five terms.
      const F4 e =
          splat(1) +
          v * (splat(1) +
               v / splat(2) * (splat(1) + v / splat(3) * (splat(1) + v / splat(4) * (splat(1) + v / splat(5)))));
      for (int k = 0; k < kCoarsening; ++k) {
        if (d[k] == Vec2f{} || weights[k] <= 0) continue;
        const std::size_t i = grid.index(x + k, y);
        if (!(ring && cells.zone[i] == Zone::Ring)) frequency[i] = e[k];
      }
    }
  });
  if (run.cancelled()) return cancelledRun();
  return frequency;
}

}  // namespace sillon
