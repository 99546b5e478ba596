#include "gcode_job.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base_layers.hpp"
#include "bed.hpp"
#include "gcode_checks.hpp"
#include "gcode_template.hpp"
#include "offset_loops.hpp"
#include "sillon/bed_fit.hpp"
#include "sillon/gcode_check.hpp"
#include "sillon/measure.hpp"
#include "text.hpp"
#include "turned.hpp"

namespace sillon {
namespace {

constexpr double kNoBead = 0.01;           // [nozzle], what is thinner is meant as a thread across a gap
constexpr double kThread = 0.02;           // [nozzle], a hair, of which each move still carries a step of E
constexpr double kMaxWidth = 1.6;          // [nozzle], wider beads do not reach their sides
constexpr double kMinFlowSpeed = 5;        // [mm/s], slower than this the hot end is the wrong one
constexpr double kOutsideTolerance = 0.1;  // [mm]
constexpr double kColdest = 170;           // [degrees Celsius]
constexpr double kEdge = 5;                // [mm] from the bed's edge to the purge line
constexpr double kPurgeLength = 60;        // [mm]
constexpr double kSlack = 1e-6;            // [mm], widths and points are floats
constexpr double kMinHatch = 0.9;          // [area of the shape]
constexpr int kMaxLoops = 1000;            // of a concentric layer
constexpr double kMinArea = 1e-6;          // [mm²], less is rounding

std::optional<Error> invalid(std::string message) { return Error{ErrorCode::InvalidArgument, std::move(message)}; }

PointUm rounded(Vec2 p) { return {std::llround(p.x * 1000), std::llround(p.y * 1000)}; }

// From one copy to the next [mm].
Vec2 copyStep(const Bounds& box, const Printer& printer, const PrintParams& params) {
  const double around = 2 * params.brim * printer.nozzle + params.copyGap;
  return box.size() + Vec2{around, around};
}

BeadPath placed(const Polyline& line, PointUm offset, double width, bool closed) {
  BeadPath path;
  path.closed = closed;
  for (const Vec2 p : line) {
    const PointUm point = rounded(p) + offset;
    if (path.points.empty() || path.points.back() != point) path.points.push_back(point);
  }
  path.widths.assign(path.points.size(), width);
  return path;
}

double lengthMm(PointUm d) { return length(Vec2{static_cast<double>(d.x), static_cast<double>(d.y)}) / 1000; }

struct PlacedCycles {
  std::vector<BeadPath> paths;
  double lengthMm = 0;
  double heldMm = 0;    // with a width held at a limit
  double beadArea = 0;  // [mm²]
};

// The cycles on the bed: equal vertices merged, widths held between the limits, but for threads across gaps, which
// would become walls. Counts what was held.
std::optional<Error> placeCycles(const Toolpath& toolpath, PointUm offset, double nozzle, PlacedCycles& out) {
  const double low = kLeastBead * nozzle;
  const double high = kMaxWidth * nozzle;
  for (std::size_t c = 0; c < toolpath.cycles.size(); ++c) {
    const Cycle& cycle = toolpath.cycles[c];
    BeadPath path;
    path.closed = true;
    path.points.reserve(cycle.points.size() + 1);
    path.widths.reserve(cycle.points.size() + 1);
    std::vector<bool> held;
    held.reserve(cycle.points.size() + 1);
    for (std::size_t i = 0; i < cycle.points.size(); ++i) {
      const PointUm point = rounded({cycle.points[i].x, cycle.points[i].y}) + offset;
      if (!path.points.empty() && path.points.back() == point) continue;
      const double width = cycle.widths[i];
      path.points.push_back(point);
      const bool thread = width > 0 && width < kNoBead * nozzle;
      path.widths.push_back(thread ? kThread * nozzle : std::clamp(width, low, high));
      held.push_back(!thread && (width < low - 1e-6 || width > high + 1e-6));  // widths are floats, limits are not
    }
    while (path.points.size() > 1 && path.points.back() == path.points.front()) {
      path.points.pop_back();
      path.widths.pop_back();
    }
    const std::size_t count = path.points.size();
    if (count < 3) {
      return invalid("cycle " + std::to_string(c) + " (from 0) has " + std::to_string(count) +
                     " different points at 0.001 mm; it must have at least 3");
    }
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t next = i + 1 < count ? i + 1 : 0;
      const double piece = lengthMm(path.points[next] - path.points[i]);
      out.lengthMm += piece;
      out.beadArea += piece * (path.widths[i] + path.widths[next]) / 2;
      out.heldMm += piece / 2 * (static_cast<int>(held[i]) + static_cast<int>(held[next]));
    }
    out.paths.push_back(std::move(path));
  }
  return std::nullopt;
}

// Beads with half their width to every side [mm].
void addBeads(Bounds& box, const BeadPath& path) {
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const Vec2 p{static_cast<double>(path.points[i].x) / 1000, static_cast<double>(path.points[i].y) / 1000};
    const Vec2 half{path.widths[i] / 2, path.widths[i] / 2};
    box.add(p - half);
    box.add(p + half);
  }
}

