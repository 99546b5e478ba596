#include "rebrush/wanted_directions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/refused.hpp"
#include "geometry/shape_points.hpp"
#include "rebrush/blocks.hpp"
#include "sillon/look/appearance.hpp"
#include "sillon/project/project.hpp"

namespace sillon {
namespace {

constexpr int kMostTexels = 4096;  // largest number of texels along a side of a cut map

// Cuts out the part of a map that lies over `part`, where the map lies over `whole`. Maps of 1 x 1 are the same
// everywhere.
template <class Map, class Texels>
Map cutMap(const Map& map, const Texels& texels, const Bounds& part, const Bounds& whole) {
  if ((map.width <= 1 && map.height <= 1) || whole.empty()) return map;
  const Vec2 size = whole.size();
  const Vec2 page = part.size();
  Map cut;
  const auto side = [](double share, int all) {
    return std::clamp(static_cast<int>(std::ceil(2 * share * all)), 1, kMostTexels);
  };
  cut.width = side(page.x / size.x, map.width);
  cut.height = side(page.y / size.y, map.height);
  for (int y = 0; y < cut.height; ++y) {
    for (int x = 0; x < cut.width; ++x) {
      const Vec2 p = part.min + Vec2{page.x * (x + 0.5) / cut.width, page.y * (1 - (y + 0.5) / cut.height)};
      const Vec2 t{(p.x - whole.min.x) / size.x, 1 - (p.y - whole.min.y) / size.y};
      const int column = static_cast<int>(std::clamp(t.x * map.width, 0.0, map.width - 1.0));
      const int row = static_cast<int>(std::clamp(t.y * map.height, 0.0, map.height - 1.0));
      (cut.*texels).push_back((map.*texels)[indexOf(column, row, map.width)]);
    }
  }
  return cut;
}

/// Mirrors a map from left to right, as it is seen from the other side. \param turn  mirrors the value of a texel.
template <class Texel, class Turn>
void mirror(std::vector<Texel>& texels, int width, const Turn& turn) {
  for (auto row = texels.begin(); row != texels.end(); row += width) std::reverse(row, row + width);
  for (Texel& texel : texels) texel = turn(texel);
}

// Page of a surface on the bed.
Bounds pageOf(const SlicedSurface& surface) {
  Bounds box;
  box.add(surface.corner);
  box.add(surface.corner + surface.region.page);
  return box;
}

}  // namespace

bool isChosen(const SlicedSurface& surface, std::size_t index, const RebrushOptions& options) {
  if (!options.only.empty()) return std::find(options.only.begin(), options.only.end(), index) != options.only.end();
  return surface.side == SurfaceSide::Top ? options.tops : options.bottoms;
}

bool DirectionSource::share(const SlicedSurface& one, std::size_t index, const SlicedSurface& other) const {
  if (options_.fit == PictureFit::Face) return &one == &other;
  if (!isChosen(one, index, options_) || one.left != LeftBecause::None || one.side != other.side) return false;
  return options_.fit != PictureFit::Object || one.object == other.object;
}

Result<Bounds> DirectionSource::pageFor(const SlicedSurface& surface) const {
  if (options_.fit == PictureFit::Bed) {
    const Bounds& bed = file_.blocks->settings.bed;
    const Vec2 size = bed.empty() ? Vec2{} : bed.size();
    if (!(size.x > 0 && size.y > 0)) return refusedArgument("FitWithoutBed");
    return bed;
  }
  Bounds box;
  for (std::size_t k = 0; k < file_.surfaces.size(); ++k) {
    const SlicedSurface& other = file_.surfaces[k];
    if (!share(other, k, surface)) continue;
    const Bounds page = pageOf(other);
    box.add(page.min);
    box.add(page.max);
  }
  return box;
}

Shape DirectionSource::shapeOn(const Bounds& page, const SlicedSurface& surface) const {
  Shape shape;
  shape.page = page.size();
  for (std::size_t k = 0; k < file_.surfaces.size(); ++k) {
    const SlicedSurface& other = file_.surfaces[k];
    if (!share(other, k, surface)) continue;
    Shape region = other.region;
    movePoints(region, [by = other.corner - page.min](Vec2 point) { return point + by; });
    shape.paths.insert(shape.paths.end(), region.paths.begin(), region.paths.end());
  }
  if (surface.side == SurfaceSide::Bottom) {
    movePoints(shape, [width = shape.page.x](Vec2 point) { return Vec2{width - point.x, point.y}; });
  }
  return shape;
}

Result<DirectionSource::LaidComposition> DirectionSource::lay(const SlicedSurface& surface,
                                                              const RunContext& run) const {
  const Result<Bounds> page = pageFor(surface);
  if (!page) return page.error();
  const bool below = surface.side == SurfaceSide::Bottom;
  Project project = options_.project;
  project.toolpath.spacing = surface.spacing;
  project.printer.nozzle = file_.nozzle;
  project.print = {};
  project.print.showSide = below ? ShowSide::Bed : ShowSide::Up;
  if (options_.ownSpool != nullptr) {
    const Roughness slopes = roughnessOf(*options_.ownSpool, file_.nozzle, below);
    project.pictures.slopes = Vec2{slopes.along, slopes.across};
  }
  Result<PlateInput> ground = readPlateInput(project, shapeOn(page.value(), surface), options_.read);
  if (!ground) return ground.error();
  Result<Composition> composed = compose(project, std::move(ground).value(), {options_.read}, run);
  if (!composed) return composed.error();
  PlateInput input = composed.value().laid();
  if (below) {
    mirror(input.directions.angle, input.directions.width,
           [](std::uint16_t angle) { return static_cast<std::uint16_t>(65535 - angle); });
    mirror(input.modes.mode, input.modes.width, [](DirectionMode mode) { return mode; });
  }
  return LaidComposition{std::move(composed).value(), std::move(input.directions), std::move(input.modes),
                         page.value()};
}

Result<WantedDirections> DirectionSource::of(std::size_t block, const RunContext& run) {
  const SlicedSurface& surface = file_.surfaces[block];
  std::string key = surface.side == SurfaceSide::Bottom ? "below " : "above ";
  if (options_.fit == PictureFit::Face) {
    key += std::to_string(block);
    laid_.clear();  // no other surface shares a composition
  }
  if (options_.fit == PictureFit::Object) key += surface.object;
  auto found = laid_.find(key);
  if (found == laid_.end()) {
    Result<LaidComposition> laid = lay(surface, run);
    if (!laid) return laid.error();
    found = laid_.emplace(key, std::move(laid).value()).first;
  }
  last_ = &found->second;
  const Bounds page = pageOf(surface);
  return WantedDirections{cutMap(last_->directions, &DirectionMap::angle, page, last_->page),
                          cutMap(last_->modes, &ModeMap::mode, page, last_->page)};
}

Result<std::vector<JudgedPicture>> DirectionSource::judge(std::size_t block, Toolpath toolpath,
                                                          const RunContext& run) const {
  const SlicedSurface& surface = file_.surfaces[block];
  const Vec2 by = surface.corner - last_->page.min;
  const double width = last_->page.size().x;
  for (Cycle& cycle : toolpath.cycles) {
    for (Vec2f& point : cycle.points) {
      Vec2 at = wide(point) + by;
      if (surface.side == SurfaceSide::Bottom) at.x = width - at.x;
      point = {static_cast<float>(at.x), static_cast<float>(at.y)};
    }
  }
  return judgePictures(last_->composition, toolpath, run);
}

}  // namespace sillon
