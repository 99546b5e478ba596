// Calibration prints: kinds, the pieces they are made of, and the plate that grows.
#pragma once

#include <cstddef>
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

// Kinds of calibration: the values that each tries, their ranges, and what is said of them.

struct CalibrationRow {
  const char* name;
  double from, to;
  int count;
  int digits;  ///< of the values
  const char* setting;
  const char* unit;
  const char* advice;
};

inline constexpr double kLeastWidth = 0.6;  ///< [nozzle], the narrowest and the widest bead that is printed
inline constexpr double kMostWidth = 1.6;

const CalibrationRow& rowOf(CalibrationKind kind);

/// Fastest speed that hot end and machine manage [mm/s]. \param width  of the widest bead [nozzle].
double fastest(const Printer& printer, const PrintParams& print, double width);

/// The values that a plate tries. \return InvalidArgument (what, value, range).
Result<std::vector<double>> valuesToTry(const CalibrationRequest& request);

// Pieces of calibration plates: filled polygons, spirals, wedges, wavy rows, writing.

Ring box(Vec2 low, Vec2 high);
Ring disc(Vec2 centre, double radius);

/// Zigzag through a convex polygon, half a bead off its border. Where it is a rectangle of whole beads, lines along a
/// side, its cells are the rectangle less one bead's square.
/// \param polygon  counter-clockwise. \param along  of the lines, of length 1. \param width  of bead and spacing [mm].
std::vector<PatchLine> filled(const Ring& polygon, Vec2 along, double width);

inline constexpr int kSpiralSteps = 72;  ///< straight pieces of a turn

/// One bead round and round, from the middle out: at angle a, in turns, its radius is `pitch` times a plus whole turns.
/// If the pitch is the width, its cells are the disc.
/// \param radius  [mm], more than `pitch`.
PatchLine spiral(Vec2 centre, double radius, double width, double pitch);

/// `lines` beads side by side along +x, as one zigzag, whose width grows evenly. Their cells are the trapezoid less
/// the ends of its joints.
PatchLine wedge(Vec2 leftMiddle, double length, int lines, double from, double to);

/// `lines` (even) beads side by side along +x, as one zigzag, that are by turns a quarter wider and narrower than
/// `width`, over waves of 9 mm. Their cells are the rectangle. \param length  [mm], `width` plus a multiple of 9.
PatchLine wavyRow(Vec2 corner, double length, int lines, double width);

/// Writing. \param unit  a sixth of a capital's height [mm].
std::vector<PatchLine> writing(std::string_view text, Vec2 corner, double unit, double width);

/// A straight bead.
PatchLine stroke(Vec2 from, Vec2 to, double width);

// Writing as single strokes.

inline constexpr double kLetterHeight = 6;     ///< [units]
inline constexpr double kLetterWidth = 4;      ///< [units]
inline constexpr double kLetterAdvance = 5.5;  ///< [units], from one letter to the next

/// Length of a line of writing [units].
double textWidth(std::string_view text);

/// Strokes of a line of writing, each of at least two points. Letters are shown as capitals, what has no strokes as
/// "-". \param corner  lower left [mm]. \param unit  a sixth of a capital's height [mm].
std::vector<std::vector<Vec2>> textStrokes(std::string_view text, Vec2 corner, double unit);

// A calibration plate that grows: bases, patches, labels.

inline constexpr double kUnit = 0.55;                   ///< [mm] of writing: capitals of 3.3 mm
inline constexpr double kMargin = 0.6;                  ///< [mm] from writing to an edge
inline constexpr double kHigh = kUnit * kLetterHeight;  ///< [mm] of capitals

/// ".88", "-.06", "215".
std::string written(double value, int digits);

class PlateBuilder {
 public:
  PlateBuilder(const CalibrationRequest& request, std::vector<double> values);

  [[nodiscard]] const std::vector<double>& values() const { return values_; }
  /// After the point, that all values need.
  [[nodiscard]] int digits() const;
  /// Width of a bead: the nozzle [mm].
  [[nodiscard]] double width() const { return plate_.printer.nozzle; }
  [[nodiscard]] const Printer& printer() const { return plate_.printer; }
  [[nodiscard]] const PrintParams& print() const { return plate_.print; }
  PrintParams& print() { return plate_.print; }

  void base(Ring ring) { rings_.push_back(std::move(ring)); }

  /// Beads as oriented layers have them, until changed.
  Patch& patch(std::vector<PatchLine> lines, int layer = 1);
  Patch& labels() { return plate_.patches.patches.front(); }
  void draw(std::vector<PatchLine> lines);
  /// \param unit  a sixth of a capital's height [mm].
  void label(const std::string& text, Vec2 corner, double unit = kUnit);
  /// \param middle  of the writing.
  void labelAt(const std::string& text, Vec2 middle, double unit = kUnit);
  /// Notes the value of the patch that is laid next.
  void value(double value, std::string label, Vec2 at);

  /// Moves all to the page's corner.
  CalibrationPlate done() &&;

 private:
  CalibrationPlate plate_;
  std::vector<double> values_;
  std::vector<Ring> rings_;
};

// The star of directions, which has all of them.

/// The unit vector towards 15 k degrees.
Vec2 spoke(int k);

/// Sector k of 24 lies where the dial says 15 k degrees, and its beads run that way.
/// \param tell  whether the degrees are the values of the plate.
void layStar(PlateBuilder& plate, Vec2 centre, double inner, double outer, bool tell);

// The coupon: all of one spool on a card, and where it has what a photograph of it is read from.

inline constexpr double kCouponSide = 54;  ///< [mm]

/// One bead round and round. A spiral has every direction, so that some of it shines under any lamp.
struct CouponSpiral {
  Vec2 centre;        ///< from the lower left [mm]
  double radius = 0;  ///< [mm]
  double pitch = 0;   ///< from one turn to the next [mm]
};

/// Corner marks, counter-clockwise from the lower left: closed spirals.
std::vector<CouponSpiral> couponMarks(double nozzle);

/// Spirals whose turns lie two nozzles apart: their beads are as wide as the printer makes them.
std::vector<CouponSpiral> looseSpirals(double nozzle);

/// Disc `k` of flow, from the top.
CouponSpiral flowDisc(int k, double nozzle);

class PlateBuilder;

/// Star on the upper left, discs on the right, loose spirals and wedge below, ruler and corner marks along the edges.
void layCoupon(PlateBuilder& plate);

// Places of each kind's pieces on its plate.

/// Every kind but the swatch, whose toolpath is made as any picture's: see addSwatch.
void layOut(CalibrationKind kind, PlateBuilder& plate);

// A card that tells by its directions which filament it is, and how it was printed.

/// Fills in shape, toolpath and values. \return the errors of generateToolpath.
std::optional<Error> addSwatch(CalibrationPlate& plate, const Project& project, const RunContext& run);

}  // namespace sillon