Vec2 mm(PointUm p) { return {static_cast<double>(p.x) / 1000, static_cast<double>(p.y) / 1000}; }

// Upon the bed and clear of its excluded box, beads with half their width.
bool fits(const BeadPath& path, const Bed& bed, PointUm shift = {}) {
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const double half = path.widths[i] / 2;
    const std::size_t next = i + 1 < path.points.size() ? i + 1 : path.closed ? 0 : i;
    const Vec2 from = mm(path.points[i] + shift);
    if (bed.overhang(from, half) > kSlack || bed.crossesZone(from, mm(path.points[next] + shift), half)) return false;
  }
  return true;
}

bool fit(const std::vector<BeadPath>& paths, const Bed& bed) {
  return std::all_of(paths.begin(), paths.end(), [&](const BeadPath& path) { return fits(path, bed); });
}

// Of one copy: how far its border and its beads stick out [mm].
double overhangOf(const Shape& outline, Vec2 place, const GcodeJob& job, PointUm copy, const Bed& bed) {
  double overhang = 0;
  for (const FilledPath& path : outline.paths) {
    for (const Ring& ring : path.rings) {
      for (const Vec2 p : ring) overhang = std::max(overhang, bed.overhang(p + place, 0));
    }
  }
  for (const auto* paths : {&job.cycles, &job.bedCycles, &job.brim}) {
    for (const BeadPath& path : *paths) {
      for (std::size_t i = 0; i < path.points.size(); ++i) {
        overhang = std::max(overhang, bed.overhang(mm(path.points[i] + copy), path.widths[i] / 2));
      }
    }
  }
  return overhang;
}

bool touchesZone(const Shape& outline, Vec2 place, const GcodeJob& job, PointUm copy, const Bed& bed) {
  for (const FilledPath& path : outline.paths) {
    for (const Ring& ring : path.rings) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        if (bed.crossesZone(ring[i] + place, ring[i + 1 < ring.size() ? i + 1 : 0] + place, 0)) return true;
      }
    }
  }
  for (const auto* paths : {&job.cycles, &job.bedCycles, &job.brim}) {
    for (const BeadPath& path : *paths) {
      if (!fits(path, bed, copy)) return true;
    }
  }
  return false;
}

/// \param box  around all copies. \param outline  the shape, which the base layers fill up to its border.
std::optional<Error> checkFit(const Bounds& box, const Shape& outline, Vec2 shift, const GcodeJob& job,
                              const Printer& printer) {
  const Bed bed(printer);
  const std::string plate = (job.copies.size() == 1 ? "the plate of " : "the plates of ") + fixed(box.size().x, 1) +
                            " x " + fixed(box.size().y, 1) + " mm";
  const char* reach = job.copies.size() == 1 ? " reaches" : " reach";
  std::string sides;
  const auto add = [&](double overhang, const char* side) {
    if (overhang <= kSlack) return;
    sides += (sides.empty() ? "" : ", ") + fixed(std::max(overhang, 0.001), 3) + " mm " + side;
  };
  if (!printer.roundBed) {
    add(printer.bedMin.x - box.min.x, "on the left");
    add(box.max.x - printer.bedMax.x, "on the right");
    add(printer.bedMin.y - box.min.y, "in front");
    add(box.max.y - printer.bedMax.y, "at the back");
  }
  if (!sides.empty()) {
    return Error{ErrorCode::DoesNotFit, plate + reach + " over the edge of the bed by " + sides};
  }
  double overhang = 0;
  for (const PointUm copy : job.copies) {
    if (printer.roundBed) overhang = std::max(overhang, overhangOf(outline, shift + mm(copy), job, copy, bed));
    if (bed.hasZone() && overhang <= kSlack && touchesZone(outline, shift + mm(copy), job, copy, bed)) {
      return Error{ErrorCode::DoesNotFit, plate + " touches the excluded part of the bed; place it elsewhere"};
    }
  }
  if (overhang > kSlack) {
    return Error{ErrorCode::DoesNotFit,
                 plate + reach + " over the edge of the round bed by " + fixed(std::max(overhang, 0.001), 3) + " mm"};
  }
  return std::nullopt;
}

