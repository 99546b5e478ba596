#include "field/fields.hpp"

#include "base/fast_math.hpp"
#include "base/parallel_for.hpp"
#include "base/simd.hpp"
#include "field/hierarchy.hpp"

namespace sillon {
namespace {

constexpr float kNoLine = 1e-6f;  ///< an average shorter than this has no direction

// Lines of one level as z = e^{2i angle}. Masked cells have z = 0, and so count for nothing in any sum.
struct LineLevel {
  LevelShape shape;
  Planes re;
  Planes im;
  Planes free;  ///< 1 where smoothing may change the line, else 0
};

// Lines at the finest level before smoothing, and which of them stay.
struct LineInput {
  std::vector<Vec2f> line;          ///< z per cell, 0 where masked
  std::vector<std::uint8_t> fixed;  ///< 1 where the line stays, per cell
};

LineLevel makeLevel(LevelShape shape) { return {shape, makePlanes(shape), makePlanes(shape), makePlanes(shape)}; }

// Sorts the cells by colour into the planes of the finest level.
LineLevel finestLevel(const Grid& grid, const LineInput& input) {
  LineLevel level = makeLevel(LevelShape(grid.nx, grid.ny));
  for (int y = 0; y < grid.ny; ++y) {
    for (int x = 0; x < grid.nx; ++x) {
      const std::size_t i = grid.index(x, y);
      const std::size_t colour = colourOf(x, y);
      const std::size_t at = level.shape.atCell(x, y);
      level.re[colour][at] = input.line[i].x;
      level.im[colour][at] = input.line[i].y;
      const bool masked = input.line[i] == Vec2f{};
      level.free[colour][at] = !masked && !input.fixed[i] ? 1.0f : 0.0f;
    }
  }
  return level;
}

// Makes the next coarser level. A parent is the average of its fixed children if it has any, else of all; it is fixed
// if one of them is.
LineLevel restricted(const LineLevel& fine) {
  LineLevel coarse = makeLevel(fine.shape.coarser());
  for (int y = 0; y < fine.shape.py; ++y) {
    for (int x = 0; x < fine.shape.px; ++x) {
      const std::size_t child = fine.shape.at(x, y);
      Vec2f all{};
      Vec2f fixedSum{};
      Vec2f any{};
      bool fixed = false;
      for (std::size_t c = 0; c < kColours; ++c) {
        // Sum up the children that are not masked, and the fixed ones apart.
        const Vec2f z{fine.re[c][child], fine.im[c][child]};
        if (z == Vec2f{}) continue;
        any = z;
        all = all + z;
        if (fine.free[c][child] == 0) {
          fixed = true;
          fixedSum = fixedSum + z;
        }
      }
      if (any == Vec2f{}) continue;
      // Any child's line serves if the lines cancel out.
      Vec2f z = fixed ? fixedSum : all;
      const float size = length(z);
      z = size > kNoLine ? z * (1 / size) : any;
      const std::size_t colour = colourOf(x, y);
      const std::size_t at = coarse.shape.atCell(x, y);
      coarse.re[colour][at] = z.x;
      coarse.im[colour][at] = z.y;
      coarse.free[colour][at] = fixed ? 0.0f : 1.0f;
    }
  }
  return coarse;
}

// Gives each free child its parent's line, to begin the sweeps of its level with.
void prolong(const LineLevel& coarse, LineLevel& fine) {
  for (int y = 0; y < fine.shape.py; ++y) {
    for (int x = 0; x < fine.shape.px; ++x) {
      const std::size_t colour = colourOf(x, y);
      const std::size_t parent = coarse.shape.atCell(x, y);
      const std::size_t child = fine.shape.at(x, y);
      for (std::size_t c = 0; c < kColours; ++c) {
        if (fine.free[c][child] == 0) continue;
        fine.re[c][child] = coarse.re[colour][parent];
        fine.im[c][child] = coarse.im[colour][parent];
      }
    }
  }
}

// One sweep of one colour in place (Eq. 4): each cell gets the line that minimises the energy of Eq. 1 among its
// weighted neighbours. That minimum, the average of Eq. 2, has a closed form: the angle of the sum of the lines' z.
void sweepColour(LineLevel& level, std::size_t colour, const RunContext& run) {
  const LevelShape& shape = level.shape;
  // The eight neighbours, each as a pointer into its plane: they lie at unit stride, so that loops can use vectors.
  struct Source {
    const float* re;
    const float* im;
    float weight;
  };
  std::array<Source, 8> sources{};
  std::size_t count = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if (dx == 0 && dy == 0) continue;
      const NeighbourPlane n = neighbourPlane(shape, colour, dx, dy);
      sources[count++] = {level.re[n.colour].data() + n.offset, level.im[n.colour].data() + n.offset,
                          dx != 0 && dy != 0 ? kCornerWeight : kSideWeight};
    }
  }
  float* re = level.re[colour].data();
  float* im = level.im[colour].data();
  const float* free = level.free[colour].data();
  parallelForEach(run, shape.py, rowGrain(run, shape.py, 6.0 * shape.px), [&](int y) {
    for (int x = 0; x < shape.px; x += 4) {
      const std::size_t i = shape.at(x, y);
      F4 sumRe = splat(0);
      F4 sumIm = splat(0);
      for (const Source& s : sources) {
        sumRe = sumRe + splat(s.weight) * load4(s.re + i);
        sumIm = sumIm + splat(s.weight) * load4(s.im + i);
      }
      // Normalise where the sum has a direction and the cell is free; all other cells keep their line.
      const F4 size2 = sumRe * sumRe + sumIm * sumIm;
      const I4 change = (size2 > splat(kNoLine * kNoLine)) & (load4(free + i) > splat(0));
      const F4 scale = splat(1) / sqrt4(max4(size2, splat(kNoLine * kNoLine)));
      store4(re + i, select4(change, sumRe * scale, load4(re + i)));
      store4(im + i, select4(change, sumIm * scale, load4(im + i)));
    }
  });
}

