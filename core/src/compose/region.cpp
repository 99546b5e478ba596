#include "compose/region.hpp"

#include <algorithm>
#include <cstddef>

#include "compose/lines.hpp"
#include "geometry/outline.hpp"
#include "geometry/signed_distance.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

Cells borderCells(const LayerPlate& plate, double width) {
  Cells cells = insideCells(plate.shape, plate.width, plate.height);
  const double cell = plate.shape.page.x / plate.width;
  // Cells beyond the page are outside, too, hence a margin of one cell.
  const int columns = plate.width + 2, rows = plate.height + 2;
  Cells outside(cellCount(columns, rows), 1);
  const auto at = [&](int x, int y) { return indexOf(x + 1, y + 1, columns); };
  const auto own = [&](int x, int y) { return indexOf(x, y, plate.width); };
  for (int y = 0; y < plate.height; ++y) {
    for (int x = 0; x < plate.width; ++x) outside[at(x, y)] = cells[own(x, y)] == 0 ? 1 : 0;
  }
  const std::vector<float> depth = chamferDistance(outside, columns, rows);
  for (int y = 0; y < plate.height; ++y) {
    for (int x = 0; x < plate.width; ++x) {
      if ((depth[at(x, y)] - 0.5F) * cell > width) cells[own(x, y)] = 0;
    }
  }
  return cells;
}

bool unbounded(const Layer& layer) {
  const auto* pattern = layer.as<PatternLayer>();
  const bool echo = pattern != nullptr && pattern->pattern == LayerPattern::Echo;
  const bool formula = pattern != nullptr || layer.as<DirectionLayer>() != nullptr;
  return layer.mask == LayerMask::Own && (echo || (formula && layer.size == Vec2{}));
}

bool outlined(const Layer& layer) { return layer.as<TextLayer>() != nullptr || layer.as<DrawingLayer>() != nullptr; }

namespace {

/// Hides cells where a picture with opacity is less than half opaque.
void hideClear(const LayerContent& content, const Placement& place, const LayerPlate& plate, Cells& shown) {
  const Image& picture = *content.picture;
  if (picture.channels % 2 == 1) return;
  const Vec2 step{plate.shape.page.x / plate.width, plate.shape.page.y / plate.height};
  for (std::size_t k = 0; k < shown.size(); ++k) {
    if (shown[k] == 0) continue;
    const std::size_t width = plate.width;
    const Vec2 at{(static_cast<double>(k % width) + 0.5) * step.x,
                  (plate.height - static_cast<double>(k / width) - 0.5) * step.y};
    const auto texel = texelOf(picture, place.toOwn(at), content.size);
    const std::size_t channels = picture.channels;
    if (texel && picture.samples[(*texel + 1) * channels - 1] < 32768) shown[k] = 0;
  }
}

}  // namespace

Region regionOf(const Layer& layer, const LayerContent& content, const Placement& place, const LayerPlate& plate) {
  const Vec2 page = plate.shape.page;
  const auto cellsOf = [&](const Shape& shape) { return insideCells(shape, plate.width, plate.height); };
  const auto everywhere = [&] { return Cells(cellCount(plate.width, plate.height), 1); };
  Region region;
  if (layer.as<BorderLayer>() != nullptr) {
    region.shown = borderCells(plate, layer.as<BorderLayer>()->width);
  } else if (layer.mask == LayerMask::Page || unbounded(layer)) {
    region.shown = everywhere();
  } else {
    region.shown =
        cellsOf(layer.mask == LayerMask::Disc ? place.stretched(makeDisc(200).value(), page) : place.box(page));
  }
  if (layer.mask == LayerMask::Inside || layer.mask == LayerMask::Outside) {
    const Cells mask = cellsOf(place.stretched(*content.mask, page));
    const bool inside = layer.mask == LayerMask::Inside;
    const bool ends = layer.as<LayerCrop>() != nullptr || layer.as<BorderLayer>() != nullptr;
    if (!inside && !ends) {
      region.shown = everywhere();
    }
    for (std::size_t k = 0; k < mask.size(); ++k) {
      if ((mask[k] != 0) != inside) region.shown[k] = 0;
    }
  }
  if (content.picture && !content.fills) hideClear(content, place, plate, region.shown);
  if (outlined(layer)) {
    region.content = cellsOf(place.stretched(*content.shape, page));
    for (std::size_t k = 0; k < region.shown.size(); ++k) {
      if (!layer.as<LayerGround>()->ground && region.content[k] == 0) region.shown[k] = 0;
      if (region.shown[k] == 0) region.content[k] = 0;
    }
  }
  return region;
}

/// Returns the share of a layer in each cell: 1 inside, 0 outside, with a ramp over the width of its soft edge.
std::vector<float> coverOf(const Cells& shown, const LayerPlate& plate, double soft) {
  std::vector<float> cover(shown.begin(), shown.end());
  const double cell = plate.shape.page.x / plate.width;
  if (!(soft > cell)) return cover;
  Cells walls = shown;
  const std::vector<float> outside = chamferDistance(walls, plate.width, plate.height);
  for (char& wall : walls) wall = wall == 0 ? 1 : 0;
  const std::vector<float> inside = chamferDistance(walls, plate.width, plate.height);
  const auto scale = static_cast<float>(cell / soft);
  for (std::size_t k = 0; k < cover.size(); ++k) {
    const float depth = shown[k] != 0 ? inside[k] - 0.5F : 0.5F - outside[k];
    cover[k] = std::clamp(0.5F + depth * scale, 0.0F, 1.0F);
  }
  return cover;
}

}  // namespace sillon
