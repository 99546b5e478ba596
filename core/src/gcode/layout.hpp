// Plates on the bed: their place, copies and seams.
#pragma once

#include <cmath>
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

/// Mirrored left to right if asked, then turned counter-clockwise, both about the page's middle; the page becomes the
/// box around the turned one, with its lower left corner at the origin again. Quarter turns are exact.
class PlateTransform {
 public:
  PlateTransform(const PrintParams& params, Vec2 page);

  [[nodiscard]] bool none() const { return none_; }
  [[nodiscard]] Vec2 apply(Vec2 p) const;
  /// The point that apply() brings to p.
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

/// To the grid of the file.
inline PointUm rounded(Vec2 p) { return {toWhole(p.x * 1000), toWhole(p.y * 1000)}; }
inline Vec2 mm(PointUm p) { return {static_cast<double>(p.x) / 1000, static_cast<double>(p.y) / 1000}; }

/// Where the first page's origin lies on the bed, on the grid of the file, so that the path keeps its own rounding.
/// \param box  around the turned shape.
PointUm placement(const Bounds& box, const Printer& printer, const PrintParams& params);

/// Where each plate stands, from the first: row by row, every second one backwards, for short ways over what is done.
std::vector<PointUm> copyPlaces(const Bounds& box, const Printer& printer, const PrintParams& params);

/// A line of one width on the bed, equal points merged.
BeadPath placed(const Polyline& line, PointUm offset, double width, bool closed);

struct PlacedCycles {
  std::vector<BeadPath> paths;
  double lengthMm = 0;
  double heldMm = 0;    ///< with a width held at a limit
  double beadArea = 0;  ///< [mm²]
};

/// The cycles on the bed: equal vertices merged, widths held between the limits, but for threads across gaps, which
/// would become walls. Counts what was held. \return InvalidArgument if a cycle has fewer than 3 points.
std::optional<Error> placeCycles(const Toolpath& toolpath, PointUm offset, double nozzle, PlacedCycles& out);

/// Beads with half their width to every side [mm].
void addBeads(Bounds& box, const BeadPath& path);

/// Whether beads with half their width lie upon the bed and clear of its excluded box.
bool fits(const BeadPath& path, const Bed& bed, PointUm shift = {});

/// \param box  around all copies. \param outline  the shape, which the base layers fill up to its border.
/// \return DoesNotFit with the overhang of each side.
std::optional<Error> checkFit(const Bounds& box, const Shape& outline, Vec2 shift, const GcodeJob& job,
                              const Printer& printer);

/// What would bring a plate upon the bed that does not fit where it is; empty if nothing would.
std::string wayOut(const Shape& shape, const Printer& printer, const PrintParams& params);

// Seams: cycles begin at places where a seam does not show.

/// Marks where each cycle may begin unseen: within a bead of the border, seen along x or y; near a concave corner if it
/// passes one. Marks, too, where its first point is within a bead of the border. \param offset  from the shape to the
/// cycles. \param spacing  of the toolpath [mm].
void markSeams(std::vector<BeadPath>& cycles, PointUm offset, const Shape& shape, const ShapeScan& scan,
               double spacing);

// Tells whether a plate finds room on a bed, and what would help if it does not.

/// Ways to bring all copies of a plate, brims included, upon the bed, judged by their boxes: shapes that find room only
/// between the corners of a round bed or around its excluded part are not found, except single ones on a round bed.
struct BedFit {
  bool centred = false;  ///< in the middle of the bed, turned as it is
  bool turned = false;   ///< there, after a quarter turn
  int percent = 100;     ///< largest whole percentage of its size that fits there, turned as it is; 0: none
};

/// \param params  of which rotate, mirror, brim, copies and copyGap count. All values within their ranges.
BedFit fitBed(const Shape& shape, const Printer& printer, const PrintParams& params);

}  // namespace sillon
