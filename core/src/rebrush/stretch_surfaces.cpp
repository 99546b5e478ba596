#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/sort_key.hpp"
#include "rebrush/stretches.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {
namespace {

constexpr double kThreeBeads = 3;        // [spacings] least breadth: narrower surfaces are left
constexpr double kTenSquares = 10;       // [spacings²] least area: smaller surfaces are left
constexpr double kNotch = 0.3;           // [spacings] radius of notches between the ends of beads: narrower than walls
constexpr double kLooseFilament = 0.02;  // [mm] filament that retractions inside a block may gain or lose
constexpr double kFullFlow = 0.01;       // deviation of flow from 1 up to which it counts as 1
constexpr double kMostFlow = 0.25;       // largest deviation of a slicer's flow from 1: beyond it, 1 is assumed
constexpr double kJoined = 0.01;         // [mm] largest gap between the end of a bead and the beginning of the next
constexpr double kFlatEnds = 0.01;       // least empty share of a region at which flat ends of beads are tried
constexpr double kRoundSides = 1 - std::numbers::pi / 4;  // [height] excess of a bead's width over section / height

// Weighted median.
double median(std::vector<std::pair<double, double>> valueAndWeight) {
  std::sort(valueAndWeight.begin(), valueAndWeight.end());
  double all = 0;
  for (const auto& entry : valueAndWeight) all += entry.second;
  double sum = 0;
  for (const auto& [value, weight] : valueAndWeight) {
    sum += weight;
    if (2 * sum >= all) return value;
  }
  return 0;
}

// Median distance between neighbouring straight beads [mm]; 0 if there are too few of them.
double neighbourDistance(const std::vector<StretchLine>& lines) {
  constexpr double kLong = 2;         // [mm] least length of a bead
  constexpr double kParallel = 0.02;  // sine of the largest angle between neighbours
  constexpr std::size_t kEnough = 8;  // least number of pairs
  std::vector<std::pair<double, double>> distances;
  const MachineMove* last = nullptr;
  for (const StretchLine& line : lines) {
    if (!line.bead() || line.move->arc || line.move->length < kLong) continue;
    const Vec2 d = 1 / line.move->length * (line.move->to - line.move->from);
    if (last != nullptr && std::abs(cross(d, last->to - last->from)) < kParallel * last->length) {
      distances.emplace_back(std::abs(cross(d, last->from - line.move->from)), 1.0);
    }
    last = &*line.move;
  }
  return distances.size() < kEnough ? 0 : median(std::move(distances));
}

bool joined(Vec2 a, Vec2 b) { return length(a - b) < kJoined; }

// Tells whether most beads are followed by a way without plastic.
bool areSeparate(const std::vector<RegionBead>& beads) {
  std::size_t gaps = 1;
  for (std::size_t k = 1; k < beads.size(); ++k) gaps += joined(beads[k - 1].to, beads[k].from) ? 0 : 1;
  return 2 * gaps > beads.size();
}

// Cuts beads back by half their width where no other bead goes on: OrcaSlicer and Bambu Studio end separate lines at
// the edge of the surface, others half a bead before it.
std::vector<RegionBead> withFlatEnds(std::vector<RegionBead> beads) {
  for (std::size_t first = 0; first < beads.size();) {
    std::size_t last = first;
    while (last + 1 < beads.size() && joined(beads[last].to, beads[last + 1].from)) ++last;
    const auto cut = [](Vec2& end, Vec2 other, double width) {
      const double size = length(end - other);
      if (size > 0) end = end + std::min(width / 2, 0.49 * size) / size * (other - end);
    };
    if (!joined(beads[first].from, beads[last].to)) {
      const RegionBead head = beads[first];
      cut(beads[first].from, head.to, head.width);
      cut(beads[last].to, beads[last].from, beads[last].width);
    }
    first = last + 1;
  }
  return beads;
}

// Area of all parts of a field [mm²].
double areaOf(const RegionField& field) {
  const auto inside = std::count_if(field.part.begin(), field.part.end(), [](std::int32_t part) { return part >= 0; });
  return static_cast<double>(inside) * field.cell * field.cell;
}

// Usual shape of a stretch's beads.
struct BeadShape {
  double height = 0;    // [mm]
  double spacing = 0;   // [mm]
  double width = 0;     // [mm]
  double rounding = 0;  // [mm] excess of a bead's width over section / height
  double flow = 1;      // ratio of plastic to that of beads as wide as their distance: a setting for the filament
};

// Measures the beads. They are rectangles with round sides, of the section h (w - h) + pi h²/4; Cura's are plain
// rectangles. \return a shape without width if the layer's height is out of range.
BeadShape shapeOf(const Stretch& stretch) {
  BeadShape shape;
  shape.height = stretch.heightAt(stretch.lines.back().move->z);
  if (!(shape.height > 0.01 && shape.height < 5)) return shape;
  std::vector<std::pair<double, double>> sections;
  for (const StretchLine& line : stretch.lines) {
    if (line.bead()) sections.emplace_back(stretch.sectionOf(*line.move), line.move->length);
  }
  const double told = median(std::move(sections)) / shape.height;
  const double distance = neighbourDistance(stretch.lines);
  if (distance > 0.05) shape.flow = told / distance;
  if (std::abs(shape.flow - 1) <= kFullFlow || std::abs(shape.flow - 1) > kMostFlow) shape.flow = 1;
  shape.rounding = stretch.byCura ? 0 : kRoundSides * shape.height;
  shape.spacing = told / shape.flow;
  shape.width = shape.spacing + shape.rounding;
  return shape;
}

// Beads of a stretch; arcs are split into straight pieces.
struct StraightBeads {
  std::vector<RegionBead> beads;
  std::vector<Vec2> middles;  // middle of each line that is a bead
  double filled = 0;          // [mm²] area that the plastic fills
};

// Splits the beads of a stretch into straight ones, each as wide as its plastic makes it.
StraightBeads straightBeads(const Stretch& stretch, const BeadShape& shape) {
  StraightBeads made;
  made.middles.resize(stretch.lines.size());
  for (std::size_t k = 0; k < stretch.lines.size(); ++k) {
    if (!stretch.lines[k].bead()) continue;
    const MachineMove& move = *stretch.lines[k].move;
    const double section = stretch.sectionOf(move) / shape.height / shape.flow;
    const double width = std::clamp(section + shape.rounding, 0.5 * shape.width, 1.5 * shape.width);
    made.middles[k] = 0.5 * (move.from + move.to);
    made.filled += stretch.sectionOf(move) * move.length / shape.height / shape.flow;
    if (!move.arc || !move.readable) {
      made.beads.push_back({move.from, move.to, width});
      continue;
    }
    const int pieces = std::clamp(static_cast<int>(std::abs(move.turn) * 8) + 1, 1, 64);
    Vec2 last = move.from;
    for (int piece = 1; piece <= pieces; ++piece) {
      const Vec2 p = piece == pieces ? move.to : onArc(move, static_cast<double>(piece) / pieces);
      made.beads.push_back({last, p, width});
      last = p;
      if (piece == (pieces + 1) / 2) made.middles[k] = p;
    }
  }
  return made;
}

// Region of the beads. Their ends are flat if separate beads with round ends would cover more than the plastic fills.
// \return nullptr if the beads lie where no bed reaches.
std::shared_ptr<const RegionField> fieldOf(StraightBeads& straight, const BeadShape& shape) {
  Result<RegionField> made = fieldOfBeads(straight.beads, kNotch * shape.spacing);
  if (!made) return nullptr;
  const double filled = straight.filled;
  if (const double area = areaOf(made.value()); filled < (1 - kFlatEnds) * area && areSeparate(straight.beads)) {
    Result<RegionField> flat = fieldOfBeads(withFlatEnds(std::move(straight.beads)), kNotch * shape.spacing);
    if (flat && std::abs(areaOf(flat.value()) - filled) < area - filled) made = std::move(flat);
  }
  return std::make_shared<const RegionField>(std::move(made).value());
}

// Part of the field in which each line lays a bead; -1 for lines that lay none.
std::vector<int> partsOfLines(const Stretch& stretch, const RegionField& field, const std::vector<Vec2>& middles) {
  std::vector<int> partOf(stretch.lines.size(), -1);
  for (std::size_t k = 0; k < partOf.size(); ++k) {
    if (!stretch.lines[k].bead()) continue;
    if (const int cell = field.at(middles[k]); cell >= 0) partOf[k] = field.part[cell];
  }
  return partOf;
}

// Makes the block of a surface from its first to its last bead, with the settings that hold there.
SurfaceBlock blockBetween(const Stretch& stretch, const BeadShape& shape, std::size_t first, std::size_t last) {
  const StretchLine& head = stretch.lines[first];
  const StretchLine& tail = stretch.lines[last];
  SurfaceBlock block;
  SlicedSurface& surface = block.surface;
  const bool top = stretch.role == RoleKind::Top || (stretch.role == RoleKind::Skin && !stretch.onBed);
  surface.side = top ? SurfaceSide::Top : SurfaceSide::Bottom;
  surface.layer = stretch.layer;
  surface.z = head.move->z;
  surface.height = stretch.heightAt(surface.z);
  surface.object = head.object;
  surface.tool = head.before.tool;
  surface.width = shape.width;
  surface.flow = shape.flow;
  surface.spacing = stretch.byCura ? shape.width : shape.width - kRoundSides * surface.height;
  surface.entry = head.move->from;
  surface.exit = tail.move->to;
  surface.firstLine = head.number;
  surface.lastLine = tail.number;
  surface.begin = head.begin;
  surface.end = tail.end;
  block.before = head.before;
  block.after = tail.after;
  block.acceleration = head.acceleration;
  block.travelSpeed = stretch.travelSpeed;
  return block;
}

std::string_view withoutLineEnd(std::string_view line) {
  while (line.ends_with('\n') || line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

// Sums up the plastic of the surface's lines, and leaves the surface if one of them forbids replacing it.
// \param part  number of the surface's part. \param partOf  part of each line.
void judgeLines(const Stretch& stretch, std::string_view gcode, const std::vector<int>& partOf, int part,
                SurfaceBlock& block) {
  SlicedSurface& surface = block.surface;
  double laid = 0;
  double loose = 0;
  std::vector<std::pair<double, double>> speeds;
  KeptPlaces places;
  for (std::size_t k = 0; k < stretch.lines.size(); ++k) {
    const StretchLine& line = stretch.lines[k];
    if (line.begin < surface.begin || line.end > surface.end) continue;
    if (line.object != surface.object) leaveSurface(block, LeftBecause::Object);
    if (line.after.inches || !line.after.absolute || stretch.volumetric || line.after.volumetric)
      leaveSurface(block, LeftBecause::Modes);
    if (!line.move) {
      keepCommand(withoutLineEnd(gcode.substr(line.begin, line.end - line.begin)), places, block);
      continue;
    }
    if (line.move->arc && !line.move->readable) leaveSurface(block, LeftBecause::Modes);
    if (!line.bead()) {
      loose += line.move->e;
      continue;
    }
    if (partOf[k] != part) leaveSurface(block, LeftBecause::Interleaved);
    if (line.move->z != surface.z || line.move->zFrom != surface.z) leaveSurface(block, LeftBecause::Height);
    laid += line.move->e;
    speeds.emplace_back(line.after.speed, line.move->length);
  }
  surface.volumeMm3 = laid * (stretch.volumetric ? 1 : stretch.filamentArea);
  surface.speed = median(std::move(speeds));
  const MachineState& before = block.before;
  const MachineState& after = block.after;
  if (std::abs(loose) > kLooseFilament || after.firmwareRetracted != before.firmwareRetracted ||
      after.absoluteE != before.absoluteE || after.tool != before.tool || !(before.origin == after.origin)) {
    leaveSurface(block, LeftBecause::Command);
  }
}

// Finds the surface's region, and leaves the surface if it is too small or not filled. \return false if it has none.
bool judgeRegion(const RegionField& field, int part, double breadth, SurfaceBlock& block) {
  SlicedSurface& surface = block.surface;
  Result<Shape> region = regionOf(field, part, 2 * surface.width * surface.width, surface.corner);
  if (!region) return false;
  surface.region = std::move(region).value();
  const Result<Outline> outline = resolveOutline(surface.region);
  if (!outline) return false;
  surface.areaMm2 = outline.value().area;
  if (breadth < kThreeBeads * surface.spacing) leaveSurface(block, LeftBecause::Narrow);
  if (surface.areaMm2 < kTenSquares * surface.spacing * surface.spacing) leaveSurface(block, LeftBecause::Small);
  const double fill = surface.volumeMm3 / (surface.areaMm2 * surface.height);
  if (!(fill > 0.8 && fill < 1.2)) leaveSurface(block, LeftBecause::Flow);
  return true;
}

}  // namespace

StretchSurfaces surfacesOf(const Stretch& stretch, std::string_view gcode) {
  StretchSurfaces made;
  const BeadShape shape = shapeOf(stretch);
  if (!(shape.height > 0.01 && shape.height < 5)) return made;
  made.ironing = stretch.role == RoleKind::Skin && shape.spacing <= 0.05;
  if (!(shape.spacing > 0.05 && shape.spacing < 5)) return made;
  StraightBeads straight = straightBeads(stretch, shape);
  made.field = fieldOf(straight, shape);
  if (made.field == nullptr) return made;
  const RegionField& field = *made.field;
  const std::vector<double> breadth = breadths(field, depths(field));
  const std::vector<int> partOf = partsOfLines(stretch, field, straight.middles);
  std::vector<int> seen;
  for (std::size_t first = 0; first < partOf.size(); ++first) {
    const int part = partOf[first];
    if (part < 0 || std::find(seen.begin(), seen.end(), part) != seen.end()) continue;
    seen.push_back(part);
    const auto behind = std::find(partOf.rbegin(), partOf.rend(), part).base();
    const std::size_t last = behind - partOf.begin() - 1;
    SurfaceBlock block = blockBetween(stretch, shape, first, last);
    if (gcode.substr(block.surface.begin, stretch.lines[first].end - block.surface.begin).ends_with("\r\n"))
      block.lineEnd = "\r\n";
    judgeLines(stretch, gcode, partOf, part, block);
    if (!judgeRegion(field, part, breadth[part], block)) continue;
    lookAhead(gcode, stretch.byCura, block);
    made.surfaces.push_back({std::move(block), part});
  }
  return made;
}

}  // namespace sillon
