// Paths and basic shapes of SVG as polygons: https://www.w3.org/TR/SVG2/, chapters 9 and 10.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include "sillon/shape.hpp"

namespace sillon::svg {

using Matrix = Eigen::Affine2d;
Matrix rotation(double degrees);

/// Polygons of one element. Takes curves in the element's coordinates, keeps points in mm, y up, on a grid of 1 nm.
/// Throws Refused for points that lie too far away, or are too many.
class Outliner {
 public:
  /// \param tolerance  largest distance of a chord from its curve [mm]. \param pointsLeft  of the whole drawing.
  Outliner(const Matrix& toWorld, double tolerance, std::int64_t& pointsLeft)
      : toWorld_(toWorld), tolerance_(tolerance), pointsLeft_(pointsLeft) {}

  void line(Vec2 from, Vec2 to);
  void quadratic(Vec2 from, Vec2 control, Vec2 to);
  void cubic(Vec2 from, Vec2 control1, Vec2 control2, Vec2 to);
  /// center + cos(angle) u + sin(angle) v for `sweep` radians from `angle`; `to` is the exact end.
  void arc(Vec2 from, Vec2 center, Vec2 u, Vec2 v, double angle, double sweep, Vec2 to);
  void quarter(Vec2 center, Vec2 u, Vec2 v);
  void close();
  std::vector<Ring> take();

 private:
  [[nodiscard]] int pieces(double bend) const;
  void begin(Vec2 from);
  void add(Vec2 p);
  [[nodiscard]] bool hasArea() const;

  Matrix toWorld_;
  double tolerance_;
  std::int64_t& pointsLeft_;
  Ring ring_;
  std::vector<Ring> rings_;
};

inline constexpr std::int64_t kMaxPoints = 2'000'000;  ///< of a drawing

/// \param text  attribute `d`. Throws Refused.
void drawPath(Outliner& out, std::string_view text);
/// \param text  attribute `points`. Throws Refused.
void drawPolygon(Outliner& out, std::string_view text);
void drawEllipse(Outliner& out, Vec2 center, Vec2 radii);
/// \param radii  of the corners; 0 where they are sharp.
void drawRectangle(Outliner& out, Vec2 corner, Vec2 size, Vec2 radii);

}  // namespace sillon::svg
