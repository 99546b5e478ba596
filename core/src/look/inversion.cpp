// Prepares the pictures' tones and runs the inversion. direction_solver.cpp finds the directions, lamp_choice.cpp the
// lamps, white and side that were left open.
#include "sillon/look/inversion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/parallel_for.hpp"
#include "look/inversion_parts.hpp"
#include "look/rasters.hpp"
#include "toolpath/path.hpp"

namespace sillon {
namespace {

// Bounds: cells on the longer side, and the least contrast of a spool under a lamp.
constexpr int kMostCells = 4096;
constexpr double kLeastContrast = 1.5;
constexpr double kQuarrel = 3;  // weight of smoothness for several pictures: they ask for many more turns

// Unsharp masking: adds `amount` times the difference to a blurred copy. \param sigma  half of the blur's [cells].
void raiseDetails(std::vector<float>& values, int width, int height, double amount, double sigma) {
  if (!(amount > 0)) return;
  const std::vector<float> soft = blurred(values, width, height, static_cast<float>(2 * sigma));
  for (std::size_t k = 0; k < values.size(); ++k) {
    values[k] = std::clamp(values[k] + static_cast<float>(amount) * (values[k] - soft[k]), 0.0f, 1.0f);
  }
}

// Tells the first thing that is wrong with the arguments; empty if nothing is.
std::string defectOf(std::span<const LitPicture> pictures, const Roughness& roughness, const PicturePage& page,
                     const InversionParams& params) {
  const auto within = [](double v, double low, double high) { return v >= low && v <= high; };
  if (pictures.empty() || pictures.size() > kMaxPictures) {
    return std::to_string(pictures.size()) + " pictures are asked for; there must be 1 to 4";
  }
  if (std::string defect = pageDefect(page.size); !defect.empty()) return defect;
  if (!within(page.spacing, 1e-3, 1e3)) return "spacing is outside its range of 0.001 to 1000 mm";
  if (!within(params.smoothness, 0.001, 10)) return "smoothness is outside its range of 0.001 to 10";
  if (!within(params.sharpness, 0, 2)) return "sharpness is outside its range of 0 to 2";
  if (!within(params.localContrast, 0, 2)) return "local contrast is outside its range of 0 to 2";
  if (params.level != 0 && !within(params.level, 0.05, 1)) return "level is outside its range of 0.05 to 1, or 0";
  if (std::string defect = invalidRoughness(roughness); !defect.empty()) return defect;
  for (const LitPicture& picture : pictures) {
    const Tones& tones = picture.tones;
    if (tones.width < 1 || tones.height < 1 || tones.value.size() != cellCount(tones.width, tones.height)) {
      return "a picture has no pixels";
    }
    if (std::any_of(tones.value.begin(), tones.value.end(), [](float tone) { return !std::isfinite(tone); })) {
      return "a picture has a tone that is not a number";
    }
    if (std::string defect = invalidLamp(picture.lamp); !defect.empty()) return defect;
    // A high lamp or a matt spool leaves too little contrast for any picture.
    if (contrastOf(lobeOf(picture.lamp, roughness)) < kLeastContrast) {
      return "the lamp makes no direction of this spool more than 1.5 times as bright as another; choose a lower or a "
             "smaller lamp, or a glossier spool";
    }
  }
  return {};
}

}  // namespace

Result<SolvedDirections> solveDirections(std::span<const LitPicture> pictures, const Roughness& roughness,
                                         const PicturePage& page, const InversionParams& params,
                                         const RunContext& run) {
  if (std::string defect = defectOf(pictures, roughness, page, params); !defect.empty()) {
    return Error{ErrorCode::InvalidArgument, std::move(defect)};
  }
  // 1. Cells of tau/2, or larger on huge pages.
  const double cell = std::max(page.spacing / 2, std::max(page.size.x, page.size.y) / kMostCells);
  const auto cells = [&](double side) { return std::max(1, static_cast<int>(std::floor(side / cell + 0.5))); };
  const int width = cells(page.size.x);
  const int height = cells(page.size.y);

  // 2. Tones: resampled, stretched between the percentiles of the shape, and with details raised.
  SolvedDirections solved;
  const std::vector<char> shape = page.inside ? page.inside(width, height) : std::vector<char>();
  std::vector<Tones> raised;
  for (const LitPicture& picture : pictures) {
    solved.shown.push_back(levelled(resampled(picture.tones, width, height), shape));
    raised.push_back(solved.shown.back());
    raiseDetails(raised.back().value, width, height, params.localContrast, 0.05 * std::max(width, height));
    // Several pictures compete for details already, so that only a single one is sharpened.
    if (pictures.size() == 1) raiseDetails(raised.back().value, width, height, params.sharpness, page.spacing / cell);
  }
  // 3. Lamps, white and side that were left open, on a coarse grid.
  const double smoothness = pictures.size() > 1 ? kQuarrel * params.smoothness : params.smoothness;
  LampChoice choice = chooseLamps(lampTrial(raised, page.inside, roughness, smoothness, run), pictures, params.level);
  const LampTables tables = tablesOf(choice.lamps, roughness, choice.side);
  // 4. Directions on the whole grid, refined between the labels.
  ToneCells solvedCells = cellsOf(raised, shape, tables, choice.level);
  solve(solvedCells, tables, smoothness, run);
  solved.directions = refined(solvedCells, tables, smoothness, run);
  solved.lamps = std::move(choice.lamps);
  solved.azimuths = std::move(choice.azimuths);
  solved.level = choice.level;
  if (run.cancelled()) return cancelledRun();
  return solved;
}

}  // namespace sillon
