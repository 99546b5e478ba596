#include "pipeline/steps.hpp"

#include <algorithm>
#include <string>

#include "base/free_memory.hpp"
#include "base/parallel_for.hpp"
#include "base/refused.hpp"
#include "field/fields.hpp"
#include "field/hierarchy.hpp"
#include "geometry/closed_curves.hpp"
#include "input/map_defect.hpp"
#include "input/plate_size.hpp"
#include "sillon/base/result.hpp"
#include "sillon/settings/table.hpp"
#include "toolpath/path.hpp"

namespace sillon {
namespace {

/// Least `stitchAlignment` of plates with pictures, where joints off the lines would show. It costs a tenth more
/// U-turns than joints at their shortest places.
constexpr double kPictureStitchAlignment = 4;

/// Rounds in which lines give way to the beads and the waves are aligned again, if `directionTolerance` allows it.
constexpr int kGivingRounds = 3;

Error noBeadFits(const Shape& shape, double spacing) {
  const Reason why = shape.drawing.linesOnly ? Reason("LinesTooThin") : Reason("NoBeadFits");
  return refused(ErrorCode::EmptyShape, why, {{"spacing", spacing}});
}

// Requests in each cell the line across the one it has. Lines along the border stay, because no bead can cross it.
void askAcross(const LineField& lines, CellConstraints& cells) {
  for (std::size_t i = 0; i < cells.zone.size(); ++i) {
    if (lines.direction[i] == Vec2f{}) continue;
    cells.mapLine[i] = -lineOf(lines.direction[i]);
    cells.mode[i] = DirectionMode::Constrained;
  }
}

// Traces the closed curves on which the sum of the waves is zero (Sec. 5.4). The waves are freed once they are summed.
Result<ClosedCurves> contourStep(const Shape& shape, const ShapeFields& fields, SineField waves, const Making& making) {
  const ToolpathParams& params = making.params;
  const Grid nodes = nodeLattice(waves.grid);
  const Result<std::vector<float>> distance =
      bandDistance(shape, fields.border, nodes, static_cast<float>(params.spacing), making.run);
  if (!distance) return distance.error();
  Result<std::vector<float>> values = evaluateSineField(waves, distance.value(), params, making.run);
  if (!values) return values.error();
  release(waves);
  fillThinFeatures(nodes, distance.value(), fields.border, params.spacing, values.value());
  keepThinParts(fields.parts, fields.sdf, fields.border, params.spacing, values.value());
  Result<ClosedCurves> contour = contourCycles(nodes, values.value(), distance.value(), params.spacing, making.run);
  if (!contour) return contour.error();
  contour = repulsed(std::move(contour).value(), nodes, params, making.run);
  if (making.run.cancelled()) return cancelledRun();
  making.record(&Stages::nodeDistance, distance.value());
  making.record(&Stages::nodeValues, values.value());
  making.record(&Stages::contour, contour.value());
  return contour;
}

// Stitches the curves into one cycle per part (Sec. 5.5), with joints along the lines if pictures are shown.
Result<Stitched> stitchStep(ClosedCurves cycles, const ShapeFields& fields, const LineField& lines, bool showsPictures,
                            const Making& making) {
  ToolpathParams params = making.params;
  if (showsPictures) params.stitchAlignment = std::max(params.stitchAlignment, kPictureStitchAlignment);
  cycles = resampledSimply(cycles, static_cast<float>(0.25 * params.spacing), making.run);
  cycles = regularizeSmallCycles(cycles, fields.border, params.spacing, making.run);
  if (making.run.cancelled()) return cancelledRun();
  if (cycles.count() == 0) return noBeadFits({}, params.spacing);
  making.record(&Stages::cycles, cycles);
  Result<Stitched> stitched = stitchCycles(cycles, lines, fields.border, fields.parts, params, making.run);
  if (stitched) making.record(&Stages::stitched, stitched.value());
  return stitched;
}

}  // namespace

std::optional<Error> wrongInput(const PlateInput& input, const ToolpathParams& params) {
  if (auto wrong = invalidSettings(params)) return wrong;
  const DirectionMap& directions = input.directions;
  const ModeMap& modes = input.modes;
  if (auto wrong = pageDefect(input.shape.page)) return wrong;
  if (auto wrong = mapDefect("directions", directions.width, directions.height, directions.angle.size())) return wrong;
  return mapDefect("modes", modes.width, modes.height, modes.mode.size());
}

Result<ShapeFields> shapeStep(const Shape& shape, const Making& making) {
  const ToolpathParams& params = making.params;
  making.start("outline", 0.005);
  const Result<Outline> outline = resolveOutline(shape);
  if (!outline) return outline.error();
  const Vec2 size = outline.value().bounds.size();
  if (auto error = plateTooLarge(size, params.spacing, making.run.memory())) return *error;

  making.start("distance", 0.055);
  const Grid grid = makeGrid(outline.value().bounds, params.spacing);
  Result<BorderIndex> border = buildBorderIndex(outline.value(), grid, making.run);
  if (!border) return border.error();
  Result<SignedDistanceField> sdf = signedDistanceField(shape, border.value(), grid, making.run);
  if (!sdf) return sdf.error();
  Parts parts = labelParts(sdf.value(), border.value(), params.spacing, params.bridge.value_or(params.spacing));
  if (parts.count == 0) return noBeadFits(shape, params.spacing);
  making.record(&Stages::outline, outline.value());
  making.record(&Stages::border, border.value());
  making.record(&Stages::sdf, sdf.value());
  making.record(&Stages::parts, parts);
  return ShapeFields{std::move(border).value(), std::move(sdf).value(), std::move(parts)};
}

Result<WaveFields> waveStep(const PlateInput& input, const SignedDistanceField& sdf, BeadLines which,
                            const Making& making) {
  const ToolpathParams& params = making.params;
  const RunContext& run = making.run;
  // Sec. 5.1: one line per cell.
  making.start("lines", 0.075);
  Result<CellConstraints> cells = cellConstraints(sdf, input.directions, input.modes, input.shape.page, params, run);
  if (!cells) return cells.error();
  Result<LineField> lines = lineField(sdf, cells.value(), params, run);
  if (!lines) return lines.error();
  if (which == BeadLines::Across) {
    askAcross(lines.value(), cells.value());
    lines = lineField(sdf, cells.value(), params, run);
    if (!lines) return lines.error();
  }
  making.record(&Stages::cells, cells.value());
  making.record(&Stages::lines, lines.value());
  release(cells.value().mapLine);  // frees memory before its peak, in the alignment

  // Sec. 5.2 and 5.3: waves along the lines, aligned with each other.
  making.start("phases", 0.195);
  Result<std::vector<float>> frequency = spacingField(lines.value(), cells.value(), params, run);
  if (!frequency) return frequency.error();
  making.record(&Stages::frequency, frequency.value());
  const bool gives = params.directionTolerance > 0;
  const std::vector<float> kept = gives ? frequency.value() : std::vector<float>();
  Result<SineField> waves = alignPhases(lines.value(), std::move(frequency).value(), sdf, cells.value(), params, run);
  for (int round = 0; waves && gives && round < kGivingRounds; ++round) {
    Result<RelaxedDirections> given = relaxDirections(lines.value(), kept, waves.value(), cells.value(), params, run);
    if (!given) return given.error();
    waves = alignPhases(given.value().lines, std::move(given.value().frequency), sdf, cells.value(), params, run);
  }
  if (!waves) return waves.error();
  making.record(&Stages::waves, waves.value());
  return WaveFields{std::move(cells).value(), std::move(lines).value(), std::move(waves).value()};
}

Result<Dislocations> dislocationStep(const WaveFields& waves, const SignedDistanceField& sdf, const Making& making) {
  making.stop();
  const Dislocations found = findDislocations(waves.lines, waves.waves, waves.cells, sdf, making.params, making.run);
  if (making.run.cancelled()) return cancelledRun();
  return found;
}

Result<RelaxedPath> pathStep(const PlateInput& input, const ShapeFields& shape, const PathOptions& options,
                             const Making& making) {
  RelaxedPath path;
  ToolpathResult& seen = path.seen;

  Result<WaveFields> waves = waveStep(input, shape.sdf, options.lines, making);
  if (!waves) return waves.error();
  LineField& lines = waves.value().lines;
  seen.nx = lines.grid.nx;
  seen.ny = lines.grid.ny;
  if (options.countDislocations) {
    const Result<Dislocations> found = dislocationStep(waves.value(), shape.sdf, making);
    if (!found) return found.error();
    seen.dislocations = found.value();
  }

  making.start("contour", 0.25);
  Result<ClosedCurves> contour = contourStep(input.shape, shape, std::move(waves.value().waves), making);
  if (!contour) return contour.error();
  seen.contourCycles = contour.value().count();
  if (seen.contourCycles == 0) return noBeadFits(input.shape, making.params.spacing);

  making.start("stitch", 0.71);
  Result<Stitched> stitched = stitchStep(std::move(contour).value(), shape, lines, input.showsPictures, making);
  if (!stitched) return stitched.error();
  seen.parts = stitched.value().parts;
  seen.longestJointMm = stitched.value().longestJoint;
  seen.gapJoints = stitched.value().gapJoints;
  seen.unjoined = stitched.value().unjoined();
  seen.apart = std::move(stitched.value().apart);
  seen.stitchWork = stitched.value().work;

  // Sec. 5.6: even gaps; the beads of pictures stay along their lines.
  making.start("relaxation", 0.89);
  Result<Relaxed> relaxed = relaxSpacing(std::move(stitched.value().curves), shape.border, making.params, making.run,
                                         input.showsPictures ? &lines : nullptr);
  if (!relaxed) return relaxed.error();
  making.record(&Stages::relaxed, relaxed.value());
  path.relaxed = std::move(relaxed).value();
  return path;
}

Result<ToolpathResult> widthStep(const RelaxedPath& path, const BorderIndex& border, const Making& making) {
  const ClosedCurves& curves = path.relaxed.curves;
  // Widths of the beads (Eq. 16).
  making.start("width", 0.965);
  const Result<BeadWidths> widths = beadWidths(curves, path.relaxed.gaps, border, making.params, making.run);
  if (!widths) return widths.error();
  making.record(&Stages::widths, widths.value());

  making.start("simplify", 1);
  Result<Toolpath> toolpath = finishToolpath(curves, widths.value(), making.params, making.run);
  if (!toolpath) return toolpath.error();
  ToolpathResult plate = path.seen;
  plate.toolpath = std::move(toolpath).value();
  if (making.clock != nullptr) plate.time = making.clock->takeTimes();
  making.run.report(1);
  making.record(&Stages::result, plate);
  return plate;
}

}  // namespace sillon
