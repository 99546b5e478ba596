// The 2D shape to fill: painted paths on a page, and the built-in ones.
#pragma once

#include <string>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"

namespace sillon {

enum class FillRule { NonZero, EvenOdd };

using Ring = std::vector<Vec2>;  ///< closed polygon [mm], first point not repeated, any winding

/// How far from 0 the points of a shape may lie [mm]; 1e12 nm are exact in a double.
inline constexpr double kMaxCoordinate = 1e6;

/// One painted element: its rings under one fill rule.
struct FilledPath {
  std::vector<Ring> rings;
  FillRule fillRule = FillRule::NonZero;

  friend bool operator==(const FilledPath&, const FilledPath&) = default;
};

/// What readSvg left out, and what it took for granted.
struct DrawingFacts {
  bool svg = false;
  bool pixels = false;          ///< its size is in pixels, or has no unit: taken as 1/96 inch each
  int texts = 0;                ///< shown, but not read
  int images = 0;               ///< shown, but not read
  bool unpainted = false;       ///< nothing is painted: outlines were taken whatever their paint
  bool linesOnly = false;       ///< nothing is filled: strokes alone are the shape
  bool severalColours = false;  ///< painted, of which the shape shows nothing
  double offPage = 0;           ///< painted, but cut off at the page's edges [mm²]
  /// What is shown and not read beside texts and images: "<marker>", "CSS \"r\"", ...; at most 8.
  std::vector<std::string> unread = {};
  /// Painted at half opacity or less beside what is not [mm²]; 0 below 0.5 % of the shape
  double faintMm2 = 0;

  friend bool operator==(const DrawingFacts&, const DrawingFacts&) = default;
};

/// A place of a shape that is narrower than a bead.
struct ThinPlace {
  Vec2 at;             ///< its thickest point [mm]
  double areaMm2 = 0;  ///< above tau²/4
  double width = 0;    ///< of its thickest point, unless told otherwise [mm]

  friend bool operator==(const ThinPlace&, const ThinPlace&) = default;
};

/// The union of its paths on a page of `page` mm; maps are stretched over the page.
struct Shape {
  std::vector<FilledPath> paths;
  Vec2 page;
  DrawingFacts drawing = {};
  std::vector<ThinPlace> kept = {};  ///< widened to one bead by keepThinPlaces, the largest first

  friend bool operator==(const Shape&, const Shape&) = default;
};

/// Axis-parallel rectangle that fills its page.
/// \param size  width and height [mm], each > 0.
Result<Shape> makeRectangle(Vec2 size);
/// \param radius  corner radius [mm], >= 0, clamped to half the shorter side.
Result<Shape> makeRoundedRectangle(Vec2 size, double radius);
/// Disc that fills its page.
/// \param diameter  [mm], > 0.
Result<Shape> makeDisc(double diameter);

/// Outline of the bright (>= 50 %), opaque pixels of an image, stretched to the given width. An
/// image with transparent pixels is read by its alpha alone.
/// \param width  of the page [mm], > 0; the height follows.
Result<Shape> shapeFromMask(const Image& mask, double width);

/// The same shape and page scaled so that the page is `width` mm wide.
/// \param width  [mm], > 0.
Result<Shape> scaledToWidth(const Shape& shape, double width);

/// Box around the points of all rings [mm]. Rings that enclose nothing count too; it is empty
/// without points.
Bounds bounds(const Shape& shape);

}  // namespace sillon
