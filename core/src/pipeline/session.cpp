#include "sillon/pipeline/session.hpp"

#include <optional>

#include "base/free_memory.hpp"
#include "pipeline/stage_clock.hpp"
#include "pipeline/steps.hpp"

namespace sillon {
namespace {

// A session keeps 60 bytes a cell more than a single run; see plate_size.cpp.
constexpr double kMaxKeptCells = sizeof(void*) == 4 ? 3.2e6 : 40e6;

// All parameters but those that only widths and simplification read. A parameter that is listed neither here nor below
// counts as one of the waves', so that to forget a new one costs time and never shows a stale toolpath.
ToolpathParams ofPath(ToolpathParams p) {
  const ToolpathParams any;
  p.widthBalance = any.widthBalance;
  p.beadOverlap = any.beadOverlap;
  p.minWidth = any.minWidth;
  p.maxWidth = any.maxWidth;
  p.simplifyTolerance = any.simplifyTolerance;
  return p;
}

// All of those but what only the path after the waves reads.
ToolpathParams ofWaves(const ToolpathParams& all) {
  const ToolpathParams any;
  ToolpathParams p = ofPath(all);
  p.kernelRadius = any.kernelRadius;
  p.stitchAlignment = any.stitchAlignment;
  p.relaxationRounds = any.relaxationRounds;
  p.relaxationStrength = any.relaxationStrength;
  p.relaxationSmoothing = any.relaxationSmoothing;
  return p;
}

// Waves, and what they were made of besides the shape.
struct KeptWaves {
  DirectionMap directions;
  ModeMap modes;
  ToolpathParams params;  ///< those of ofWaves
  WaveFields fields;
  std::optional<Dislocations> dislocations;  ///< where they were asked for

  [[nodiscard]] bool areOf(const PlateInput& input, const ToolpathParams& wanted) const {
    return params == wanted && directions == input.directions && modes == input.modes;
  }
};

// A path, and what it was made of besides shape and waves.
struct KeptPath {
  ToolpathParams params;  ///< those of ofPath
  bool showsPictures;     ///< PlateInput::showsPictures
  RelaxedPath path;
};

}  // namespace

struct Session::State {
  Shape shape;
  double spacing = 0;
  std::optional<double> bridge;
  std::optional<ShapeFields> fields;  ///< of these three
  std::optional<KeptWaves> waves;
  std::optional<KeptPath> path;  ///< of these waves

  /// Makes what is missing or out of date. \return why it could not; what there is then is whole all the same.
  std::optional<Error> update(const PlateInput& wanted, const ToolpathParams& all, StageClock& clock,
                              const RunContext& run) {
    const ToolpathParams now = ofWaves(all);
    if (!fields || now.spacing != spacing || now.bridge != bridge || wanted.shape != shape) {
      path.reset();
      waves.reset();
      fields.reset();
      Result<ShapeFields> made = shapeStep(wanted.shape, now, clock, run);
      if (!made) return made.error();
      fields = std::move(made).value();
      shape = wanted.shape;
      spacing = now.spacing;
      bridge = now.bridge;
    }
    if (waves && waves->areOf(wanted, now)) return std::nullopt;
    path.reset();
    waves.reset();
    Result<WaveFields> made = waveStep(wanted, *fields, now, clock, run);
    if (!made) return made.error();
    waves = KeptWaves{wanted.directions, wanted.modes, now, std::move(made).value(), std::nullopt};
    return std::nullopt;
  }
};

Session::Session() : state_(std::make_unique<State>()) {}
Session::~Session() = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;

Result<ToolpathResult> Session::generateToolpath(const PlateInput& input, const ToolpathParams& params,
                                                 const RunContext& run, bool countDislocations) {
  if (auto wrong = wrongInput(input, params)) return *wrong;
  StageClock clock(run);
  if (auto error = state_->update(input, params, clock, run)) return *error;
  ShapeFields& shape = *state_->fields;
  KeptWaves& waves = *state_->waves;
  const bool keeps = static_cast<double>(shape.sdf.grid.size()) <= kMaxKeptCells;
  const Fields fields = keeps ? Fields::Kept : Fields::Freed;
  if (countDislocations && !waves.dislocations) {
    const Result<Dislocations> found = dislocationStep(waves.fields, shape, params, clock, run);
    if (!found) return found.error();
    waves.dislocations = found.value();
  }
  std::optional<KeptPath>& path = state_->path;
  const ToolpathParams wanted = ofPath(params);
  if (!path || path->params != wanted || path->showsPictures != input.showsPictures) {
    path.reset();
    Result<RelaxedPath> made = pathStep(input, shape, waves.fields, fields, params, clock, run);
    if (!made) {
      if (!keeps) *state_ = {};
      return made.error();
    }
    path = KeptPath{wanted, input.showsPictures, std::move(made).value()};
  }
  Result<ToolpathResult> result = widthStep(path->path, shape.border, fields, params, clock, run);
  if (result && countDislocations) result.value().dislocations = waves.dislocations;
  if (!keeps) *state_ = {};
  return result;
}

}  // namespace sillon
