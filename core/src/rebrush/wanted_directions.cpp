#include "rebrush/wanted_directions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "look/inversion_parts.hpp"
#include "rebrush/blocks.hpp"
#include "sillon/look/spools.hpp"

namespace sillon {
namespace {

constexpr int kMostTexels = 4096;  // of a side of a cut map
constexpr const char* kNoBed = "fit is bed, but the file does not give its bed; it must be face, object or all";

// The part of a map that lies over `part` where the map lies over `whole`. 1 x 1 maps are the same everywhere.
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
      (cut.*texels)
          .push_back((map.*texels)[static_cast<std::size_t>(row) * static_cast<std::size_t>(map.width) +
                                   static_cast<std::size_t>(column)]);
    }
  }
  return cut;
}

// As it is seen through the plate.
LitPicture mirrored(LitPicture picture) {
  for (int row = 0; row < picture.tones.height; ++row) {
    const auto begin = picture.tones.value.begin() + static_cast<std::ptrdiff_t>(row) * picture.tones.width;
    std::reverse(begin, begin + picture.tones.width);
  }
  picture.lamp.azimuth = 180 - picture.lamp.azimuth;
  return picture;
}

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

Bounds DirectionSource::shared(const SlicedSurface& surface) const {
  if (options_.fit == PictureFit::Face) return pageOf(surface);
  Bounds box;
  for (std::size_t k = 0; k < file_.surfaces.size(); ++k) {
    const SlicedSurface& other = file_.surfaces[k];
    if (!isChosen(other, k, options_) || other.left != LeftBecause::None) continue;
    if (options_.fit == PictureFit::Object && other.object != surface.object) continue;
    const Bounds page = pageOf(other);
    box.add(page.min);
    box.add(page.max);
  }
  return box;
}

Result<Bounds> DirectionSource::whole(const SlicedSurface& surface) const {
  if (options_.fit != PictureFit::Bed) return shared(surface);
  const Bounds& bed = file_.blocks->settings.bed;
  const Vec2 size = bed.empty() ? Vec2{} : bed.size();
  if (!(size.x > 0 && size.y > 0)) return Error{ErrorCode::InvalidArgument, kNoBed};
  return bed;
}

Result<WantedDirections> DirectionSource::of(std::size_t block, const RunContext& run) {
  const SlicedSurface& surface = file_.surfaces[block];
  const Result<Bounds> stretched = whole(surface);
  if (!stretched) return stretched.error();
  const Bounds page = pageOf(surface);
  WantedDirections wanted;
  wanted.modes = cutMap(options_.modes, &ModeMap::mode, page, stretched.value());
  if (options_.pictures.empty()) {
    wanted.directions = cutMap(options_.directions, &DirectionMap::angle, page, stretched.value());
    return wanted;
  }
  const Spool* spool = options_.ownSpool != nullptr ? options_.ownSpool : findSpool(options_.spool);
  if (spool == nullptr)
    return Error{ErrorCode::InvalidArgument, "spool \"" + options_.spool + "\" is none of those listed"};
  const bool below = surface.side == SurfaceSide::Bottom;
  wanted.roughness = roughnessOf(*spool, file_.nozzle, below);

  const Bounds box = shared(surface);
  std::string key = below ? "below " : "above ";
  if (options_.fit == PictureFit::Face) key += std::to_string(block);
  if (options_.fit == PictureFit::Object) key += surface.object;
  auto found = solved_.find(key);
  if (found == solved_.end()) {
    std::vector<LitPicture> pictures;
    std::vector<double> leftOut;
    for (const LitPicture& given : options_.pictures) {
      LitPicture& picture = pictures.emplace_back(below ? mirrored(given) : given);
      picture.tones =
          pageTones(std::move(picture.tones), stretched.value().size(), options_.proportions, leftOut.emplace_back());
      picture.tones = cutMap(picture.tones, &Tones::value, box, stretched.value());
    }
    if (options_.fit == PictureFit::Face) solved_.clear();  // nobody asks for it again
    auto solved = solveDirections(pictures, wanted.roughness, {box.size(), surface.spacing}, options_.inversion, run);
    if (!solved) return solved.error();
    found = solved_.emplace(key, Solved{std::move(solved).value(), std::move(leftOut)}).first;
  }
  const SolvedDirections& solved = found->second.directions;
  wanted.leftOut = found->second.leftOut;
  wanted.directions = cutMap(solved.directions, &DirectionMap::angle, page, box);
  for (std::size_t k = 0; k < solved.shown.size(); ++k) {
    wanted.shown.push_back({{}, solved.lamps[k], cutMap(solved.shown[k], &Tones::value, page, box)});
  }
  return wanted;
}

}  // namespace sillon
