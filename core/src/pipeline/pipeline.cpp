#include "sillon/pipeline/pipeline.hpp"

#include "pipeline/steps.hpp"

namespace sillon {
namespace {

// Makes a plate: Alg. 1 of the paper. \param stages  receives the result of each stage; may be null.
Result<ToolpathResult> runStages(const PlateInput& input, const ToolpathParams& params, const RunContext& run,
                                 const PathOptions& options, Stages* stages = nullptr) {
  if (auto wrong = wrongInput(input, params)) return *wrong;
  StageClock clock(run);
  const Making making{params, run, &clock, Recorder(stages)};
  const Result<ShapeFields> shape = shapeStep(input.shape, making);
  if (!shape) return shape.error();
  const Result<RelaxedPath> path = pathStep(input, shape.value(), options, making);
  if (!path) return path.error();
  return widthStep(path.value(), shape.value().border, making);
}

}  // namespace

Result<ToolpathResult> generateToolpath(const PlateInput& input, const ToolpathParams& params, const RunContext& run,
                                        bool countDislocations) {
  return runStages(input, params, run, {BeadLines::Asked, countDislocations});
}

Result<ToolpathResult> generateAcross(const PlateInput& input, const ToolpathParams& params, const RunContext& run) {
  return runStages(input, params, run, {BeadLines::Across, false});
}

Result<Stages> generateStages(const PlateInput& input, const ToolpathParams& params, const RunContext& run) {
  Stages stages;
  const Result<ToolpathResult> result = runStages(input, params, run, {}, &stages);
  if (!result) return result.error();
  return stages;
}

}  // namespace sillon
