#include "pipeline/steps.hpp"

#include <algorithm>
#include <cmath>

#include "base/cancelled.hpp"
#include "base/decimal_text.hpp"
#include "base/free_memory.hpp"
#include "geometry/closed_curves.hpp"
#include "sillon/base/reasons.hpp"
#include "sillon/field/sine_field.hpp"
#include "sillon/input/plate_size.hpp"
#include "sillon/toolpath/contour.hpp"
#include "sillon/toolpath/simplify.hpp"
#include "sillon/toolpath/small_cycles.hpp"
#include "sillon/toolpath/thin_features.hpp"

namespace sillon {
namespace {

/// Of plates with pictures, at least: joints off the lines show. Those along them leave a tenth fewer U-turns.
constexpr double kPictureStitchAlignment = 4;

template <class T>
void release(Fields fields, T& field) {
  if (fields == Fields::Freed) sillon::release(field);
}

}  // namespace

Result<ShapeFields> shapeStep(const Shape& shape, const ToolpathParams& params, StageClock& clock,
                              const RunContext& run, Stages* record) {
  clock.start("outline", 0.02);
  const Result<Outline> outline = resolveOutline(shape);
  if (!outline) return outline.error();
  const Vec2 size = outline.value().bounds.size();
  if (auto error = plateTooLarge(size, params.spacing, run.memory())) return *error;

  clock.start("distance", 0.06);
  const Grid grid = makeGrid(outline.value().bounds, params.spacing);
  Result<BorderIndex> border = buildBorderIndex(outline.value(), grid, run);
  if (!border) return border.error();
  Result<SignedDistanceField> sdf = signedDistanceField(shape, border.value(), grid, run);
  if (!sdf) return sdf.error();
  Parts parts = labelParts(sdf.value(), border.value(), params.spacing, params.bridge.value_or(params.spacing));
  if (parts.count == 0) {
    return Error{ErrorCode::EmptyShape,
                 "spacing is " + decimal(params.spacing, 3) + " mm, which is too wide for this shape of " +
                     decimal(size.x, 3) + " x " + decimal(size.y, 3) +
                     " mm; no place in it is wide enough for one bead",
                 reason::kNoBeadFits,
                 {{"spacing", params.spacing}}};
  }
  if (record != nullptr) {
    record->outline = outline.value();
    record->border = border.value();
    record->sdf = sdf.value();
    record->parts = parts;
  }
  return ShapeFields{std::move(border).value(), std::move(sdf).value(), std::move(parts)};
}

Result<WaveFields> waveStep(const PlateInput& input, const ShapeFields& shape, const ToolpathParams& params,
                            StageClock& clock, const RunContext& run, Stages* record, Lines which) {
  clock.start("lines", 0.12);
  WaveRecord seen;
  Result<WaveFields> waves = waveFields(
      shape.sdf, input.directions, input.modes, input.shape.page, params, run, [&] { clock.start("phases", 0.35); },
      record == nullptr ? nullptr : &seen, which);
  if (waves && record != nullptr) {
    record->cells = std::move(seen.cells);
    record->frequency = std::move(seen.frequency);
    record->lines = waves.value().lines;
    record->waves = waves.value().waves;
  }
  return waves;
}

Result<Dislocations> dislocationStep(const WaveFields& waves, const ShapeFields& shape, const ToolpathParams& params,
                                     StageClock& clock, const RunContext& run) {
  clock.stop();
  const Dislocations found = findDislocations(waves.lines, waves.waves, waves.cells, shape.sdf, params, run);
  if (run.cancelled()) return cancelledRun();
  return found;
}

Result<RelaxedPath> pathStep(const PlateInput& input, ShapeFields& shape, WaveFields& waves, Fields fields,
                             const ToolpathParams& params, StageClock& clock, const RunContext& run, Stages* record) {
  ToolpathResult plate;
  const Grid grid = waves.lines.grid;
  plate.nx = grid.nx;
  plate.ny = grid.ny;

  clock.start("contour", 0.5);
  const Grid nodes = nodeLattice(grid);
  ClosedCurves cycles;
  {
    const Result<std::vector<float>> distance =
        bandDistance(input.shape, shape.border, nodes, static_cast<float>(params.spacing), run);
    if (!distance) return distance.error();
    Result<std::vector<float>> values = evaluateSineField(waves.waves, distance.value(), params, run);
    if (!values) return values.error();
    release(fields, waves.waves);
    fillThinFeatures(nodes, distance.value(), shape.border, params.spacing, values.value());
    keepThinParts(shape.parts, shape.sdf, shape.border, params.spacing, values.value());
    release(fields, shape.sdf);
    Result<ClosedCurves> contour = contourCycles(nodes, values.value(), distance.value(), params.spacing, run);
    if (!contour) return contour.error();
    if (record != nullptr) {
      record->nodeDistance = distance.value();
      record->nodeValues = values.value();
      record->contour = contour.value();
    }
    cycles = std::move(contour).value();
  }
  plate.contourCycles = cycles.count();
  const auto noBead = [&] {
    return Error{ErrorCode::EmptyShape,
                 "no bead fits into this shape at spacing " + decimal(params.spacing, 3) +
                     " mm; use a smaller spacing or a larger shape",
                 reason::kNoBeadFits,
                 {{"spacing", params.spacing}}};
  };
  if (plate.contourCycles == 0) return noBead();

  clock.start("stitch", 0.65);
  cycles = resampledSimply(cycles, static_cast<float>(0.25 * params.spacing), run);
  cycles = regularizeSmallCycles(cycles, shape.border, params.spacing, run);
  if (run.cancelled()) return cancelledRun();
  if (cycles.count() == 0) return noBead();
  ToolpathParams joining = params;
  if (input.showsPictures) joining.stitchAlignment = std::max(joining.stitchAlignment, kPictureStitchAlignment);
  Result<Stitched> stitched = stitchCycles(cycles, waves.lines, shape.border, shape.parts, joining, run);
  if (!stitched) return stitched.error();
  if (record != nullptr) {
    record->cycles = cycles;
    record->stitched = stitched.value();
  }
  sillon::release(cycles);
  if (!input.showsPictures) release(fields, waves.lines);
  release(fields, shape.parts);
  plate.parts = stitched.value().parts;
  plate.longestJointMm = stitched.value().longestJoint;
  plate.gapJoints = stitched.value().gapJoints;
  plate.unjoined = stitched.value().unjoined();
  plate.apart = std::move(stitched.value().apart);
  plate.stitchWork = stitched.value().work;

  clock.start("relaxation", 0.88);
  Result<Relaxed> relaxed = relaxSpacing(std::move(stitched.value().curves), shape.border, params, run,
                                         input.showsPictures ? &waves.lines : nullptr);
  release(fields, waves.lines);
  if (!relaxed) return relaxed.error();
  if (record != nullptr) record->relaxed = relaxed.value();
  return RelaxedPath{std::move(relaxed).value(), std::move(plate)};
}

Result<ToolpathResult> widthStep(RelaxedPath& path, const BorderIndex& border, Fields fields,
                                 const ToolpathParams& params, StageClock& clock, const RunContext& run,
                                 Stages* record) {
  const ClosedCurves& curves = path.relaxed.curves;
  clock.start("width", 0.95);
  const Result<BeadWidths> widths = beadWidths(curves, path.relaxed.gaps, border, params, run);
  if (!widths) return widths.error();
  if (record != nullptr) record->widths = widths.value();
  release(fields, path.relaxed.gaps);

  clock.start("simplify", 1);
  Result<Toolpath> toolpath = finishToolpath(curves, widths.value(), params, run);
  if (!toolpath) return toolpath.error();
  ToolpathResult plate = path.seen;
  plate.toolpath = std::move(toolpath).value();
  plate.time = clock.takeTimes();
  run.report(1);
  if (record != nullptr) record->result = plate;
  return plate;
}

}  // namespace sillon
