// Lines and waves of a plate: the steps from the directions to the field whose zeros are the beads.
#pragma once

#include <functional>

#include "sillon/constraints.hpp"
#include "sillon/line_field.hpp"
#include "sillon/phase_field.hpp"

namespace sillon {

struct WaveFields {
  CellConstraints cells;  ///< without the map's lines: they are in `lines` now
  LineField lines;
  SineField waves;
};

/// \param beforePhases  called when the lines are done, for clocks. \return the errors of the steps.
Result<WaveFields> waveFields(const SignedDistanceField& sdf, const DirectionMap& directions, const ModeMap& modes,
                              Vec2 page, const ToolpathParams& params, const RunContext& run,
                              const std::function<void()>& beforePhases = {});

}  // namespace sillon
