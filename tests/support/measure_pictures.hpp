// The likeness of pictures to what a path shows.
#pragma once

#include <span>
#include <vector>

#include "quality/seen_cells.hpp"

namespace sillon {

/// Measures each picture by what seePlate sees, one row per picture.
inline Result<std::vector<PictureMeasures>> measurePictures(const Toolpath& toolpath, Vec2 page,
                                                            std::span<const ShownPicture> pictures,
                                                            const Roughness& roughness, const RunContext& run) {
  std::vector<Lamp> lamps;
  for (const ShownPicture& picture : pictures) lamps.push_back(picture.lamp);
  const auto seen = seePlate(toolpath, page, lamps, roughness, run);
  if (!seen) return seen.error();
  return comparePictures(seen.value().light, pictures, seen.value().width, seen.value().height);
}

}  // namespace sillon
