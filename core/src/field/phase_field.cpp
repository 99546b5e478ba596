#include "field/fields.hpp"

#include <cmath>

#include "base/fast_math.hpp"
#include "base/free_memory.hpp"
#include "base/parallel_for.hpp"
#include "base/simd.hpp"
#include "field/hierarchy.hpp"

namespace sillon {
namespace {

// Edges kept per cell: to the neighbours at (1,0), (0,1), (1,1), (-1,1). The other four belong to the neighbours.
constexpr std::size_t kEdges = 4;
constexpr int kEdgeX[kEdges] = {1, 0, 1, -1};
constexpr int kEdgeY[kEdges] = {0, 1, 1, 1};

// A sum of phases shorter than this keeps the old phase.
constexpr float kNoPhase = 1e-9f;

// Transport of a phase along an edge: with a = w |d_i.d_j| e^{i theta0} and s = sign(d_i.d_j), q_i += (s Re(a q_j),
// Im(a q_j)) (Eq. 8 and 10). The other way round is the transposed 2 x 2 matrix. As published, theta0 depends on the
// line of j only, so that the way back has numbers of its own, written as if they were transposed.
struct Transport {
  Planes re;
  Planes im;
  Planes sign;
  Planes backRe;  ///< empty for the midpoint, where the way back is the transposed matrix
  Planes backIm;
};

// One level of the pyramid.
struct PhaseLevel {
  LevelShape shape;
  float step = 0;  ///< the unit wave's phase over a cell side of the level [rad]
  int depth = 0;   ///< 0 on the finest level
  PhaseTransport transport = PhaseTransport::Midpoint;
  Planes dx, dy;  ///< lines; 0 where masked
  Planes f;       ///< frequency, about 1
  Planes qr, qi;  ///< phases
  Planes free;    ///< 1 where sweeps may change the phase, else 0
  Planes ar, ai;  ///< the border's wave times its weight, for soft borders; else empty
  std::array<Transport, kEdges> edges;
};

// Displacement of a cell's sample point, in cell sides of its level (tau/2 on the finest), by a hash of seed and cell;
// zero for seed 0, as plates are regular without it.
class Jitter {
 public:
  Jitter(std::uint64_t seed, float most) : seed_(seed), most_(2 * most) {}
  [[nodiscard]] bool none() const { return seed_ == 0; }
  [[nodiscard]] Vec2f at(int depth, int x, int y) const {
    if (none()) return {};
    const std::uint64_t cell =
        (static_cast<std::uint64_t>(static_cast<std::uint32_t>(y)) << 32) | static_cast<std::uint32_t>(x);
    const std::uint64_t bits = hash64(hash64(seed_ + static_cast<std::uint64_t>(depth)) ^ cell);
    const auto unit = [](std::uint64_t v) { return static_cast<float>(v & 0xffffff) * (1.0f / 0x800000) - 1; };
    return {most_ * unit(bits), most_ * unit(bits >> 32)};
  }