// What would bring a plate upon the bed that does not fit where it is.
std::string wayOut(const Shape& shape, const Printer& printer, const PrintParams& params) {
  const BedFit fit = fitBed(shape, printer, params);
  if (fit.centred && params.place) return "; it fits when it is centred";
  if (fit.turned) return "; it fits when it is turned by 90 degrees and centred";
  if (fit.percent < 1) return "";
  return "; it fits when it is scaled to " + std::to_string(std::min(fit.percent, 99)) + " % and centred";
}

// The hot end must melt the widest bead at a speed worth printing.
std::optional<Error> checkFlow(const GcodeJob& job, const Printer& printer, const PrintParams& params) {
  double widest = 0;
  for (const BeadPath& path : job.cycles) {
    for (const double width : path.widths) widest = std::max(widest, width);
  }
  const double height = std::max(params.layerHeight, firstLayerHeight(params));
  double area = params.flow * height * widest;
  if (params.base > 0 || params.skirt > 0) area = std::max(area, params.baseFlow * height * printer.nozzle);
  if (printer.maxFlow >= kMinFlowSpeed * area) return std::nullopt;
  return invalid("maxFlow is " + decimal(printer.maxFlow, 3) + " mm3/s; beads of " + decimal(area, 4) +
                 " mm2 need at least " + decimal(kMinFlowSpeed * area, 3) + " to print at 5 mm/s");
}

// The shape along horizontal lines, fine enough to measure its area and to tell what lies outside.
struct Scan {
  std::vector<std::vector<Interval>> rows;
  double firstY = 0;
  double step = 0;
  double area = 0;
};

Scan scan(const Shape& shape, const Bounds& box) {
  Scan result;
  const int count = std::clamp(static_cast<int>(box.size().y / 0.05), 1, 4000);
  result.step = box.size().y / count;
  result.firstY = box.min.y + result.step / 2;
  if (!(result.step > 0)) return result;
  result.rows = insideIntervals(shape, result.firstY, result.step, count);
  for (const std::vector<Interval>& row : result.rows) {
    for (const Interval& piece : row) result.area += (piece.end - piece.begin) * result.step;
  }
  return result;
}

bool rowHolds(const std::vector<Interval>& row, double x) {
  const auto after = std::upper_bound(row.begin(), row.end(), x + kOutsideTolerance,
                                      [](double value, const Interval& piece) { return value < piece.begin; });
  return after != row.begin() && std::prev(after)->end >= x - kOutsideTolerance;
}

std::int64_t countOutside(const Toolpath& toolpath, const Scan& scan) {
  const auto last = static_cast<double>(scan.rows.size()) - 1;
  const auto holds = [&](double row, double x) {
    return row >= 0 && row <= last && rowHolds(scan.rows[static_cast<std::size_t>(row)], x);
  };
  std::int64_t outside = 0;
  for (const Cycle& cycle : toolpath.cycles) {
    for (const Vec2f p : cycle.points) {
      const double at = (static_cast<double>(p.y) - scan.firstY) / scan.step;
      const double reach = kOutsideTolerance / scan.step;
      bool found = holds(std::floor(at), p.x);  // nearly always
      for (double row = std::floor(at - reach); !found && row <= std::ceil(at + reach); ++row) found = holds(row, p.x);
      if (!found) ++outside;
    }
  }
  return outside;
}

bool holds(const Scan& scan, Vec2 p) {
  const double row = std::floor((p.y - scan.firstY) / scan.step + 0.5);
  return row >= 0 && row <= static_cast<double>(scan.rows.size()) - 1 &&
         rowHolds(scan.rows[static_cast<std::size_t>(row)], p.x);
}

