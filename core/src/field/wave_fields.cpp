#include "field/wave_fields.hpp"

#include "base/free_memory.hpp"
#include "field/double_angle.hpp"
#include "sillon/field/direction_tolerance.hpp"
#include "sillon/field/spacing_field.hpp"

namespace sillon {
namespace {

// Asks each cell for the line across the one it got. Those along the border stay: no bead can cross it.
void askAcross(const LineField& lines, CellConstraints& cells) {
  for (std::size_t i = 0; i < cells.zone.size(); ++i) {
    if (lines.direction[i] == Vec2f{}) continue;
    cells.mapLine[i] = -lineOf(lines.direction[i]);
    cells.mode[i] = DirectionMode::Constrained;
  }
}

}  // namespace

Result<WaveFields> waveFields(const SignedDistanceField& sdf, const DirectionMap& directions, const ModeMap& modes,
                              Vec2 page, const ToolpathParams& params, const RunContext& run,
                              const std::function<void()>& beforePhases, WaveRecord* record, Lines which) {
  constexpr int kGivingRounds = 3;  // of lines that give way and waves that are aligned anew
  Result<CellConstraints> cells = cellConstraints(sdf, directions, modes, page, params, run);
  if (!cells) return cells.error();
  Result<LineField> lines = lineField(sdf, cells.value(), params, run);
  if (!lines) return lines.error();
  if (which == Lines::Across) {
    askAcross(lines.value(), cells.value());
    lines = lineField(sdf, cells.value(), params, run);
    if (!lines) return lines.error();
  }
  if (record != nullptr) record->cells = cells.value();
  release(cells.value().mapLine);  // memory peaks in the alignment
  if (beforePhases) beforePhases();
  Result<std::vector<float>> frequency = spacingField(lines.value(), cells.value(), params, run);
  if (!frequency) return frequency.error();
  if (record != nullptr) record->frequency = frequency.value();
  const bool gives = params.directionTolerance > 0;
  const std::vector<float> kept = gives ? frequency.value() : std::vector<float>();
  Result<SineField> waves = alignPhases(lines.value(), std::move(frequency).value(), sdf, cells.value(), params, run);
  for (int round = 0; waves && gives && round < kGivingRounds; ++round) {
    Result<RelaxedDirections> given = relaxDirections(lines.value(), kept, waves.value(), cells.value(), params, run);
    if (!given) return given.error();
    waves = alignPhases(given.value().lines, std::move(given.value().frequency), sdf, cells.value(), params, run);
  }
  if (!waves) return waves.error();
  return WaveFields{std::move(cells).value(), std::move(lines).value(), std::move(waves).value()};
}

}  // namespace sillon
