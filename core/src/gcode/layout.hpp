// Where plates lie on the bed: placement, copies, the grid of the file, and whether all of it fits.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "base/whole_number.hpp"
#include "gcode/hatch.hpp"
#include "gcode/job.hpp"
#include "printer/bed.hpp"
#include "sillon/base/result.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

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

}  // namespace sillon
