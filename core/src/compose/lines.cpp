#include "compose/lines.hpp"

#include "base/exact_math.hpp"
#include "input/stored_angle.hpp"

namespace sillon {

Vec2f lineOf(double radians) {
  const exact::SinCos turn = exact::sinCos(2 * radians);
  return {static_cast<float>(turn.cos), static_cast<float>(turn.sin)};
}

Vec2f lineAlong(Vec2 direction) {
  const double square = dot(direction, direction);
  if (!(square > 0)) return {1, 0};
  return {static_cast<float>((direction.x * direction.x - direction.y * direction.y) / square),
          static_cast<float>(2 * direction.x * direction.y / square)};
}

LineAt mapLines(const LayerContent& content, const Placement& place) {
  return [&content, &place](Vec2 at) {
    const auto texel = texelOf(*content.map, place.toOwn(at), content.size);
    if (!texel) return Vec2f{1, 0};
    const double own = angleOf(content.map->angle[*texel]);
    return lineOf(place.rotation() + (place.mirror() ? -own : own));
  };
}

CodeLines codeLines(const CodeLayer& code) {
  return {lineOf(code.angle * kDegree), lineOf(code.ground.value_or(code.angle + 90) * kDegree)};
}

LineAt codeLinesAt(const CodeLayer& code, const LayerContent& content, const Placement& place) {
  return [lines = codeLines(code), &content, &place](Vec2 at) {
    const auto texel = texelOf(*content.modules, place.toOwn(at), content.size);
    return texel && content.modules->samples[*texel] == 0 ? lines.dark : lines.light;
  };
}

}  // namespace sillon
