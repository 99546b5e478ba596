#include "sillon/pipeline/pipeline.hpp"

#include "base/decimal_text.hpp"
#include "pipeline/stage_clock.hpp"
#include "pipeline/steps.hpp"
#include "sillon/pipeline/stages.hpp"
#include "sillon/settings/table.hpp"

namespace sillon {
namespace {

bool within(double value, double low, double high) { return value >= low && value <= high; }  // false for NaN

}  // namespace

std::optional<Error> wrongInput(const PlateInput& input, const ToolpathParams& params) {
  if (std::string bad = invalidSettings(params); !bad.empty()) return Error{ErrorCode::InvalidArgument, std::move(bad)};
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

Result<ToolpathResult> generateToolpath(const PlateInput& input, const ToolpathParams& params, const RunContext& run,
                                        bool countDislocations) {
  if (auto wrong = wrongInput(input, params)) return *wrong;
  StageClock clock(run);
  Result<ShapeFields> shape = shapeStep(input.shape, params, clock, run);
  if (!shape) return shape.error();
  Result<WaveFields> waves = waveStep(input, shape.value(), params, clock, run);
  if (!waves) return waves.error();
  std::optional<Dislocations> dislocations;
  if (countDislocations) {
    const Result<Dislocations> found = dislocationStep(waves.value(), shape.value(), params, clock, run);
    if (!found) return found.error();
    dislocations = found.value();
  }
  Result<RelaxedPath> path = pathStep(input, shape.value(), waves.value(), Fields::Freed, params, clock, run);
  if (!path) return path.error();
  Result<ToolpathResult> plate = widthStep(path.value(), shape.value().border, Fields::Freed, params, clock, run);
  if (plate) plate.value().dislocations = dislocations;
  return plate;
}

Result<ToolpathResult> generateAcross(const PlateInput& input, const ToolpathParams& params, const RunContext& run) {
  if (auto wrong = wrongInput(input, params)) return *wrong;
  StageClock clock(run);
  Result<ShapeFields> shape = shapeStep(input.shape, params, clock, run);
  if (!shape) return shape.error();
  Result<WaveFields> waves = waveStep(input, shape.value(), params, clock, run, nullptr, Lines::Across);
  if (!waves) return waves.error();
  Result<RelaxedPath> path = pathStep(input, shape.value(), waves.value(), Fields::Freed, params, clock, run);
  if (!path) return path.error();
  return widthStep(path.value(), shape.value().border, Fields::Freed, params, clock, run);
}

Result<Stages> generateStages(const PlateInput& input, const ToolpathParams& params, const RunContext& run) {
  if (auto wrong = wrongInput(input, params)) return *wrong;
  Stages stages;
  StageClock clock(run);
  Result<ShapeFields> shape = shapeStep(input.shape, params, clock, run, &stages);
  if (!shape) return shape.error();
  Result<WaveFields> waves = waveStep(input, shape.value(), params, clock, run, &stages);
  if (!waves) return waves.error();
  Result<RelaxedPath> path = pathStep(input, shape.value(), waves.value(), Fields::Freed, params, clock, run, &stages);
  if (!path) return path.error();
  const Result<ToolpathResult> result =
      widthStep(path.value(), shape.value().border, Fields::Freed, params, clock, run, &stages);
  if (!result) return result.error();
  return stages;
}

}  // namespace sillon
