#include "sillon/pipeline.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "curves.hpp"
#include "sillon/bead_width.hpp"
#include "sillon/contour.hpp"
#include "sillon/line_field.hpp"
#include "sillon/parts.hpp"
#include "sillon/phase_field.hpp"
#include "sillon/relaxation.hpp"
#include "sillon/sdf.hpp"
#include "sillon/simplify.hpp"
#include "sillon/sine_field.hpp"
#include "sillon/spacing_field.hpp"
#include "sillon/stitch.hpp"
#include "text.hpp"

namespace sillon {
namespace {

// A cell takes some 230 bytes; where pointers have 32 bits no more than 2 GB can be had.
constexpr double kMaxCells = sizeof(void*) == 4 ? 8e6 : 100e6;

// Times stages and tells the run where in the job they lie.
class StageClock {
 public:
  StageClock(const RunContext& run, std::vector<StageTime>& times) : run_(run), times_(times) { run.beginJob(); }
  ~StageClock() { stop(); }

  /// \param end  share of the job done when this stage is; measured on plates of a million cells.
  void start(const char* stage, double end) {
    stop();
    run_.beginStage(stage, done_, end);
    done_ = end;
    stage_ = stage;
    begin_ = std::chrono::steady_clock::now();
  }
  void stop() {
    if (stage_ == nullptr) return;
    times_.push_back({stage_, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count()});
    stage_ = nullptr;
  }

