#include "gcode/base_layers.hpp"

#include <algorithm>
#include <cmath>

#include "gcode/layout.hpp"

namespace sillon {
namespace {

constexpr double kEdge = 5;           // [mm] between the bed's edge and the purge line
constexpr double kNarrowEdge = 1;     // [mm], the same if kEdge leaves no room
constexpr double kClear = 2;          // [mm] between the purge line and the plates
constexpr double kPurgeSection = 2;   // [nozzle²], section of the purge line; Klipper allows up to 4
constexpr double kLongestPass = 100;  // [mm], longest pass of the purge line
constexpr double kShortestPass = 8;   // [mm], shortest pass of the purge line
constexpr double kSkirtDistance = 5;  // [mm] between skirt and beads

// Tells whether all paths lie on the bed.
bool fit(const std::vector<BeadPath>& paths, const Bed& bed) {
  return std::all_of(paths.begin(), paths.end(), [&](const BeadPath& path) { return fits(path, bed); });
}

// Lays passes side by side, out along `along` and back.
BeadPath serpentine(Vec2 corner, Vec2 along, Vec2 across, double pass, int passes, double width) {
  Polyline line;
  for (int k = 0; k < passes; ++k) {
    const Vec2 begin = corner + k * width * across;
    const Vec2 end = begin + pass * along;
    line.push_back(k % 2 == 0 ? begin : end);
    line.push_back(k % 2 == 0 ? end : begin);
  }
  return placed(line, {}, width, false);
}

// Finds a purge line near an edge of the bed, clear of the box by 2 mm; no points if there is no room.
BeadPath purgePath(const Bounds& box, const Printer& printer, double width, double wanted) {
  const Bed bed(printer);
  const Vec2 lo = printer.bedMin;
  const Vec2 hi = printer.bedMax;
  for (const double edge : {kEdge, kNarrowEdge}) {
    const double inset = edge + width / 2;
    struct PageSide {
      Vec2 corner, along, across;
      double room;
    };
    std::vector<PageSide> sides;
    const auto add = [&](Vec2 corner, Vec2 along, Vec2 across, double room) {
      sides.push_back({corner, along, across, room});
      const Vec2 zone = printer.excludedMax - printer.excludedMin;  // the excluded box; there may be room behind it
      const double past = dot(printer.excludedMax - corner, along) + inset;
      if (bed.hasZone() && dot(zone, along) > 0 && past > 0) {
        sides.push_back({corner + past * along, along, across, room - past});
      }
    };
    if (printer.roundBed) {
      const double half = 0.25 * bed.radius();  // half of a chord, which is half a radius long
      const double off = 0.97 * bed.radius() - edge - width;
      const Vec2 c = bed.centre();
      add(c + Vec2{-half, -off}, {1, 0}, {0, 1}, 2 * half);
      add(c + Vec2{-off, -half}, {0, 1}, {1, 0}, 2 * half);
      add(c + Vec2{-half, off}, {1, 0}, {0, -1}, 2 * half);
      add(c + Vec2{off, -half}, {0, 1}, {-1, 0}, 2 * half);
    } else {
      const Vec2 room = hi - lo - Vec2{2 * inset, 2 * inset};
      add(lo + Vec2{inset, inset}, {1, 0}, {0, 1}, room.x);
      add(lo + Vec2{inset, inset}, {0, 1}, {1, 0}, room.y);
      add({lo.x + inset, hi.y - inset}, {1, 0}, {0, -1}, room.x);
      add({hi.x - inset, lo.y + inset}, {0, 1}, {-1, 0}, room.y);
    }
    for (const PageSide& side : sides) {
      const double pass = std::min({side.room, kLongestPass, wanted});
      if (pass < kShortestPass) continue;
      const int passes = static_cast<int>(std::ceil(wanted / pass - 1e-9));
      BeadPath path = serpentine(side.corner, side.along, side.across, wanted / passes, passes, width);
      if (!fits(path, bed)) continue;
      Bounds around;
      addBeads(around, path);
      const bool clear = around.max.x + kClear < box.min.x || around.min.x - kClear > box.max.x ||
                         around.max.y + kClear < box.min.y || around.min.y - kClear > box.max.y;
      if (clear) return path;
    }
  }
  return {};
}

}  // namespace

std::vector<Polyline> skirtLoops(const Bounds& box, double lineWidth, int loops) {
  std::vector<Polyline> result;
  for (int k = loops - 1; k >= 0; --k) {
    const double d = kSkirtDistance + k * lineWidth;
    const Vec2 lo = box.min - Vec2{d, d};
    const Vec2 hi = box.max + Vec2{d, d};
    result.push_back({lo, {hi.x, lo.y}, hi, {lo.x, hi.y}});
  }
  return result;
}

void addSkirt(GcodeJob& job, const Bounds& box, const Printer& printer, int loops) {
  for (const Polyline& loop : skirtLoops(box, printer.nozzle, loops)) {
    job.skirt.push_back(placed(loop, {}, printer.nozzle, true));
  }
  if (fit(job.skirt, Bed(printer))) return;
  job.skirt.clear();
  job.warn(WarningCode::SkirtLeftOut);
}

void addPurge(GcodeJob& job, const Bounds& box, const Printer& printer, const PrintParams& params) {
  // The bead is flat, and as wide as its section makes it at that height.
  job.purgeHeight = std::max(firstLayerHeight(params), 0.6 * printer.nozzle);
  const double section = kPurgeSection * printer.nozzle * printer.nozzle;
  const double width = section / job.purgeHeight;
  if (params.purgeLength <= 0) return;
  const double pushed = (params.purgeLength + printer.retractLength) * filamentArea(printer.filamentDiameter);  // [mm³]
  const double length = pushed / (section * printer.filamentFlow);
  Bounds all = box;
  for (const BeadPath& path : job.skirt) addBeads(all, path);
  job.purge = purgePath(all, printer, width, length);
  if (job.purge.points.empty() && !job.skirt.empty()) {
    job.purge = purgePath(box, printer, width, length);
    if (!job.purge.points.empty()) {  // a skirt extrudes too little to fill an empty nozzle
      job.skirt.clear();
      job.warn(WarningCode::SkirtLeftOut);
    }
  }
  if (job.purge.points.empty()) job.warn(WarningCode::NotPrimed);
}

std::optional<Error> addBrim(GcodeJob& job, const Shape& shape, PointUm offset, const Printer& printer,
                             const PrintParams& params) {
  if (params.brim == 0 || !beginsOnBed(params)) return std::nullopt;
  const double inset = params.base > 0 && params.showSide == ShowSide::Up ? params.elephantFoot : 0;
  const Result<std::vector<Polyline>> loops =
      offsetLoops(shape, printer.nozzle / 2 - inset, printer.nozzle, params.brim);
  if (!loops) return loops.error();
  for (const Polyline& loop : loops.value()) {
    double area = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) area += cross(loop[i], loop[i + 1 < loop.size() ? i + 1 : 0]);
    if (area < 0) job.brim.push_back(placed(loop, offset, printer.nozzle, true));
  }
  std::reverse(job.brim.begin(), job.brim.end());
  return std::nullopt;
}

}  // namespace sillon
