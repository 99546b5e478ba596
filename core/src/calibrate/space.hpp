// Vectors and maps of space, no more than a photograph needs: headers that know all of algebra take compilers long.
#pragma once

#include <cmath>
#include <cstddef>

#include "sillon/base/types.hpp"

namespace sillon {

struct Vec3 {
  double x = 0, y = 0, z = 0;

  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
  friend constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend constexpr Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  friend double length(Vec3 a) { return std::sqrt(dot(a, a)); }
  friend Vec3 unit(Vec3 a) { return (1 / length(a)) * a; }
};

/// A linear map, by its columns.
struct Mat3 {
  Vec3 a{1, 0, 0}, b{0, 1, 0}, c{0, 0, 1};

  friend constexpr Vec3 operator*(const Mat3& m, Vec3 v) { return v.x * m.a + v.y * m.b + v.z * m.c; }
  friend constexpr Mat3 operator*(const Mat3& m, const Mat3& n) { return {m * n.a, m * n.b, m * n.c}; }

  [[nodiscard]] constexpr Mat3 transposed() const { return {{a.x, b.x, c.x}, {a.y, b.y, c.y}, {a.z, b.z, c.z}}; }
  /// Of one that has an inverse.
  [[nodiscard]] constexpr Mat3 inverse() const {
    const Vec3 bc = cross(b, c);
    const double by = 1 / dot(a, bc);
    return Mat3{by * bc, by * cross(c, a), by * cross(a, b)}.transposed();
  }
};

/// Where a map of planes has a point: homogeneous coordinates.
constexpr Vec2 mapped(const Mat3& map, Vec2 p) {
  const Vec3 at = map * Vec3{p.x, p.y, 1};
  return {at.x / at.z, at.y / at.z};
}

}  // namespace sillon
