#include "sillon/project/pictures.hpp"

#include <cstddef>
#include <span>
#include <utility>

#include "project/input_file.hpp"
#include "project/missing_tones.hpp"
#include "sillon/look/spools.hpp"
#include "sillon/quality/picture_measures.hpp"

namespace sillon {

Roughness roughnessOf(const Project& project) {
  const PictureParams& params = project.pictures;
  if (params.slopes) return {params.slopes->x, params.slopes->y};
  return roughnessOf(spoolOf(params.spool), project.printer.nozzle, project.print.showSide == ShowSide::Bed);
}

InversionParams inversionOf(const PictureParams& params) {
  InversionParams inversion;
  inversion.smoothness = params.smoothness;
  inversion.localContrast = params.localContrast;
  return inversion;
}

Result<std::vector<LitPicture>> readPictures(const PictureParams& params, const ReadInput& read) {
  std::vector<LitPicture> lit;
  for (const LampPicture& asked : params.files) {
    const Result<Image> image = readPicture(read, asked.file, "picture");
    if (!image) return image.error();
    Lamp lamp;
    lamp.slope = params.lampSize;
    if (asked.lamp) {
      lamp.azimuth = asked.lamp->x;
      lamp.elevation = asked.lamp->y;
    } else if (!lit.empty()) {
      lamp.elevation = lit[0].lamp.elevation;  // one lamp, carried around the plate
    }
    lit.push_back({tonesOf(image.value()), lamp, !asked.lamp});
  }
  return lit;
}

Result<PlatePictures> solvePictures(const Project& project, const ReadInput& read, PlateInput& input,
                                    const RunContext& run) {
  const PictureParams& params = project.pictures;
  PlatePictures pictures;
  pictures.roughness = roughnessOf(project);
  if (params.files.empty()) return pictures;
  const Result<std::vector<LitPicture>> decoded = readPictures(params, read);
  if (!decoded) return decoded.error();
  const std::vector<LitPicture>& lit = decoded.value();
  auto solved =
      solveDirections(lit, pictures.roughness, input.shape.page, project.toolpath.spacing, inversionOf(params), run);
  if (!solved) return solved.error();
  for (std::size_t k = 0; k < lit.size(); ++k) {
    pictures.chosen.push_back(lit[k].chooseAzimuth);
    pictures.shown.push_back({params.files[k].file, solved.value().lamps[k], std::move(solved.value().shown[k])});
  }
  pictures.level = solved.value().level;
  pictures.contrast = contrastOf(lobeOf(pictures.shown[0].lamp, pictures.roughness));
  input.directions = std::move(solved.value().directions);
  return pictures;
}

Result<ToolpathResult> makeShownPlate(const Project& project, const PlatePictures& pictures, PlateInput& input,
                                      const MakeToolpath& make, const RunContext& run) {
  const PictureParams& params = project.pictures;
  const bool corrected = pictures.shown.size() == 1 && params.localContrast == 0;
  const int rounds = corrected ? 1 + params.corrections : 1;
  Result<ToolpathResult> best = make(input, 0, rounds);
  if (!best || rounds == 1) return best;

  const ShownPicture& picture = pictures.shown[0];
  std::vector<LitPicture> lit{{picture.tones, picture.lamp, false}};
  InversionParams inversion = inversionOf(params);
  inversion.level = pictures.level;
  double highest = -2;
  PlateInput tried = input;
  Result<ToolpathResult> plate = best;
  for (int round = 1;; ++round) {
    const auto seen =
        seePlate(plate.value().toolpath, input.shape.page, std::span(&picture.lamp, 1), pictures.roughness, run);
    if (!seen) return seen.error();
    const auto& [width, height, light] = seen.value();
    const Tones asked = resampled(picture.tones, width, height);
    const double r = compareTones(light[0], asked).r;
    if (r > highest) {
      highest = r;
      input.directions = tried.directions;
      best = std::move(plate);
    }
    if (round == rounds) return best;
    addMissingTones(light[0], asked, lobeOf(picture.lamp, pictures.roughness), pictures.level, lit[0].tones);
    auto solved = solveDirections(lit, pictures.roughness, input.shape.page, project.toolpath.spacing, inversion, run);
    if (!solved) return solved.error();
    tried.directions = std::move(solved.value().directions);
    plate = make(tried, round, rounds);
    if (!plate) return plate;
  }
}

LookParams lookOf(const Project& project, const PlatePictures& pictures, std::size_t picture) {
  LookParams look;
  look.colour = spoolOf(project.pictures.spool).colour;
  look.roughness = pictures.roughness;
  look.lamp.slope = project.pictures.lampSize;
  if (picture < pictures.shown.size()) {
    look.lamp = pictures.shown[picture].lamp;
    look.eyeDistance = 0;
  }
  return look;
}

}  // namespace sillon