 private:
  std::uint64_t seed_;
  float most_;
};

Jitter jitterOf(const ToolpathParams& params) { return {params.seed, static_cast<float>(params.jitter)}; }

Vec2f multiply(Vec2f a, Vec2f b) { return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x}; }

// Eq. 8: the wave of j seen from i, without weight. The phase flips to pi - phase where the lines oppose each other. By
// the mean of both lines, at the midpoint, it is second order, which raises alignment by 0.012 to 0.016.
Vec2f transported(PhaseTransport transport, Vec2f offsetSteps, Vec2f ki, Vec2f kj, Vec2f qj) {
  const float s = dot(ki, kj) > 0 ? 1.0f : -1.0f;
  const Vec2f k = transport == PhaseTransport::Midpoint ? (kj + ki * s) * 0.5f : kj;
  const SinCos turn = sinCos(dot(offsetSteps, k));
  const Vec2f q = multiply({turn.cos, turn.sin}, qj);
  return {s * q.x, q.y};
}

Vec2f lineAt(const PhaseLevel& level, std::size_t colour, std::size_t i) {
  return {level.dx[colour][i], level.dy[colour][i]};
}

Vec2f waveAt(const PhaseLevel& level, std::size_t colour, std::size_t i) {
  return lineAt(level, colour, i) * level.f[colour][i];
}

bool isMasked(const PhaseLevel& level, std::size_t colour, std::size_t i) {
  return level.dx[colour][i] == 0 && level.dy[colour][i] == 0;
}

PhaseLevel makeLevel(LevelShape shape, float step, int depth, PhaseTransport transport, bool anchors) {
  PhaseLevel level;
  level.transport = transport;
  level.shape = shape;
  level.step = step;
  level.depth = depth;
  for (Planes* planes : {&level.dx, &level.dy, &level.f, &level.qr, &level.qi, &level.free})
    *planes = makePlanes(shape);
  if (anchors) {
    level.ar = makePlanes(shape);
    level.ai = makePlanes(shape);
  }
  return level;
}

// Displacements between the sample points of two cells, for the cells of a row: the way from one to the other less that
// between the cells.
struct RowMoves {
  std::vector<float> x;
  std::vector<float> y;
};

// Computes the transport (Eq. 8) along one edge for the cells of a row, four at a time: it may run over the row's end,
// to the end of a vector.
// \param i  index of the row's first cell in its plane. \param move  added to the way from j to i for each cell; empty
// for none.
void fillEdges(PhaseLevel& level, std::size_t e, std::size_t colour, std::size_t i, const RowMoves& move) {
  const NeighbourPlane n = neighbourPlane(level.shape, colour, kEdgeX[e], kEdgeY[e]);
  const std::size_t j = static_cast<std::ptrdiff_t>(i) + n.offset;
  const bool midpoint = level.transport == PhaseTransport::Midpoint;
  const F4 edgeWeight = splat(kEdgeX[e] != 0 && kEdgeY[e] != 0 ? kCornerWeight : kSideWeight);
  const F4 step = splat(level.step);
  const F4 share = splat(midpoint ? 0.5f * level.step : level.step);
  Transport& edge = level.edges[e];
  for (std::size_t k = 0, cells = level.shape.px; k < cells; k += 4) {
    F4 ox = splat(static_cast<float>(-kEdgeX[e]));
    F4 oy = splat(static_cast<float>(-kEdgeY[e]));
    if (!move.x.empty()) {
      ox = ox + load4(&move.x[k]);
      oy = oy + load4(&move.y[k]);
    }
    const F4 dix = load4(&level.dx[colour][i + k]);
    const F4 diy = load4(&level.dy[colour][i + k]);
    const F4 djx = load4(&level.dx[n.colour][j + k]);
    const F4 djy = load4(&level.dy[n.colour][j + k]);
    // The weight |d_i.d_j| leaves lines at a right angle unconnected: neither sign of theirs would be better.
    const F4 along = dix * djx + diy * djy;
    const F4 sign = select4(along > splat(0), splat(1), splat(-1));
    const F4 fi = sign * load4(&level.f[colour][i + k]);
    const F4 fj = load4(&level.f[n.colour][j + k]);
    const F4 weight = edgeWeight * (sign * along);
    const F4 kx = midpoint ? fj * djx + fi * dix : fj * djx;
    const F4 ky = midpoint ? fj * djy + fi * diy : fj * djy;
    const SinCos4 turn = sinCos(share * (ox * kx + oy * ky));
    store4(&edge.re[colour][i + k], weight * turn.cos);
    store4(&edge.im[colour][i + k], weight * turn.sin);
    store4(&edge.sign[colour][i + k], sign);
    if (midpoint) continue;
    const SinCos4 back = sinCos(step * (ox * fi * dix + oy * fi * diy));
    store4(&edge.backRe[colour][i + k], weight * back.cos);
    store4(&edge.backIm[colour][i + k], weight * back.sin);
  }
}

// Computes w |d_i.d_j| e^{i theta} for every edge of a level beforehand, as all sweeps use the same; masked ends get 0.
void computeEdges(PhaseLevel& level, const Jitter& jitter, const RunContext& run) {
  const LevelShape& shape = level.shape;
  for (std::size_t e = 0; e < kEdges; ++e) {
    level.edges[e] = {makePlanes(shape), makePlanes(shape), makePlanes(shape), {}, {}};
    if (level.transport != PhaseTransport::Midpoint) {
      level.edges[e].backRe = level.edges[e].backIm = makePlanes(shape);
    }
    for (std::size_t colour = 0; colour < kColours; ++colour) {
      parallelFor(run, shape.py, rowGrain(run, shape.py, 10.0 * shape.px), [&](int begin, int end) {
        // With jitter, the way between two cells is different for each pair.
        RowMoves move;
        if (!jitter.none()) move.x = move.y = std::vector<float>(shape.stride);
        for (int y = begin; y < end; ++y) {
          for (int x = 0; x < shape.px && !jitter.none(); ++x) {
            const int cx = 2 * x + colourX(colour);
            const int cy = 2 * y + colourY(colour);
            const Vec2f way = jitter.at(level.depth, cx, cy) - jitter.at(level.depth, cx + kEdgeX[e], cy + kEdgeY[e]);
            move.x[x] = way.x;
            move.y[x] = way.y;
          }
          fillEdges(level, e, colour, shape.at(0, y), move);
        }
      });
    }
  }
}

// Pointers to one edge's transport and to the neighbours' phases, so shifted that a cell's index serves for all.
struct SweepSource {
  const float* re;
  const float* im;
  const float* sign;
  const float* qr;
  const float* qi;
};

// The arrays that the update of one colour reads and writes.
struct ColourSweep {
  SweepSource ahead[kEdges];   ///< edges that the cell owns
  SweepSource behind[kEdges];  ///< edges that the neighbour owns
  float* qr;
  float* qi;
  const float* free;
  const float* ar;  ///< null without a soft border
  const float* ai;
};
ColourSweep colourSweep(PhaseLevel& level, std::size_t colour) {
  const bool anchors = !level.ar[colour].empty();
  ColourSweep sweep{{},
                    {},
                    level.qr[colour].data(),
                    level.qi[colour].data(),
                    level.free[colour].data(),
                    anchors ? level.ar[colour].data() : nullptr,
                    anchors ? level.ai[colour].data() : nullptr};
  for (std::size_t e = 0; e < kEdges; ++e) {
    const NeighbourPlane a = neighbourPlane(level.shape, colour, kEdgeX[e], kEdgeY[e]);
    const NeighbourPlane b = neighbourPlane(level.shape, colour, -kEdgeX[e], -kEdgeY[e]);
    const Transport& edge = level.edges[e];
    sweep.ahead[e] = {edge.re[colour].data(), edge.im[colour].data(), edge.sign[colour].data(),
                      level.qr[a.colour].data() + a.offset, level.qi[a.colour].data() + a.offset};
    const bool midpoint = level.transport == PhaseTransport::Midpoint;
    const Planes& re = midpoint ? edge.re : edge.backRe;
    const Planes& im = midpoint ? edge.im : edge.backIm;
    sweep.behind[e] = {re[b.colour].data() + b.offset, im[b.colour].data() + b.offset,
                       edge.sign[b.colour].data() + b.offset, level.qr[b.colour].data() + b.offset,
                       level.qi[b.colour].data() + b.offset};
  }
  return sweep;
}

// Updates some cells of one row of one colour (Eq. 10), in place and four at a time: q_i becomes the normalised sum of
// the neighbours' transported phases. It may run over the row's end, to the end of a vector.
void sweepCells(const ColourSweep& sweep, std::size_t first, int cells) {
  for (std::size_t i = first; i < first + cells; i += 4) {
    // A soft border's wave is one more neighbour.
    F4 sumRe = sweep.ar != nullptr ? load4(sweep.ar + i) : splat(0);
    F4 sumIm = sweep.ai != nullptr ? load4(sweep.ai + i) : splat(0);
    for (std::size_t e = 0; e < kEdges; ++e) {
      const SweepSource& s = sweep.ahead[e];
      const F4 re = load4(s.re + i);
      const F4 im = load4(s.im + i);
      const F4 jr = load4(s.qr + i);
      const F4 ji = load4(s.qi + i);
      sumRe = sumRe + load4(s.sign + i) * (re * jr - im * ji);
      sumIm = sumIm + (re * ji + im * jr);
    }
    for (std::size_t e = 0; e < kEdges; ++e) {
      // An edge that the neighbour owns is used the other way round: by the transposed matrix.
      const SweepSource& s = sweep.behind[e];
      const F4 sign = load4(s.sign + i);
      const F4 re = load4(s.re + i);
      const F4 im = load4(s.im + i);
      const F4 jr = load4(s.qr + i);
      const F4 ji = load4(s.qi + i);
      sumRe = sumRe + (sign * (re * jr) + im * ji);
      sumIm = sumIm + (re * ji - sign * (im * jr));
    }
    // Fixed cells, and cells whose neighbours cancel out, keep their phase.
    const F4 size2 = sumRe * sumRe + sumIm * sumIm;
    const I4 change = (size2 > splat(kNoPhase * kNoPhase)) & (load4(sweep.free + i) > splat(0));
    const F4 scale = splat(1) / sqrt4(max4(size2, splat(kNoPhase * kNoPhase)));
    store4(sweep.qr + i, select4(change, sumRe * scale, load4(sweep.qr + i)));
    store4(sweep.qi + i, select4(change, sumIm * scale, load4(sweep.qi + i)));
  }
}

// Sweeps once over the four colours: the update of Eq. 11, which lowers the field's energy (Eq. 9). The colours of even
// rows (0, 1) see the odd rows (2, 3) above and below, and so the odd rows may follow one row behind: the level passes
// through the cache once instead of four times, with the same result (measured at 16 million cells: half the time). The
// last odd row of each band waits for the band above it.
void sweepOnce(const std::array<ColourSweep, kColours>& colours, const LevelShape& shape, const RunContext& run) {
  const int grain = std::max(4, rowGrain(run, shape.py, 32.0 * shape.px));
  const auto evenRow = [&](int y) {
    sweepCells(colours[0], shape.at(0, y), shape.px);
    sweepCells(colours[1], shape.at(0, y), shape.px);
  };
  const auto oddRow = [&](int y) {
    sweepCells(colours[2], shape.at(0, y), shape.px);
    sweepCells(colours[3], shape.at(0, y), shape.px);
  };
  parallelFor(run, shape.py, grain, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      evenRow(y);
      if (y > begin) oddRow(y - 1);
    }
  });
  parallelForEach(run, (shape.py + grain - 1) / grain, 1,
                  [&](int band) { oddRow(std::min((band + 1) * grain, shape.py) - 1); });
}

