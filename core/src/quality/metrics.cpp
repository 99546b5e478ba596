#include "sillon/quality/metrics.hpp"

#include <algorithm>
#include <cmath>

#include "base/decimal_text.hpp"
#include "base/fast_math.hpp"
#include "base/whole_number.hpp"
#include "field/wave_fields.hpp"
#include "geometry/closed_curves.hpp"
#include "geometry/lost_cells.hpp"
#include "quality/bead_area.hpp"
#include "sillon/field/constraints.hpp"
#include "sillon/geometry/signed_distance.hpp"
#include "sillon/pipeline/plate_size.hpp"
#include "toolpath/toolpath_check.hpp"

namespace sillon {
namespace {

Vec2 wide(Vec2f p) { return {static_cast<double>(p.x), static_cast<double>(p.y)}; }

Result<std::vector<ThinPlace>> lostPlaces(const Shape& shape, const BorderIndex& border, const Bounds& box,
                                          double spacing, const RunContext& run) {
  const Result<LostCells> found = lostCells(shape, border, box, spacing, run);
  if (!found) return found.error();
  const LostCells& cells = found.value();
  const double cell = cells.grid.cell;
  std::vector<ThinPlace> places;
  for (const std::vector<std::size_t>& samples : cells.places) {
    const std::size_t deepest = *std::min_element(samples.begin(), samples.end(), [&](std::size_t i, std::size_t j) {
      return cells.distance[i] != cells.distance[j] ? cells.distance[i] < cells.distance[j] : i < j;
    });
    // Samples lie half a cell beside the thickest point, on average a quarter.
    const double width = 0.5 * cell - 2.0 * static_cast<double>(cells.distance[deepest]);
    places.push_back({cells.at(deepest), static_cast<double>(samples.size()) * cell * cell, width});
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const ThinPlace& a, const ThinPlace& b) { return a.areaMm2 > b.areaMm2; });
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
// \param lines  as beadLines.
Alignment alignmentOf(const Cycle& cycle, const BorderIndex& border, Vec2 page, const DirectionMap& directions,
                      const std::vector<Vec2f>& lines, const ModeMap& modes, const ToolpathParams& params) {
  Alignment sums;
  const double spacing = params.spacing;
  TexelIndex last{-1, -1};
  Vec2f z;  // of the last texel
  const auto modeAt = [&](Vec2 p) {
    if (modes.mode.size() == 1) return modes.mode.front();
    const TexelIndex at = texelAt(p, page, modes.width, modes.height);
    return modes
        .mode[static_cast<std::size_t>(at.y) * static_cast<std::size_t>(modes.width) + static_cast<std::size_t>(at.x)];
  };
  const double shell = params.perimeterMode == PerimeterMode::Count ? std::max(params.perimeters, 1) : 1;
  const double shallow = (shell + 0.05) * spacing;
  double away = 0;  // from the border, at least, at the start of a segment
  for (std::size_t k = 0; k < cycle.points.size(); ++k) {
    const Vec2 a = wide(cycle.points[k]);
    const Vec2 b = wide(cycle.points[k + 1 < cycle.points.size() ? k + 1 : 0]);
    const double size = length(b - a);
    if (size <= 0) continue;
    const Vec2 t = (b - a) * (1 / size);
    const int pieces = static_cast<int>(std::ceil(size / (spacing / 8)));
    const double share = size / pieces;
    const auto cos2Of = [&] {  // of the angle between the lines, from their doubled angles
      return 0.5 * (1 + (t.x * t.x - t.y * t.y) * static_cast<double>(z.x) + 2 * t.x * t.y * static_cast<double>(z.y));
    };
    double cos2 = cos2Of();
    if (away - size <= shallow) away = static_cast<double>(border.blockDistance(a));
    away -= size;
    for (int piece = 0; piece < pieces; ++piece) {
      const Vec2 p = a + (b - a) * ((piece + 0.5) / pieces);
      const TexelIndex at = texelAt(p, page, directions.width, directions.height);
      if (at.x != last.x || at.y != last.y) {
        last = at;
        z = lines[directions.angle[static_cast<std::size_t>(at.y) * static_cast<std::size_t>(directions.width) +
                                   static_cast<std::size_t>(at.x)]];
        cos2 = cos2Of();
      }
      sums.all.add(share, cos2);
      const double depth = away > shallow || static_cast<double>(border.blockDistance(p)) > shallow
                               ? 1e9
                               : -static_cast<double>(border.nearest(p).distance);
      if (depth > 1.05 * spacing) sums.interior.add(share, cos2);
      if (depth > shallow && modeAt(p) == DirectionMode::Constrained) {
        sums.constrained.add(share, cos2);
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

// The value at which the shares of all lesser ones have come to `below`. By halves, as sorting them all takes
// longer. \param weighted  values and shares; their order changes.
float weightedQuantile(std::vector<std::pair<float, float>>& weighted, double below) {
  auto begin = weighted.begin();
  auto end = weighted.end();
  while (end - begin > 1) {
    const auto middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end);
    double lesser = 0;
    for (auto at = begin; at != middle; ++at) lesser += static_cast<double>(at->second);
    if (lesser > below) {
      end = middle;
    } else {
      below -= lesser;
      begin = middle;
    }
  }
  return begin->first;
}

WidthMeasures widthsOf(const Toolpath& toolpath, const ToolpathParams& params, double totalLength) {
  std::vector<std::pair<float, float>> weighted;  // width, length
  WidthMeasures out;
  const double spacing = toolpath.spacing;
  for (const Cycle& cycle : toolpath.cycles) {
    const std::size_t n = cycle.points.size();
    float after = n > 0 ? length(cycle.points.front() - cycle.points.back()) : 0;
    for (std::size_t k = 0; k < n; ++k) {
      const float before = after;
      after = length(cycle.points[k + 1 < n ? k + 1 : 0] - cycle.points[k]);
      const float share = 0.5f * (before + after);
      weighted.emplace_back(cycle.widths[k], share);
      const double w = static_cast<double>(cycle.widths[k]) / spacing;
      if (w < 0.5 - 1e-9) out.belowHalf += static_cast<double>(share);
      if (w <= params.minWidth + 1e-3 || w >= params.maxWidth - 1e-3) out.clamped += static_cast<double>(share);
    }
  }
  if (totalLength <= 0) return out;
  for (const auto& [q, value] : {std::pair{0.01, &out.p01}, std::pair{0.5, &out.median}, std::pair{0.99, &out.p99}}) {
    *value = static_cast<double>(weightedQuantile(weighted, q * totalLength)) / spacing;
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
  return findDislocations(fields.value().lines, fields.value().waves, fields.value().cells, sdf.value(), params, run);
}

}  // namespace

std::int64_t countCrossings(const Toolpath& toolpath) {
  return static_cast<std::int64_t>(findCrossings(curvesOf(toolpath), RunContext(1)).size());
}

std::string digestOf(const Toolpath& toolpath) {
  std::uint64_t hash = 0;
  const auto add = [&](std::int64_t v) { hash = hash64(hash ^ static_cast<std::uint64_t>(v)); };
  const auto addLength = [&](float v) { add(toWhole(static_cast<double>(v) * 1000)); };
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
  Bounds box = outline.value().bounds;
  for (const Cycle& cycle : toolpath.cycles) {
    for (const Vec2f p : cycle.points) box.add(wide(p));
  }
  if (auto error = plateTooLarge(box.size(), std::min(toolpath.spacing, params.spacing))) return *error;
  const Result<Dislocations> dislocations =
      known ? *known : dislocationsOf(outline.value(), shape, directions, modes, params, run);
  if (!dislocations) return dislocations.error();
  run.beginStage("measure", making, 1);
  const Result<BorderIndex> border = buildBorderIndex(outline.value(), makeGrid(box, params.spacing), run);
  if (!border) return border.error();

  Measures out;
  out.digest = digestOf(toolpath);
  out.dislocations = dislocations.value().count;
  out.singularities = dislocations.value().singularities;
  out.dislocationBound = dislocations.value().bound;
  out.turnBound = dislocations.value().bound + dislocations.value().borderTurns;
  Alignment alignment;
  const std::vector<Vec2f> lines = beadLines();
  double laidArea = 0;
  for (const Cycle& cycle : toolpath.cycles) {
    const std::size_t n = cycle.points.size();
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t next = k + 1 < n ? k + 1 : 0;
      const double size = static_cast<double>(length(cycle.points[next] - cycle.points[k]));
      out.lengthMm += size;
      laidArea += size * 0.5 * static_cast<double>(cycle.widths[k] + cycle.widths[next]);
    }
    const Alignment sums = alignmentOf(cycle, border.value(), shape.page, directions, lines, modes, params);
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

  const BeadArea area = beadArea(toolpath, shape, border.value(), box, run);
  const double pixels = std::max<double>(1, static_cast<double>(area.shape));
  out.coverage = 100 * static_cast<double>(area.covered) / pixels;
  out.spill = 100 * static_cast<double>(area.spilled) / pixels;
  out.overlap = 100 * static_cast<double>(area.overlapped) / pixels;
  out.fillRatio = laidArea / outline.value().area;
  out.shapeAreaMm2 = outline.value().area;
  Result<std::vector<ThinPlace>> lost = lostPlaces(shape, border.value(), outline.value().bounds, params.spacing, run);
  if (!lost) return lost.error();
  out.lostPlaces = std::move(lost).value();
  for (const ThinPlace& place : out.lostPlaces) out.lostAreaMm2 += place.areaMm2;

  out.keptPlaces = shape.kept;
  for (const ThinPlace& place : out.keptPlaces) out.keptAreaMm2 += place.areaMm2;

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
