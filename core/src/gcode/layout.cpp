#include "gcode/layout.hpp"

#include <algorithm>

#include "base/refused.hpp"

namespace sillon {
namespace {

constexpr double kNoBead = 0.01;  // [nozzle]; thinner beads are meant as threads across gaps
constexpr double kThread = 0.02;  // [nozzle], width of a thread; thick enough that each move carries a step of E
constexpr double kSlack = 1e-6;   // [mm], slack because widths and points are floats

// Distance from one copy to the next, per axis [mm].
Vec2 copyStep(const Bounds& box, const Printer& printer, const PrintParams& params) {
  const double around = 2 * params.brim * printer.nozzle + params.copyGap;
  return box.size() + Vec2{around, around};
}

// Overhang of one copy: the distance by which its border and its beads stick out over the bed [mm].
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

// Tells whether the border or a bead of one copy touches the excluded box of the bed.
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

std::optional<Error> placeCycles(const Toolpath& toolpath, PointUm offset, double nozzle, PlacedCycles& out) {
  const double low = kLeastBead * nozzle;
  const double high = kWidestBead * nozzle;
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
      held.push_back(!thread && (width < low - 1e-6 || width > high + 1e-6));  // slack, as widths are floats
    }
    while (path.points.size() > 1 && path.points.back() == path.points.front()) {
      path.points.pop_back();
      path.widths.pop_back();
    }
    const std::size_t count = path.points.size();
    if (count < 3) return refusedArgument("FewPoints", {{"cycle", c}, {"points", count}});
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

void addBeads(Bounds& box, const BeadPath& path) {
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const Vec2 p{static_cast<double>(path.points[i].x) / 1000, static_cast<double>(path.points[i].y) / 1000};
    const Vec2 half{path.widths[i] / 2, path.widths[i] / 2};
    box.add(p - half);
    box.add(p + half);
  }
}

bool fits(const BeadPath& path, const Bed& bed, PointUm shift) {
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const double half = path.widths[i] / 2;
    const std::size_t next = i + 1 < path.points.size() ? i + 1 : path.closed ? 0 : i;
    const Vec2 from = mm(path.points[i] + shift);
    if (bed.overhang(from, half) > kSlack || bed.crossesZone(from, mm(path.points[next] + shift), half)) return false;
  }
  return true;
}

std::optional<Error> checkFit(const Bounds& box, const Shape& outline, Vec2 shift, const GcodeJob& job,
                              const Printer& printer) {
  const Bed bed(printer);
  const std::string plate = (job.copies.size() == 1 ? "the plate of " : "the plates of ") + fixed(box.size().x, 1) +
                            " x " + fixed(box.size().y, 1) + " mm";
  const char* reach = job.copies.size() == 1 ? " reaches" : " reach";
  std::string sides;
  std::vector<NamedValue> over;
  const auto add = [&](double overhang, const char* name, const char* side) {
    if (overhang <= kSlack) return;
    over.emplace_back(name, std::max(overhang, 0.001));
    sides += (sides.empty() ? "" : ", ") + fixed(over.back().number, 3) + " mm " + side;
  };
  if (!printer.roundBed) {
    add(printer.bedMin.x - box.min.x, "left", "on the left");
    add(box.max.x - printer.bedMax.x, "right", "on the right");
    add(printer.bedMin.y - box.min.y, "front", "in front");
    add(box.max.y - printer.bedMax.y, "back", "at the back");
  }
  if (!over.empty()) {
    return Error{ErrorCode::DoesNotFit, plate + reach + " over the edge of the bed by " + sides, reason::kOverBedEdge,
                 std::move(over)};
  }
  double overhang = 0;
  for (const PointUm copy : job.copies) {
    if (printer.roundBed) overhang = std::max(overhang, overhangOf(outline, shift + mm(copy), job, copy, bed));
    if (bed.hasZone() && overhang <= kSlack && touchesZone(outline, shift + mm(copy), job, copy, bed)) {
      return refused(ErrorCode::DoesNotFit, "OnExcludedZone");
    }
  }
  if (overhang > kSlack) {
    return refused(ErrorCode::DoesNotFit, "OverRoundBed", {{"by", std::max(overhang, 0.001)}});
  }
  return std::nullopt;
}

std::string wayOut(const Shape& shape, const Printer& printer, const PrintParams& params) {
  const BedFit fit = fitBed(shape, printer, params);
  if (fit.centred && params.place) return "; it fits when it is centred";
  if (fit.turned) return "; it fits when it is turned by 90 degrees and centred";
  if (fit.percent < 1) return "";
  return "; it fits when it is scaled to " + std::to_string(std::min(fit.percent, 99)) + " % and centred";
}

}  // namespace sillon
