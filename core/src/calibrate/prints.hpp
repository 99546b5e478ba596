// Calibration prints: their kinds, the pieces that they consist of, and the plate that is built from these.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/calibrate/calibrate.hpp"
#include "sillon/gcode/writer.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// Kinds of calibration: the values that each tries, their ranges, and the advice on how to read them.

/// A kind's usual range, number of values, and texts.
struct CalibrationRow {
  const char* name;
  double from, to;
  int count;
  int digits;  ///< digits of the values after the decimal point
  const char* setting;
  const char* unit;
  const char* advice;
};

inline constexpr double kLeastWidth = 0.6;  ///< [nozzle] width of the narrowest bead that is printed
inline constexpr double kMostWidth = 1.6;   ///< [nozzle] width of the widest bead that is printed

const CalibrationRow& rowOf(CalibrationKind kind);

/// Fastest speed that hot end and machine manage [mm/s]. \param width  width of the widest bead [nozzle].
double fastest(const Printer& printer, const PrintParams& print, double width);

/// The values that a plate tries. \return InvalidArgument, with the value and its range, if one is out of range.
Result<std::vector<double>> valuesToTry(const CalibrationRequest& request);

// Pieces of calibration plates: filled polygons, spirals, wedges, wavy rows, writing.

Ring box(Vec2 low, Vec2 high);
Ring disc(Vec2 centre, double radius);

/// Fills a convex polygon by a zigzag that keeps half a bead off its border. If the polygon is a rectangle of whole
/// beads with lines along a side, the cells are the rectangle less one bead's square.
/// \param polygon  counter-clockwise. \param along  direction of the lines, of length 1. \param width  width and
/// spacing of the beads [mm].
std::vector<PatchLine> filled(const Ring& polygon, Vec2 along, double width);

inline constexpr int kSpiralSteps = 72;  ///< straight pieces per turn

/// Lays one bead as an Archimedean spiral from the middle outward: its radius is `pitch` times its angle in turns. If
/// the pitch is the width, its cells are the disc.
/// \param radius  radius of the disc [mm], more than `pitch`.
PatchLine spiral(Vec2 centre, double radius, double width, double pitch);

/// Lays `lines` beads side by side along +x, as one zigzag, whose width grows evenly. Their cells are the trapezoid
/// less the ends of its joints.
PatchLine wedge(Vec2 leftMiddle, double length, int lines, double from, double to);

/// Lays `lines` (even) beads side by side along +x, as one zigzag, that are by turns a quarter wider and narrower than
/// `width`, over waves of 9 mm. Their cells are the rectangle. \param length  `width` plus a multiple of 9 [mm].
PatchLine wavyRow(Vec2 corner, double length, int lines, double width);

/// Lays text as beads. \param unit  a sixth of a capital's height [mm].
std::vector<PatchLine> writing(std::string_view text, Vec2 corner, double unit, double width);

/// A straight bead.
PatchLine stroke(Vec2 from, Vec2 to, double width);

// Writing as single strokes.

inline constexpr double kLetterHeight = 6;     ///< [units] height of a capital
inline constexpr double kLetterWidth = 4;      ///< [units] width of a letter
inline constexpr double kLetterAdvance = 5.5;  ///< [units] from one letter to the next

/// Length of a line of writing [units].
double textWidth(std::string_view text);

/// Strokes of a line of writing, each of at least two points. Letters become capitals, and characters without strokes
/// "-". \param corner  lower left corner [mm]. \param unit  a sixth of a capital's height [mm].
std::vector<std::vector<Vec2>> textStrokes(std::string_view text, Vec2 corner, double unit);

// A calibration plate is built piece by piece: bases, patches, labels.

inline constexpr double kUnit = 0.55;                   ///< [mm] unit of writing: capitals of 3.3 mm
inline constexpr double kMargin = 0.6;                  ///< [mm] distance of writing from an edge
inline constexpr double kHigh = kUnit * kLetterHeight;  ///< [mm] height of capitals