 private:
  const RunContext& run_;
  std::vector<StageTime>& times_;
  const char* stage_ = nullptr;
  double done_ = 0;
  std::chrono::steady_clock::time_point begin_;
};

std::string outOfRange(const char* field, double value, const char* unit, const char* range) {
  const std::string text = std::isfinite(value) ? decimal(value, 6) : "not a number";
  return std::string(field) + " is " + text + unit + "; it must be " + range;
}

bool within(double value, double low, double high) { return value >= low && value <= high; }  // false for NaN

}  // namespace

std::string invalidParameter(const ToolpathParams& p) {
  if (!within(p.spacing, 0.05, 20)) return outOfRange("spacing", p.spacing, " mm", "0.05 to 20 mm");
  if (p.perimeters < 0 || p.perimeters > 100) return outOfRange("perimeters", p.perimeters, "", "0 to 100");
  if (p.bridge && !within(*p.bridge, 0, 100)) return outOfRange("bridge", *p.bridge, " mm", "0 to 100 mm");
  if (!within(p.jitter, 0, 0.25)) return outOfRange("jitter", p.jitter, " spacings", "0 to 0.25 spacings");
  if (p.sweepsPerLevel < 1 || p.sweepsPerLevel > 1000)
    return outOfRange("sweepsPerLevel", p.sweepsPerLevel, "", "1 to 1000");
  if (!within(p.waveReach, 0.45, 1.5)) return outOfRange("waveReach", p.waveReach, " spacings", "0.45 to 1.5 spacings");
  if (!within(p.spacingBend, 0, 0.5)) return outOfRange("spacingBend", p.spacingBend, "", "0 to 0.5");
  if (!within(p.borderPull, 0, 100)) return outOfRange("borderPull", p.borderPull, "", "0 to 100");
  if (!within(p.stitchAlignment, 0, 10)) return outOfRange("stitchAlignment", p.stitchAlignment, "", "0 to 10");
  if (p.relaxationRounds < 0 || p.relaxationRounds > 100) {
    return outOfRange("relaxationRounds", p.relaxationRounds, "", "0 to 100");
  }
  if (!within(p.relaxationStrength, 0, 0.5))
    return outOfRange("relaxationStrength", p.relaxationStrength, "", "0 to 0.5");
  if (!within(p.relaxationSmoothing, 0, 1))
    return outOfRange("relaxationSmoothing", p.relaxationSmoothing, "", "0 to 1");
  if (!within(p.widthBalance, 0, 1)) return outOfRange("widthBalance", p.widthBalance, "", "0 to 1");
  if (!within(p.beadOverlap, 0, 1)) return outOfRange("beadOverlap", p.beadOverlap, " spacings", "0 to 1 spacings");
  if (!within(p.minWidth, 0.1, 1)) return outOfRange("minWidth", p.minWidth, " spacings", "0.1 to 1 spacings");
  if (!within(p.maxWidth, 1, 4)) return outOfRange("maxWidth", p.maxWidth, " spacings", "1 to 4 spacings");
  if (!within(p.simplifyTolerance, 0, 1))
    return outOfRange("simplifyTolerance", p.simplifyTolerance, " mm", "0 to 1 mm");
  return {};
}

Result<Plate> generateToolpath(const PlateInput& input, const ToolpathParams& params, const RunContext& run) {
  if (std::string bad = invalidParameter(params); !bad.empty())
    return Error{ErrorCode::InvalidArgument, std::move(bad)};
  if (!within(input.shape.page.x, 1e-3, 1e5) || !within(input.shape.page.y, 1e-3, 1e5)) {
    return Error{ErrorCode::InvalidArgument, "the page is " + decimal(input.shape.page.x, 3) + " x " +
                                                 decimal(input.shape.page.y, 3) +
                                                 " mm; both sides must be 0.001 to 100000 mm"};
  }
  if (input.directions.angle.empty() || input.modes.mode.empty()) {
    return Error{ErrorCode::InvalidArgument,
                 "the direction map or the mode map is empty; each needs at least one pixel"};
  }
  Plate plate;
  StageClock clock(run, plate.time);

  clock.start("outline", 0.02);
  const Result<Outline> outline = resolveOutline(input.shape);
  if (!outline) return outline.error();
  const Vec2 size = outline.value().bounds.size();
  const double cells = 4 * (size.x / params.spacing + 3) * (size.y / params.spacing + 3);
  if (cells > kMaxCells) {
    return Error{ErrorCode::TooLarge, "the plate of " + decimal(size.x, 1) + " x " + decimal(size.y, 1) + " mm needs " +
                                          decimal(cells / 1e6, 0) + " million cells at spacing " +
                                          decimal(params.spacing, 3) + " mm; at most " + decimal(kMaxCells / 1e6, 0) +
                                          " million are possible"};
  }

  clock.start("distance", 0.06);
  const Grid grid = makeGrid(outline.value().bounds, params.spacing);
  plate.nx = grid.nx;
  plate.ny = grid.ny;
  const Result<BorderIndex> border = buildBorderIndex(outline.value(), grid, run);
  if (!border) return border.error();
  const Result<SignedDistanceField> sdf = signedDistanceField(input.shape, border.value(), grid, run);
  if (!sdf) return sdf.error();
  const Parts parts = labelParts(sdf.value(), border.value(), params.spacing, params.bridge.value_or(params.spacing));
  if (parts.count == 0) {
    return Error{ErrorCode::EmptyShape, "spacing is " + decimal(params.spacing, 3) +
                                            " mm, which is too wide for this shape of " + decimal(size.x, 3) + " x " +
                                            decimal(size.y, 3) + " mm; no place in it is wide enough for one bead"};
  }

  clock.start("lines", 0.12);
  const Result<CellConstraints> constraints =
      cellConstraints(sdf.value(), input.directions, input.modes, input.shape.page, params, run);
  if (!constraints) return constraints.error();
  const Result<LineField> lines = lineField(sdf.value(), constraints.value(), params, run);
  if (!lines) return lines.error();

  clock.start("phases", 0.35);
  const Result<std::vector<float>> frequency = spacingField(lines.value(), constraints.value(), params, run);
  if (!frequency) return frequency.error();
  const Result<SineField> waves =
      alignPhases(lines.value(), frequency.value(), sdf.value(), constraints.value(), params, run);
  if (!waves) return waves.error();

  clock.start("contour", 0.5);
  const Grid nodes = nodeLattice(grid);
  const Result<std::vector<float>> distance =
      bandDistance(input.shape, border.value(), nodes, static_cast<float>(params.spacing), run);
  if (!distance) return distance.error();
  Result<std::vector<float>> values = evaluateSineField(waves.value(), distance.value(), params, run);
  if (!values) return values.error();
  keepThinParts(parts, sdf.value(), params.spacing, values.value());
  const Result<ClosedCurves> contour = contourCycles(nodes, values.value(), distance.value(), params.spacing, run);
  if (!contour) return contour.error();
  plate.contourCycles = contour.value().count();
  if (plate.contourCycles == 0) {
    return Error{ErrorCode::EmptyShape, "no bead fits into this shape at spacing " + decimal(params.spacing, 3) +
                                            " mm; use a smaller spacing or a larger shape"};
  }

  clock.start("stitch", 0.65);
  const ClosedCurves cycles = resampledSimply(contour.value(), static_cast<float>(0.25 * params.spacing), run);
  const Result<Stitched> stitched = stitchCycles(cycles, lines.value(), border.value(), parts, params, run);
  if (!stitched) return stitched.error();
  plate.parts = stitched.value().parts;
  plate.longestJointMm = stitched.value().longestJoint;
  plate.gapJoints = stitched.value().gapJoints;

  clock.start("relaxation", 0.88);
  const Result<Relaxed> relaxed = relaxSpacing(stitched.value().curves, border.value(), params, run);
  if (!relaxed) return relaxed.error();
  const ClosedCurves& path = relaxed.value().curves;

  clock.start("width", 0.95);
  const Result<BeadWidths> widths = beadWidths(path, relaxed.value().gaps, border.value(), params, run);
  if (!widths) return widths.error();

  clock.start("simplify", 1);
  Result<Toolpath> toolpath = finishToolpath(path, widths.value(), params, run);
  if (!toolpath) return toolpath.error();
  plate.toolpath = std::move(toolpath).value();
  clock.stop();
  run.report(1);
  return plate;
}

}  // namespace sillon
