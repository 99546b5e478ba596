// The 2D shape to fill: painted paths on a page, and the built-in ones.
#pragma once

#include <string>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"

namespace sillon {

enum class FillRule { NonZero, EvenOdd };

using Ring = std::vector<Vec2>;  ///< closed polygon [mm], first point not repeated, any winding

/// One painted element: its rings under one fill rule.
struct FilledPath {
  std::vector<Ring> rings;
  FillRule fillRule = FillRule::NonZero;

  friend bool operator==(const FilledPath&, const FilledPath&) = default;
};

/// A letter that the font of a text lacks.
struct LackedLetter {
  std::string letter;    ///< the letter in UTF-8
  std::string font;      ///< built-in font that draws it; empty: no font has it, so it is left out
  bool picture = false;  ///< the text's own font has a picture of it, without outlines

  friend bool operator==(const LackedLetter&, const LackedLetter&) = default;
};

/// Facts about a drawing: parts that readSvg left out, and assumptions that it made.
struct DrawingFacts {
  bool svg = false;
  bool pixels = false;     ///< its size is in pixels, or has no unit: each is taken as 1/96 inch
  int texts = 0;           ///< number of texts that are shown but were not read
  int images = 0;          ///< number of images that are shown but were not read
  bool otherFont = false;  ///< text is drawn in fonts that stand in for its own
  /// Letters of its text that the font lacks, as in ShapedLine
  std::vector<LackedLetter> lacked = {};
  bool unpainted = false;  ///< nothing is painted, so that outlines were taken whatever their paint
  bool linesOnly = false;  ///< nothing is filled, so that strokes alone are the shape
  bool severalColours = false;  ///< it is painted in several colours, which the shape does not show
  /// A picture with a transparent ground lends the shape only its proportions
  bool cutOut = false;
  double offPage = 0;  ///< area painted beyond the page and cut off at its edges [mm²]
  /// Other things that are shown but were not read: "<marker>", "CSS \"r\"", ...; at most 8
  std::vector<std::string> unread = {};
  /// Area that is painted at half opacity or less, where other paint is not [mm²]; 0 below 0.5 % of
  /// the shape
  double faintMm2 = 0;
  std::string maker = {};  ///< program whose pixels are not 1/96 inch; empty: none is known
  double makerWidth = 0;   ///< width of the page by the pixels of that program [mm]

  friend bool operator==(const DrawingFacts&, const DrawingFacts&) = default;
};

/// A place of a shape that is narrower than a bead.
struct ThinPlace {
  Vec2 at;             ///< its thickest point [mm]
  double areaMm2 = 0;  ///< its area [mm²], above tau²/4
  double width = 0;    ///< width at its thickest point, unless stated otherwise [mm]

  friend bool operator==(const ThinPlace&, const ThinPlace&) = default;
};

/// A shape: the union of its paths on a page of `page` mm, over which maps are stretched.
struct Shape {
  std::vector<FilledPath> paths;
  Vec2 page;
  DrawingFacts drawing = {};
  /// Places that keepThinPlaces widened to one bead, the largest first
  std::vector<ThinPlace> kept = {};

