// Plates on the bed: their place, copies and seams.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/numbers.hpp"
#include "gcode/base_layers.hpp"
#include "gcode/job.hpp"
#include "gcode/motion.hpp"
#include "printer/bed.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// A plate turned and mirrored on its page, before it is placed on the bed.

/// Mirrors a plate left to right if asked, then turns it counter-clockwise, both about the page's middle. The new page
/// is the box around the turned one, its lower left corner at the origin again. Quarter turns are exact.
class PlateTransform {
 public:
  PlateTransform(const PrintParams& params, Vec2 page);

  [[nodiscard]] bool none() const { return none_; }
  [[nodiscard]] Vec2 apply(Vec2 p) const;
  /// Returns the point that apply() maps to p.
  [[nodiscard]] Vec2 invert(Vec2 p) const;
  [[nodiscard]] Toolpath apply(const Toolpath& toolpath) const;
  [[nodiscard]] Shape apply(const Shape& shape) const;

 private:
  bool none_;
  double mirror_;
  double cos_;
  double sin_;
  Vec2 from_;  ///< middle of the page
  Vec2 to_;    ///< middle of the turned page
};

// Placement of plates on the bed: copies, the grid of the file, and whether all of it fits.

/// Rounds a point to the grid of the file, 0.001 mm.
inline PointUm rounded(Vec2 p) { return {toWhole(p.x * 1000), toWhole(p.y * 1000)}; }
inline Vec2 mm(PointUm p) { return {static_cast<double>(p.x) / 1000, static_cast<double>(p.y) / 1000}; }

/// Position of the first page's origin on the bed. It lies on the grid of the file, so that the path keeps its own
/// rounding. \param box  around the turned shape.
PointUm placement(const Bounds& box, const Printer& printer, const PrintParams& params);

/// Offsets of all plates from the first one: row by row, every second row backwards, so that travels over finished
/// plates are short.
std::vector<PointUm> copyPlaces(const Bounds& box, const Printer& printer, const PrintParams& params);

/// Places a line of one width on the bed and merges equal neighbours.
BeadPath placed(const Polyline& line, PointUm offset, double width, bool closed);

/// Cycles on the bed, and their sums.
struct PlacedCycles {
  std::vector<BeadPath> paths;
  double lengthMm = 0;
  double heldMm = 0;    ///< length whose width is held at a limit [mm]
  double beadArea = 0;  ///< area of all beads [mm²]
};

/// Places the cycles on the bed: merges equal vertices and holds widths between the limits, except for threads across
/// gaps, which would become walls. Counts the length that was held. \return InvalidArgument if a cycle has fewer than 3
/// points.
std::optional<Error> placeCycles(const Toolpath& toolpath, PointUm offset, double nozzle, PlacedCycles& out);

/// Extends a box by beads, with half their width to every side [mm].
void addBeads(Bounds& box, const BeadPath& path);

/// Tells whether beads, with half their width to every side, lie on the bed and clear of its excluded box.
bool fits(const BeadPath& path, const Bed& bed, PointUm shift = {});

/// Checks that all copies lie on the bed. \param box  around all copies. \param outline  the shape, which the base
/// layers fill up to its border. \return DoesNotFit with the overhang of each side.
std::optional<Error> checkFit(const Bounds& box, const Shape& outline, Vec2 shift, const GcodeJob& job,
                              const Printer& printer);

/// Advice that ends the message about a plate that does not fit, such as "it fits when it is centred"; empty if there
/// is none.
std::string wayOut(const Shape& shape, const Printer& printer, const PrintParams& params);

// Seams: cycles begin at places where a seam does not show.

/// Marks the points where each cycle may begin unseen: those within a bead of the border, measured along x or y, or
/// only those near a concave corner if the cycle passes one. Sets beginsUnseen where the first point is within a bead
/// of the border. \param offset  from the shape to the cycles. \param spacing  spacing of the toolpath [mm].
void markSeams(std::vector<BeadPath>& cycles, PointUm offset, const Shape& shape, const ShapeScan& scan,
               double spacing);

// Tells whether a plate finds room on a bed, and what would help if it does not.

/// Ways to bring all copies of a plate, brims included, onto the bed. They are judged by their boxes, except for a
/// single plate on a round bed, so a shape that only fits around the excluded part or into the round of the bed is
/// missed.
struct BedFit {
  bool centred = false;  ///< the copies fit in the middle of the bed, turned as they are
  bool turned = false;   ///< the copies fit there after a quarter turn
  int percent = 100;     ///< largest whole percentage of its size that fits there, turned as it is; 0: none
};

/// Finds the ways to bring the copies onto the bed. \param params  all values within their ranges; rotate, mirror,
/// brim, copies and copyGap count.
BedFit fitBed(const Shape& shape, const Printer& printer, const PrintParams& params);

}  // namespace sillon
