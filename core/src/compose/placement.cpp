#include "compose/placement.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace sillon {
namespace {

/// Rounds to the grid of 1 nm that shapes use, so that every machine gets the same bytes.
Vec2 onGrid(Vec2 point) { return {std::round(point.x * 1e6) / 1e6, std::round(point.y * 1e6) / 1e6}; }

}  // namespace

Placement::Placement(const Layer& layer, Vec2 middle, Vec2 size)
    : middle_(middle),
      size_(size),
      rotation_(layer.rotation * std::numbers::pi / 180),
      turn_(exact::sinCos(rotation_)),
      mirror_(layer.mirror) {}

Vec2 Placement::toPage(Vec2 own) const {
  const double x = mirror_ ? -own.x : own.x;
  return middle_ + Vec2{turn_.cos * x - turn_.sin * own.y, turn_.sin * x + turn_.cos * own.y};
}

Vec2 Placement::toOwn(Vec2 page) const {
  const Vec2 from = page - middle_;
  const Vec2 own{turn_.cos * from.x + turn_.sin * from.y, turn_.cos * from.y - turn_.sin * from.x};
  return {mirror_ ? -own.x : own.x, own.y};
}

Shape Placement::box(Vec2 page) const {
  Shape unit;
  unit.page = {1, 1};
  unit.paths = {{{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}}};
  return stretched(unit, page);
}

Shape Placement::stretched(const Shape& shape, Vec2 page) const {
  Shape out;
  out.page = page;
  for (const FilledPath& path : shape.paths) {
    FilledPath placed{{}, path.fillRule};
    for (const Ring& ring : path.rings) {
      Ring moved;
      moved.reserve(ring.size());
      for (const Vec2 point : ring) {
        moved.push_back(
            onGrid(toPage({(point.x / shape.page.x - 0.5) * size_.x, (point.y / shape.page.y - 0.5) * size_.y})));
      }
      placed.rings.push_back(std::move(moved));
    }
    out.paths.push_back(std::move(placed));
  }
  return out;
}

}  // namespace sillon
