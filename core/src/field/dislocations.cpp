#include "field/fields.hpp"

#include <array>
#include <cmath>

#include "base/fast_math.hpp"
#include "base/parallel_for.hpp"
#include "field/hierarchy.hpp"

namespace sillon {
namespace {

constexpr double kTurn = 6.283185307179586;
constexpr int kSigma = 4;           ///< sigma of the smoothing [cells]: 2 tau
constexpr int kReach = 3 * kSigma;  ///< reach of its Gaussian [cells]

// A cell's wave with its phase as an angle.
struct CellWave {
  Vec2f k;
  double phi = 0;
};

// The same wave seen along a direction that agrees with `k`: (k, phi) = (-k, pi - phi).
CellWave alike(Vec2f k, CellWave w) { return dot(k, w.k) < 0 ? CellWave{-w.k, kTurn / 2 - w.phi} : w; }

// Reads the waves of one row: the arc tangent of each cell is taken once, not for each of its four blocks. Its error of
// 1e-5 falls out of the sum round a block, where each angle is added and taken off again.
void wavesOfRow(const SineField& waves, int y, std::vector<CellWave>& row) {
  row.resize(waves.grid.nx);
  for (int x = 0; x < waves.grid.nx; ++x) {
    const std::size_t i = waves.grid.index(x, y);
    const Vec2f q = waves.phase[i];
    row[x] = {waves.wave[i], static_cast<double>(atan2Approx(q.y, q.x))};
  }
}

// Rounds like std::round, which costs a call.
int nearestWhole(double v) { return static_cast<int>(v < 0 ? v - 0.5 : v + 0.5); }

// Result of one way round a block.
struct PhaseTurn {
  int index = 0;       ///< whole turns that the phase gains; each is a dislocation
  bool flips = false;  ///< the line comes back reversed: a singularity of the lines
};

// Goes round the block whose lower left cell is at x, counter-clockwise, and adds up the phase from cell to cell.
PhaseTurn roundBlock(const std::vector<CellWave>& lower, const std::vector<CellWave>& upper, std::size_t x) {
  constexpr double kHalfStep = kTurn / 8;  // phase of the unit wave over half a cell of tau/2
  constexpr std::array<Vec2f, 4> kMoves{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  const std::array<CellWave, 4> corners{lower[x], lower[x + 1], upper[x + 1], upper[x]};
  CellWave here = corners[0];
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const CellWave there = alike(here.k, corners[(k + 1) % 4]);
    const double step = kHalfStep * static_cast<double>(dot(kMoves[k], here.k + there.k));
    // The waves predict `step`; the rest is taken to the nearest whole turn.
    const double gain = there.phi - here.phi - step;
    sum += step + gain - kTurn * nearestWhole(gain / kTurn);
    here = there;
  }
  return {nearestWhole(sum / kTurn), dot(here.k, corners[0].k) < 0};
}

// Gaussian smoothing by sums along rows, then columns; masked cells count nothing.
std::vector<Vec2f> smoothed(const Grid& grid, const std::vector<Vec2f>& z, const RunContext& run) {
  std::array<float, kReach + 1> weight{};
  for (int k = 0; k <= kReach; ++k) {
    weight[k] = static_cast<float>(std::exp(-0.5 * k * k / (kSigma * kSigma)));
  }
  std::vector<Vec2f> rows(z.size());
  std::vector<Vec2f> out(z.size());
  // Sums go tap by tap over whole rows, which compilers turn into vector code; the order of each sum stays the same.
  const auto add = [&](std::vector<Vec2f>& to, std::size_t at, const std::vector<Vec2f>& from, std::size_t fromAt,
                       std::size_t count, int tap) {
    const float w = weight[std::abs(tap)];
    for (std::size_t x = 0; x < count; ++x) to[at + x] = to[at + x] + from[fromAt + x] * w;
  };
  const int grain = rowGrain(run, grid.ny, 10.0 * grid.nx);
  parallelForEach(run, grid.ny, grain, [&](int y) {
    for (int tap = -kReach; tap <= kReach; ++tap) {
      const int first = std::max(0, -tap);
      const int count = grid.nx - std::abs(tap);
      if (count > 0) add(rows, grid.index(first, y), z, grid.index(first + tap, y), count, tap);
    }
  });
  parallelForEach(run, grid.ny, grain, [&](int y) {
    for (int from = std::max(0, y - kReach); from <= std::min(grid.ny - 1, y + kReach); ++from) {
      add(out, grid.index(0, y), rows, grid.index(0, from), grid.nx, from - y);
    }
  });
  return out;
}

// Directions of the waves, smoothed over the infill; (0, 0) where there are none.
std::vector<Vec2f> smoothDirections(const LineField& lines, const CellConstraints& cells, const RunContext& run) {
  // The ring is left out: its beads follow the border.
  std::vector<Vec2f> z(lines.grid.size());
  for (std::size_t i = 0; i < z.size(); ++i) {
    if (cells.zone[i] == Zone::Infill || cells.zone[i] == Zone::Shell) z[i] = lineOf(lines.direction[i]);
  }
  z = smoothed(lines.grid, z, run);
  for (Vec2f& v : z) {
    const float size = length(v);
    v = size > 0 ? directionOf(v * (1 / size)) : Vec2f{};
  }
  return z;
}

// Estimates the dislocations that fanning lines need: the integral of |div t| over the infill, divided by 2 tau. Beads
// end at a rate of div t / tau, and one dislocation ends two of them. `z` holds the smoothed directions.
double boundOf(const std::vector<Vec2f>& z, const CellConstraints& cells, const RunContext& run) {
  const Grid& grid = cells.grid;
  const double most = 0.25 / grid.cell;  // 1/(2 tau), as the cell is tau/2
  std::vector<double> sums(grid.ny, 0.0);
  parallelForEach(run, grid.ny, rowGrain(run, grid.ny, 10.0 * grid.nx), [&](int y) {
    for (int x = 0; x < grid.nx; ++x) {
      if (cells.zone[grid.index(x, y)] != Zone::Infill) continue;
      const Vec2f d = z[grid.index(x, y)];
      // t = (d_y, -d_x), so that div t is the slope of d_y along x minus that of d_x along y.
      const auto slope = [&](int dx, int dy) {
        Vec2f sum{};
        double span = 0;
        for (const int side : {-1, 1}) {
          const int cx = x + side * dx;
          const int cy = y + side * dy;
          if (cx < 0 || cy < 0 || cx >= grid.nx || cy >= grid.ny) continue;
          const Vec2f n = z[grid.index(cx, cy)];
          if (n == Vec2f{}) continue;
          sum = sum + (n * (dot(n, d) < 0 ? -1.0f : 1.0f) - d) * static_cast<float>(side);
          span += grid.cell;
        }
        return span > 0 ? Vec2{static_cast<double>(sum.x) / span, static_cast<double>(sum.y) / span} : Vec2{};
      };
      sums[y] += std::min(std::abs(slope(1, 0).y - slope(0, 1).x), most);
    }
  });
  double total = 0;
  for (const double sum : sums) total += sum;
  return total * grid.cell * grid.cell / (4 * grid.cell);
}

// U-turns that lines force where they meet the border at an angle. The integral along the border is taken as one over
// the outermost tau of the infill, divided by tau.
double borderTurnsOf(const std::vector<Vec2f>& z, const SignedDistanceField& sdf, const CellConstraints& cells,
                     double depth) {
  const Grid& grid = cells.grid;
  const double spacing = 2 * grid.cell;
  double sum = 0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    if (cells.zone[i] != Zone::Infill || static_cast<double>(sdf.distance[i]) < -(depth + spacing)) continue;
    sum += static_cast<double>(std::abs(cross(z[i], sdf.normal[i])));
  }
  return sum * grid.cell * grid.cell / spacing / (2 * spacing);
}

}  // namespace

