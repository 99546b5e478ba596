#include "sillon/pipeline/pipeline.hpp"

#include "pipeline/steps.hpp"

namespace sillon {
namespace {

// Largest plate that a session keeps [cells]; it needs some 33 bytes per cell (plate_size.cpp).
constexpr double kMaxKeptCells = sizeof(void*) == 4 ? 3.2e6 : 40e6;

// Resets the parameters that only widths and simplification read, which leaves those of the path. A parameter that is
// not listed here counts as one of the path, so a forgotten new one costs time but never shows a stale toolpath.
ToolpathParams ofPath(ToolpathParams p) {
  const ToolpathParams any;
  p.widthBalance = any.widthBalance;
  p.beadOverlap = any.beadOverlap;
  p.minWidth = any.minWidth;
  p.maxWidth = any.maxWidth;
  p.simplifyTolerance = any.simplifyTolerance;
  return p;
}

// Fields of a shape, and the input that they were made of.
struct KeptShape {
  Shape shape;
  double spacing;
  std::optional<double> bridge;
  ShapeFields fields;

  [[nodiscard]] bool isOf(const PlateInput& input, const ToolpathParams& params) const {
    return spacing == params.spacing && bridge == params.bridge && shape == input.shape;
  }
};

// A path, and the input that it was made of besides the shape.
struct KeptPath {
  DirectionMap directions;
  ModeMap modes;
  bool showsPictures;
  ToolpathParams params;  ///< parameters of the path, from ofPath
  RelaxedPath path;

  [[nodiscard]] bool isOf(const PlateInput& input, const ToolpathParams& wanted) const {
    return params == ofPath(wanted) && showsPictures == input.showsPictures && directions == input.directions &&
           modes == input.modes;
  }
};

}  // namespace

struct Session::State {
  std::optional<KeptShape> shape;
  std::optional<KeptPath> path;  ///< path on this shape

  /// Makes the fields and the path that are missing or out of date. \return the error that stopped it; the kept state
  /// is valid even then.
  std::optional<Error> update(const PlateInput& input, bool countDislocations, const Making& making) {
    if (!shape || !shape->isOf(input, making.params)) {
      path.reset();
      shape.reset();
      Result<ShapeFields> made = shapeStep(input.shape, making);
      if (!made) return made.error();
      shape = KeptShape{input.shape, making.params.spacing, making.params.bridge, std::move(made).value()};
    }
    if (!path || !path->isOf(input, making.params)) {
      path.reset();
      Result<RelaxedPath> made = pathStep(input, shape->fields, {BeadLines::Asked, countDislocations}, making);
      if (!made) return made.error();
      path =
          KeptPath{input.directions, input.modes, input.showsPictures, ofPath(making.params), std::move(made).value()};
    }
    return countDislocations ? count(input, making) : std::nullopt;
  }

  /// Counts the dislocations of a kept path, if that has not been done, for which its waves are made again.
  std::optional<Error> count(const PlateInput& input, const Making& making) {
    std::optional<Dislocations>& known = path->path.seen.dislocations;
    if (known) return std::nullopt;
    const SignedDistanceField& sdf = shape->fields.sdf;
    making.run.beginStage("phases", 0, 0.195);  // reported as that stage, but not counted in the times of the path
    const Making unclocked{making.params, making.run};
    const Result<WaveFields> waves = waveStep(input, sdf, BeadLines::Asked, unclocked);
    if (!waves) return waves.error();
    const Result<Dislocations> found = dislocationStep(waves.value(), sdf, unclocked);
    if (!found) return found.error();
    known = found.value();
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
  const Making making{params, run, &clock};
  if (auto error = state_->update(input, countDislocations, making)) return *error;
  const ShapeFields& fields = state_->shape->fields;
  Result<ToolpathResult> result = widthStep(state_->path->path, fields.border, making);
  if (result && !countDislocations) result.value().dislocations.reset();
  if (static_cast<double>(fields.sdf.grid.size()) > kMaxKeptCells) *state_ = {};
  return result;
}

}  // namespace sillon
