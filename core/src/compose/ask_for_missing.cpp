#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "pictures/parts.hpp"
#include "sillon/compose/compose.hpp"

namespace sillon {
Result<std::vector<PictureMeasures>> askForMissing(LayerStack& stack, const Toolpath& toolpath, Vec2 page,
                                                   const Roughness& roughness, const RunContext& run) {
  std::vector<Lamp> lamps;
  for (const auto& [number, picture] : stack.pictures) lamps.push_back(picture.lamp);
  const auto plate = seePlate(toolpath, page, lamps, roughness, run);
  if (!plate) return plate.error();
  const SeenCells& seen = plate.value();
  // Index in a raster of the page of a place in shares of it, from its upper left corner.
  const auto indexIn = [](int width, int height, Vec2 share) {
    const int x = std::clamp(static_cast<int>(share.x * width), 0, width - 1);
    const int y = std::clamp(static_cast<int>(share.y * height), 0, height - 1);
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  };
  const double cell = page.x / seen.width;
  std::vector<PictureMeasures> measures;
  std::size_t lamp = 0;
  for (auto& [number, picture] : stack.pictures) {
    const int columns = std::max(1, static_cast<int>(std::lround(picture.size.x / cell)));
    const int rows = std::max(1, static_cast<int>(std::lround(picture.size.y / cell)));
    std::vector<float> light;  // negative where the picture is not on top
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x) {
        const Vec2 at =
            picture.origin + Vec2{(x + 0.5) * picture.size.x / columns, (rows - y - 0.5) * picture.size.y / rows};
        const Vec2 share{at.x / page.x, 1 - at.y / page.y};
        const bool onTop = stack.texels[indexIn(stack.width, stack.height, share)].top == number + 1;
        light.push_back(onTop ? seen.light[lamp][indexIn(seen.width, seen.height, share)] : -1);
      }
    }
    const Tones asked = resampled(picture.asked, columns, rows);
    measures.push_back(compareTones(light, asked));
    addMissingTones(light, asked, lobeOf(picture.lamp, roughness), picture.level, picture.solved);
    ++lamp;
  }
  return measures;
}

}  // namespace sillon
