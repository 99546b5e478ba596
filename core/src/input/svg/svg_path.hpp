// Lengths, viewports, paths, shapes and strokes of a drawing.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "input/svg/svg_node.hpp"
#include "input/svg/svg_work.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/outline.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon::svg {

// Lengths with units: https://www.w3.org/TR/SVG2/coords.html#Units.

inline constexpr double kMmPerPx = 25.4 / 96;

/// One of a length's units: user units where all is 0.
struct Unit {
  double mm = 0;
  double ems = 0;
};

struct Length {
  double value = 0;
  Unit unit;
  bool percent = false;
};

/// The unit of a CSS length, in lower case. Nothing for an unknown one. ex: half an em; rem: of a 16 px font.
std::optional<Unit> unitOf(std::string_view unit);

/// Nothing for a missing attribute and for "auto". Throws Refused: an unknown unit.
std::optional<Length> lengthOf(const Node& node, const char* name);

/// Lengths in user units of the drawing. Throws Refused where an attribute cannot be read.
struct UserUnits {
  double mm = kMmPerPx;  ///< of one
  double em = 16;        ///< size of the letters where the length stands

  [[nodiscard]] double of(double value, const Unit& unit) const {
    return unit.mm > 0 ? value * unit.mm / mm : unit.ems > 0 ? value * unit.ems * em : value;
  }

  /// \param full  100 % in user units
  [[nodiscard]] double of(const Node& node, const char* name, double full, double missing) const;
  /// Throws Refused if it is negative, too.
  [[nodiscard]] double positive(const Node& node, const char* name, double full, double missing) const;
  /// rx and ry; a missing one is like the other. \param full  100 % of either.
  [[nodiscard]] Vec2 radii(const Node& node, Vec2 full) const;
  /// The length in a style; NaN for what is none.
  [[nodiscard]] double ofStyle(std::string_view text, double full) const;
};

// Paths and basic shapes of SVG as polygons: https://www.w3.org/TR/SVG2/, chapters 9 and 10.

using Matrix = Eigen::Affine2d;
Matrix rotation(double degrees);

/// One part of a path, before it is closed for filling.
struct Line {
  std::vector<Vec2> points;  ///< [mm], none twice in a row
  std::vector<char> smooth;  ///< 1: within a curve, where a stroke has no join
  bool closed = false;       ///< the last point may repeat the first
};

inline constexpr std::size_t kNoRing = static_cast<std::size_t>(-1);

/// A part of a path that stays open.
struct LoosePiece {
  Ring points;
  std::size_t layer = 0;       ///< that shows it, closed by a straight line
  std::size_t ring = kNoRing;  ///< of that layer; none: the piece spans no area
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
  /// The parts that span an area, closed. \param[out] loose  receives those that were open.
  std::vector<Ring> rings(std::vector<LoosePiece>* loose = nullptr) const;

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

// Transforms and viewports: https://www.w3.org/TR/SVG2/coords.html.

/// (x, y) -> (a x + c y + e, b x + d y + f), as SVG counts them.
Matrix matrix(double a, double b, double c, double d, double e, double f);
Matrix shifted(double x, double y);

/// References for lengths in CSS.
struct CssLengths {
  UserUnits units;
  Vec2 box;  ///< of the element's transform-box: 100 % in user units
};

/// \param text  attribute `transform`, or the property where `css` is given: it takes units and translateX, skew, ...
/// Throws Refused, for transforms in space, too.
Matrix parseTransform(std::string_view text, const CssLengths* css = nullptr);
/// \param text  `transform-origin`, from the corner of the box; what lies behind is not read. Throws Refused.
Vec2 parseOrigin(std::string_view text, const CssLengths& css);

struct ViewBox {
  Vec2 min;
  Vec2 size;
};

/// Nothing where there is none. Throws Refused.
std::optional<ViewBox> viewBoxOf(const Node& node);
/// Lays a viewBox into a viewport of the given size at the origin, as preserveAspectRatio says. Throws Refused.
Matrix fit(const Node& node, const ViewBox& box, Vec2 size);

// Outlines of the elements that have one: paths and basic shapes.

/// Tells whether elements of this name have an outline.
bool isShape(std::string_view name);

/// \param view  what percentages refer to, in user units. \return false: it has no area, and no stroke either.
/// Throws Refused.
bool outlineShape(Outliner& out, const Node& node, Vec2 view, const UserUnits& units);

// Strokes as areas: https://www.w3.org/TR/SVG2/painting.html, chapters 13.4 and 13.5.

enum class StrokeCap { Butt, Round, Square };
enum class StrokeJoin { Miter, Round, Bevel };

/// Lengths in user units of the element.
struct Stroke {
  double width = 1;
  StrokeCap cap = StrokeCap::Butt;
  StrokeJoin join = StrokeJoin::Miter;
  double miterLimit = 4;  ///< >= 1
  /// Dash, gap, dash, ...; each >= 0, an even number. They are shared by all elements that inherit them.
  using Dashes = std::shared_ptr<const std::vector<double>>;
  Dashes dashes;          ///< null: solid
  double dashOffset = 0;  ///< where in the pattern a line begins
};

/// The area that a stroke covers, to be filled by nonzero winding: no part of a ring runs against the others, so that
/// overlaps never cancel. \param toWorld  from the element's units to mm; of a singular one nothing is left. \param
/// tolerance  of round caps and joins [mm]. \param pointsLeft  of the whole drawing. Throws Refused: too many points.
std::vector<Ring> strokeRings(const std::vector<Line>& lines, const Stroke& stroke, const Matrix& toWorld,
                              double tolerance, std::int64_t& pointsLeft);

// Areas that limit what is shown, and areas laid over each other.

/// A limit of what is shown: all of it lies inside.
struct Limit {
  FilledPath area;
  Bounds box;
  bool isBox = false;  ///< nothing of the box is outside
};

/// An area that adds to what lies below it, or hides it.
struct Layer {
  FilledPath path;
  bool adds = true;
  PathPaint paint = {};
};

// Outlines without paint.

/// Adds the rings that pieces make whose ends meet, and takes the pieces out of their own layers.
void joinLoose(const std::vector<LoosePiece>& pieces, std::vector<Layer>& layers);
/// Makes outlines within others holes, and those within holes solid. Outlines that cross are one body.
/// Throws Refused: they are too many.
void alternateNested(std::vector<Layer>& layers);

std::shared_ptr<const Limit> limitOf(FilledPath area);
/// Tells whether nothing of `box` is cut off.
bool covers(const Limit& limit, const Bounds& box);
Bounds boxOf(const std::vector<Ring>& rings);

/// Combines paths by a rule. Throws Refused.
FilledPath combine(const std::vector<FilledPath>& paths, const InsideRule& rule, Work& work);
/// Cuts a path to what lies within all limits. Throws Refused.
FilledPath within(FilledPath path, const std::vector<const Limit*>& limits, Work& work);
/// Cuts a path to what lies outside of a limit that is a box, in pieces. Throws Refused.
std::vector<FilledPath> beyondBox(const FilledPath& path, const Limit& limit, Work& work);
/// Layers from below upwards as one area. Throws Refused.
FilledPath flattened(const std::vector<Layer>& layers, Work& work);

}  // namespace sillon::svg
