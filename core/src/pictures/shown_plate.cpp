#include <cstddef>
#include <utility>
#include <vector>

#include "pictures/parts.hpp"
#include "sillon/pictures/pictures.hpp"
#include "sillon/quality/metrics.hpp"

namespace sillon {

int platesFor(const PictureParams& params) {
  return params.files.empty() || params.localContrast != 0 ? 1 : 1 + params.corrections;
}

Result<ToolpathResult> makeShownPlate(const Project& project, const PlatePictures& pictures, PlateInput& input,
                                      const MakeToolpath& make, const RunContext& run) {
  const int rounds = pictures.shown.empty() ? 1 : platesFor(project.pictures);
  Result<ToolpathResult> best = make(input, 0, rounds);
  if (!best || rounds == 1) return best;

  std::vector<LitPicture> lit;
  std::vector<Lamp> lamps;
  for (const ShownPicture& picture : pictures.shown) {
    lit.push_back({picture.tones, picture.lamp, false});
    lamps.push_back(picture.lamp);
  }
  InversionParams inversion = inversionOf(project.pictures);
  inversion.level = pictures.level;
  double highest = -1e9;  // sum of the pictures' r
  PlateInput tried = input;
  Result<ToolpathResult> plate = best;
  for (int round = 1;; ++round) {
    const auto seen = seePlate(plate.value().toolpath, input.shape.page, lamps, pictures.roughness, run);
    if (!seen) return seen.error();
    const auto& [width, height, light] = seen.value();
    std::vector<Tones> asked;
    double r = 0;
    for (std::size_t k = 0; k < lit.size(); ++k) {
      asked.push_back(resampled(pictures.shown[k].tones, width, height));
      r += compareTones(light[k], asked[k]).r;
    }
    if (r > highest) {
      highest = r;
      input.directions = tried.directions;
      best = std::move(plate);
    }
    if (round == rounds) return best;
    if (lit.size() > 1) asked = shownTones(pictures, tried.directions, width, height);
    for (std::size_t k = 0; k < lit.size(); ++k) {
      addMissingTones(light[k], asked[k], lobeOf(lamps[k], pictures.roughness), pictures.level, lit[k].tones);
    }
    auto solved = solveDirections(lit, pictures.roughness,
                                  {input.shape.page, project.toolpath.spacing, insideOf(input.shape)}, inversion, run);
    if (!solved) return solved.error();
    tried.directions = std::move(solved.value().directions);
    plate = make(tried, round, rounds);
    if (!plate) return plate;
  }
}

}  // namespace sillon
