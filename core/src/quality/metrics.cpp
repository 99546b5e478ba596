#include "sillon/quality/metrics.hpp"

#include <algorithm>
#include <cmath>

#include "base/decimal_text.hpp"
#include "base/fast_math.hpp"
#include "base/parallel_for.hpp"
#include "field/wave_fields.hpp"
#include "geometry/closed_curves.hpp"
#include "quality/bead_area.hpp"
#include "sillon/field/constraints.hpp"
#include "sillon/geometry/signed_distance.hpp"
#include "toolpath/toolpath_check.hpp"

namespace sillon {
namespace {

Vec2 wide(Vec2f p) { return {static_cast<double>(p.x), static_cast<double>(p.y)}; }

// Shape minus its opening by a disc of radius tau/2, pieces above tau²/4: samples tau/8 apart.
Result<std::vector<LostPlace>> lostPlaces(const Shape& shape, const BorderIndex& border, const Bounds& box,
                                          double spacing, const RunContext& run) {
  constexpr int kSamples = 8;
  const double cell = spacing / kSamples;
  const Grid grid{{box.min.x - spacing, box.min.y - spacing},
                  cell,
                  static_cast<int>((box.size().x + 2 * spacing) / cell) + 1,
                  static_cast<int>((box.size().y + 2 * spacing) / cell) + 1};
  const float deep = static_cast<float>(-0.5 * spacing);
  const Result<std::vector<float>> distance = bandDistance(shape, border, grid, -deep, run);  // exact down to `deep`
  if (!distance) return distance.error();
  const std::vector<float>& sd = distance.value();
  std::vector<char> lost(grid.size(), 0);
  constexpr int kReach = kSamples / 2 + 1;
  constexpr double kLimit = (kSamples / 2 + 0.75) * (kSamples / 2 + 0.75);  // a deep sample stands for its cell
  parallelFor(run, grid.ny, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < grid.nx; ++x) {
        const std::size_t i = grid.index(x, y);
        if (sd[i] > 0 || sd[i] <= deep) continue;
        bool reached = false;
        for (int dy = -kReach; dy <= kReach && !reached; ++dy) {
          for (int dx = -kReach; dx <= kReach && !reached; ++dx) {
            if (dx * dx + dy * dy > kLimit || x + dx < 0 || y + dy < 0 || x + dx >= grid.nx || y + dy >= grid.ny)
              continue;
            reached = sd[grid.index(x + dx, y + dy)] <= deep;
          }
        }
        lost[i] = reached ? 0 : 1;
      }
    }
  });
  std::vector<LostPlace> places;
  std::vector<std::size_t> stack;
  for (std::size_t start = 0; start < lost.size(); ++start) {
    if (!lost[start]) continue;
    std::size_t size = 0;
    std::size_t deepest = start;
    stack.assign(1, start);
    lost[start] = 0;
    while (!stack.empty()) {
      const std::size_t i = stack.back();
      stack.pop_back();
      ++size;
      if (sd[i] < sd[deepest]) deepest = i;
      const std::size_t nx = static_cast<std::size_t>(grid.nx);
      for (const std::size_t j : {i - 1, i + 1, i - nx, i + nx}) {  // the frame is never lost, so no index runs out
        if (!lost[j]) continue;
        lost[j] = 0;
        stack.push_back(j);
      }
    }
    const double piece = static_cast<double>(size) * cell * cell;
    if (piece <= 0.25 * spacing * spacing) continue;
    const auto nx = static_cast<std::size_t>(grid.nx);
    const Vec2 at = grid.origin + cell * Vec2{static_cast<double>(deepest % nx), static_cast<double>(deepest / nx)};
    // Samples lie half a cell beside the thickest point, on average a quarter.
    places.push_back({at, piece, 0.5 * cell - 2.0 * static_cast<double>(sd[deepest])});
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const LostPlace& a, const LostPlace& b) { return a.areaMm2 > b.areaMm2; });
  return places;
}

struct AlignmentSums {
  double length = 0;
  double along = 0;  ///< length times cos²

