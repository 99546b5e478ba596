// Shapes that need no file. Each fills its page, apart from its cut corners.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/exact_math.hpp"
#include "geometry/shape_points.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDiscTolerance = 0.001;  // largest distance between a circle and its polygon [mm]

Shape oneRing(Ring ring, Vec2 page) {
  Shape shape;
  shape.page = snapped(page);
  shape.paths.push_back({{std::move(ring)}, FillRule::NonZero});
  return shape;
}

// Returns the number of chords for an arc: the sagitta of a chord over the angle s is below radius s²/8.
int piecesOf(double radius, double angle) {
  return static_cast<int>(std::ceil(angle * std::sqrt(radius / (8 * kDiscTolerance))));
}

// Adds a quarter of a circle from center + u to center + v, both ends included and exact.
void addQuarter(Ring& ring, Vec2 center, Vec2 u, Vec2 v) {
  const int pieces = std::max(2, piecesOf(length(u), kPi / 2));
  ring.push_back(snapped(center + u));
  for (int i = 1; i < pieces; ++i) {
    const double angle = kPi / 2 * i / pieces;
    ring.push_back(snapped(center + std::cos(angle) * u + std::sin(angle) * v));
  }
  ring.push_back(snapped(center + v));
}

// Makes a rounded rectangle, counter-clockwise from the right end of the lower side.
Ring roundedRing(Vec2 size, double radius) {
  const double r = radius;
  Ring ring;
  addQuarter(ring, {size.x - r, r}, {0, -r}, {r, 0});
  addQuarter(ring, {size.x - r, size.y - r}, {r, 0}, {0, r});
  addQuarter(ring, {r, size.y - r}, {0, r}, {-r, 0});
  addQuarter(ring, {r, r}, {-r, 0}, {0, -r});
  dropRepeatedPoints(ring);
  return ring;
}

// Adds an arc of an axis-parallel ellipse, both ends included. Angles are those of the circle before it is stretched.
void addArc(Ring& ring, Vec2 centre, Vec2 radii, double from, double to) {
  const int pieces = std::max(2, piecesOf(std::max(radii.x, radii.y), std::abs(to - from)));
  for (int i = 0; i <= pieces; ++i) {
    const exact::SinCos at = exact::sinCos(from + (to - from) * i / pieces);
    ring.push_back(snapped(centre + Vec2{radii.x * at.cos, radii.y * at.sin}));
  }
}

// Adds a cut corner between two straight sides that end at `before` and `after`.
void addCorner(Ring& ring, Vec2 before, Vec2 at, Vec2 after, Corners corners) {
  const double toBefore = length(before - at);
  const double toAfter = length(after - at);
  const Vec2 u = (before - at) * (1 / toBefore);
  const Vec2 v = (after - at) * (1 / toAfter);
  const double cosine = std::clamp(dot(u, v), -1.0, 1.0);
  const double slope = std::sqrt((1 - cosine) / (1 + cosine));  // tangent of half the angle
  const double cut = std::min({corners.radius / slope, toBefore / 2, toAfter / 2});
  if (!(cut > 0) || cosine >= 1) return ring.push_back(snapped(at));
  const Vec2 begin = at + cut * u;
  const Vec2 end = at + cut * v;
  ring.push_back(snapped(begin));
  if (!corners.chamfered) {
    const double radius = cut * slope;
    const double sweep = kPi - exact::acos(cosine);
    const Vec2 middle = at + (radius / std::sqrt((1 - cosine) / 2)) * (1 / length(u + v)) * (u + v);
    const int pieces = std::max(2, piecesOf(radius, sweep));
    const double whole = exact::sin(sweep);
    for (int i = 1; i < pieces && whole > 1e-9; ++i) {
      const double past = exact::sin(sweep * i / pieces) / whole;
      const double left = exact::sin(sweep * (pieces - i) / pieces) / whole;
      ring.push_back(snapped(middle + left * (begin - middle) + past * (end - middle)));
    }
  }
  ring.push_back(snapped(end));
}

// Makes a polygon with all of its corners cut.
Ring polygon(std::span<const Vec2> points, Corners corners) {
  Ring ring;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t before = i > 0 ? i - 1 : points.size() - 1;
    const std::size_t after = i + 1 < points.size() ? i + 1 : 0;
    addCorner(ring, points[before], points[i], points[after], corners);
  }
  dropRepeatedPoints(ring);
  return ring;
}

