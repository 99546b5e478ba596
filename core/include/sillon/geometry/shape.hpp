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

/// A letter that the font of a text lacks.
struct LackedLetter {
  std::string letter;  ///< in UTF-8
  std::string font;    ///< built-in one that it is drawn in; empty: none has it, so it is left out
  bool picture = false;  ///< the text's own font has a picture of it, without outlines

  friend bool operator==(const LackedLetter&, const LackedLetter&) = default;
};

/// What readSvg left out, and what it took for granted.
struct DrawingFacts {
  bool svg = false;
  bool pixels = false;     ///< its size is in pixels, or has no unit: taken as 1/96 inch each
  int texts = 0;           ///< shown, but not read
  int images = 0;          ///< shown, but not read
  bool otherFont = false;  ///< text is drawn in fonts that stand in for its own
  std::vector<LackedLetter> lacked = {};  ///< of its text, as in ShapedLine
  bool unpainted = false;       ///< nothing is painted: outlines were taken whatever their paint
  bool linesOnly = false;       ///< nothing is filled: strokes alone are the shape
  bool severalColours = false;  ///< painted, of which the shape shows nothing
  bool cutOut = false;          ///< a picture with a transparent ground lends the shape no more than its proportions
  double offPage = 0;           ///< painted, but cut off at the page's edges [mm²]
  /// What is shown and not read beside texts and images: "<marker>", "CSS \"r\"", ...; at most 8.
  std::vector<std::string> unread = {};
  /// Painted at half opacity or less beside what is not [mm²]; 0 below 0.5 % of the shape
  double faintMm2 = 0;
  std::string maker = {};  ///< program whose pixels are others than 1/96 inch; empty: none is known
  double makerWidth = 0;   ///< of the page, in its pixels [mm]

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

/// Moves every point of a shape; its page stays.
/// \param move  from a point to where it goes.
template <class Move>
void movePoints(Shape& shape, const Move& move) {
  for (FilledPath& path : shape.paths) {
    for (Ring& ring : path.rings) {
      for (Vec2& point : ring) point = move(point);
    }
  }
}

/// Corners of polygons.
struct Corners {
  /// Radius of the arc that rounds a corner [mm], >= 0; the arc begins and ends at most half a side
  /// away
  double radius = 0;
  bool chamfered = false;  ///< cut off straight between the ends of that arc
};

// Built-in shapes. Each fills its page, but for what is taken off its corners; a height of 0 is the
// one that the shape has of its own. Curves are within 0.001 mm. All return InvalidArgument for
// what is out of range.

/// Axis-parallel rectangle that fills its page.
/// \param size  width and height [mm], each > 0.
Result<Shape> makeRectangle(Vec2 size);
/// \param radius  corner radius [mm], >= 0, clamped to half the shorter side.
/// \param chamfered  cuts the corners off instead of rounding them.
Result<Shape> makeRoundedRectangle(Vec2 size, double radius, bool chamfered = false);
/// Disc that fills its page.
/// \param diameter  [mm], > 0.
Result<Shape> makeDisc(double diameter);
/// Disc with a round hole in its middle.
/// \param diameter  [mm], > 0. \param inner  of the hole [mm], below the diameter; 0: half of it.
Result<Shape> makeRing(double diameter, double inner);
/// Hexagon with corners at the left and at the right; regular in its own height.
/// \param size  of the page [mm], width > 0, height >= 0.
Result<Shape> makeHexagon(Vec2 size, Corners corners = {});
/// Star with a tip on top.
/// \param points  3..24. \param size  of the page [mm], width > 0, height >= 0.
Result<Shape> makeStar(int points, Vec2 size, Corners corners = {});
/// Heart on its tip.
/// \param size  of the page [mm], width > 0, height >= 0.
Result<Shape> makeHeart(Vec2 size);
/// Shield with a level top and a tip below; `corners` are those on top.
/// \param size  of the page [mm], width > 0, height >= 0.
Result<Shape> makeShield(Vec2 size, Corners corners = {});
/// Tag with a hole near its round end, which is on the left, or on top of a tag that is taller than
/// wide; `corners` are those of the other end.
/// \param size  of the page [mm], width > 0, height >= 0.
/// \param inner  diameter of the hole [mm], below the shorter side; 0: 5 mm.
Result<Shape> makeTag(Vec2 size, double inner, Corners corners = {});

/// The shape with round holes cut out of it, as one path on the same page.
/// \param holes  each on a part of the shape.
/// \return InvalidArgument for a hole that lies wholly outside or a diameter that is not above 0;
///   EmptyShape if nothing is left; as resolveOutline.
Result<Shape> withHoles(Shape shape, const std::vector<RoundHole>& holes);

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