Dislocations findDislocations(const LineField& lines, const SineField& waves, const CellConstraints& cells,
                              const SignedDistanceField& sdf, const ToolpathParams& params, const RunContext& run) {
  const Grid& grid = waves.grid;
  // 1. Count per row, as rows are worked on by several threads, and sum up in order.
  std::vector<std::int64_t> counts(grid.ny, 0);
  std::vector<std::int64_t> singular(grid.ny, 0);
  parallelFor(run, grid.ny - 1, rowGrain(run, grid.ny, 40.0 * grid.nx), [&](int begin, int end) {
    std::vector<CellWave> lower;
    std::vector<CellWave> upper;
    wavesOfRow(waves, begin, upper);
    for (int y = begin; y < end; ++y) {
      // Each row of waves serves the blocks below and above it.
      std::swap(lower, upper);
      wavesOfRow(waves, y + 1, upper);
      for (int x = 0; x + 1 < grid.nx; ++x) {
        const std::size_t i = grid.index(x, y);
        const std::size_t up = grid.index(x, y + 1);
        if (cells.zone[i] == Zone::Masked || cells.zone[i + 1] == Zone::Masked || cells.zone[up] == Zone::Masked ||
            cells.zone[up + 1] == Zone::Masked) {
          continue;
        }
        const PhaseTurn turn = roundBlock(lower, upper, x);
        (turn.flips ? singular : counts)[y] += turn.flips ? 1 : std::abs(turn.index);
      }
    }
  });
  Dislocations found;
  for (std::size_t y = 0; y < counts.size(); ++y) {
    found.count += counts[y];
    found.singularities += singular[y];
  }
  // 2. Compare with what the lines ask for.
  const std::vector<Vec2f> z = smoothDirections(lines, cells, run);
  found.bound = boundOf(z, cells, run);
  const int perimeters = countedPerimeters(params);
  found.borderTurns = borderTurnsOf(z, sdf, cells, std::max(1, perimeters) * params.spacing);
  return found;
}

}  // namespace sillon