Shape polygonShape(std::span<const Vec2> points, Vec2 size, Corners corners) {
  return oneRing(polygon(points, corners), size);
}

// Checks the size and the corner radius of a shape.
std::optional<Error> wrongSize(Vec2 size, Corners corners) {
  if (!validSize(size.x)) return sizeError("shape.size.x", size.x);
  if (!validSize(size.y)) return sizeError("shape.size.y", size.y);
  if (corners.radius >= 0) return std::nullopt;  // false for NaN
  return refusedArgument("RadiusNegative", {{"radius", corners.radius}});
}

/// Checks the diameter of the hole of a ring or a tag. \param side  the shape's shorter side
std::optional<Error> wrongInner(double inner, double side) {
  if (inner > 0 && inner < side) return std::nullopt;  // false for NaN
  return refusedArgument("InnerOutOfRange", {{"inner", inner}, {"side", side}});
}

// Fills in the height, if none is given, by the shape's own proportions. \param share  height / width.
Vec2 withHeight(Vec2 size, double share) { return {size.x, size.y == 0 ? snapped(size.x * share) : size.y}; }

Ring hole(Vec2 centre, double diameter) {
  Ring ring = circleRing(centre, diameter);
  std::reverse(ring.begin(), ring.end());
  return ring;
}

}  // namespace

Ring circleRing(Vec2 centre, double diameter) {
  Ring ring = roundedRing({diameter, diameter}, diameter / 2);
  const Vec2 corner = centre - Vec2{diameter / 2, diameter / 2};
  for (Vec2& p : ring) p = snapped(p + corner);
  return ring;
}

Result<Shape> makeRectangle(Vec2 size) {
  if (auto error = wrongSize(size, {})) return *error;
  return oneRing({snapped(Vec2{0, 0}), snapped(Vec2{size.x, 0}), snapped(size), snapped(Vec2{0, size.y})}, size);
}

Result<Shape> makeRoundedRectangle(Vec2 size, double radius, bool chamfered) {
  if (auto error = wrongSize(size, {radius, chamfered})) return *error;
  if (radius == 0) return makeRectangle(size);
  const double held = std::min(radius, std::min(size.x, size.y) / 2);
  const std::array<Vec2, 4> box{Vec2{0, 0}, {size.x, 0}, size, {0, size.y}};
  Ring ring = chamfered ? polygon(box, {held, true}) : roundedRing(size, held);
  if (ring.size() < 3) return makeRectangle(size);  // a size of a few nm: the corners are below the grid of points
  return oneRing(std::move(ring), size);
}

Result<Shape> makeDisc(double diameter) {
  if (!validSize(diameter)) return sizeError("shape.size.x", diameter);
  return makeRoundedRectangle({diameter, diameter}, diameter / 2);
}

Result<Shape> makeRing(double diameter, double inner) {
  Result<Shape> disc = makeDisc(diameter);
  if (!disc) return disc;
  if (inner == 0) inner = diameter / 2;
  if (auto error = wrongInner(inner, diameter)) return *error;
  Shape shape = std::move(disc).value();
  shape.paths[0].rings.push_back(hole({diameter / 2, diameter / 2}, inner));
  return shape;
}

Result<Shape> makeHexagon(Vec2 size, Corners corners) {
  size = withHeight(size, std::numbers::sqrt3 / 2);
  if (auto error = wrongSize(size, corners)) return *error;
  const auto [w, h] = size;
  const std::array<Vec2, 6> points{Vec2{0, h / 2}, {w / 4, 0}, {3 * w / 4, 0}, {w, h / 2}, {3 * w / 4, h}, {w / 4, h}};
  return polygonShape(points, size, corners);
}