  void add(double size, double cos2) {
    length += size;
    along += size * cos2;
  }
  [[nodiscard]] double value() const { return length > 0 ? -along / length : 0; }
};

struct Alignment {
  AlignmentSums all, interior, constrained;
};

// Eq. 17 over pieces of at most tau/8, against the nearest texel of the map as stored.
Alignment alignmentOf(const Cycle& cycle, const BorderIndex& border, Vec2 page, const DirectionMap& directions,
                      const ModeMap& modes, const ToolpathParams& params) {
  Alignment sums;
  const double spacing = params.spacing;
  TexelIndex last{-1, -1};
  Vec2f z;  // of the last texel
  const double shell = params.perimeterMode == PerimeterMode::Count ? std::max(params.perimeters, 1) : 1;
  for (std::size_t k = 0; k < cycle.points.size(); ++k) {
    const Vec2 a = wide(cycle.points[k]);
    const Vec2 b = wide(cycle.points[k + 1 < cycle.points.size() ? k + 1 : 0]);
    const double size = length(b - a);
    if (size <= 0) continue;
    const Vec2 t = (b - a) * (1 / size);
    const int pieces = static_cast<int>(std::ceil(size / (spacing / 8)));
    for (int piece = 0; piece < pieces; ++piece) {
      const Vec2 p = a + (b - a) * ((piece + 0.5) / pieces);
      const TexelIndex at = texelAt(p, page, directions.width, directions.height);
      if (at.x != last.x || at.y != last.y) {
        last = at;
        z = beadLine(directions.angle[static_cast<std::size_t>(at.y) * static_cast<std::size_t>(directions.width) +
                                      static_cast<std::size_t>(at.x)]);
      }
      // cos² of the angle between the lines, from their doubled angles.
      const double cos2 =
          0.5 * (1 + (t.x * t.x - t.y * t.y) * static_cast<double>(z.x) + 2 * t.x * t.y * static_cast<double>(z.y));
      const double share = size / pieces;
      sums.all.add(share, cos2);
      const double depth = static_cast<double>(border.blockDistance(p)) > (shell + 0.05) * spacing
                               ? 1e9
                               : -static_cast<double>(border.nearest(p).distance);
      if (depth > 1.05 * spacing) sums.interior.add(share, cos2);
      if (depth > (shell + 0.05) * spacing) {
        const TexelIndex m = texelAt(p, page, modes.width, modes.height);
        if (modes.mode[static_cast<std::size_t>(m.y) * static_cast<std::size_t>(modes.width) +
                       static_cast<std::size_t>(m.x)] == DirectionMode::Constrained) {
          sums.constrained.add(share, cos2);
        }
      }
    }
  }
  return sums;
}

// Unit vectors along the steps of a cycle.
std::vector<Vec2f> headingsOf(const Vec2f* points, int n) {
  std::vector<Vec2f> headings;
  headings.reserve(static_cast<std::size_t>(n));
  for (int k = 0; k < n; ++k) {
    const Vec2f e = points[k + 1 < n ? k + 1 : 0] - points[k];
    const float size = length(e);
    headings.push_back(size > 0 ? e * (1 / size) : Vec2f{});
  }
  return headings;
}

// Runs of steps whose heading differs by at least the given angle from that `apart` steps on, round the cycle.
std::int64_t countTurns(const std::vector<Vec2f>& headings, std::size_t apart, float cosine) {
  const std::size_t n = headings.size();
  const auto turnsAt = [&](std::size_t k) {
    const std::size_t on = k + apart;
    return dot(headings[k], headings[on < n ? on : on % n]) <= cosine;
  };
  std::int64_t runs = 0;
  bool before = turnsAt(n - 1);
  const bool all = before;
  for (std::size_t k = 0; k < n; ++k) {
    const bool turns = turnsAt(k);
    runs += turns && !before ? 1 : 0;
    before = turns;
  }
  return runs == 0 && all ? 1 : runs;
}

