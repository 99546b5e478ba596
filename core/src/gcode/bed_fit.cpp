#include "gcode/layout.hpp"

#include <algorithm>
#include <utility>

namespace sillon {
namespace {

constexpr double kSlack = 1e-6;  // [mm], covers rounding

// All plates, as one group in the middle of the bed.
struct Group {
  Vec2 plate;        // size of the box around one plate [mm]
  double reach = 0;  // radius of the shape around the middle of its box [mm]
  Vec2 copies;
  double brim = 0;  // width of the brim [mm]
  double gap = 0;   // distance between boxes, brims included [mm]
};

// Tells whether a group, its plates scaled, lies on the bed and clear of its excluded box.
bool fits(const Group& group, double scale, const Printer& printer, const Bed& bed) {
  const auto along = [&](double plate, double copies) {
    return copies * (plate * scale + 2 * group.brim) + (copies - 1) * group.gap;
  };
  const Vec2 half = 0.5 * Vec2{along(group.plate.x, group.copies.x), along(group.plate.y, group.copies.y)};
  if (printer.roundBed) {
    const bool single = group.copies.x * group.copies.y == 1;
    const double reach = single ? group.reach * scale + group.brim : length(half);
    if (reach > bed.radius() + kSlack) return false;
  } else {
    const Vec2 room = 0.5 * (printer.bedMax - printer.bedMin);
    if (half.x > room.x + kSlack || half.y > room.y + kSlack) return false;
  }
  if (!bed.hasZone()) return true;
  const Vec2 lo = bed.centre() - half;
  const Vec2 hi = bed.centre() + half;
  return lo.x >= printer.excludedMax.x || hi.x <= printer.excludedMin.x || lo.y >= printer.excludedMax.y ||
         hi.y <= printer.excludedMin.y;
}

}  // namespace

BedFit fitBed(const Shape& shape, const Printer& printer, const PrintParams& params) {
  const PlateTransform turn(params, shape.page);
  const Bed bed(printer);
  Bounds box;
  for (const FilledPath& path : shape.paths) {
    for (const Ring& ring : path.rings) {
      for (const Vec2 p : ring) box.add(turn.apply(p));
    }
  }
  if (box.empty()) return {true, true, 100};
  Group group{box.size(), 0, params.copies, params.brim * printer.nozzle, params.copyGap};
  const Vec2 middle = 0.5 * (box.min + box.max);
  for (const FilledPath& path : shape.paths) {
    for (const Ring& ring : path.rings) {
      for (const Vec2 p : ring) group.reach = std::max(group.reach, length(turn.apply(p) - middle));
    }
  }
  BedFit fit;
  fit.centred = fits(group, 1, printer, bed);
  while (fit.percent > 0 && !fits(group, fit.percent / 100.0, printer, bed)) --fit.percent;
  std::swap(group.plate.x, group.plate.y);
  fit.turned = fits(group, 1, printer, bed);
  return fit;
}

}  // namespace sillon