// Offset from a child's point to its parent's, in child cell sides.
Vec2f toParent(std::size_t colour) {
  return {0.5f - static_cast<float>(colourX(colour)), 0.5f - static_cast<float>(colourY(colour))};
}

// The same between their displaced sample points.
Vec2f parentOffset(const PhaseLevel& fine, std::size_t colour, int px, int py, const Jitter& jitter) {
  const Vec2f parent = jitter.at(fine.depth + 1, px, py) * 2.0f;
  const Vec2f child = jitter.at(fine.depth, 2 * px + colourX(colour), 2 * py + colourY(colour));
  return toParent(colour) + parent - child;
}

// Makes the next coarser level (Eq. 12). Its lines are z-sums of the children. Only phases of fixed children matter, as
// prolongation overwrites free ones. The waves of soft borders add up. A parent with a fixed child is fixed.
PhaseLevel restricted(const PhaseLevel& fine, const Jitter& jitter, const RunContext& run) {
  const bool anchors = !fine.ar[0].empty();
  PhaseLevel coarse = makeLevel(fine.shape.coarser(), 2 * fine.step, fine.depth + 1, fine.transport, anchors);
  parallelForEach(run, fine.shape.py, rowGrain(run, fine.shape.py, 40.0 * fine.shape.px), [&](int y) {
    for (int x = 0; x < fine.shape.px; ++x) {
      const std::size_t child = fine.shape.at(x, y);
      Vec2f z{};
      Vec2f any{};
      float frequencies = 0;
      float count = 0;
      for (std::size_t c = 0; c < kColours; ++c) {
        const Vec2f d = lineAt(fine, c, child);
        if (isMasked(fine, c, child)) continue;
        any = d;
        z = z + lineOf(d);
        frequencies += fine.f[c][child];
        ++count;
      }
      // The parent's line and frequency.
      if (any == Vec2f{}) continue;
      const std::size_t colour = colourOf(x, y);
      const std::size_t at = coarse.shape.atCell(x, y);
      const float size = length(z);
      Vec2f d = any;
      if (size > 1e-6f) d = directionOf(z * (1 / size));
      coarse.dx[colour][at] = d.x;
      coarse.dy[colour][at] = d.y;
      coarse.f[colour][at] = frequencies / count;
      const Vec2f k = waveAt(coarse, colour, at);
      // Its phase: the children's waves transported to the parent's sample point, weighted by how well lines agree.
      Vec2f fixedSum{};
      Vec2f anchorSum{};
      bool fixed = false;
      for (std::size_t c = 0; c < kColours; ++c) {
        if (isMasked(fine, c, child)) continue;
        const Vec2f kj = waveAt(fine, c, child);
        const Vec2f offset = parentOffset(fine, c, x, y, jitter) * fine.step;
        const float along = std::abs(dot(d, lineAt(fine, c, child)));
        if (fine.free[c][child] == 0) {
          fixed = true;
          fixedSum =
              fixedSum + transported(fine.transport, offset, k, kj, {fine.qr[c][child], fine.qi[c][child]}) * along;
        }
        if (anchors)
          anchorSum =
              anchorSum + transported(fine.transport, offset, k, kj, {fine.ar[c][child], fine.ai[c][child]}) * along;
      }
      // A free parent's phase does not matter, as prolongation overwrites it.
      const float sum = length(fixedSum);
      const Vec2f q = sum > kNoPhase ? fixedSum * (1 / sum) : Vec2f{1, 0};
      coarse.qr[colour][at] = q.x;
      coarse.qi[colour][at] = q.y;
      coarse.free[colour][at] = fixed ? 0.0f : 1.0f;
      if (anchors) {
        coarse.ar[colour][at] = anchorSum.x;
        coarse.ai[colour][at] = anchorSum.y;
      }
    }
  });
  return coarse;
}