// Corners that the shape lies around, where a seam hides best: between the two sides, a little way off, is nothing.
// None where there are very many: no seam shows among them.
std::vector<Vec2> concaveCorners(const Shape& shape, const Scan& scan) {
  constexpr double kAway = 0.5;  // [mm]
  constexpr std::size_t kMost = 100;
  constexpr double kStraight = -0.94;  // cosine between the sides; blunter corners hide nothing
  std::vector<Vec2> corners;
  for (const FilledPath& path : shape.paths) {
    for (const Ring& ring : path.rings) {
      for (std::size_t i = 0; i < ring.size() && ring.size() > 2; ++i) {
        const Vec2 before = ring[i > 0 ? i - 1 : ring.size() - 1] - ring[i];
        const Vec2 after = ring[i + 1 < ring.size() ? i + 1 : 0] - ring[i];
        const double sides = length(before) * length(after);
        if (!(sides > 0) || dot(before, after) < kStraight * sides) continue;
        const Vec2 between = 1 / length(before) * before + 1 / length(after) * after;
        const double span = length(between);
        if (span > 0 && !holds(scan, ring[i] + kAway / span * between)) corners.push_back(ring[i]);
      }
    }
  }
  if (corners.size() > kMost) corners.clear();
  return corners;
}

// Where a cycle may begin unseen: within a bead of the border, seen along x or y; near a concave corner if it passes
// one.
void markSeams(std::vector<BeadPath>& cycles, PointUm offset, const Shape& shape, const Scan& scan, double spacing) {
  const double reach = spacing + kOutsideTolerance;
  const std::vector<Vec2> corners = concaveCorners(shape, scan);
  for (BeadPath& path : cycles) {
    std::vector<std::uint32_t> hidden;
    for (std::size_t i = 0; i < path.points.size(); ++i) {
      const Vec2 p = mm(path.points[i] - offset);
      if (holds(scan, p + Vec2{reach, 0}) && holds(scan, p - Vec2{reach, 0}) && holds(scan, p + Vec2{0, reach}) &&
          holds(scan, p - Vec2{0, reach})) {
        continue;
      }
      path.seams.push_back(static_cast<std::uint32_t>(i));
      const auto near = [&](Vec2 corner) { return length(corner - p) <= 2 * reach; };
      if (std::any_of(corners.begin(), corners.end(), near)) hidden.push_back(static_cast<std::uint32_t>(i));
    }
    if (!hidden.empty()) path.seams = std::move(hidden);
  }
}

// A straight line near an edge of the bed, if the plate leaves room there: nothing else would prime the nozzle.
void addPurgeLine(GcodeJob& job, const Bounds& box, const Printer& printer) {
  const Bed bed(printer);
  const double width = printer.nozzle;
  const double gap = width / 2 + 2;
  Vec2 corner = printer.bedMin + Vec2{kEdge, kEdge};
  Vec2 room = printer.bedMax - printer.bedMin - Vec2{2 * kEdge, 2 * kEdge};
  if (printer.roundBed) {  // chords half a radius long, near the edge
    corner = bed.centre() - Vec2{0.9 * bed.radius(), 0.9 * bed.radius()};
    room = {0.5 * bed.radius(), 0.5 * bed.radius()};
  }
  const double alongX = std::min(kPurgeLength, room.x);
  const double alongY = std::min(kPurgeLength, room.y);
  const Vec2 front = printer.roundBed ? Vec2{bed.centre().x - alongX / 2, corner.y} : corner;
  const Vec2 left = printer.roundBed ? Vec2{corner.x, bed.centre().y - alongY / 2} : corner;
  struct Line {
    Vec2 begin;
    Vec2 end;
    bool clear;
  };
  const bool clearFront = box.min.y > corner.y + gap && alongX >= 10;
  const bool clearLeft = box.min.x > corner.x + gap && alongY >= 10;
  const Vec2 beyond = printer.excludedMax + Vec2{kEdge, kEdge};
  const Line lines[] = {{front, front + Vec2{alongX, 0}, clearFront},
                        {{beyond.x, front.y}, {beyond.x + alongX, front.y}, clearFront && bed.hasZone()},
                        {left, left + Vec2{0, alongY}, clearLeft},
                        {{left.x, beyond.y}, {left.x, beyond.y + alongY}, clearLeft && bed.hasZone()}};
  for (const Line& line : lines) {
    BeadPath path = placed({line.begin, line.end}, {}, width, false);
    if (!line.clear || !fits(path, bed)) continue;
    job.skirt.push_back(std::move(path));
    return;
  }
  job.warnings.emplace_back(
      "the plate leaves no room for a purge line; the nozzle is not primed before the first bead");
}