  friend bool operator==(const Shape&, const Shape&) = default;
};

/// Treatment of a polygon's corners.
struct Corners {
  /// Radius of the arc that rounds a corner [mm], >= 0; the arc begins and ends at most half a side
  /// away
  double radius = 0;
  bool chamfered = false;  ///< corners are cut off straight between the ends of that arc
};

// Built-in shapes. Each fills its page, except for what is taken off its corners; a height of 0
// stands for the shape's own height. Curves are exact to 0.001 mm. All return InvalidArgument for
// arguments that are out of range.

/// Makes an axis-parallel rectangle that fills its page.
/// \param size  width and height [mm], each > 0.
Result<Shape> makeRectangle(Vec2 size);
/// Makes a rectangle with rounded or chamfered corners.
/// \param radius  corner radius [mm], >= 0, clamped to half the shorter side.
/// \param chamfered  cuts the corners off instead of rounding them.
Result<Shape> makeRoundedRectangle(Vec2 size, double radius, bool chamfered = false);
/// Makes a disc that fills its page.
/// \param diameter  diameter [mm], > 0.
Result<Shape> makeDisc(double diameter);
/// Makes a disc with a round hole in its middle.
/// \param diameter  outer diameter [mm], > 0.
/// \param inner  diameter of the hole [mm], below the outer one; 0: half of it.
Result<Shape> makeRing(double diameter, double inner);
/// Makes a hexagon with corners at the left and at the right; it is regular at its own height.
/// \param size  size of the page [mm], width > 0, height >= 0.
Result<Shape> makeHexagon(Vec2 size, Corners corners = {});
/// Makes a star with a tip on top.
/// \param points  number of tips, 3..24.
/// \param size  size of the page [mm], width > 0, height >= 0.
Result<Shape> makeStar(int points, Vec2 size, Corners corners = {});
/// Makes a heart that stands on its tip.
/// \param size  size of the page [mm], width > 0, height >= 0.
Result<Shape> makeHeart(Vec2 size);
/// Makes a shield with a level top and a tip below; `corners` are those on top.
/// \param size  size of the page [mm], width > 0, height >= 0.
Result<Shape> makeShield(Vec2 size, Corners corners = {});
/// Makes a tag with a hole near its round end, which is on the left, or on top if the tag is taller
/// than wide; `corners` are those of the other end.
/// \param size  size of the page [mm], width > 0, height >= 0.
/// \param inner  diameter of the hole [mm], below the shorter side; 0: 5 mm.
Result<Shape> makeTag(Vec2 size, double inner, Corners corners = {});

/// Cuts round holes out of the shape; the result is one path on the same page.
/// \param holes  holes, each on a part of the shape.
/// \return InvalidArgument for a hole that lies wholly outside or a diameter that is not above 0;
/// EmptyShape if nothing is left; the errors of resolveOutline.
Result<Shape> withHoles(Shape shape, const std::vector<RoundHole>& holes);

/// Outlines the bright (>= 50 %), opaque pixels of an image, stretched to the given width. An image
/// with transparent pixels is read by its alpha alone.
/// \param width  width of the page [mm], > 0; the height follows.
Result<Shape> shapeFromMask(const Image& mask, double width);

/// Returns the box around the points of all rings [mm]. Rings that enclose nothing count too; the
/// box is empty without points.
Bounds bounds(const Shape& shape);

/// One straight piece of the border; the inside lies on its left.
struct BorderSegment {
  Vec2 a;
  Vec2 b;
};

/// The border of a shape, the line between inside and outside, as a soup of segments: no interior
/// edges, no duplicates, in a fixed order.
struct Outline {
  std::vector<BorderSegment> segments;
  Bounds bounds;
  double area = 0;  ///< area |Omega| of the inside [mm²]
};

/// Splits all rings where they meet and keeps the pieces with inside on exactly one side.
/// \return EmptyShape if no area remains; TooLarge beyond 4 million pieces; InvalidArgument for a
/// point more than 1e6 mm from 0.
Result<Outline> resolveOutline(const Shape& shape);

/// Unites the shape into one path on the same page, with all points on the grid of 0.001 mm. Paths
/// that overlap, share an edge or lie less than the grid apart become one body.
/// \return the errors of resolveOutline.
Result<Shape> unitedOnGrid(const Shape& shape);

/// Moves the outline of the shape outwards, or inwards by an offset below 0. Corners that move
/// outwards become round, holes become smaller, and bodies that meet become one. The page grows
/// with the outline, and keeps its size where the outline shrinks.
/// \param offset  distance [mm], -20..50. The new outline is exact to 0.005 mm, and to a tenth of a
/// mm in corners that move inwards.
/// \return InvalidArgument for another offset; EmptyShape if nothing is left; the errors of
/// resolveOutline; TooLarge, OutOfMemory or Cancelled.
Result<Shape> offsetShape(Shape shape, double offset, const RunContext& run);

}  // namespace sillon
