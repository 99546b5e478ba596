// Paths and basic shapes of SVG as polygons: https://www.w3.org/TR/SVG2/, chapters 9 and 10.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include "sillon/geometry/shape.hpp"

namespace sillon::svg {

using Matrix = Eigen::Affine2d;
Matrix rotation(double degrees);

/// One part of a path, before it is closed for filling.
struct Line {
  std::vector<Vec2> points;  ///< [mm], none twice in a row
  std::vector<char> smooth;  ///< 1: within a curve, where a stroke has no join
  bool closed = false;       ///< the last point may repeat the first
};

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
  void begin(Vec2 from);  ///< a part, if none has begun
  void end();             ///< of a part that stays open
  void close();           ///< its end joins its beginning
  [[nodiscard]] const std::vector<Line>& lines() const { return lines_; }
  /// The parts that span an area, closed.
  [[nodiscard]] std::vector<Ring> rings() const;

 private:
  [[nodiscard]] int pieces(double bend) const;
  void add(Vec2 p, bool smooth = false);

  Matrix toWorld_;
  double tolerance_;
  std::int64_t& pointsLeft_;
  Line line_;
  std::vector<Line> lines_;
};

inline constexpr std::int64_t kMaxPoints = 2'000'000;  ///< of a drawing

/// On the grid of 1 nm. Throws Refused for points that lie too far away.
Vec2 onGrid(Vec2 p);
/// Throws Refused: there are more than kMaxPoints.
[[noreturn]] void refusePoints();

/// \param text  attribute `d`. Throws Refused.
void drawPath(Outliner& out, std::string_view text);
/// \param text  attribute `points`. Throws Refused.
void drawPolygon(Outliner& out, std::string_view text, bool closed);
void drawEllipse(Outliner& out, Vec2 center, Vec2 radii);
/// \param radii  of the corners; 0 where they are sharp.
void drawRectangle(Outliner& out, Vec2 corner, Vec2 size, Vec2 radii);

}  // namespace sillon::svg
