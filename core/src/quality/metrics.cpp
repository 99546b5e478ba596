#include "sillon/quality/metrics.hpp"

#include <algorithm>

#include "base/fast_math.hpp"
#include "base/numbers.hpp"
#include "base/parallel_for.hpp"
#include "base/refused.hpp"
#include "base/sort_key.hpp"
#include "geometry/closed_curves.hpp"
#include "geometry/parts.hpp"
#include "geometry/signed_distance.hpp"
#include "input/plate_size.hpp"
#include "pipeline/steps.hpp"
#include "quality/measured_parts.hpp"
#include "toolpath/path.hpp"

namespace sillon {
namespace {

// Finds the places of a shape that are lost because no bead fits, with area and width.
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
    // The width is that of a strip of the same mean depth, so that junctions of lines do not count for the lines. It is
    // limited by the deepest sample, which lies up to half a cell beside the thickest point, on average a quarter.
    double depth = 0;
    for (const std::size_t k : samples) depth -= static_cast<double>(cells.distance[k]);
    const double width = std::min({0.5 * cell - 2.0 * static_cast<double>(cells.distance[deepest]),
                                   4 * depth / static_cast<double>(samples.size()), spacing});
    places.push_back({cells.at(deepest), static_cast<double>(samples.size()) * cell * cell, width});
  }
  sortBy(places, [](const ThinPlace& place) { return -place.areaMm2; });
  return places;
}

// Copies the cycles of a toolpath into one list of points.
ClosedCurves curvesOf(const Toolpath& toolpath) {
  ClosedCurves curves;
  for (const Cycle& cycle : toolpath.cycles) {
    curves.begin.push_back(static_cast<int>(curves.points.size()));
    curves.points.insert(curves.points.end(), cycle.points.begin(), cycle.points.end());
  }
  curves.begin.push_back(static_cast<int>(curves.points.size()));
  return curves;
}

// Counts dislocations in the waves, which are made again as in the pipeline, because the path itself no longer shows
// them.
Result<Dislocations> dislocationsOf(const Outline& outline, const PlateInput& input, const ToolpathParams& params,
                                    const RunContext& run) {
  const Grid grid = makeGrid(outline.bounds, params.spacing);
  const Result<BorderIndex> border = buildBorderIndex(outline, grid, run);
  if (!border) return border.error();
  const Result<SignedDistanceField> sdf = signedDistanceField(input.shape, border.value(), grid, run);
  if (!sdf) return sdf.error();
  const Making making{params, run};
  const Result<WaveFields> waves = waveStep(input, sdf.value(), BeadLines::Asked, making);
  if (!waves) return waves.error();
  return dislocationStep(waves.value(), sdf.value(), making);
}

}  // namespace

std::int64_t countCrossings(const Toolpath& toolpath) {
  return static_cast<std::int64_t>(findCrossings(curvesOf(toolpath), RunContext(1)).size());
}

// Hash of all points and widths, rounded to 1 µm; equal toolpaths give equal digests on every platform.
std::string digestOf(const Toolpath& toolpath) {
  std::uint64_t hash = 0;
  const auto add = [&](std::int64_t v) { hash = hash64(hash ^ static_cast<std::uint64_t>(v)); };
  const auto addLength = [&](float v) { add(toWhole(static_cast<double>(v) * 1000)); };
  for (const Cycle& cycle : toolpath.cycles) {
    add(static_cast<std::int64_t>(cycle.points.size()));
    for (std::size_t k = 0; k < cycle.points.size(); ++k) {
      addLength(cycle.points[k].x);
      addLength(cycle.points[k].y);
      addLength(k < cycle.widths.size() ? cycle.widths[k] : 0);
    }
  }
  std::string digits(16, '0');
  for (std::size_t k = 0; k < 16; ++k) digits[k] = "0123456789abcdef"[(hash >> (60 - 4 * k)) & 15];
  return digits;
}

Result<Measures> measureToolpath(const Toolpath& toolpath, const PlateInput& input, const ToolpathParams& params,
                                 const RunContext& run, const std::optional<Dislocations>& known) {
  const Shape& shape = input.shape;
  if (auto defect = toolpathDefect(toolpath, shape.page)) return *std::move(defect);
  for (std::size_t c = 0; c < toolpath.cycles.size(); ++c) {
    if (toolpath.cycles[c].points.empty()) return refusedArgument("FewPoints", {{"cycle", c}, {"points", 0}});
  }
  ToolpathParams made = params;
  made.spacing = toolpath.spacing;
  for (const ToolpathParams& each : {made, params}) {
    if (auto wrong = wrongInput(input, each)) return *wrong;
  }
  const double making = known ? 0 : 0.3;  // share of the time that the waves take
  run.beginJob();
  run.beginStage("measure", 0, making);
  const Result<Outline> outline = resolveOutline(shape);
  if (!outline) return outline.error();
  Bounds box = outline.value().bounds;
  for (const Cycle& cycle : toolpath.cycles) {
    for (const Vec2f p : cycle.points) box.add(wide(p));
  }
  if (auto error = plateTooLarge(box.size(), std::min(toolpath.spacing, params.spacing), run.memory())) return *error;
  const Result<Dislocations> dislocations = known ? *known : dislocationsOf(outline.value(), input, params, run);
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
  double laidArea = 0;
  for (const Cycle& cycle : toolpath.cycles) {
    const std::size_t n = cycle.points.size();
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t next = k + 1 < n ? k + 1 : 0;
      const double size = static_cast<double>(length(cycle.points[next] - cycle.points[k]));
      out.lengthMm += size;
      laidArea += size * 0.5 * static_cast<double>(cycle.widths[k] + cycle.widths[next]);
    }
  }
  const Alignment alignment = alignmentOf(toolpath, border.value(), input, params, run);
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
  const Turns turns = countTurns(curves, params.spacing, run);
  out.uTurns = turns.uTurns;
  out.kinks = turns.kinks;
  out.crossings = static_cast<std::int64_t>(findCrossings(curves, run).size());
  out.width = widthMeasures(toolpath, params, out.lengthMm);
  if (run.cancelled()) return cancelledRun();
  run.report(1);
  return out;
}

}  // namespace sillon
