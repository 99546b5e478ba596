// Lengths, viewports, paths, shapes and strokes of a drawing.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "geometry/outline.hpp"
#include "input/svg/svg_node.hpp"
#include "input/svg/svg_work.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon::svg {

// Lengths with units: https://www.w3.org/TR/SVG2/coords.html#Units.

inline constexpr double kMmPerPx = 25.4 / 96;

/// Unit of a length; user units where both fields are 0.
struct Unit {
  double mm = 0;
  double ems = 0;
};

struct Length {
  double value = 0;
  Unit unit;
  bool percent = false;
};

/// Looks up a unit of CSS, given in lower case; nothing if unknown. An ex counts as half an em, a rem as 16 px.
std::optional<Unit> unitOf(std::string_view unit);

/// Reads the length of an attribute; nothing if it is missing or "auto". Throws Refused for an unknown unit.
std::optional<Length> lengthOf(const Node& node, const char* name);

/// Converts lengths to user units of the drawing. Throws Refused if an attribute cannot be read.
struct UserUnits {
  double mm = kMmPerPx;  ///< size of a user unit [mm]
  double em = 16;        ///< font size at the place of the length [user units]

  [[nodiscard]] double of(double value, const Unit& unit) const {
    return unit.mm > 0 ? value * unit.mm / mm : unit.ems > 0 ? value * unit.ems * em : value;
  }

  /// Reads a length.
  /// \param full  100 % in user units
  /// \param missing  result if there is no attribute
  [[nodiscard]] double of(const Node& node, const char* name, double full, double missing) const;
  /// Reads a length; throws Refused if it is negative, too.
  [[nodiscard]] double positive(const Node& node, const char* name, double full, double missing) const;
  /// Reads rx and ry; a missing one equals the other. \param full  100 % of either.
  [[nodiscard]] Vec2 radii(const Node& node, Vec2 full) const;
  /// Reads the length of a style; NaN if it is none.
  [[nodiscard]] double ofStyle(std::string_view text, double full) const;
};

// Paths and basic shapes of SVG as polygons: https://www.w3.org/TR/SVG2/, chapters 9 and 10.

using Matrix = Eigen::Affine2d;
Matrix rotation(double degrees);

/// A part of a path, before it is closed for filling.
struct PathLine {
  std::vector<Vec2> points;  ///< [mm], without equal neighbours
  std::vector<char> smooth;  ///< 1 for a point within a curve, where a stroke has no join
  bool closed = false;       ///< if true, the last point may repeat the first
};

inline constexpr std::size_t kNoRing = -1;

/// A part of a path that stays open.
struct LoosePiece {
  Ring points;
  std::size_t layer = 0;       ///< index of the layer that fills the piece, closed by a straight line
  std::size_t ring = kNoRing;  ///< index in that layer's rings; kNoRing: the piece spans no area
};

/// Makes polygons of one element. It takes curves in the element's coordinates and keeps points in mm, y up, on a grid
/// of 1 nm. Throws Refused for points that lie too far away, or are too many.
class Outliner {
 public:
  /// \param tolerance  largest distance of a chord from its curve [mm]
  /// \param pointsLeft  points that the whole drawing may still have
  Outliner(const Matrix& toWorld, double tolerance, std::int64_t& pointsLeft)
      : toWorld_(toWorld), tolerance_(tolerance), pointsLeft_(pointsLeft) {}

  void line(Vec2 from, Vec2 to);
  void quadratic(Vec2 from, Vec2 control, Vec2 to);
  void cubic(Vec2 from, Vec2 control1, Vec2 control2, Vec2 to);
  /// Adds center + cos(angle) u + sin(angle) v for `sweep` radians from `angle`; `to` is the exact end.
  void arc(Vec2 from, Vec2 center, Vec2 u, Vec2 v, double angle, double sweep, Vec2 to);
  void quarter(Vec2 center, Vec2 u, Vec2 v);
  void begin(Vec2 from);  ///< begins a part, if none has begun
  void end();             ///< ends a part that stays open
  void close();           ///< closes a part: its end joins its beginning
  [[nodiscard]] const std::vector<PathLine>& lines() const { return lines_; }
  /// Returns the parts that span an area, closed. \param[out] loose  receives those that were open.
  std::vector<Ring> rings(std::vector<LoosePiece>* loose = nullptr) const;

 private:
  [[nodiscard]] int pieces(double bend) const;
  void add(Vec2 p, bool smooth = false);

  Matrix toWorld_;
  double tolerance_;
  std::int64_t& pointsLeft_;
  PathLine line_;
  std::vector<PathLine> lines_;
};

inline constexpr std::int64_t kMaxPoints = 2'000'000;  ///< limit on the points of a drawing

/// Rounds to the grid of 1 nm. Throws Refused for points that lie too far away.
Vec2 onGrid(Vec2 p);
/// Throws Refused, because there are more points than kMaxPoints.
[[noreturn]] void refusePoints();