void addSkirt(GcodeJob& job, const Bounds& box, const Printer& printer, int loops) {
  for (const Polyline& loop : skirtLoops(box, printer.nozzle, loops)) {
    job.skirt.push_back(placed(loop, {}, printer.nozzle, true));
  }
  if (!fit(job.skirt, Bed(printer))) {
    job.skirt.clear();
    job.warnings.emplace_back("the skirt does not fit the bed and was left out");
  }
  if (job.skirt.empty()) addPurgeLine(job, box, printer);
}

// Nothing goes down to the bed where a print stands: no skirt, no purge line. Homing does, and is not ours to change.
void warnAbovePrint(GcodeJob& job, const Printer& printer, double height) {
  job.warnings.push_back(
      "a print of " + decimal(height, 3) +
      " mm stands on the bed while the start block homes; G28 and G29 must not come down on it on this printer");
  if (printer.startGcode.empty()) {
    job.warnings.emplace_back("nothing is printed beside a print that stands on the bed; the nozzle is not primed");
  }
}

struct BasePaths {
  std::vector<BeadPath> paths;
  double areaMm2 = 0;
};

Result<BasePaths> basePaths(const Shape& shape, PointUm offset, const Printer& printer, BasePattern pattern, int turn,
                            double inset) {
  const double width = printer.nozzle;
  const bool closed = pattern == BasePattern::Concentric;
  std::vector<Polyline> lines;
  if (closed) {
    Result<std::vector<Polyline>> loops = offsetLoops(shape, -inset - width / 2, -width, kMaxLoops);
    if (!loops) return loops.error();
    lines = std::move(loops).value();
  } else {
    lines = hatchLines(shape, width, turn % 2 == 1, inset);
  }
  BasePaths result;
  for (const Polyline& line : lines) {
    BeadPath path = placed(line, offset, width, closed);
    if (path.points.size() < (closed ? 3U : 2U)) continue;
    for (std::size_t i = 0; i + (closed ? 0 : 1) < path.points.size(); ++i) {
      const std::size_t next = i + 1 < path.points.size() ? i + 1 : 0;
      result.areaMm2 += width * lengthMm(path.points[next] - path.points[i]);
    }
    result.paths.push_back(std::move(path));
  }
  return result;
}

// A base layer that is missing somewhere leaves the layers above it hanging in the air there.
std::optional<Error> addBaseLayers(GcodeJob& job, const Shape& shape, double area, PointUm offset,
                                   const Printer& printer, const PrintParams& params) {
  if (params.base == 0 || params.basePattern == BasePattern::Same) return std::nullopt;
  double least = 1;
  const auto turns = std::min<std::size_t>(job.bases.size(), static_cast<std::size_t>(params.base));
  for (std::size_t k = 0; k < turns; ++k) {
    if (k == 1 && params.basePattern == BasePattern::Concentric) {
      job.bases[1] = job.bases[0];
      break;
    }
    Result<BasePaths> base = basePaths(shape, offset, printer, params.basePattern, static_cast<int>(k), 0);
    if (!base) return base.error();
    least = std::min(least, base.value().areaMm2 / area);
    job.bases[k] = std::move(base).value().paths;
  }
  if (least <= 0) {
    return invalid("base is " + std::to_string(params.base) + ", but the shape is too thin for lines of " +
                   decimal(printer.nozzle, 3) + " mm; it must be 0 here");
  }
  if (least < kMinHatch) {
    job.warnings.push_back("the base layers cover only " + fixed(100 * least, 0) +
                           " % of the shape; what is thinner than their lines has nothing below it");
  }
  if (params.elephantFoot > 0 && params.showSide == ShowSide::Up && beginsOnBed(params)) {
    Result<BasePaths> first = basePaths(shape, offset, printer, params.basePattern, 0, params.elephantFoot);
    if (!first) return first.error();
    job.firstBase = std::move(first).value().paths;
  }
  return std::nullopt;
}

// Loops around the outside of the plate, the outermost first; holes stay free.
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

