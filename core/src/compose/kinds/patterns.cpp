// Computes directions from a formula, and along contours.
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "base/exact_math.hpp"
#include "compose/lines.hpp"
#include "geometry/signed_distance.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {
namespace {

Vec2f turned(Vec2f line, Vec2f by) { return {line.x * by.x - line.y * by.y, line.x * by.y + line.y * by.x}; }

LineAt radial(const PatternLayer& pattern, const Placement& place) {
  return [middle = place.middle(), by = lineOf(pattern.angle * kDegree)](Vec2 at) {
    return turned(lineAlong(at - middle), by);
  };
}

LineAt waves(const PatternLayer& pattern, const Placement& place) {
  const double main = pattern.angle * kDegree + place.rotation();
  const exact::SinCos way = exact::sinCos(main);
  const double turns = 2 * std::numbers::pi / pattern.waveLength, swing = pattern.amplitude * kDegree;
  return [=, middle = place.middle()](Vec2 at) {
    const Vec2 from = at - middle;
    return lineOf(main + swing * exact::sin((from.x * way.cos + from.y * way.sin) * turns));
  };
}

/// Rays that turn by 180 degrees per wave length on their way out, so that equal directions lie on spirals.
LineAt spiral(const PatternLayer& pattern, const Placement& place) {
  const double turns = (place.mirror() ? -1 : 1) * std::numbers::pi / pattern.waveLength;
  return [turns, middle = place.middle(), angle = pattern.angle * kDegree](Vec2 at) {
    const Vec2 from = at - middle;
    return turned(lineAlong(from), lineOf(angle + turns * std::sqrt(dot(from, from))));
  };
}

/// Returns a number in -1..1, the same for equal seeds and knots on every platform.
double chance(std::uint64_t seed, std::int64_t x, std::int64_t y) {
  auto hash = static_cast<std::uint32_t>(seed ^ (seed >> 32)) * 0x9e3779b1U;
  hash = (hash ^ static_cast<std::uint32_t>(x)) * 0x85ebca6bU;
  hash = (hash ^ (hash >> 15) ^ static_cast<std::uint32_t>(y)) * 0xc2b2ae35U;
  hash = (hash ^ (hash >> 13)) * 0x27d4eb2fU;
  return static_cast<double>(hash ^ (hash >> 16)) / 2147483648.0 - 1;
}

/// Smoothing polynomial whose first two derivatives are 0 at 0 and 1, so that knots do not show as creases.
double eased(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

/// Value noise: the angle, turned by up to the amplitude to either side. The grid of knots has its origin in the
/// layer's middle and turns with the layer.
LineAt noise(const PatternLayer& pattern, const Placement& place) {
  return [&pattern, place](Vec2 at) {
    const Vec2 own = place.toOwn(at) * (1 / pattern.waveLength);
    const double left = std::floor(own.x), below = std::floor(own.y);
    const double across = eased(own.x - left), up = eased(own.y - below);
    const auto between = [&](double row) {
      const auto x = static_cast<std::int64_t>(left), y = static_cast<std::int64_t>(row);
      const double from = chance(pattern.seed, x, y);
      return from + across * (chance(pattern.seed, x + 1, y) - from);
    };
    const double low = between(below);
    const double turn = low + up * (between(below + 1) - low);
    return lineOf(place.rotation() + (pattern.angle + pattern.amplitude * turn) * kDegree);
  };
}

}  // namespace

LineAt patternLines(const PatternLayer& pattern, const Placement& place) {
  switch (pattern.pattern) {
    case LayerPattern::Spiral:
      return spiral(pattern, place);
    case LayerPattern::Waves:
      return waves(pattern, place);
    case LayerPattern::Noise:
      return noise(pattern, place);
    case LayerPattern::Radial:
    case LayerPattern::Echo:
      break;
  }
  return radial(pattern, place);
}

Result<LineAt> alongLines(const Shape& shape, double spacing, const RunContext& run) {
  const Result<Outline> outline = resolveOutline(shape);
  if (!outline) return outline.error();
  Bounds page;
  page.add({0, 0});
  page.add(shape.page);
  const Grid grid = makeGrid(page, spacing);
  const Result<BorderIndex> index = buildBorderIndex(outline.value(), grid, run);
  if (!index) return index.error();
  Result<SignedDistanceField> field = signedDistanceField(shape, index.value(), grid, run);
  if (!field) return field.error();
  return LineAt([field = std::move(field).value()](Vec2 at) {
    const Vec2f normal = field.normal[field.grid.cellAt(at)];
    return lineAlong(Vec2{-static_cast<double>(normal.y), static_cast<double>(normal.x)});
  });
}

}  // namespace sillon