/// Draws a path. \param text  attribute `d`. Throws Refused.
void drawPath(Outliner& out, std::string_view text);
/// Draws a polygon or polyline. \param text  attribute `points`. Throws Refused.
void drawPolygon(Outliner& out, std::string_view text, bool closed);
void drawEllipse(Outliner& out, Vec2 center, Vec2 radii);
/// Draws a rectangle. \param radii  radii of the corners; 0 for sharp ones.
void drawRectangle(Outliner& out, Vec2 corner, Vec2 size, Vec2 radii);

// Transforms and viewports: https://www.w3.org/TR/SVG2/coords.html.

/// Returns the map (x, y) -> (a x + c y + e, b x + d y + f), with the parameters in SVG's order.
Matrix matrix(double a, double b, double c, double d, double e, double f);
Matrix shifted(double x, double y);

/// References for lengths in CSS.
struct CssLengths {
  UserUnits units;
  Vec2 box;  ///< size of the element's transform-box, 100 % in user units
};

/// Reads a list of transforms.
/// \param text  attribute `transform`; with `css`, the CSS property, which also takes units, translateX, skew, ...
/// Throws Refused, also for transforms in 3D.
Matrix parseTransform(std::string_view text, const CssLengths* css = nullptr);
/// Reads an origin relative to the corner of the box; a third length (z) is not read.
/// \param text  `transform-origin`. Throws Refused.
Vec2 parseOrigin(std::string_view text, const CssLengths& css);

struct ViewBox {
  Vec2 min;
  Vec2 size;
};

/// Reads the viewBox of an element; nothing if it has none. Throws Refused.
std::optional<ViewBox> viewBoxOf(const Node& node);
/// Fits a viewBox into a viewport of the given size at the origin, by preserveAspectRatio. Throws Refused.
Matrix fit(const Node& node, const ViewBox& box, Vec2 size);

// Outlines of the elements that have one: paths and basic shapes.

/// Tells whether elements of this name have an outline.
bool isShape(std::string_view name);

/// Draws the outline of a shape.
/// \param view  size that percentages refer to, in user units.
/// \return false if the shape has no area, and no stroke either. Throws Refused.
bool outlineShape(Outliner& out, const Node& node, Vec2 view, const UserUnits& units);

// Strokes as areas: https://www.w3.org/TR/SVG2/painting.html, chapters 13.4 and 13.5.

enum class StrokeCap { Butt, Round, Square };
enum class StrokeJoin { Miter, Round, Bevel };

/// Properties of a stroke; lengths are in user units of the element.
struct LineStroke {
  double width = 1;
  StrokeCap cap = StrokeCap::Butt;
  StrokeJoin join = StrokeJoin::Miter;
  double miterLimit = 4;  ///< >= 1
  /// Lengths of dash, gap, dash, ...; an even number, each >= 0. Elements that inherit them share them.
  using Dashes = std::shared_ptr<const std::vector<double>>;
  Dashes dashes;          ///< null for a solid stroke
  double dashOffset = 0;  ///< distance into the pattern at which a line begins
};

/// Returns the area that a stroke covers, to be filled by nonzero winding: all parts of a ring run in the same sense,
/// so that overlaps never cancel.
/// \param toWorld  from the element's units to mm; a singular one yields no area.
/// \param tolerance  tolerance of round caps and joins [mm].
/// \param pointsLeft  points that the whole drawing may still have. Throws Refused if there are too many.
std::vector<Ring> strokeRings(const std::vector<PathLine>& lines, const LineStroke& stroke, const Matrix& toWorld,
                              double tolerance, std::int64_t& pointsLeft);

// Limits of the visible area, and layers.

/// A limit: only the part inside is shown.
struct Limit {
  FilledPath area;
  Bounds box;
  bool isBox = false;  ///< the area is exactly its box
};

/// A layer, which either adds to those below it or hides them.
struct PaintLayer {
  FilledPath path;
  bool adds = true;
  PathPaint paint = {};
};

// Outlines without paint.

/// Adds the rings that pieces with meeting ends form, and removes the pieces from their own layers.
void joinLoose(const std::vector<LoosePiece>& pieces, std::vector<PaintLayer>& layers);
/// Makes outlines within others holes, and outlines within holes solid. Outlines that cross form one body.
/// Throws Refused if there are too many.
void alternateNested(std::vector<PaintLayer>& layers);

std::shared_ptr<const Limit> limitOf(FilledPath area);
/// Tells whether the limit cuts nothing off `box`.
bool covers(const Limit& limit, const Bounds& box);
Bounds boxOf(const std::vector<Ring>& rings);

/// Combines paths by a rule. Throws Refused.
FilledPath combine(const std::vector<FilledPath>& paths, const InsideRule& rule, Work& work);
/// Cuts a path to the part inside all limits. Throws Refused.
FilledPath within(FilledPath path, const std::vector<const Limit*>& limits, Work& work);
/// Cuts a path to the part outside of a limit that is a box, in pieces. Throws Refused.
std::vector<FilledPath> beyondBox(const FilledPath& path, const Limit& limit, Work& work);
/// Combines layers, bottom first, to one area. Throws Refused.
FilledPath flattened(const std::vector<PaintLayer>& layers, Work& work);

}  // namespace sillon::svg