WidthMeasures widthsOf(const Toolpath& toolpath, const ToolpathParams& params, double totalLength) {
  std::vector<std::pair<float, float>> weighted;  // width, length
  WidthMeasures out;
  const double spacing = toolpath.spacing;
  for (const Cycle& cycle : toolpath.cycles) {
    const std::size_t n = cycle.points.size();
    for (std::size_t k = 0; k < n; ++k) {
      const float share = 0.5f * (length(cycle.points[k] - cycle.points[(k + n - 1) % n]) +
                                  length(cycle.points[(k + 1) % n] - cycle.points[k]));
      weighted.emplace_back(cycle.widths[k], share);
      const double w = static_cast<double>(cycle.widths[k]) / spacing;
      if (w < 0.5 - 1e-9) out.belowHalf += static_cast<double>(share);
      if (w <= params.minWidth + 1e-3 || w >= params.maxWidth - 1e-3) out.clamped += static_cast<double>(share);
    }
  }
  if (totalLength <= 0) return out;
  std::sort(weighted.begin(), weighted.end());
  double sum = 0;
  const auto quantiles = {std::pair{0.01, &out.p01}, std::pair{0.5, &out.median}, std::pair{0.99, &out.p99}};
  for (const auto& [width, share] : weighted) {
    const double before = sum;
    sum += static_cast<double>(share);
    for (const auto& [q, value] : quantiles) {
      if (before <= q * totalLength && sum > q * totalLength) *value = static_cast<double>(width) / spacing;
    }
  }
  out.belowHalf /= totalLength;
  out.clamped /= totalLength;
  return out;
}

ClosedCurves curvesOf(const Toolpath& toolpath) {
  ClosedCurves curves;
  for (const Cycle& cycle : toolpath.cycles) {
    curves.begin.push_back(static_cast<int>(curves.points.size()));
    curves.points.insert(curves.points.end(), cycle.points.begin(), cycle.points.end());
  }
  curves.begin.push_back(static_cast<int>(curves.points.size()));
  return curves;
}

// Of the waves as the pipeline makes them: the path itself no longer shows them.
Result<Dislocations> dislocationsOf(const Outline& outline, const Shape& shape, const DirectionMap& directions,
                                    const ModeMap& modes, const ToolpathParams& params, const RunContext& run) {
  const Grid grid = makeGrid(outline.bounds, params.spacing);
  const Result<BorderIndex> border = buildBorderIndex(outline, grid, run);
  if (!border) return border.error();
  const Result<SignedDistanceField> sdf = signedDistanceField(shape, border.value(), grid, run);
  if (!sdf) return sdf.error();
  const Result<WaveFields> fields = waveFields(sdf.value(), directions, modes, shape.page, params, run);
  if (!fields) return fields.error();
  return findDislocations(fields.value().lines, fields.value().waves, fields.value().cells, run);
}

}  // namespace

std::int64_t countCrossings(const Toolpath& toolpath) {
  return static_cast<std::int64_t>(findCrossings(curvesOf(toolpath), RunContext(1)).size());
}

std::string digestOf(const Toolpath& toolpath) {
  std::uint64_t hash = 0;
  const auto add = [&](std::int64_t v) { hash = hash64(hash ^ static_cast<std::uint64_t>(v)); };
  const auto addLength = [&](float v) { add(std::llround(static_cast<double>(v) * 1000)); };
  for (const Cycle& cycle : toolpath.cycles) {
    add(static_cast<std::int64_t>(cycle.points.size()));
    for (std::size_t k = 0; k < cycle.points.size(); ++k) {
      addLength(cycle.points[k].x);
      addLength(cycle.points[k].y);
      addLength(cycle.widths[k]);
    }
  }
  std::string digits(16, '0');
  for (std::size_t k = 0; k < 16; ++k) digits[k] = "0123456789abcdef"[(hash >> (60 - 4 * k)) & 15];
  return digits;
}

