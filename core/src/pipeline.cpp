#include "sillon/pipeline.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "curves.hpp"
#include "release.hpp"
#include "sillon/bead_width.hpp"
#include "sillon/contour.hpp"
#include "sillon/narrow_places.hpp"
#include "sillon/parts.hpp"
#include "sillon/relaxation.hpp"
#include "sillon/sdf.hpp"
#include "sillon/session.hpp"
#include "sillon/simplify.hpp"
#include "sillon/sine_field.hpp"
#include "sillon/stitch.hpp"
#include "sillon/tiny_cycles.hpp"
#include "text.hpp"
#include "wave_fields.hpp"
#include "wave_preview.hpp"

namespace sillon {
namespace {

// A cell takes some 110 bytes; where pointers have 32 bits no more than 2 GB can be had, and 1 GB with threads.
constexpr double kMaxCells = sizeof(void*) == 4 ? 8e6 : 100e6;
constexpr double kMaxKeptCells = 0.4 * kMaxCells;  // a session keeps 60 bytes a cell more

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

bool within(double value, double low, double high) { return value >= low && value <= high; }  // false for NaN

}  // namespace

std::string invalidParameter(const ToolpathParams& p) {
  if (!within(p.spacing, 0.05, 20)) return outOfRange("spacing", p.spacing, " mm", "0.05 to 20 mm");
  if (p.perimeters < 0 || p.perimeters > 100) return outOfRange("perimeters", p.perimeters, "", "0 to 100");
  if (p.bridge && !within(*p.bridge, 0, 100)) return outOfRange("bridge", *p.bridge, " mm", "0 to 100 mm");
  if (!within(p.jitter, 0, 0.25)) return outOfRange("jitter", p.jitter, " spacings", "0 to 0.25 spacings");
  if (p.sweepsPerLevel < 1 || p.sweepsPerLevel > 1000)
    return outOfRange("sweepsPerLevel", p.sweepsPerLevel, "", "1 to 1000");
  if (!within(p.lineGive, 0, 30)) return outOfRange("lineGive", p.lineGive, " degrees", "0 to 30 degrees");
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

namespace {

std::optional<Error> wrongInput(const PlateInput& input, const ToolpathParams& params) {
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
  return std::nullopt;
}

// What the shape, the spacing and the bridge decide.
struct ShapeFields {
  BorderIndex border;
  SignedDistanceField sdf;
  Parts parts;
};

Result<ShapeFields> shapeFields(const Shape& shape, const ToolpathParams& params, StageClock& clock,
                                const RunContext& run) {
  clock.start("outline", 0.02);
  const Result<Outline> outline = resolveOutline(shape);
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
  Result<BorderIndex> border = buildBorderIndex(outline.value(), grid, run);
  if (!border) return border.error();
  Result<SignedDistanceField> sdf = signedDistanceField(shape, border.value(), grid, run);
  if (!sdf) return sdf.error();
  Parts parts = labelParts(sdf.value(), border.value(), params.spacing, params.bridge.value_or(params.spacing));
  if (parts.count == 0) {
    return Error{ErrorCode::EmptyShape, "spacing is " + decimal(params.spacing, 3) +
                                            " mm, which is too wide for this shape of " + decimal(size.x, 3) + " x " +
                                            decimal(size.y, 3) + " mm; no place in it is wide enough for one bead"};
  }
  return ShapeFields{std::move(border).value(), std::move(sdf).value(), std::move(parts)};
}

Result<WaveFields> timedWaves(const PlateInput& input, const ShapeFields& shape, const ToolpathParams& params,
                              WaveDetail detail, StageClock& clock, const RunContext& run) {
  clock.start("lines", 0.12);
  return waveFields(shape.sdf, input.directions, input.modes, input.shape.page, params, detail, run,
                    [&] { clock.start("phases", 0.35); });
}

// Frees what is not needed any more where nothing is kept.
template <class T>
void release(bool keep, T& fields) {
  if (!keep) sillon::release(fields);
}

// From the fields to the path; they are emptied on the way unless they are kept.
Result<Plate> plateOf(const PlateInput& input, ShapeFields& shape, WaveFields& fields, bool keep,
                      const ToolpathParams& params, bool countDislocations, StageClock& clock,
                      std::vector<StageTime>& times, const RunContext& run) {
  Plate plate;
  clock.stop();
  if (countDislocations) plate.dislocations = findDislocations(fields.lines, fields.waves, fields.cells, run);
  const Grid grid = fields.lines.grid;
  plate.nx = grid.nx;
  plate.ny = grid.ny;

  clock.start("contour", 0.5);
  const Grid nodes = nodeLattice(grid);
  ClosedCurves cycles;
  {
    const Result<std::vector<float>> distance =
        bandDistance(input.shape, shape.border, nodes, static_cast<float>(params.spacing), run);
    if (!distance) return distance.error();
    Result<std::vector<float>> values = evaluateSineField(fields.waves, distance.value(), params, run);
    if (!values) return values.error();
    release(keep, fields.waves);
    keepThinParts(shape.parts, shape.sdf, params.spacing, values.value());
    fillNarrowPlaces(nodes, distance.value(), params.spacing, values.value());
    release(keep, shape.sdf);
    Result<ClosedCurves> contour = contourCycles(nodes, values.value(), distance.value(), params.spacing, run);
    if (!contour) return contour.error();
    cycles = std::move(contour).value();
  }
  plate.contourCycles = cycles.count();
  if (plate.contourCycles == 0) {
    return Error{ErrorCode::EmptyShape, "no bead fits into this shape at spacing " + decimal(params.spacing, 3) +
                                            " mm; use a smaller spacing or a larger shape"};
  }

  clock.start("stitch", 0.65);
  cycles = resampledSimply(cycles, static_cast<float>(0.25 * params.spacing), run);
  cycles = settleTinyCycles(cycles, shape.border, params.spacing, run);
  Result<Stitched> stitched = stitchCycles(cycles, fields.lines, shape.border, shape.parts, params, run);
  if (!stitched) return stitched.error();
  sillon::release(cycles);
  release(keep, fields.lines);
  release(keep, shape.parts);
  plate.parts = stitched.value().parts;
  plate.longestJointMm = stitched.value().longestJoint;
  plate.gapJoints = stitched.value().gapJoints;

  clock.start("relaxation", 0.88);
  Result<Relaxed> relaxed = relaxSpacing(std::move(stitched.value().curves), shape.border, params, run);
  if (!relaxed) return relaxed.error();
  const ClosedCurves& path = relaxed.value().curves;

  clock.start("width", 0.95);
  const Result<BeadWidths> widths = beadWidths(path, relaxed.value().gaps, shape.border, params, run);
  if (!widths) return widths.error();
  sillon::release(relaxed.value().gaps);

  clock.start("simplify", 1);
  Result<Toolpath> toolpath = finishToolpath(path, widths.value(), params, run);
  if (!toolpath) return toolpath.error();
  plate.toolpath = std::move(toolpath).value();
  clock.stop();
  plate.time = std::move(times);
  run.report(1);
  return plate;
}

// The parameters that the waves depend on; the others as they are by default.
ToolpathParams ofWaves(const ToolpathParams& p) {
  ToolpathParams kept;
  kept.spacing = p.spacing;
  kept.bridge = p.bridge;  // of the shape's fields
  kept.perimeterMode = p.perimeterMode;
  kept.perimeters = p.perimeters;
  kept.mapFilter = p.mapFilter;
  kept.seed = p.seed;
  kept.jitter = p.jitter;
  kept.phaseTransport = p.phaseTransport;
  kept.sweepsPerLevel = p.sweepsPerLevel;
  kept.spacingBend = p.spacingBend;
  kept.lineGive = p.lineGive;
  kept.borderPull = p.borderPull;
  return kept;
}

}  // namespace

Result<Plate> generateToolpath(const PlateInput& input, const ToolpathParams& params, const RunContext& run,
                               bool countDislocations) {
  if (auto wrong = wrongInput(input, params)) return *wrong;
  std::vector<StageTime> times;
  StageClock clock(run, times);
  Result<ShapeFields> shape = shapeFields(input.shape, params, clock, run);
  if (!shape) return shape.error();
  Result<WaveFields> waves = timedWaves(input, shape.value(), params, WaveDetail::Plate, clock, run);
  if (!waves) return waves.error();
  return plateOf(input, shape.value(), waves.value(), false, params, countDislocations, clock, times, run);
}

namespace {

// Waves, and what they were made of besides the shape.
struct KeptWaves {
  DirectionMap directions;
  ModeMap modes;
  ToolpathParams params;  ///< those of ofWaves
  WaveFields fields;

  [[nodiscard]] bool areOf(const PlateInput& input, const ToolpathParams& wanted) const {
    return params == wanted && directions == input.directions && modes == input.modes;
  }
};

}  // namespace

struct Session::State {
  Shape shape;
  double spacing = 0;
  std::optional<double> bridge;
  std::optional<ShapeFields> fields;  ///< of these three
  std::optional<KeptWaves> plate;
  std::optional<KeptWaves> preview;  ///< the waves only

  /// Makes what is missing or out of date. \return why it could not; what there is then is whole all the same.
  std::optional<Error> update(const PlateInput& wanted, const ToolpathParams& all, WaveDetail detail, StageClock& clock,
                              const RunContext& run) {
    const ToolpathParams now = ofWaves(all);
    if (!fields || now.spacing != spacing || now.bridge != bridge || wanted.shape != shape) {
      plate.reset();
      preview.reset();
      fields.reset();
      Result<ShapeFields> made = shapeFields(wanted.shape, now, clock, run);
      if (!made) return made.error();
      fields = std::move(made).value();
      shape = wanted.shape;
      spacing = now.spacing;
      bridge = now.bridge;
    }
    std::optional<KeptWaves>& kept = detail == WaveDetail::Plate ? plate : preview;
    if (kept && kept->areOf(wanted, now)) return std::nullopt;
    kept.reset();
    Result<WaveFields> made = timedWaves(wanted, *fields, now, detail, clock, run);
    if (!made) return made.error();
    kept = KeptWaves{wanted.directions, wanted.modes, now, std::move(made).value()};
    release(detail == WaveDetail::Plate, kept->fields.cells);
    release(detail == WaveDetail::Plate, kept->fields.lines);
    return std::nullopt;
  }
};

Session::Session() : state_(std::make_unique<State>()) {}
Session::~Session() = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;

Result<Plate> Session::generateToolpath(const PlateInput& input, const ToolpathParams& params, const RunContext& run,
                                        bool countDislocations) {
  if (auto wrong = wrongInput(input, params)) return *wrong;
  std::vector<StageTime> times;
  StageClock clock(run, times);
  if (auto error = state_->update(input, params, WaveDetail::Plate, clock, run)) return *error;
  ShapeFields& shape = *state_->fields;
  if (static_cast<double>(shape.sdf.grid.size()) <= kMaxKeptCells)
    return plateOf(input, shape, state_->plate->fields, true, params, countDislocations, clock, times, run);
  state_->preview.reset();
  Result<Plate> plate =
      plateOf(input, shape, state_->plate->fields, false, params, countDislocations, clock, times, run);
  *state_ = {};
  return plate;
}

Result<RgbImage> Session::previewWaves(const PlateInput& input, const ToolpathParams& params, int width,
                                       const RunContext& run) {
  if (auto wrong = wrongInput(input, params)) return *wrong;
  if (width < 16 || width > 8192)
    return Error{ErrorCode::InvalidArgument, outOfRange("width", width, " pixels", "16 to 8192 pixels")};
  std::vector<StageTime> times;
  StageClock clock(run, times);
  if (auto error = state_->update(input, params, WaveDetail::Preview, clock, run)) return *error;
  clock.start("preview", 1);
  return drawWaves(state_->preview->fields.waves, state_->fields->sdf, input.shape.page, width, run);
}

}  // namespace sillon