// Gives each free child its parent's phase, transported to the child's sample point: the start of its level's sweeps.
void prolong(const PhaseLevel& coarse, PhaseLevel& fine, const Jitter& jitter, const RunContext& run) {
  parallelForEach(run, fine.shape.py, rowGrain(run, fine.shape.py, 40.0 * fine.shape.px), [&](int y) {
    for (int x = 0; x < fine.shape.px; ++x) {
      const std::size_t colour = colourOf(x, y);
      const std::size_t parent = coarse.shape.atCell(x, y);
      const std::size_t child = fine.shape.at(x, y);
      const Vec2f kp = waveAt(coarse, colour, parent);
      const Vec2f qp{coarse.qr[colour][parent], coarse.qi[colour][parent]};
      for (std::size_t c = 0; c < kColours; ++c) {
        if (fine.free[c][child] == 0) continue;
        const Vec2f offset = parentOffset(fine, c, x, y, jitter) * -fine.step;
        const Vec2f q = transported(fine.transport, offset, waveAt(fine, c, child), kp, qp);
        fine.qr[c][child] = q.x;
        fine.qi[c][child] = q.y;
      }
    }
  });
}

// The wave whose first zero lies half a bead inside the border: phase pi (sd/tau + 1/2) along the outward normal.
Vec2f borderPhase(float distance, float spacing) {
  const SinCos v = sinCos(kPi * (distance / spacing + 0.5f));
  return {v.cos, v.sin};
}