Result<Measures> measureToolpath(const Toolpath& toolpath, const Shape& shape, const DirectionMap& directions,
                                 const ModeMap& modes, const ToolpathParams& params, const RunContext& run,
                                 const std::optional<Dislocations>& known) {
  if (std::string defect = toolpathDefect(toolpath, shape.page); !defect.empty())
    return Error{ErrorCode::InvalidArgument, std::move(defect)};
  for (const double spacing : {toolpath.spacing, params.spacing}) {
    if (!(spacing >= 0.05 && spacing <= 20))  // NaN too
      return Error{ErrorCode::InvalidArgument, outOfRange("spacing", spacing, " mm", "0.05 to 20 mm")};
  }
  const double making = known ? 0 : 0.3;  // the waves' share
  run.beginJob();
  run.beginStage("measure", 0, making);
  const Result<Outline> outline = resolveOutline(shape);
  if (!outline) return outline.error();
  const Result<Dislocations> dislocations =
      known ? *known : dislocationsOf(outline.value(), shape, directions, modes, params, run);
  if (!dislocations) return dislocations.error();
  run.beginStage("measure", making, 1);
  Bounds box = outline.value().bounds;
  for (const Cycle& cycle : toolpath.cycles) {
    for (const Vec2f p : cycle.points) box.add(wide(p));
  }
  const Result<BorderIndex> border = buildBorderIndex(outline.value(), makeGrid(box, params.spacing), run);
  if (!border) return border.error();

  Measures out;
  out.digest = digestOf(toolpath);
  out.dislocations = dislocations.value().count;
  out.singularities = dislocations.value().singularities;
  out.dislocationBound = dislocations.value().bound;
  Alignment alignment;
  double laidArea = 0;
  for (const Cycle& cycle : toolpath.cycles) {
    const std::size_t n = cycle.points.size();
    for (std::size_t k = 0; k < n; ++k) {
      const double size = static_cast<double>(length(cycle.points[(k + 1) % n] - cycle.points[k]));
      out.lengthMm += size;
      laidArea += size * 0.5 * static_cast<double>(cycle.widths[k] + cycle.widths[(k + 1) % n]);
    }
    const Alignment sums = alignmentOf(cycle, border.value(), shape.page, directions, modes, params);
    for (const auto& [total, part] :
         {std::pair{&alignment.all, &sums.all}, std::pair{&alignment.interior, &sums.interior},
          std::pair{&alignment.constrained, &sums.constrained}}) {
      total->length += part->length;
      total->along += part->along;
    }
  }
  out.alignment = alignment.all.value();
  out.alignmentInterior = alignment.interior.value();
  out.alignmentConstrained = alignment.constrained.value();

  const BeadArea area = beadArea(toolpath, shape, box, run);
  const double pixels = std::max<double>(1, static_cast<double>(area.shape));
  out.coverage = 100 * static_cast<double>(area.covered) / pixels;
  out.spill = 100 * static_cast<double>(area.spilled) / pixels;
  out.overlap = 100 * static_cast<double>(area.overlapped) / pixels;
  out.fillRatio = laidArea / outline.value().area;
  out.shapeAreaMm2 = outline.value().area;
  Result<std::vector<LostPlace>> lost = lostPlaces(shape, border.value(), outline.value().bounds, params.spacing, run);
  if (!lost) return lost.error();
  out.lostPlaces = std::move(lost).value();
  for (const LostPlace& place : out.lostPlaces) out.lostAreaMm2 += place.areaMm2;

  const ClosedCurves curves = curvesOf(toolpath);
  const ClosedCurves fine = resampled(curves, static_cast<float>(params.spacing / 8), run);
  for (int c = 0; c < fine.count(); ++c) {
    const Vec2f* points = fine.points.data() + fine.begin[static_cast<std::size_t>(c)];
    const std::vector<Vec2f> headings = headingsOf(points, fine.size(c));
    out.uTurns += countTurns(headings, 12, -0.5f);
    out.kinks += countTurns(headings, 2, 0.5f);
  }
  out.crossings = static_cast<std::int64_t>(findCrossings(curves, run).size());
  out.width = widthsOf(toolpath, params, out.lengthMm);
  if (run.cancelled()) return Error{ErrorCode::Cancelled, "the run was cancelled"};
  run.report(1);
  return out;
}

}  // namespace sillon
