// Prepares the pictures' tones and runs the inversion. direction_solver.cpp finds the directions, lamp_choice.cpp the
// lamps, white and side that were left open.
#include "sillon/look/inversion.hpp"
#include "base/refused.hpp"
#include "input/map_defect.hpp"

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

// Refuses the first argument that is wrong; nothing if none is.
std::optional<Error> defectOf(std::span<const LitPicture> pictures, const Roughness& roughness, const PicturePage& page,
                              const InversionParams& params) {
  struct Limited {
    const char* name;
    double value, low, high;
    const char* unit = "";
  };
  // A level of 0 is chosen here.
  const double level = params.level == 0 ? 1 : params.level;
  const Limited limits[] = {{"pictures", static_cast<double>(pictures.size()), 1, kMaxPictures},
                            {"toolpath.spacing", page.spacing, 1e-3, 1e3, "mm"},
                            {"smoothness", params.smoothness, 0.001, 10},
                            {"sharpness", params.sharpness, 0, 2},
                            {"localContrast", params.localContrast, 0, 2},
                            {"level", level, 0.05, 1}};
  for (const Limited& one : limits) {
    if (!(one.value >= one.low && one.value <= one.high)) {
      return outOfRange(one.name, one.value, one.low, one.high, one.unit);
    }
  }
  if (auto defect = pageDefect(page.size)) return defect;
  if (auto defect = invalidRoughness(roughness)) return defect;
  for (const LitPicture& picture : pictures) {
    const Tones& tones = picture.tones;
    if (auto defect = mapDefect("tones", tones.width, tones.height, tones.value.size())) return defect;
    for (const float tone : tones.value) {
      if (!std::isfinite(tone)) return outOfRange("tone", tone, 0, 1, "");
    }
    if (auto defect = invalidLamp(picture.lamp)) return defect;
    // A high lamp or a matt spool leaves too little contrast for any picture.
    if (contrastOf(lobeOf(picture.lamp, roughness)) < kLeastContrast) return refusedArgument("WeakLamp");
  }
  return std::nullopt;
}

}  // namespace

Result<SolvedDirections> solveDirections(std::span<const LitPicture> pictures, const Roughness& roughness,
                                         const PicturePage& page, const InversionParams& params,
                                         const RunContext& run) {
  if (auto defect = defectOf(pictures, roughness, page, params)) return *std::move(defect);
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
