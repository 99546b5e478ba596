#include "quality/measured_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/parallel_for.hpp"
#include "field/fields.hpp"

namespace sillon {
namespace {

// The requested directions and modes, with which pieces of beads are compared.
struct Asked {
  const BorderIndex& border;
  Vec2 page;
  const DirectionMap& directions;
  const std::vector<Vec2f>& lines;  ///< line of each angle of a map, from beadLines()
  const ModeMap& modes;
  double spacing;
  double shallow;  ///< [mm] from the border, depth of the perimeters, in which no bead is constrained

  [[nodiscard]] Vec2f lineAt(TexelIndex at) const {
    return lines[directions.angle[indexOf(at.x, at.y, directions.width)]];
  }

  [[nodiscard]] DirectionMode modeAt(Vec2 p) const {
    if (modes.mode.size() == 1) return modes.mode.front();
    const TexelIndex at = texelAt(p, page, modes.width, modes.height);
    return modes.mode[indexOf(at.x, at.y, modes.width)];
  }
};

// Segments begin to end - 1 of one cycle: the unit of work that threads share.
struct SegmentRange {
  const Cycle* cycle;
  std::size_t begin;
  std::size_t end;
};

// Cuts the cycles into ranges of at most kSegments segments.
std::vector<SegmentRange> rangesOf(const Toolpath& toolpath) {
  constexpr std::size_t kSegments = 4096;
  std::vector<SegmentRange> ranges;
  for (const Cycle& cycle : toolpath.cycles) {
    for (std::size_t begin = 0; begin < cycle.points.size(); begin += kSegments)
      ranges.push_back({&cycle, begin, std::min(begin + kSegments, cycle.points.size())});
  }
  return ranges;
}

// Sums the alignment over the segments of a range.
Alignment sumsOf(const SegmentRange& range, const Asked& asked) {
  Alignment sums;
  const std::vector<Vec2f>& points = range.cycle->points;
  TexelIndex last{-1, -1};
  Vec2f z;          // doubled-angle line of the last texel
  double away = 0;  // lower bound of the distance from the border at the start of a segment [mm]
  for (std::size_t k = range.begin; k < range.end; ++k) {
    const Vec2 a = wide(points[k]);
    const Vec2 b = wide(points[k + 1 < points.size() ? k + 1 : 0]);
    const double size = length(b - a);
    if (size <= 0) continue;
    const Vec2 t = (b - a) * (1 / size);
    const int pieces = static_cast<int>(std::ceil(size / (asked.spacing / 8)));
    const double share = size / pieces;
    const auto cos2Of = [&] {  // cos² of the angle between the lines
      return 0.5 * (1 + (t.x * t.x - t.y * t.y) * static_cast<double>(z.x) + 2 * t.x * t.y * static_cast<double>(z.y));
    };
    double cos2 = cos2Of();
    if (away - size <= asked.shallow) away = static_cast<double>(asked.border.blockDistance(a));
    away -= size;
    for (int piece = 0; piece < pieces; ++piece) {
      const Vec2 p = a + (b - a) * ((piece + 0.5) / pieces);
      const TexelIndex at = texelAt(p, asked.page, asked.directions.width, asked.directions.height);
      if (at.x != last.x || at.y != last.y) {
        last = at;
        z = asked.lineAt(at);
        cos2 = cos2Of();
      }
      sums.all.add(share, cos2);
      const double depth = away > asked.shallow || static_cast<double>(asked.border.blockDistance(p)) > asked.shallow
                               ? 1e9
                               : -static_cast<double>(asked.border.nearest(p).distance);
      if (depth > 1.05 * asked.spacing) sums.interior.add(share, cos2);
      if (depth > asked.shallow && asked.modeAt(p) == DirectionMode::Constrained) sums.constrained.add(share, cos2);
    }
  }
  return sums;
}

}  // namespace

Alignment alignmentOf(const Toolpath& toolpath, const BorderIndex& border, const PlateInput& input,
                      const ToolpathParams& params, const RunContext& run) {
  const std::vector<Vec2f> lines = beadLines();
  const double perimeters = std::max(countedPerimeters(params), 1);
  const Asked asked{border,
                    input.shape.page,
                    input.directions,
                    lines,
                    input.modes,
                    params.spacing,
                    (perimeters + 0.05) * params.spacing};
  const std::vector<SegmentRange> ranges = rangesOf(toolpath);
  std::vector<Alignment> sums(ranges.size());
  parallelForEach(run, static_cast<int>(ranges.size()), 1, [&](int k) { sums[k] = sumsOf(ranges[k], asked); });
  Alignment out;
  for (const Alignment& part : sums) {
    out.all.add(part.all);
    out.interior.add(part.interior);
    out.constrained.add(part.constrained);
  }
  return out;
}

}  // namespace sillon
