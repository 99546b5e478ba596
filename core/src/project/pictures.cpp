#include "sillon/project/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "look/page_tones.hpp"
#include "project/input_file.hpp"
#include "project/missing_tones.hpp"
#include "sillon/geometry/outline.hpp"
#include "sillon/look/conflict.hpp"
#include "sillon/look/spools.hpp"
#include "sillon/quality/picture_measures.hpp"

namespace sillon {

namespace {

/// Of larger pictures nothing is kept: 16 MB of tones.
constexpr std::size_t kMostKeptTones = 4'000'000;

constexpr double kTrialBeads = 100;   // on the page's longer side
constexpr double kFinestTrial = 0.1;  // [mm]
constexpr double kCoarsestTrial = 2;

/// What the directions alone show of each picture, on another raster. What pictures take from each other is missing
/// from it: no correction brings that back.
std::vector<Tones> shownTones(const PlatePictures& pictures, const DirectionMap& directions, int width, int height) {
  const PictureConflict conflict = conflictOf(directions, pictures.shown, pictures.roughness, pictures.level);
  std::vector<Tones> out;
  for (std::size_t k = 0; k < pictures.shown.size(); ++k) {
    Tones shown = pictures.shown[k].tones;
    for (std::size_t c = 0; c < shown.value.size(); ++c) shown.value[c] -= conflict.missing[k][c];
    out.push_back(resampled(shown, width, height));
  }
  return out;
}

/// As PlatePictures::fieldR.
std::vector<double> fieldR(const PlatePictures& pictures, const DirectionMap& directions) {
  std::vector<double> r;
  if (pictures.shown.size() < 2) return r;
  // Cells of 2 tau, as plates are judged.
  const int width = std::max(1, directions.width / 4), height = std::max(1, directions.height / 4);
  const std::vector<Tones> seen = shownTones(pictures, directions, width, height);
  for (std::size_t k = 0; k < seen.size(); ++k) {
    std::vector<float> light;
    light.reserve(seen[k].value.size());
    for (const float code : seen[k].value) light.push_back(lightOfCode(std::max(0.0f, code)));
    r.push_back(compareTones(light, resampled(pictures.shown[k].tones, width, height)).r);
  }
  return r;
}

InsideCells insideOf(const Shape& shape) {
  return [&shape](int width, int height) {
    const double stepX = shape.page.x / width, stepY = shape.page.y / height;
    std::vector<char> inside(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
    const auto rows = insideIntervals(shape, 0.5 * stepY, stepY, height);
    for (int y = 0; y < height; ++y) {
      char* const row = &inside[static_cast<std::size_t>(height - 1 - y) * static_cast<std::size_t>(width)];
      for (const Interval& span : rows[static_cast<std::size_t>(y)]) {
        const int first = std::max(0, static_cast<int>(std::ceil(span.begin / stepX - 0.5)));
        const int end = std::min(width, static_cast<int>(std::ceil(span.end / stepX - 0.5)));
        std::fill(row + first, row + std::max(first, end), char{1});
      }
    }
    const bool none = std::find(inside.begin(), inside.end(), 1) == inside.end();
    const bool all = std::find(inside.begin(), inside.end(), 0) == inside.end();
    return none || all ? std::vector<char>() : inside;
  };
}

// Of three azimuths that force few beads to end the one whose plate shows the picture best: forced ends say little of
// what they spoil. Plates for this have the usual settings and as many beads on any page, so that whoever changes a
// setting keeps the lamp.
Result<double> chosenAzimuth(std::vector<LitPicture> lit, const Roughness& roughness, const Shape& shape,
                             const InversionParams& inversion, const RunContext& run, const OnTrial& onTrial) {
  ToolpathParams params;
  params.spacing = std::clamp(std::max(shape.page.x, shape.page.y) / kTrialBeads, kFinestTrial, kCoarsestTrial);
  const auto solve = [&] {
    return solveDirections(lit, roughness, shape.page, params.spacing, inversion, run, insideOf(shape));
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
                                    const RunContext& run, std::optional<KeptPictures>* kept, const OnTrial& onTrial) {
  const PictureParams& params = project.pictures;
  PlatePictures pictures;
  pictures.roughness = roughnessOf(project);
  if (params.files.empty()) return pictures;
  Result<std::vector<LitPicture>> decoded = readPictures(params, read);
  if (!decoded) return decoded.error();
  std::vector<LitPicture> lit = std::move(decoded).value();
  const Vec2 page = input.shape.page;
  const double spacing = project.toolpath.spacing;
  const InversionParams inversion = inversionOf(params);
  for (LitPicture& picture : lit) {
    pictures.leftOut.push_back(0);
    picture.tones = pageTones(std::move(picture.tones), page, params.proportions, pictures.leftOut.back());
  }
  std::optional<double> azimuth;  // of a lamp that is to be chosen
  if (kept != nullptr && *kept) {
    const KeptPictures& before = **kept;
    if (before.lit == lit && before.pictures.roughness == pictures.roughness && before.shape == input.shape &&
        before.inversion == inversion) {
      if (before.spacing == spacing) {
        PlatePictures again = before.pictures;
        again.leftOut = pictures.leftOut;
        for (std::size_t k = 0; k < lit.size(); ++k) again.shown[k].file = params.files[k].file;
        input.directions = before.directions;
        input.showsPictures = true;
        return again;
      }
      if (lit.size() == 1) azimuth = before.pictures.shown[0].lamp.azimuth;
    }
    kept->reset();  // its memory is of use now
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
  auto solved = solveDirections(placed, pictures.roughness, page, spacing, inversion, run, insideOf(input.shape));
  if (!solved) return solved.error();
  std::size_t tones = 0;
  for (std::size_t k = 0; k < lit.size(); ++k) {
    tones += lit[k].tones.value.size();
    pictures.chosen.push_back(lit[k].chooseAzimuth);
    pictures.shown.push_back({params.files[k].file, solved.value().lamps[k], std::move(solved.value().shown[k])});
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

Result<ToolpathResult> makeShownPlate(const Project& project, const PlatePictures& pictures, PlateInput& input,
                                      const MakeToolpath& make, const RunContext& run) {
  const PictureParams& params = project.pictures;
  const bool corrected = !pictures.shown.empty() && params.localContrast == 0;
  const int rounds = corrected ? 1 + params.corrections : 1;
  Result<ToolpathResult> best = make(input, 0, rounds);
  if (!best || rounds == 1) return best;

  std::vector<LitPicture> lit;
  std::vector<Lamp> lamps;
  for (const ShownPicture& picture : pictures.shown) {
    lit.push_back({picture.tones, picture.lamp, false});
    lamps.push_back(picture.lamp);
  }
  InversionParams inversion = inversionOf(params);
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
    auto solved = solveDirections(lit, pictures.roughness, input.shape.page, project.toolpath.spacing, inversion, run,
                                  insideOf(input.shape));
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
