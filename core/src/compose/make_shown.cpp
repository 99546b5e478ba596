// Improves the pictures of a plate in rounds: makes a path, compares it with the pictures, and corrects the tones by
// the difference.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "compose/redraw.hpp"
#include "look/rasters.hpp"
#include "pictures/parts.hpp"
#include "quality/seen_cells.hpp"
#include "sillon/compose/compose.hpp"
#include "sillon/quality/metrics.hpp"

namespace sillon {
namespace {

/// Pictures of one layer, and the light that is seen of them.
struct SeenWindow {
  std::size_t layer = 0;  ///< index of the layer
  std::span<const ShownPicture> shown;
  int columns = 0;
  int rows = 0;
  std::vector<std::vector<float>> light;  ///< light per cell of each picture; negative where the layer is not on top
};

/// Returns the index in a raster of the page for a place in shares of the page, from its upper left corner.
std::size_t indexIn(int width, int height, Vec2 share) {
  const int x = std::clamp(static_cast<int>(share.x * width), 0, width - 1);
  const int y = std::clamp(static_cast<int>(share.y * height), 0, height - 1);
  return indexOf(x, y, width);
}

/// Fills the light in the cells of a window.
/// \param lamp  index of its first lamp.
/// \param top  LayerStack::Texel::top of its layer.
void fillWindow(SeenWindow& window, Vec2 origin, Vec2 size, const Composition& of, const SeenCells& seen,
                std::size_t lamp, std::size_t top) {
  const Vec2 page = of.ground.shape.page;
  window.light.resize(window.shown.size());
  for (int y = 0; y < window.rows; ++y) {
    for (int x = 0; x < window.columns; ++x) {
      const Vec2 at =
          origin + Vec2{(x + 0.5) * size.x / window.columns, (window.rows - y - 0.5) * size.y / window.rows};
      const Vec2 share{at.x / page.x, 1 - at.y / page.y};
      const LayerStack& stack = of.layers;
      const bool onTop = stack.width == 0 || stack.texels[indexIn(stack.width, stack.height, share)].top == top;
      const std::size_t cell = indexIn(seen.width, seen.height, share);
      for (std::size_t k = 0; k < window.light.size(); ++k) {
        window.light[k].push_back(onTop ? seen.light[lamp + k][cell] : -1);
      }
    }
  }
}

/// Returns the windows of all layers with pictures, that of the ground first.
Result<std::vector<SeenWindow>> seeWindows(const Composition& of, const Toolpath& toolpath, const RunContext& run) {
  std::vector<Lamp> lamps;
  for (const ShownPicture& picture : of.pictures.shown) lamps.push_back(picture.lamp);
  for (const auto& [number, pictures] : of.layers.pictures) {
    for (const ShownPicture& picture : pictures.shown) lamps.push_back(picture.lamp);
  }
  const Vec2 page = of.ground.shape.page;
  const auto plate = seePlate(toolpath, page, lamps, of.pictures.roughness, run);
  if (!plate) return plate.error();
  const SeenCells& seen = plate.value();
  std::vector<SeenWindow> windows;
  std::size_t lamp = 0;
  if (!of.pictures.shown.empty()) {
    windows.push_back({0, of.pictures.shown, seen.width, seen.height, {}});
    fillWindow(windows.back(), {}, page, of, seen, lamp, 0);
    lamp += of.pictures.shown.size();
  }
  const double cell = page.x / seen.width;
  const auto cells = [cell](double side) { return std::max(1, static_cast<int>(std::lround(side / cell))); };
  for (const auto& [number, pictures] : of.layers.pictures) {
    windows.push_back({number, pictures.shown, cells(pictures.size.x), cells(pictures.size.y), {}});
    fillWindow(windows.back(), pictures.origin, pictures.size, of, seen, lamp, number + 1);
    lamp += pictures.shown.size();
  }
  return windows;
}

/// Compares what is seen in all windows with their pictures.
std::vector<JudgedPicture> judged(const std::vector<SeenWindow>& windows) {
  std::vector<JudgedPicture> all;
  for (const SeenWindow& window : windows) {
    std::vector<PictureMeasures> measures = comparePictures(window.light, window.shown, window.columns, window.rows);
    for (std::size_t k = 0; k < window.shown.size(); ++k) {
      all.push_back({window.layer + 1, window.shown[k].file, window.shown[k].lamp, std::move(measures[k])});
    }
  }
  return all;
}

/// Adds the missing part of pictures to the tones that are solved next.
/// \param directions  directions that were solved last, over the window.
void addMissing(const SeenWindow& window, const DirectionMap& directions, const Roughness& roughness, double level,
                std::vector<Tones>& solved) {
  std::vector<Tones> asked;
  if (window.shown.size() > 1) {
    asked = shownTones(window.shown, directions, {roughness, level}, window.columns, window.rows);
  } else {
    asked.push_back(resampled(window.shown[0].tones, window.columns, window.rows));
  }
  for (std::size_t k = 0; k < asked.size(); ++k) {
    addMissingTones(window.light[k], asked[k], lobeOf(window.shown[k].lamp, roughness), level, solved[k]);
  }
}

/// Solves for the pictures of the ground once more.
std::optional<Error> solveGround(const Project& project, Composition& of, const RunContext& run) {
  std::vector<LitPicture> lit;
  for (std::size_t k = 0; k < of.pictures.shown.size(); ++k) {
    lit.push_back({of.pictures.solved[k], of.pictures.shown[k].lamp, false});
  }
  InversionParams inversion = inversionOf(project.pictures);
  inversion.level = of.pictures.level;
  const Shape& shape = of.ground.shape;
  auto solved = solveDirections(lit, of.pictures.roughness, {shape.page, project.toolpath.spacing, insideOf(shape)},
                                inversion, run);
  if (!solved) return solved.error();
  of.ground.directions = std::move(solved.value().directions);
  return std::nullopt;
}

/// Corrects the tones by the differences that a path shows, and solves again.
std::optional<Error> correct(const Project& project, Composition& of, const std::vector<SeenWindow>& windows,
                             const ReadInput& read, const RunContext& run) {
  auto window = windows.begin();
  if (!of.pictures.shown.empty()) {
    addMissing(*window++, of.ground.directions, of.pictures.roughness, of.pictures.level, of.pictures.solved);
    if (auto error = solveGround(project, of, run)) return error;
  }
  for (auto& [number, pictures] : of.layers.pictures) {
    addMissing(*window++, pictures.directions, of.pictures.roughness, pictures.level, pictures.solved);
  }
  return of.layers.pictures.empty() ? std::nullopt : redrawLayers(project, of, read, run);
}

bool shows(const Layer& layer) { return layer.visible && layer.as<PictureLayer>() != nullptr; }

}  // namespace

Result<std::vector<JudgedPicture>> judgePictures(const Composition& composition, const Toolpath& toolpath,
                                                 const RunContext& run) {
  if (!composition.showsPictures()) return std::vector<JudgedPicture>();
  const auto windows = seeWindows(composition, toolpath, run);
  return windows ? judged(windows.value()) : Result<std::vector<JudgedPicture>>(windows.error());
}

int pathsFor(const Project& project) {
  const bool shown = std::any_of(project.layers.begin(), project.layers.end(), shows);
  return !shown || project.pictures.localContrast != 0 ? 1 : 1 + project.pictures.corrections;
}

Result<ToolpathResult> makeShown(const Project& project, Composition& composition, const ReadInput& read,
                                 const MakeToolpath& make, const RunContext& run) {
  const int rounds = composition.showsPictures() ? pathsFor(project) : 1;
  Result<ToolpathResult> best = make(composition.laid());
  if (!best || rounds == 1) return best;
  double highest = -1e9;  // sum of the pictures' correlations r
  Composition tried = composition;
  Result<ToolpathResult> plate = best;
  for (int round = 1;; ++round) {
    const auto windows = seeWindows(tried, plate.value().toolpath, run);
    if (!windows) return windows.error();
    double sum = 0;
    for (const JudgedPicture& picture : judged(windows.value())) sum += picture.measures.r;
    if (sum > highest) {
      highest = sum;
      composition = tried;
      best = std::move(plate);
    }
    if (round == rounds) return best;
    if (auto error = correct(project, tried, windows.value(), read, run)) return *error;
    plate = make(tried.laid());
    if (!plate) return plate;
  }
}

}  // namespace sillon
