#include "pictures/parts.hpp"

#include <algorithm>
#include <cstddef>

#include "look/rasters.hpp"
#include "quality/seen_cells.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "sillon/quality/metrics.hpp"

namespace sillon {
namespace {

constexpr double kTrialBeads = 100;   // beads along the page's longer side
constexpr double kFinestTrial = 0.1;  // [mm], finest spacing of a trial
constexpr double kCoarsestTrial = 2;

}  // namespace

Result<double> chosenAzimuth(std::vector<LitPicture> lit, const Roughness& roughness, const Shape& shape,
                             const InversionParams& inversion, const RunContext& run, const OnTrial& onTrial) {
  ToolpathParams params;
  params.spacing = std::clamp(std::max(shape.page.x, shape.page.y) / kTrialBeads, kFinestTrial, kCoarsestTrial);
  const auto solve = [&] {
    return solveDirections(lit, roughness, {shape.page, params.spacing, insideOf(shape)}, inversion, run);
  };
  Result<SolvedDirections> solved = solve();
  if (!solved) return solved.error();
  std::vector<double> azimuths{solved.value().lamps[0].azimuth};
  azimuths.insert(azimuths.end(), solved.value().azimuths.begin(), solved.value().azimuths.end());
  double best = azimuths[0];
  double highest = -1e9;
  for (std::size_t trial = 0; trial < azimuths.size(); ++trial) {
    if (onTrial) onTrial(static_cast<int>(trial), static_cast<int>(azimuths.size()));
    if (trial > 0) {
      lit[0].lamp.azimuth = azimuths[trial];
      lit[0].chooseAzimuth = false;
      solved = solve();
      if (!solved) return solved.error();
    }
    const PlateInput input{shape, solved.value().directions, uniformMode(DirectionMode::Constrained), true};
    const auto plate = generateToolpath(input, params, run);
    if (!plate) return plate.error().code == ErrorCode::Cancelled ? plate.error() : Result<double>(best);
    const auto seen = seePlate(plate.value().toolpath, shape.page, solved.value().lamps, roughness, run);
    if (!seen) return seen.error();
    const auto& [width, height, light] = seen.value();
    const PictureMeasures shows = compareTones(light[0], resampled(solved.value().shown[0], width, height));
    if (shows.r + shows.ssim <= highest) continue;
    highest = shows.r + shows.ssim;
    best = azimuths[trial];
  }
  return best;
}

}  // namespace sillon
