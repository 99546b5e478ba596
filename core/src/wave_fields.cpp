#include "wave_fields.hpp"

#include "release.hpp"
#include "sillon/line_give.hpp"
#include "sillon/spacing_field.hpp"

namespace sillon {

Result<WaveFields> waveFields(const SignedDistanceField& sdf, const DirectionMap& directions, const ModeMap& modes,
                              Vec2 page, const ToolpathParams& params, WaveDetail detail, const RunContext& run,
                              const std::function<void()>& beforePhases) {
  constexpr int kGivingRounds = 3;  // of lines that give way and waves that are aligned anew
  const bool preview = detail == WaveDetail::Preview;
  Result<CellConstraints> cells = cellConstraints(sdf, directions, modes, page, params, run);
  if (!cells) return cells.error();
  Result<LineField> lines = lineField(sdf, cells.value(), params, run);
  if (!lines) return lines.error();
  release(cells.value().mapLine);  // memory peaks in the alignment
  if (beforePhases) beforePhases();
  Result<std::vector<float>> frequency = spacingField(lines.value(), cells.value(), params, run);
  if (!frequency) return frequency.error();
  const bool gives = !preview && params.lineGive > 0;
  const std::vector<float> kept = gives ? frequency.value() : std::vector<float>();
  Result<SineField> waves =
      alignPhases(lines.value(), std::move(frequency).value(), sdf, cells.value(), params, run, preview ? 1 : 0);
  for (int round = 0; waves && gives && round < kGivingRounds; ++round) {
    Result<GivenLines> given = giveLines(lines.value(), kept, waves.value(), cells.value(), params, run);
    if (!given) return given.error();
    waves = alignPhases(given.value().lines, std::move(given.value().frequency), sdf, cells.value(), params, run);
  }
  if (!waves) return waves.error();
  return WaveFields{std::move(cells).value(), std::move(lines).value(), std::move(waves).value()};
}

}  // namespace sillon