// Seen from below, a plate is its mirror image; only shapes that are their own can show the same on both sides.
std::optional<Error> addBedCycles(GcodeJob& job, const Toolpath& given, const Shape& givenShape, const Turn& turn,
                                  const Scan& inside, PointUm offset, const Printer& printer) {
  const Bounds box = bounds(givenShape);
  const double sum = box.min.x + box.max.x;
  Toolpath flipped = given;
  for (Cycle& cycle : flipped.cycles) {
    for (Vec2f& p : cycle.points) p.x = static_cast<float>(sum - static_cast<double>(p.x));
  }
  const Toolpath toolpath = turn.none() ? flipped : turn.apply(flipped);
  if (const std::int64_t outside = countOutside(toolpath, inside); outside > 0) {
    return invalid("showSide is both, but the shape is not its own mirror image: " + std::to_string(outside) +
                   " points of the path would lie outside; it must be up or bed here");
  }
  PlacedCycles placedCycles;
  if (auto error = placeCycles(toolpath, offset, printer.nozzle, placedCycles)) return error;
  job.bedCycles = std::move(placedCycles.paths);
  return std::nullopt;
}

void addWarnings(GcodeJob& job, const Printer& printer, const PrintParams& params) {
  const double d = printer.filamentDiameter;
  if (std::abs(d - 1.75) > 0.1 && std::abs(d - 2.85) > 0.15) {
    job.warnings.push_back("filamentDiameter is " + decimal(d, 3) + " mm; filament is sold with 1.75 and 2.85");
  }
  if (params.layerHeight < 0.2 * printer.nozzle) {
    job.warnings.push_back("layerHeight is " + decimal(params.layerHeight, 3) + " mm; below 0.2 nozzle layers tear");
  }
  const auto unusualFlow = [&](const char* name, double flow) {
    if (flow >= 0.8 && flow <= 1.1) return;
    job.warnings.push_back(std::string(name) + " is " + decimal(flow, 3) + "; usual are 0.8 to 1.1");
  };
  unusualFlow("flow", params.flow);
  unusualFlow("baseFlow", params.baseFlow);
  std::int64_t flat = 0;
  for (const BeadPath& path : job.cycles) {
    flat += std::count_if(path.widths.begin(), path.widths.end(), [&](double w) {
      return w <= params.layerHeight && w >= kLeastBead * printer.nozzle - 1e-6;  // threads are no beads
    });
  }
  if (flat > 0) {
    job.warnings.push_back(std::to_string(flat) + " points have beads no wider than the layer is high (" +
                           decimal(params.layerHeight, 3) + " mm)");
  }
  if (job.fillRatio < 0.97 || job.fillRatio > 1.05) {
    job.warnings.push_back("the beads cover " + fixed(100 * job.fillRatio, 1) +
                           " % of the shape's area; 97 to 105 print well");
  }
  if (params.mirror && params.showSide == ShowSide::Up) {
    job.warnings.emplace_back("the plate is mirrored but shown from above; writing on it reads backwards");
  }
  if (printer.setPressureAdvance) {
    job.warnings.emplace_back(
        "pressure advance is 0 after the print, until the printer restarts or another file sets it");
  }
}

// \param height  of what stands on the bed while the block runs [mm].
void warnLow(GcodeJob& job, const char* block, const GcodeCheck& check, double height) {
  if (check.lowest >= height) return;
  job.warnings.push_back(std::string(block) + " moves along the bed at Z " + decimal(check.lowest, 3) +
                         "; what stands there is " + decimal(height, 3) + " mm high");
}

// Of a block that may be printed with all the same.
bool isWorthALook(const GcodeFinding& finding) {
  return finding.rule == "bounds" || finding.rule == "settings" || finding.rule == "modes";
}

