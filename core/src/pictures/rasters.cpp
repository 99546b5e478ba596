#include "pictures/parts.hpp"

#include <algorithm>
#include <cstddef>

#include "geometry/outline.hpp"
#include "look/rasters.hpp"
#include "sillon/look/inversion.hpp"

namespace sillon {

InsideCells insideOf(const Shape& shape) {
  return [&shape](int width, int height) {
    std::vector<char> inside = insideCells(shape, width, height);
    const bool none = std::find(inside.begin(), inside.end(), 1) == inside.end();
    const bool all = std::find(inside.begin(), inside.end(), 0) == inside.end();
    return none || all ? std::vector<char>() : inside;
  };
}

std::vector<Tones> shownTones(std::span<const ShownPicture> pictures, const DirectionMap& directions,
                              const SolvedLight& light, int width, int height) {
  const PictureConflict conflict = conflictOf(directions, pictures, light.roughness, light.level);
  std::vector<Tones> out;
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    Tones shown = pictures[k].tones;
    for (std::size_t c = 0; c < shown.value.size(); ++c) shown.value[c] -= conflict.missing[k][c];
    out.push_back(resampled(shown, width, height));
  }
  return out;
}

}  // namespace sillon
