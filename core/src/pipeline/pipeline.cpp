#include "sillon/pipeline/pipeline.hpp"

#include <string>
#include <utility>

#include "input/map_defect.hpp"
#include "pipeline/stage_clock.hpp"
#include "pipeline/steps.hpp"
#include "sillon/pipeline/stages.hpp"
#include "sillon/settings/table.hpp"
#include "toolpath/toolpath_check.hpp"

namespace sillon {
std::optional<Error> wrongInput(const Shape& shape, const DirectionMap& directions, const ModeMap& modes,
                                const ToolpathParams& params) {
  if (auto wrong = invalidSettings(params)) return wrong;
  std::string bad = pageDefect(shape.page);
  if (bad.empty()) bad = mapDefect("direction", directions.width, directions.height, directions.angle.size());
  if (bad.empty()) bad = mapDefect("mode", modes.width, modes.height, modes.mode.size());
  if (bad.empty()) return std::nullopt;
  return Error{ErrorCode::InvalidArgument, std::move(bad)};
}

namespace {

// The steps of the method in their order. \param stages  receives what each has made; may be null
Result<ToolpathResult> runSteps(const PlateInput& input, const ToolpathParams& params, const RunContext& run,
                                Lines lines, bool countDislocations, Stages* stages) {
  if (auto wrong = wrongInput(input, params)) return *wrong;
  StageClock clock(run);
  Result<ShapeFields> shape = shapeStep(input.shape, params, clock, run, stages);
  if (!shape) return shape.error();
  Result<WaveFields> waves = waveStep(input, shape.value(), params, clock, run, stages, lines);
  if (!waves) return waves.error();
  std::optional<Dislocations> dislocations;
  if (countDislocations) {
    const Result<Dislocations> found = dislocationStep(waves.value(), shape.value(), params, clock, run);
    if (!found) return found.error();
    dislocations = found.value();
  }
  Result<RelaxedPath> path = pathStep(input, shape.value(), waves.value(), Fields::Freed, params, clock, run, stages);
  if (!path) return path.error();
  Result<ToolpathResult> result =
      widthStep(path.value(), shape.value().border, Fields::Freed, params, clock, run, stages);
  if (result) result.value().dislocations = dislocations;
  return result;
}

}  // namespace

Result<ToolpathResult> generateToolpath(const PlateInput& input, const ToolpathParams& params, const RunContext& run,
                                        bool countDislocations) {
  return runSteps(input, params, run, Lines::Asked, countDislocations, nullptr);
}

Result<ToolpathResult> generateAcross(const PlateInput& input, const ToolpathParams& params, const RunContext& run) {
  return runSteps(input, params, run, Lines::Across, false, nullptr);
}

Result<Stages> generateStages(const PlateInput& input, const ToolpathParams& params, const RunContext& run) {
  Stages stages;
  const Result<ToolpathResult> result = runSteps(input, params, run, Lines::Asked, false, &stages);
  if (!result) return result.error();
  return stages;
}

}  // namespace sillon