// A start block that leaves out homing or heating prints cold or beside the bed, and nobody is there to stop it.
std::optional<Error> checkStart(const std::string& block, const Printer& printer, const PrintParams& params,
                                GcodeJob& job) {
  // Makers of Bambu machines wipe far off the bed, in code that is theirs.
  const bool trusted = printer.flavor == GcodeFlavor::Bambu;
  const GcodeCheck check = checkGcode(block, printer);
  if (!check.homes) return invalid("startGcode does not home; it must have G28 or a start macro");
  if (!check.heatsNozzle) {
    return invalid(
        "startGcode does not wait for a hot nozzle; it must have M109 or a start macro with its temperature");
  }
  if (!check.heatsBed && printer.bedTemperature > 0) {
    return invalid("startGcode does not wait for a hot bed; it must have M190 or a start macro with its temperature");
  }
  if (check.nozzleTarget < kColdest) {
    return invalid("startGcode leaves the nozzle at " + decimal(check.nozzleTarget, 0) +
                   " degrees; it must leave it at 170 or more");
  }
  if (std::abs(check.nozzleTarget - printer.firstLayerNozzleTemperature) > 20) {
    job.warnings.push_back("startGcode leaves the nozzle at " + decimal(check.nozzleTarget, 0) +
                           " degrees; the first layer is meant for " + decimal(printer.firstLayerNozzleTemperature, 0));
  }
  warnLow(job, "startGcode", check, params.startHeight);
  for (const GcodeFinding& finding : check.findings) {
    if (finding.line == 0) continue;  // of whole files
    const std::string place = "line " + std::to_string(finding.line) + " of startGcode: " + finding.message;
    if (finding.error && !trusted) return invalid(place);
    if (isWorthALook(finding)) job.warnings.push_back(place);
  }
  return std::nullopt;
}

// The end block begins above the middle of the last plate, or near it; what it reaches from there must be bed too.
std::optional<Error> checkEnd(const std::string& block, Vec2 from, double height, const Printer& printer,
                              GcodeJob& job) {
  const std::string before = "G28\nM190 S60\nM109 S200\nG1 X" + fixed(from.x, 3) + " Y" + fixed(from.y, 3) + " Z" +
                             fixed(height, 3) + " F300\nG91\nG1 X0.1 E0.0002\nG90\nG92 E0\n" +
                             (printer.absoluteE ? "M82\n" : "M83\n");
  const auto lines = std::count(before.begin(), before.end(), '\n');
  bool hot = false;
  for (const GcodeFinding& finding : checkGcode(before + block, printer).findings) {
    hot = hot || finding.rule == "end";
    if (finding.line <= lines) continue;
    const std::string place = "line " + std::to_string(finding.line - lines) + " of endGcode: " + finding.message;
    const bool fault = finding.error && (finding.rule == "bounds" || finding.rule == "grammar");
    if (fault && printer.flavor != GcodeFlavor::Bambu) return invalid(place);
    if (finding.error || isWorthALook(finding)) job.warnings.push_back(place);
  }
  if (hot) job.warnings.emplace_back("endGcode leaves the nozzle or the bed hot; M104 S0 and M140 S0 turn them off");
  return std::nullopt;
}

/// \param beads  box around all plates; the skirt is added here. \param last  middle of the last plate.
std::optional<Error> addBlocks(GcodeJob& job, Bounds beads, Vec2 last, const Printer& printer,
                               const PrintParams& params) {
  if (printer.flavor == GcodeFlavor::Bambu && printer.startGcode.empty()) {
    return invalid(
        "startGcode is empty; Bambu printers need the start block of a file that their own slicer made, "
        "which can be imported");
  }
  for (const BeadPath& path : job.skirt) addBeads(beads, path);
  const std::vector<TemplateValue> values = templateValues(printer, params, beads);
  Result<std::string> start = expandTemplate(printer.startGcode, values, "startGcode");
  if (!start) return start.error();
  Result<std::string> end = expandTemplate(printer.endGcode, values, "endGcode");
  if (!end) return end.error();
  if (!printer.startGcode.empty()) {
    if (auto error = checkStart(start.value(), printer, params, job)) return error;
  }
  warnLow(job, "endGcode", checkGcode(end.value(), printer), layerTop(params, layerCount(params) - 1));
  if (!printer.endGcode.empty()) {
    const double top = layerTop(params, layerCount(params) - 1) + printer.lift + kParkLift;
    if (auto error = checkEnd(end.value(), last, std::min(top, printer.maxZ), printer, job)) return error;
  }
  job.startBlock = std::move(start).value();
  job.endBlock = std::move(end).value();
  return std::nullopt;
}

}  // namespace

PointUm placement(const Bounds& box, const Printer& printer, const PrintParams& params) {
  if (params.place) return rounded(*params.place);
  const Vec2 step = copyStep(box, printer, params);
  const Vec2 others{(params.copies.x - 1) * step.x, (params.copies.y - 1) * step.y};
  return rounded(0.5 * (printer.bedMin + printer.bedMax) - 0.5 * (box.min + box.max) - 0.5 * others);
}

