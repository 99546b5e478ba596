#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "look/inversion_parts.hpp"
#include "look/rasters.hpp"
#include "pictures/parts.hpp"
#include "project/files.hpp"
#include "quality/seen_cells.hpp"
#include "sillon/look/appearance.hpp"
#include "sillon/pictures/pictures.hpp"
#include "sillon/quality/metrics.hpp"

namespace sillon {

namespace {

/// Most tones that are kept, 16 MB; larger pictures are solved again.
constexpr std::size_t kMostKeptTones = 4'000'000;

/// Computes PlatePictures::fieldR for directions.
std::vector<double> fieldR(const PlatePictures& pictures, const DirectionMap& directions) {
  std::vector<double> r;
  if (pictures.shown.size() < 2) return r;
  // The cells are 2 tau wide, like those in which plates are judged.
  const int width = std::max(1, directions.width / 4), height = std::max(1, directions.height / 4);
  const std::vector<Tones> seen =
      shownTones(pictures.shown, directions, {pictures.roughness, pictures.level}, width, height);
  for (std::size_t k = 0; k < seen.size(); ++k) {
    std::vector<float> light;
    light.reserve(seen[k].value.size());
    for (const float code : seen[k].value) light.push_back(lightOfCode(std::max(0.0f, code)));
    r.push_back(compareTones(light, resampled(pictures.shown[k].tones, width, height)).r);
  }
  return r;
}

}  // namespace

Roughness roughnessOf(const Project& project) {
  const PictureParams& params = project.pictures;
  if (params.slopes) return {params.slopes->x, params.slopes->y};
  return roughnessOf(spoolOf(params.spool), project.printer.nozzle, project.print.showSide == ShowSide::Bed);
}

std::vector<PictureFacts> pictureFacts(const PlatePictures& pictures, const std::vector<PictureMeasures>& measures) {
  std::vector<PictureFacts> facts(pictures.shown.size());
  for (std::size_t k = 0; k < facts.size(); ++k) {
    const std::vector<float>& tones = pictures.shown[k].tones.value;
    const auto [darkest, brightest] = std::minmax_element(tones.begin(), tones.end());
    facts[k].oneTone = tones.empty() || *brightest == *darkest;
    if (k < pictures.fieldR.size()) facts[k].fieldR = pictures.fieldR[k];
    if (k < measures.size()) facts[k].seenR = measures[k].r;
  }
  return facts;
}

InversionParams inversionOf(const PictureParams& params) {
  InversionParams inversion;
  inversion.smoothness = params.smoothness;
  inversion.localContrast = params.localContrast;
  return inversion;
}

/// Pictures with their lamps but without tones.
std::vector<LitPicture> unlit(const std::vector<LampPicture>& pictures, double lampSize) {
  std::vector<LitPicture> lit;
  for (const LampPicture& asked : pictures) {
    Lamp lamp;
    lamp.slope = lampSize;
    if (asked.lamp) {
      lamp.azimuth = asked.lamp->x;
      lamp.elevation = asked.lamp->y;
    } else if (!lit.empty()) {
      lamp.elevation = lit[0].lamp.elevation;  // one lamp, carried around the plate at one elevation
    }
    lit.push_back({{}, lamp, !asked.lamp});
  }
  return lit;
}

Result<PlatePictures> solvePictures(const Project& project, const ReadInput& read, PlateInput& input,
                                    const RunContext& run, std::optional<KeptPictures>* kept, const OnTrial& onTrial) {
  const PictureParams& params = project.pictures;
  PlatePictures pictures;
  pictures.roughness = roughnessOf(project);
  const Layer* const ground = groundOf(project.layers);
  const PictureLayer* const layer = ground == nullptr ? nullptr : ground->as<PictureLayer>();
  if (layer == nullptr) return pictures;
  std::vector<LitPicture> lit = unlit(layer->pictures, params.lampSize);
  for (std::size_t k = 0; k < lit.size(); ++k) {
    Result<Image> image = readPicture(read, layer->pictures[k].file, "picture");
    if (!image) return image.error();
    lit[k].tones = tonesOf(cropped(std::move(image).value(), *layer));
  }
  const Vec2 page = input.shape.page;
  const double spacing = project.toolpath.spacing;
  const InversionParams inversion = inversionOf(params);
  for (LitPicture& picture : lit) {
    pictures.leftOut.push_back(0);
    picture.tones = pageTones(std::move(picture.tones), page, params.proportions, pictures.leftOut.back());
  }
  std::optional<double> azimuth;  // azimuth of a lamp that is to be chosen
  if (kept != nullptr && *kept) {
    const KeptPictures& before = **kept;
    if (before.lit == lit && before.pictures.roughness == pictures.roughness && before.shape == input.shape &&
        before.inversion == inversion) {
      if (before.spacing == spacing) {
        PlatePictures again = before.pictures;
        again.leftOut = pictures.leftOut;
        for (std::size_t k = 0; k < lit.size(); ++k) again.shown[k].file = layer->pictures[k].file;
        input.directions = before.directions;
        input.showsPictures = true;
        return again;
      }
      if (lit.size() == 1) azimuth = before.pictures.shown[0].lamp.azimuth;
    }
    kept->reset();  // frees its memory for solving
  }
  std::vector<LitPicture> placed = lit;
  if (lit.size() == 1 && lit[0].chooseAzimuth) {
    if (!azimuth) {
      const auto chosen = chosenAzimuth(lit, pictures.roughness, input.shape, inversion, run, onTrial);
      if (!chosen) return chosen.error();
      azimuth = chosen.value();
    }
    placed[0].lamp.azimuth = *azimuth;
    placed[0].chooseAzimuth = false;
  }
  auto solved = solveDirections(placed, pictures.roughness, {page, spacing, insideOf(input.shape)}, inversion, run);
  if (!solved) return solved.error();
  std::size_t tones = 0;
  for (std::size_t k = 0; k < lit.size(); ++k) {
    tones += lit[k].tones.value.size();
    pictures.chosen.push_back(lit[k].chooseAzimuth);
    pictures.shown.push_back({layer->pictures[k].file, solved.value().lamps[k], std::move(solved.value().shown[k])});
    pictures.solved.push_back(pictures.shown.back().tones);
  }
  pictures.level = solved.value().level;
  pictures.contrast = contrastOf(lobeOf(pictures.shown[0].lamp, pictures.roughness));
  input.directions = std::move(solved.value().directions);
  input.showsPictures = true;
  pictures.fieldR = fieldR(pictures, input.directions);
  if (kept != nullptr && tones <= kMostKeptTones) {
    kept->emplace(KeptPictures{std::move(lit), input.shape, spacing, inversion, pictures, input.directions});
  }
  return pictures;
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
