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

/// Which waves: a plate's are aligned down to cells of tau/2, along lines that gave way where they may; a preview's
/// down to cells of tau only (a quarter as many), along the lines as they are.
enum class WaveDetail { Plate, Preview };

/// \param beforePhases  called when the lines are done, for clocks. \return the errors of the steps.
Result<WaveFields> waveFields(const SignedDistanceField& sdf, const DirectionMap& directions, const ModeMap& modes,
                              Vec2 page, const ToolpathParams& params, WaveDetail detail, const RunContext& run,
                              const std::function<void()>& beforePhases = {});

}  // namespace sillon