std::vector<PointUm> copyPlaces(const Bounds& box, const Printer& printer, const PrintParams& params) {
  const Vec2 step = copyStep(box, printer, params);
  const int columns = static_cast<int>(params.copies.x);
  std::vector<PointUm> places;
  for (int row = 0; row < static_cast<int>(params.copies.y); ++row) {
    for (int k = 0; k < columns; ++k) {
      const int column = row % 2 == 0 ? k : columns - 1 - k;
      places.push_back(rounded({column * step.x, row * step.y}));
    }
  }
  return places;
}

Result<GcodeJob> prepareGcodeJob(const Toolpath& given, const Shape& givenShape, const Printer& printer,
                                 const PrintParams& params) {
  if (auto error = checkGcodeInput(given, givenShape, printer, params)) return *error;
  PrintParams turning = params;
  if (params.showSide == ShowSide::Bed) turning.mirror = !params.mirror;
  const Turn turn(turning, givenShape.page);
  const Toolpath& toolpath = turn.none() ? given : turn.apply(given);
  const Shape& shape = turn.none() ? givenShape : turn.apply(givenShape);
  const Bounds shapeBox = bounds(shape);
  if (shapeBox.empty()) return Error{ErrorCode::EmptyShape, "the shape has no points; there is nothing to print"};

  GcodeJob job;
  job.spacing = toolpath.spacing;
  job.plate = shapeBox.size();
  const PointUm offset = placement(shapeBox, printer, params);
  job.copies = copyPlaces(shapeBox, printer, params);
  PlacedCycles cycles;
  if (auto error = placeCycles(toolpath, offset, printer.nozzle, cycles)) return *error;
  job.cycles = std::move(cycles.paths);
  job.clampedMm = cycles.heldMm;
  if (cycles.heldMm > 0.01 * cycles.lengthMm) {
    job.warnings.push_back(fixed(100 * cycles.heldMm / cycles.lengthMm, 1) +
                           " % of the path is printed with a width held at " + decimal(kLeastBead * printer.nozzle, 3) +
                           " or " + decimal(kMaxWidth * printer.nozzle, 3) + " mm (0.6 and 1.6 nozzle)");
  }
  if (auto error = checkFlow(job, printer, params)) return *error;
  const Scan inside = scan(shape, shapeBox);
  if (!(inside.area > kMinArea))
    return Error{ErrorCode::EmptyShape, "the shape has no area; there is nothing to print"};
  if (params.showSide == ShowSide::Both) {
    if (auto error = addBedCycles(job, given, givenShape, turn, inside, offset, printer)) return *error;
  }
  if (auto error = addBrim(job, shape, offset, printer, params)) return *error;

  Bounds box{shapeBox.min + mm(offset), shapeBox.max + mm(offset)};
  for (const auto* paths : {&job.cycles, &job.bedCycles, &job.brim}) {
    for (const BeadPath& path : *paths) addBeads(box, path);
  }
  const Bounds first = box;
  for (const PointUm copy : job.copies) {
    box.add(first.min + mm(copy));
    box.add(first.max + mm(copy));
  }
  if (auto error = checkFit(box, shape, mm(offset), job, printer)) {
    error->message += wayOut(givenShape, printer, params);
    return *error;
  }

  job.fillRatio = cycles.beadArea / inside.area;
  if (const std::int64_t outside = countOutside(toolpath, inside); outside > 0) {
    const std::string what = std::to_string(outside) + " points of the path lie more than 0.1 mm outside the shape";
    if (params.strict) return *invalid(what + "; strict refuses that");
    job.warnings.push_back(what);
  }
  if (params.strict) {
    if (const std::int64_t crossings = countCrossings(toolpath); crossings > 0) {
      return *invalid("the path crosses itself " + std::to_string(crossings) + (crossings == 1 ? " time" : " times") +
                      "; strict refuses that");
    }
  }
  markSeams(job.cycles, offset, shape, inside, job.spacing);
  markSeams(job.bedCycles, offset, shape, inside, job.spacing);
  if (auto error = addBaseLayers(job, shape, inside.area, offset, printer, params)) return *error;
  if (beginsOnBed(params)) {
    addSkirt(job, box, printer, params.skirt);
  } else {
    warnAbovePrint(job, printer, params.startHeight);
  }
  const Vec2 last = 0.5 * (first.min + first.max) + mm(job.copies.back());
  if (auto error = addBlocks(job, box, last, printer, params)) return *error;
  addWarnings(job, printer, params);
  return job;
}

}  // namespace sillon
