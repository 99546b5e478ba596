// Computes directions between dark and light.
#include "compose/kinds/tones.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "look/rasters.hpp"

namespace sillon {
namespace {

/// Returns lines that turn with the brightness of a picture, continuously or at a threshold.
LineAt brightnessLines(const TonesLayer& tones, const LayerContent& content, const Placement& place, double spacing) {
  const BoxCells cells = cellsOn(content.size, spacing);
  // Averages codes, not light: edges that drawing programs have smoothed then stay where they were drawn.
  Tones read = means(tonesOf(*content.picture), cells.width, cells.height);
  const double sigma = tones.smoothing / cells.cell;
  const bool levels = tones.by == TonesBy::Levels;
  if (sigma > 0.1 && !levels) {
    read.value = blurred(std::move(read.value), read.width, read.height, static_cast<float>(sigma));
  }
  const auto share = [contrast = tones.contrast, threshold = tones.threshold, levels](double tone) {
    return levels ? (tone < threshold ? 0.0 : 1.0) : std::clamp((tone - 0.5) * contrast + 0.5, 0.0, 1.0);
  };
  return [kept = std::make_shared<const Tones>(std::move(read)), place, box = content.size, share, from = tones.from,
          turn = tones.to - tones.from](Vec2 at) {
    const auto texel = texelOf(*kept, place.toOwn(at), box);
    return texel ? lineOf((from + share(kept->value[*texel]) * turn) * kDegree) : Vec2f{1, 0};
  };
}

}  // namespace

BoxCells cellsOn(Vec2 box, double spacing, int most) {
  const double side = std::max(spacing / kTexelsPerBead, std::max(box.x, box.y) / most);
  const auto count = [&](double length) {
    return std::clamp(static_cast<int>(std::lround(std::min<double>(most, length / side))), 1, most);
  };
  return {count(box.x), count(box.y), side};
}

LineAt tonesLines(const TonesLayer& tones, const LayerContent& content, const Placement& place, double spacing) {
  switch (tones.by) {
    case TonesBy::Edges:
      return edgeLines(tones, content, place, spacing);
    case TonesBy::Colours:
      return colourLines(tones, content, place, spacing);
    case TonesBy::Brightness:
    case TonesBy::Levels:
      break;
  }
  return brightnessLines(tones, content, place, spacing);
}

}  // namespace sillon
