// The order of the stages (Alg. 1), in four steps: what the shape decides, what the directions decide, where the path
// runs, and how wide its beads are.
#pragma once

#include "field/wave_fields.hpp"
#include "pipeline/stage_clock.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "sillon/pipeline/stages.hpp"

namespace sillon {

/// What the shape, the spacing and the bridge decide.
struct ShapeFields {
  BorderIndex border;
  SignedDistanceField sdf;
  Parts parts;
};

/// Where the path runs.
struct RelaxedPath {
  Relaxed relaxed;
  ToolpathResult seen;  ///< without a toolpath: what was seen on the way
};

/// What becomes of what a step is given.
enum class Fields {
  Freed,  ///< emptied as soon as they are not needed any more
  Kept,   ///< left as they are, for another path
};

/// \param record  where not null, the step's results are copied there. \return TooLarge, EmptyShape, Cancelled.
Result<ShapeFields> shapeStep(const Shape& shape, const ToolpathParams& params, StageClock& clock,
                              const RunContext& run, Stages* record = nullptr);

Result<WaveFields> waveStep(const PlateInput& input, const ShapeFields& shape, const ToolpathParams& params,
                            StageClock& clock, const RunContext& run, Stages* record = nullptr,
                            Lines which = Lines::Asked);

/// Not a stage: the clock stands still.
Result<Dislocations> dislocationStep(const WaveFields& waves, const ShapeFields& shape, const ToolpathParams& params,
                                     StageClock& clock, const RunContext& run);

Result<RelaxedPath> pathStep(const PlateInput& input, ShapeFields& shape, WaveFields& waves, Fields fields,
                             const ToolpathParams& params, StageClock& clock, const RunContext& run,
                             Stages* record = nullptr);

Result<ToolpathResult> widthStep(RelaxedPath& path, const BorderIndex& border, Fields fields,
                                 const ToolpathParams& params, StageClock& clock, const RunContext& run,
                                 Stages* record = nullptr);

/// InvalidArgument if the parameters, the page or the maps are out of range. Points of the shape: resolveOutline.
std::optional<Error> wrongInput(const Shape& shape, const DirectionMap& directions, const ModeMap& modes,
                                const ToolpathParams& params);
inline std::optional<Error> wrongInput(const PlateInput& input, const ToolpathParams& params) {
  return wrongInput(input.shape, input.directions, input.modes, params);
}

}  // namespace sillon
