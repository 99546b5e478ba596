#include "field/fields.hpp"

#include <cmath>

#include "base/fast_math.hpp"
#include "base/parallel_for.hpp"

namespace sillon {
namespace {

constexpr float kCosJump = 0.36235776f;  ///< cosine of 1.2 rad: a larger residual is a jump of the phase, no gradient
constexpr float kAlike = 0.7f;           ///< cosine below which two lines are no neighbours
constexpr int kAverages = 2;             ///< rounds of averaging over neighbours

// Change of one cell: the turn of its line, as a small angle, and the logarithm of its frequency.
struct Give {
  float turn = 0;
  float logFrequency = 0;
  bool known = false;
};

// Difference of the phases of two cells, if it is smooth.
struct Difference {
  float phase = 0;  ///< gain of the wave's phase over one cell [rad]
  bool smooth = false;
};

// Measures the gain of phase from cell i to its neighbour j, seen along the wave of i. \param move  from i to j
// [cells].
Difference difference(const SineField& waves, std::size_t i, std::size_t j, Vec2f move) {
  const Vec2f ki = waves.wave[i];
  Vec2f kj = waves.wave[j];
  Vec2f qj = waves.phase[j];
  if (qj == Vec2f{}) return {};
  // Turn the neighbour's wave to the same side: (k, phi) = (-k, pi - phi).
  if (dot(ki, kj) < 0) {
    kj = -kj;
    qj.x = -qj.x;
  }
  const Vec2f qi = waves.phase[i];
  const float step = 0.25f * kPi * dot(move, ki + kj);  // the unit wave turns by pi/2 per cell
  const SinCos back = sinCos(-step);
  // The rest beyond the expected step is small where waves agree: qj conj(qi) e^{-i step}.
  const Vec2f turned{qj.x * qi.x + qj.y * qi.y, qj.y * qi.x - qj.x * qi.y};
  const Vec2f rest{turned.x * back.cos - turned.y * back.sin, turned.x * back.sin + turned.y * back.cos};
  if (rest.x <= kCosJump) return {};
  return {step + asinApprox(std::clamp(rest.y, -1.0f, 1.0f)), true};
}

// Central differences of the phase along x and y, in units of the unit wave. Unknown where a neighbour is missing or
// the phase jumps.
bool gradientAt(const SineField& waves, int x, int y, Vec2f& gradient) {
  const Grid& grid = waves.grid;
  if (x < 1 || y < 1 || x + 1 >= grid.nx || y + 1 >= grid.ny) return false;
  const std::size_t i = grid.index(x, y);
  const auto along = [&](int dx, int dy, float& slope) {
    const Vec2f move{static_cast<float>(dx), static_cast<float>(dy)};
    const Difference ahead = difference(waves, i, grid.index(x + dx, y + dy), move);
    const Difference behind = difference(waves, i, grid.index(x - dx, y - dy), -move);
    slope = (ahead.phase - behind.phase) / kPi;
    return ahead.smooth && behind.smooth;
  };
  return along(1, 0, gradient.x) && along(0, 1, gradient.y);
}

}  // namespace

Result<RelaxedDirections> relaxDirections(const LineField& asked, const std::vector<float>& frequency,
                                          const SineField& waves, const CellConstraints& cells,
                                          const ToolpathParams& params, const RunContext& run) {
  const Grid& grid = asked.grid;
  const bool ring = countedPerimeters(params) >= 1;
  const float most = static_cast<float>(params.directionTolerance) * kPi / 180;
  const float bend = static_cast<float>(params.spacingVariation);
  // Masked cells have no line, and the ring follows the border.
  const auto stays = [&](std::size_t i) {
    return cells.zone[i] == Zone::Masked || (ring && cells.zone[i] == Zone::Ring);
  };
  // 1. Compare each line with the gradient of the phases around it: the angle is its turn, the size its frequency.
  std::vector<Give> give(grid.size());
  const int grain = rowGrain(run, grid.ny, 30.0 * grid.nx);
  parallelForEach(run, grid.ny, grain, [&](int y) {
    for (int x = 0; x < grid.nx; ++x) {
      const std::size_t i = grid.index(x, y);
      Vec2f gradient;
      if (stays(i) || !gradientAt(waves, x, y, gradient)) continue;
      const Vec2f d = asked.direction[i];
      const float size = length(gradient);
      // Gradients far from that of the unit wave tell nothing about a bead.
      if (size < 0.25f || size > 4) continue;
      Vec2f g = gradient * (1 / size);
      if (dot(d, g) < 0) g = -g;
      if (dot(d, g) < kAlike) continue;
      const float turn = asinApprox(std::clamp(cross(d, g), -1.0f, 1.0f));
      const float log = (size - 1) - (size - 1) * (size - 1) / 2;  // series of log near 1, where it is used
      give[i] = {std::clamp(turn, -most, most), std::clamp(size < 2 ? log : bend, -bend, bend), true};
    }
  });
  // 2. Average over the 3 x 3 neighbours that run alike, which also fills cells without a gradient.
  for (int round = 0; round < kAverages && !run.cancelled(); ++round) {
    const std::vector<Give> before = give;
    parallelFor(run, grid.ny, grain, [&](int begin, int end) {
      for (int y = std::max(begin, 1); y < std::min(end, grid.ny - 1); ++y) {
        for (int x = 1; x + 1 < grid.nx; ++x) {
          const std::size_t i = grid.index(x, y);
          if (stays(i)) continue;
          Give sum;
          float count = 0;
          for (int k = 0; k < 9; ++k) {
            const std::size_t j = grid.index(x + k % 3 - 1, y + k / 3 - 1);
            if (!before[j].known || std::abs(dot(asked.direction[i], asked.direction[j])) < kAlike) continue;
            sum.turn += before[j].turn;
            sum.logFrequency += before[j].logFrequency;
            ++count;
          }
          if (count > 0) give[i] = {sum.turn / count, sum.logFrequency / count, true};
        }
      }
    });
  }
  // 3. Turn the lines, and exponentiate the frequencies by a series.
  RelaxedDirections given{asked, frequency};
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (stays(i) || !give[i].known) continue;
    const SinCos turn = sinCos(give[i].turn);
    const Vec2f d = asked.direction[i];
    given.lines.direction[i] = {d.x * turn.cos - d.y * turn.sin, d.x * turn.sin + d.y * turn.cos};
    const float u = give[i].logFrequency;
    given.frequency[i] = 1 + u * (1 + u / 2 * (1 + u / 3 * (1 + u / 4)));
  }
  if (run.cancelled()) return cancelledRun();
  return given;
}

}  // namespace sillon
