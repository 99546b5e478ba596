// Lines and waves of a plate: the steps from the directions to the field whose zeros are the beads.
#pragma once

#include <functional>

#include "sillon/field/constraints.hpp"
#include "sillon/field/line_field.hpp"
#include "sillon/field/phase_field.hpp"

namespace sillon {

struct WaveFields {
  CellConstraints cells;  ///< without the map's lines: they are in `lines` now
  LineField lines;
  SineField waves;
};

/// What is freed or changed on the way, for who wants to see it.
struct WaveRecord {
  CellConstraints cells;         ///< with the map's lines
  std::vector<float> frequency;  ///< as spacingField gave it
};

/// Which lines the waves follow.
enum class Lines {
  Asked,   ///< those that the maps ask for
  Across,  ///< at right angles to those, except along the border
};

/// \param beforePhases  called when the lines are done, for clocks. \param record  filled where it is not null. \return
/// the errors of the steps.
Result<WaveFields> waveFields(const SignedDistanceField& sdf, const DirectionMap& directions, const ModeMap& modes,
                              Vec2 page, const ToolpathParams& params, const RunContext& run,
                              const std::function<void()>& beforePhases = {}, WaveRecord* record = nullptr,
                              Lines which = Lines::Asked);

}  // namespace sillon
