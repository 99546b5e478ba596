// Computes directions that show the pictures of a layer.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "compose/content.hpp"
#include "compose/lines.hpp"
#include "geometry/outline.hpp"
#include "geometry/shape_points.hpp"
#include "input/stored_angle.hpp"
#include "look/rasters.hpp"
#include "pictures/parts.hpp"
#include "sillon/look/inversion.hpp"
#include "sillon/pictures/pictures.hpp"

namespace sillon {
namespace {

/// Solves for the directions that show pictures under their lamps, where the layer's box and the surface overlap.
class PictureSolver {
 public:
  PictureSolver(const Layer& layer, const LayerContent& content, const Placement& place, const LayerPlate& plate)
      : layer_(layer), content_(content), place_(place), plate_(plate) {}

  /// \param known  result of the previous plate; its tones, lamps and level are solved again. If it is empty, it is
  /// filled.
  Result<LineAt> solve(LayerPictures& known, const RunContext& run) {
    const Project& project = plate_.project;
    Bounds box = bounds(place_.box(plate_.shape.page));
    origin_ = {std::max(box.min.x, 0.0), std::max(box.min.y, 0.0)};
    const Vec2 end{std::min(box.max.x, plate_.shape.page.x), std::min(box.max.y, plate_.shape.page.y)};
    size_ = end - origin_;
    // The window is empty, so any line does.
    if (!(size_.x > 0 && size_.y > 0)) return LineAt([](Vec2 /*anywhere*/) { return Vec2f{1, 0}; });
    const bool again = !known.shown.empty();
    InversionParams inversion = inversionOf(project.pictures);
    if (again) inversion.level = known.level;
    const std::vector<LitPicture> lit = again ? litAgain(known) : litAtFirst();
    const InsideCells inside = [this](int columns, int rows) { return insideOn(columns, rows); };
    auto solved = solveDirections(lit, roughnessOf(project), {size_, project.toolpath.spacing, inside}, inversion, run);
    if (!solved) return solved.error();
    if (!again) {
      known.origin = origin_;
      known.size = size_;
      known.level = solved.value().level;
      const auto& pictures = layer_.as<PictureLayer>()->pictures;
      for (std::size_t k = 0; k < lit.size(); ++k) {
        known.shown.push_back({pictures[k].file, solved.value().lamps[k], std::move(solved.value().shown[k])});
        known.solved.push_back(known.shown.back().tones);
      }
    }
    known.directions = std::move(solved.value().directions);
    return LineAt([map = known.directions, origin = origin_, size = size_](Vec2 at) {
      const auto texel = texelOf(map, at - origin - size * 0.5, size);
      return texel ? lineOf(angleOf(map.angle[*texel])) : Vec2f{1, 0};
    });
  }

 private:
  /// Returns the tones and lamps that the previous plate kept.
  static std::vector<LitPicture> litAgain(const LayerPictures& known) {
    std::vector<LitPicture> lit;
    for (std::size_t k = 0; k < known.shown.size(); ++k) lit.push_back({known.solved[k], known.shown[k].lamp, false});
    return lit;
  }
  /// Returns the pictures with their lamps for the first solution.
  [[nodiscard]] std::vector<LitPicture> litAtFirst() const {
    const double cell = plate_.project.toolpath.spacing / 2;
    const int width = std::clamp(static_cast<int>(std::ceil(size_.x / cell)), 1, kMostTexels);
    const int height = std::clamp(static_cast<int>(std::ceil(size_.y / cell)), 1, kMostTexels);
    const auto& pictures = layer_.as<PictureLayer>()->pictures;
    std::vector<LitPicture> lit = unlit(pictures, plate_.project.pictures.lampSize);
    // A single picture takes the lamp of the pictures below, so that one lamp shows both.
    if (lit.size() == 1 && lit[0].chooseAzimuth) {
      lit[0].lamp = plate_.lamp.value_or(lit[0].lamp);
      lit[0].chooseAzimuth = false;
    }
    for (std::size_t k = 0; k < lit.size(); ++k) lit[k].tones = tonesOn(content_.tones[k], width, height);
    return lit;
  }
  [[nodiscard]] Vec2 centre(int x, int y, int width, int height) const {
    return origin_ + Vec2{(x + 0.5) * size_.x / width, (height - y - 0.5) * size_.y / height};
  }
  /// Resamples tones to the cells of the window: the picture is first shrunk to cells of this size, then the nearest
  /// texel is taken.
  [[nodiscard]] Tones tonesOn(const Tones& given, int width, int height) const {
    const double cell = size_.x / width;
    const int columns = std::clamp(static_cast<int>(std::lround(content_.size.x / cell)), 1, kMostTexels);
    const int rows = std::clamp(static_cast<int>(std::lround(content_.size.y / cell)), 1, kMostTexels);
    const Tones tones = resampled(given, columns, rows);
    Tones out{width, height, {}};
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        // 1 is white: cells beyond the picture stay bright.
        const auto texel = texelOf(tones, place_.toOwn(centre(x, y, width, height)), content_.size);
        out.value.push_back(texel ? tones.value[*texel] : 1);
      }
    }
    return out;
  }
  /// Returns the cells of the window that lie inside both the shape and the layer's box. The list is empty if all cells
  /// lie inside, and also if none do, since the solver then counts every cell.
  [[nodiscard]] std::vector<char> insideOn(int width, int height) const {
    Shape window = plate_.shape;
    movePoints(window, [this](Vec2 point) { return point - origin_; });
    window.page = size_;
    std::vector<char> inside = insideCells(window, width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const Vec2 own = place_.toOwn(centre(x, y, width, height));
        const bool covered = std::abs(own.x) <= content_.size.x / 2 && std::abs(own.y) <= content_.size.y / 2;
        if (!covered) inside[indexOf(x, y, width)] = 0;
      }
    }
    const bool none = std::find(inside.begin(), inside.end(), 1) == inside.end();
    const bool all = std::find(inside.begin(), inside.end(), 0) == inside.end();
    return none || all ? std::vector<char>() : inside;
  }

  const Layer& layer_;
  const LayerContent& content_;
  const Placement& place_;
  const LayerPlate& plate_;
  Vec2 origin_;
  Vec2 size_;
};

}  // namespace

Result<LineAt> pictureLines(const Layer& layer, const LayerContent& content, const Placement& place,
                            const LayerPlate& plate, LayerPictures& known, const RunContext& run) {
  return PictureSolver(layer, content, place, plate).solve(known, run);
}

}  // namespace sillon
