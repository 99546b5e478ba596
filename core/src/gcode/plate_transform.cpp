#include "gcode/layout.hpp"

#include "base/fast_math.hpp"
#include "geometry/shape_points.hpp"

namespace sillon {
namespace {

struct Rotation {
  double cos;
  double sin;
};

// Cosine and sine of an angle; quarter turns are exact.
Rotation rotation(double degrees) {
  const double quarters = degrees / 90;
  if (quarters == std::floor(quarters)) {
    const int quarter = static_cast<int>(std::fmod(std::fmod(quarters, 4) + 4, 4));
    constexpr Rotation kQuarters[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    return kQuarters[quarter];
  }
  const SinCos turn = sinCos(static_cast<float>(degrees) * (kPi / 180));
  const double size = length(Vec2{static_cast<double>(turn.cos), static_cast<double>(turn.sin)});
  return {static_cast<double>(turn.cos) / size, static_cast<double>(turn.sin) / size};
}

}  // namespace

PlateTransform::PlateTransform(const PrintParams& params, Vec2 page)
    : none_(params.rotate == 0 && !params.mirror), mirror_(params.mirror ? -1 : 1), from_(0.5 * page) {
  const Rotation turn = rotation(params.rotate);
  cos_ = turn.cos;
  sin_ = turn.sin;
  to_ =
      0.5 * Vec2{std::abs(cos_) * page.x + std::abs(sin_) * page.y, std::abs(sin_) * page.x + std::abs(cos_) * page.y};
}

Vec2 PlateTransform::apply(Vec2 p) const {
  const Vec2 d{mirror_ * (p.x - from_.x), p.y - from_.y};
  return to_ + Vec2{cos_ * d.x - sin_ * d.y, sin_ * d.x + cos_ * d.y};
}

Vec2 PlateTransform::invert(Vec2 p) const {
  const Vec2 d = p - to_;
  return from_ + Vec2{mirror_ * (cos_ * d.x + sin_ * d.y), cos_ * d.y - sin_ * d.x};
}

Toolpath PlateTransform::apply(const Toolpath& toolpath) const {
  Toolpath out = toolpath;
  for (Cycle& cycle : out.cycles) {
    for (Vec2f& p : cycle.points) {
      const Vec2 turned = apply(wide(p));
      p = {static_cast<float>(turned.x), static_cast<float>(turned.y)};
    }
  }
  return out;
}

Shape PlateTransform::apply(const Shape& shape) const {
  Shape out = shape;
  out.page = 2 * to_;
  movePoints(out, [this](Vec2 p) { return apply(p); });
  return out;
}

}  // namespace sillon