// Sorts lines and frequencies into planes by colour, and sets the waves of the ring.
PhaseLevel finestLevel(const LineField& lines, const std::vector<float>& frequency, const SignedDistanceField& sdf,
                       const CellConstraints& cells, const ToolpathParams& params, const RunContext& run) {
  const Jitter jitter = jitterOf(params);
  const Grid& grid = lines.grid;
  const float spacing = static_cast<float>(params.spacing);
  const bool soft = params.perimeterMode == PerimeterMode::Soft;
  const bool ring = countedPerimeters(params) >= 1;
  PhaseLevel level = makeLevel(LevelShape(grid.nx, grid.ny), 0.5f * kPi, 0, params.phaseTransport, soft);
  parallelForEach(run, grid.ny, rowGrain(run, grid.ny, 10.0 * grid.nx), [&](int y) {
    for (int x = 0; x < grid.nx; ++x) {
      const std::size_t i = grid.index(x, y);
      if (cells.zone[i] == Zone::Masked) continue;
      const std::size_t colour = colourOf(x, y);
      const std::size_t at = level.shape.atCell(x, y);
      const Vec2f d = lines.direction[i];
      // All phases begin at 0: only the ring says anything yet.
      level.dx[colour][at] = d.x;
      level.dy[colour][at] = d.y;
      level.f[colour][at] = frequency[i];
      level.free[colour][at] = 1;
      level.qr[colour][at] = 1;
      if (cells.zone[i] != Zone::Ring || !(ring || soft)) continue;
      // The ring's wave is the border's, seen along the cell's line and from its sample point.
      const Vec2f n = sdf.normal[i];
      const float along = dot(d, n);
      Vec2f q = borderPhase(sdf.distance[i], spacing);
      if (along < 0) q.x = -q.x;  // (d, phi) = (-d, pi - phi)
      const SinCos move = sinCos(level.step * frequency[i] * dot(jitter.at(0, x, y), d));
      q = multiply({move.cos, move.sin}, q);
      // Mode Count fixes it; mode Soft makes it one more neighbour, the stronger the closer the line follows the
      // normal.
      if (ring) {
        level.qr[colour][at] = q.x;
        level.qi[colour][at] = q.y;
        level.free[colour][at] = 0;
      } else {
        const float weight = static_cast<float>(params.borderWeight) * std::abs(along);
        level.ar[colour][at] = weight * q.x;
        level.ai[colour][at] = weight * q.y;
      }
    }
  });
  return level;
}

}  // namespace