// Lowers the field's energy (Eq. 3) by the update of Eq. 5 over the hierarchy: restricts to the top, then prolongs and
// sweeps level by level.
std::vector<Vec2f> smoothLines(const Grid& grid, const LineInput& input, int sweeps, const RunContext& run) {
  std::vector<LineLevel> levels;
  // Up: each level has a quarter of the cells.
  levels.push_back(finestLevel(grid, input));
  while (!levels.back().shape.coarsest()) levels.push_back(restricted(levels.back()));
  // Down: coarse lines carry far in few sweeps, and finer levels add detail. In place by colours, 8 sweeps reach what
  // 32 reach from old values.
  for (std::size_t k = levels.size() - 1; k-- > 0;) {
    prolong(levels[k + 1], levels[k]);
    levels.pop_back();
    for (int sweep = 0; sweep < sweeps && !run.cancelled(); ++sweep) {
      for (std::size_t colour = 0; colour < kColours; ++colour) sweepColour(levels[k], colour, run);
    }
  }
  // Back from the planes to rows.
  std::vector<Vec2f> lines(grid.size());
  const LineLevel& finest = levels.front();
  for (int y = 0; y < grid.ny; ++y) {
    for (int x = 0; x < grid.nx; ++x) {
      const std::size_t at = finest.shape.atCell(x, y);
      lines[grid.index(x, y)] = {finest.re[colourOf(x, y)][at], finest.im[colourOf(x, y)][at]};
    }
  }
  return lines;
}

}  // namespace

Result<LineField> lineField(const SignedDistanceField& sdf, const CellConstraints& cells, const ToolpathParams& params,
                            const RunContext& run) {
  const Grid& grid = cells.grid;
  const bool ring = countedPerimeters(params) >= 1;
  // Smoothing is skipped where no mode needs it: the base line serves shells and the modes along and across the border,
  // the final one only smoothest cells.
  bool needsBase = ring && params.perimeters >= 2;
  bool needsFinal = false;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (cells.zone[i] == Zone::Masked) continue;
    const DirectionMode mode = cells.mode[i];
    needsBase = needsBase || mode == DirectionMode::Parallel || mode == DirectionMode::Orthogonal;
    needsFinal = needsFinal || mode == DirectionMode::Smoothest;
  }

  const auto forCells = [&](const auto& visit) {
    parallelFor(run, grid.ny, rowGrain(run, grid.ny, 5.0 * grid.nx), [&](int begin, int end) {
      for (std::size_t i = grid.index(0, begin); i < grid.index(0, end); ++i) visit(i);
    });
  };
  // 1. Base line: everything begins as the normal of the nearest border, and the ring's normals are diffused over the
  // shape.
  LineInput base{std::vector<Vec2f>(grid.size()), std::vector<std::uint8_t>(grid.size(), 0)};
  forCells([&](std::size_t i) {
    if (cells.zone[i] == Zone::Masked) return;
    base.line[i] = lineOf(sdf.normal[i]);
    base.fixed[i] = cells.zone[i] == Zone::Ring ? 1 : 0;
  });
  if (needsBase) base.line = smoothLines(grid, base, params.sweepsPerLevel, run);

  // 2. Fix the lines that are asked for: further perimeters, modes along and across the border, and the map.
  LineInput lines = std::move(base);
  forCells([&](std::size_t i) {
    const Zone zone = cells.zone[i];
    if (zone == Zone::Masked || (zone == Zone::Ring && ring)) return;
    const DirectionMode mode = cells.mode[i];
    lines.fixed[i] = mode == DirectionMode::Smoothest ? 0 : 1;
    if (zone == Zone::Shell || mode == DirectionMode::Smoothest || mode == DirectionMode::Parallel) return;
    lines.line[i] = mode == DirectionMode::Orthogonal ? -lines.line[i] : cells.mapLine[i];
  });
  // 3. Smooth the rest between them.
  if (needsFinal) lines.line = smoothLines(grid, lines, params.sweepsPerLevel, run);

  // 4. From z to one of its two directions.
  LineField field{grid, std::vector<Vec2f>(grid.size()), std::move(lines.fixed)};
  forCells([&](std::size_t i) {
    if (cells.zone[i] != Zone::Masked) field.direction[i] = directionOf(lines.line[i]);
  });
  if (run.cancelled()) return cancelledRun();
  return field;
}

}  // namespace sillon