/// Text of a value on a plate, without a leading zero: ".88", "-.06", "215".
std::string written(double value, int digits);

/// Gathers the pieces of one calibration plate.
class PlateBuilder {
 public:
  PlateBuilder(const CalibrationRequest& request, std::vector<double> values);

  [[nodiscard]] const std::vector<double>& values() const { return values_; }
  /// Digits after the decimal point that the values need.
  [[nodiscard]] int digits() const;
  /// Width of a bead: the nozzle [mm].
  [[nodiscard]] double width() const { return plate_.printer.nozzle; }
  [[nodiscard]] const Printer& printer() const { return plate_.printer; }
  [[nodiscard]] const PrintParams& print() const { return plate_.print; }
  PrintParams& print() { return plate_.print; }

  /// Adds a part of the base that carries the pieces.
  void base(Ring ring) { rings_.push_back(std::move(ring)); }

  /// Adds a patch that is laid as oriented layers are, unless the caller changes it before the next one is added.
  Patch& patch(std::vector<PatchLine> lines, int layer = 1);
  Patch& labels() { return plate_.patches.patches.front(); }
  /// Adds lines to the labels.
  void draw(std::vector<PatchLine> lines);
  /// Writes text from its lower left corner. \param unit  a sixth of a capital's height [mm].
  void label(const std::string& text, Vec2 corner, double unit = kUnit);
  /// Writes text around its middle.
  void labelAt(const std::string& text, Vec2 middle, double unit = kUnit);
  /// Notes the value of the patch that is added next. \param at  place of the patch on the plate.
  void value(double value, std::string label, Vec2 at);

  /// Moves everything to the page's corner, and hands over the plate.
  CalibrationPlate done() &&;

 private:
  CalibrationPlate plate_;
  std::vector<double> values_;
  std::vector<Ring> rings_;
};

// A star whose sectors have all directions.

/// The unit vector towards 15 k degrees.
Vec2 spoke(int k);

/// Lays a star of 24 sectors: sector k lies where the dial says 15 k degrees, and its beads run that way.
/// \param tell  true: the degrees are the values of the plate.
void layStar(PlateBuilder& plate, Vec2 centre, double inner, double outer, bool tell);

// The coupon: all tests of one spool on a card, and the places of the spirals that a photograph of it is read from.

inline constexpr double kCouponSide = 54;  ///< [mm] side of the square card

/// A spiral of one bead. It has every direction, so that some of it shines under any lamp.
struct CouponSpiral {
  Vec2 centre;        ///< place of its middle, from the lower left of the card [mm]
  double radius = 0;  ///< [mm]
  double pitch = 0;   ///< distance from one turn to the next [mm]
};

/// Corner marks, counter-clockwise from the lower left. They are closed spirals.
std::vector<CouponSpiral> couponMarks(double nozzle);

/// Spirals whose turns lie two nozzles apart, so that each bead lies alone and is as wide as the printer makes it.
std::vector<CouponSpiral> looseSpirals(double nozzle);

/// Disc `k` of the flows, counted from the top.
CouponSpiral flowDisc(int k, double nozzle);

class PlateBuilder;

/// Lays the star on the upper left, discs on the right, loose spirals and wedge below, ruler and corner marks along the
/// edges.
void layCoupon(PlateBuilder& plate);

// Places of each kind's pieces on its plate.

/// Lays the pieces of every kind but the swatch, whose toolpath is made like any picture's: see addSwatch.
void layOut(CalibrationKind kind, PlateBuilder& plate);

// The swatch: a card on which bead directions spell the filament's name and how it was printed.

/// Fills in shape, toolpath and values of a swatch. \return the errors of generateToolpath.
std::optional<Error> addSwatch(CalibrationPlate& plate, const Project& project, const RunContext& run);

}  // namespace sillon