Result<SineField> alignPhases(const LineField& lines, std::vector<float> frequency, const SignedDistanceField& sdf,
                              const CellConstraints& cells, const ToolpathParams& params, const RunContext& run) {
  const Jitter jitter = jitterOf(params);
  // Up: restrict to the coarsest level.
  std::vector<PhaseLevel> levels;
  levels.push_back(finestLevel(lines, frequency, sdf, cells, params, run));
  release(frequency);  // memory peaks in the finest sweeps
  while (!levels.back().shape.coarsest() && !run.cancelled()) levels.push_back(restricted(levels.back(), jitter, run));
  // Down: prolong, and sweep each level. Coarse levels align waves over long ways; sweeps on the finest level alone
  // would need many more rounds for that (Sec. 5.3).
  for (std::size_t k = levels.size() - 1; k-- > 0;) {
    PhaseLevel& level = levels[k];
    prolong(levels[k + 1], level, jitter, run);
    levels.pop_back();
    // Edges are computed only for the level that is swept, as they take most of the memory.
    computeEdges(level, jitter, run);
    const std::array<ColourSweep, kColours> colours = {colourSweep(level, 0), colourSweep(level, 1),
                                                       colourSweep(level, 2), colourSweep(level, 3)};
    for (int sweep = 0; sweep < params.sweepsPerLevel && !run.cancelled(); ++sweep) {
      sweepOnce(colours, level.shape, run);
      if (k == 0) run.report((sweep + 1.0) / params.sweepsPerLevel);
    }
  }
  if (run.cancelled()) return cancelledRun();

  PhaseLevel& finest = levels[0];
  release(finest.edges);  // edges take most of the memory, which peaks in here
  const LevelShape& shape = finest.shape;
  const Grid& grid = lines.grid;
  // Back from the planes to rows, as wave vectors and unit phases.
  SineField field{grid, params.spacing, std::vector<Vec2f>(grid.size()), std::vector<Vec2f>(grid.size())};
  parallelForEach(run, grid.ny, rowGrain(run, grid.ny, 4.0 * grid.nx), [&](int y) {
    for (int x = 0; x < grid.nx; ++x) {
      const std::size_t colour = colourOf(x, y);
      const std::size_t at = shape.atCell(x, y);
      if (isMasked(finest, colour, at)) continue;
      const std::size_t i = grid.index(x, y);
      field.wave[i] = waveAt(finest, colour, at);
      Vec2f q{finest.qr[colour][at], finest.qi[colour][at]};
      if (params.seed != 0) {  // back from the moved sample point to the cell's centre
        const SinCos move = sinCos(-finest.step * dot(jitter.at(finest.depth, x, y), field.wave[i]));
        q = multiply({move.cos, move.sin}, q);
      }
      field.phase[i] = q;
    }
  });
  return field;
}

}  // namespace sillon