Result<Shape> makeStar(int points, Vec2 size, Corners corners) {
  if (points < 3 || points > 24) return outOfRange("shape.points", points, 3, 24, "");
  // Straight lines from each tip to the next but one give the inner radius for five and for six points; stars with
  // fewer or more points take the nearer of these two.
  const double inner = points <= 5 ? (3 - std::sqrt(5.0)) / 2 : std::numbers::inv_sqrt3;
  std::vector<Vec2> star;
  Bounds box;
  for (int k = 0; k < 2 * points; ++k) {
    const exact::SinCos at = exact::sinCos(kPi / 2 + kPi * k / points);
    star.push_back((k % 2 == 0 ? 1 : inner) * Vec2{at.cos, at.sin});
    box.add(star.back());
  }
  size = withHeight(size, box.size().y / box.size().x);
  if (auto error = wrongSize(size, corners)) return *error;
  for (Vec2& p : star) {
    p = {size.x * (p.x - box.min.x) / box.size().x, size.y * (p.y - box.min.y) / box.size().y};
  }
  return polygonShape(star, size, corners);
}

// Makes a heart from a square that stands on a corner and half a disc on each of its upper sides.
Result<Shape> makeHeart(Vec2 size) {
  constexpr double kHalf = std::numbers::sqrt2 / 2;  // half the square's diagonal; its side is 1
  constexpr Vec2 kBox{kHalf + 1, 1.5 * kHalf + 0.5};
  size = withHeight(size, kBox.y / kBox.x);
  if (auto error = wrongSize(size, {})) return *error;
  const Vec2 scale{size.x / kBox.x, size.y / kBox.y};
  const auto centre = [&](double side) { return Vec2{size.x / 2 + side * kHalf / 2 * scale.x, 1.5 * kHalf * scale.y}; };
  Ring ring{snapped(Vec2{size.x / 2, 0})};
  // Angles in eighths of a circle: the ends of the arcs, and the places where they touch the page's edges.
  for (const auto& [side, stops] : {std::pair{1.0, std::array{-1, 0, 2, 3}}, {-1.0, std::array{1, 2, 4, 5}}}) {
    for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
      addArc(ring, centre(side), 0.5 * scale, kPi / 4 * stops[k], kPi / 4 * stops[k + 1]);
    }
  }
  dropRepeatedPoints(ring);
  return oneRing(std::move(ring), size);
}

// Makes a shield: straight sides above two arcs that meet in a tip, each centred at the other side's lower end.
Result<Shape> makeShield(Vec2 size, Corners corners) {
  constexpr double kArcs = std::numbers::sqrt3 / 2;  // height of the arcs; the width is 1
  constexpr double kSides = 1.0 / 3;
  size = withHeight(size, kArcs + kSides);
  if (auto error = wrongSize(size, corners)) return *error;
  const auto [w, h] = size;
  const double y = h * kArcs / (kArcs + kSides);
  const Vec2 radii{w, y / kArcs};
  Ring ring;
  addArc(ring, {0, y}, radii, -kPi / 3, 0);
  addCorner(ring, {w, y}, {w, h}, {0, h}, corners);
  addCorner(ring, {w, h}, {0, h}, {0, y}, corners);
  addArc(ring, {w, y}, radii, kPi, kPi * 4 / 3);
  dropRepeatedPoints(ring);
  return oneRing(std::move(ring), size);
}

// Makes a tag, round at the end with the hole: on the left, or on top if the tag is taller than wide.
Result<Shape> makeTag(Vec2 size, double inner, Corners corners) {
  constexpr double kUsualHole = 5;  // fits a key ring [mm]
  constexpr double kWall = 3;       // between the hole and the end [mm]
  size = withHeight(size, 0.4);
  if (auto error = wrongSize(size, corners)) return *error;
  const bool upright = size.y > size.x;
  const Vec2 lying = upright ? Vec2{size.y, size.x} : size;
  const double r = lying.y / 2;
  if (inner == 0) inner = kUsualHole;
  if (auto error = wrongInner(inner, lying.y)) return *error;
  Ring ring;
  addQuarter(ring, {r, r}, {0, r}, {-r, 0});
  addQuarter(ring, {r, r}, {-r, 0}, {0, -r});
  addCorner(ring, {r, 0}, {lying.x, 0}, lying, corners);
  addCorner(ring, {lying.x, 0}, lying, {r, lying.y}, corners);
  Ring around = hole({std::min(inner / 2 + kWall, r), r}, inner);
  for (Ring* one : {&ring, &around}) {
    for (Vec2& p : *one) p = upright ? snapped(Vec2{p.y, lying.x - p.x}) : p;
    dropRepeatedPoints(*one);
  }
  Shape shape = oneRing(std::move(ring), size);
  shape.paths[0].rings.push_back(std::move(around));
  return shape;
}

}  // namespace sillon
