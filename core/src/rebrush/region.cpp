#include "rebrush/region.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/refused.hpp"
#include "geometry/signed_distance.hpp"

namespace sillon {
namespace {

constexpr double kFinest = 0.05;      // [mm] least side of a cell
constexpr double kMostCells = 4e6;    // largest number of cells: larger faces have larger cells
constexpr double kLargestBed = 5000;  // [mm] largest coordinate on any bed
constexpr int kMargin = 3;            // [cells] margin around the beads, so that outlines close

std::size_t index(const RegionField& field, int x, int y) { return indexOf(x, y, field.columns); }

// Lowers the distances near a bead to those from its edge, up to `beyond` [mm] outside.
void draw(RegionField& field, const RegionBead& bead, double beyond) {
  const double reach = bead.width / 2 + beyond;
  const Vec2 a = bead.from - field.corner;
  const Vec2 d = bead.to - bead.from;
  const double along = dot(d, d);
  const auto cellOf = [&](double at, int count) {
    return static_cast<int>(std::clamp(at / field.cell, 0.0, count - 1.0));
  };
  const int firstRow = cellOf(std::min(a.y, a.y + d.y) - reach, field.rows);
  const int lastRow = cellOf(std::max(a.y, a.y + d.y) + reach, field.rows);
  for (int row = firstRow; row <= lastRow; ++row) {
    const double y = (row + 0.5) * field.cell - a.y;
    double low = std::min(0.0, d.x);
    double high = std::max(0.0, d.x);
    // A long slanted bead crosses a row in a small part of its box only.
    if (std::abs(d.y) > reach) {
      const double s = std::clamp((y - reach) / d.y, 0.0, 1.0) * d.x;
      const double t = std::clamp((y + reach) / d.y, 0.0, 1.0) * d.x;
      low = std::min(s, t);
      high = std::max(s, t);
    }
    const int first = cellOf(a.x + low - reach, field.columns);
    const int last = cellOf(a.x + high + reach, field.columns);
    for (int column = first; column <= last; ++column) {
      const Vec2 p{(column + 0.5) * field.cell - a.x, y};
      const Vec2 off = p - (along > 0 ? std::clamp(dot(p, d) / along, 0.0, 1.0) : 0.0) * d;
      const auto distance = static_cast<float>(length(off) - bead.width / 2);
      float& least = field.distance[index(field, column, row)];
      least = std::min(least, distance);
    }
  }
}

// Fills notches by a morphological closing on distances: a disc rolls along the beads from outside, and places that it
// cannot reach are filled.
void fillNotches(RegionField& field, double radius) {
  const int span = static_cast<int>(std::ceil(radius / field.cell)) + 3;
  const std::vector<float> given = field.distance;
  // Distance from each cell to the nearest place that the disc's middle can reach [mm].
  std::vector<float> depth(given.size(), static_cast<float>(radius + 3 * field.cell));
  const auto far = [&](std::size_t k) { return static_cast<double>(given[k]) >= radius; };
  for (int y = 1; y + 1 < field.rows; ++y) {
    for (int x = 1; x + 1 < field.columns; ++x) {
      const std::size_t middle = index(field, x, y);
      if (!far(middle) || (far(index(field, x - 1, y)) && far(index(field, x + 1, y)) && far(index(field, x, y - 1)) &&
                           far(index(field, x, y + 1)))) {
        continue;
      }
      const double over = static_cast<double>(given[middle]) - radius;
      for (int v = std::max(0, y - span); v <= std::min(field.rows - 1, y + span); ++v) {
        for (int u = std::max(0, x - span); u <= std::min(field.columns - 1, x + span); ++u) {
          const auto away = static_cast<float>(field.cell * std::hypot(u - x, v - y) - over);
          float& least = depth[index(field, u, v)];
          least = std::min(least, away);
        }
      }
    }
  }
  for (std::size_t k = 0; k < given.size(); ++k) {
    if (!far(k)) field.distance[k] = std::min(given[k], static_cast<float>(radius) - depth[k]);
  }
}

// Numbers the connected parts. Cells connect by their sides; parts are numbered in the order of their first cells.
void labelParts(RegionField& field) {
  field.part.assign(field.distance.size(), -1);
  std::vector<std::size_t> queue;
  const std::size_t columns = field.columns;
  for (std::size_t seed = 0; seed < field.distance.size(); ++seed) {
    if (field.distance[seed] >= 0 || field.part[seed] >= 0) continue;
    queue.assign(1, seed);
    field.part[seed] = field.parts;
    while (!queue.empty()) {
      const std::size_t cell = queue.back();
      queue.pop_back();
      // The margin keeps all four neighbours within the field.
      for (const std::size_t next : {cell - 1, cell + 1, cell - columns, cell + columns}) {
        if (field.distance[next] >= 0 || field.part[next] >= 0) continue;
        field.part[next] = field.parts;
        queue.push_back(next);
      }
    }
    ++field.parts;
  }
}

// Signed area of a ring [mm²], positive if it is counter-clockwise.
double areaOf(const Ring& ring) {
  double sum = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) sum += cross(ring[k], ring[(k + 1) % ring.size()]);
  return sum / 2;
}

}  // namespace

int RegionField::at(Vec2 p) const {
  const Vec2 local = p - corner;
  if (!(local.x >= 0 && local.y >= 0 && local.x < columns * cell && local.y < rows * cell)) return -1;
  const int x = std::min(static_cast<int>(local.x / cell), columns - 1);
  const int y = std::min(static_cast<int>(local.y / cell), rows - 1);
  return y * columns + x;
}

Result<RegionField> fieldOfBeads(const std::vector<RegionBead>& beads, double notch) {
  Bounds box;
  for (const RegionBead& bead : beads) {
    const Vec2 half{bead.width / 2, bead.width / 2};
    for (const Vec2 p : {bead.from, bead.to}) {
      if (!(std::abs(p.x) <= kLargestBed && std::abs(p.y) <= kLargestBed)) {
        return refused(ErrorCode::TooLarge, "MoveTooFar", {{"most", kLargestBed}});
      }
      box.add(p - half);
      box.add(p + half);
    }
  }
  RegionField field;
  if (box.empty()) return field;
  const Vec2 size = box.size();
  field.cell = std::max(kFinest, std::sqrt(size.x * size.y / kMostCells));
  // Distances are cut off where a disc is free anyway.
  const double beyond = notch > 0 ? notch + 2 * field.cell : 2 * field.cell;
  const int margin = kMargin + static_cast<int>(std::ceil(notch / field.cell));
  field.corner = box.min - Vec2{margin * field.cell, margin * field.cell};
  field.columns = static_cast<int>(std::ceil(size.x / field.cell)) + 2 * margin;
  field.rows = static_cast<int>(std::ceil(size.y / field.cell)) + 2 * margin;
  field.distance.assign(cellCount(field.columns, field.rows), static_cast<float>(beyond));
  for (const RegionBead& bead : beads) draw(field, bead, beyond);
  if (notch > 0) fillNotches(field, notch);
  labelParts(field);
  return field;
}

Result<Shape> regionOf(const RegionField& field, int part, double hole, Vec2& corner) {
  int left = field.columns;
  int right = -1;
  int below = field.rows;
  int above = -1;
  for (int y = 0; y < field.rows; ++y) {
    for (int x = 0; x < field.columns; ++x) {
      if (field.part[index(field, x, y)] != part) continue;
      left = std::min(left, x);
      right = std::max(right, x);
      below = std::min(below, y);
      above = std::max(above, y);
    }
  }
  if (right < 0) return refused(ErrorCode::EmptyShape, "SurfaceEmpty");
  left -= 2;
  below -= 2;
  right += 2;
  above += 2;
  Image mask;
  mask.width = right - left + 1;
  mask.height = above - below + 1;
  mask.channels = 1;
  mask.samples.resize(cellCount(mask.width, mask.height));
  // Grey is one half at the edge, so that the outline runs between cells. Cells of other parts are outside.
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      const std::size_t cell = index(field, left + x, above - y);
      const bool other = field.part[cell] >= 0 && field.part[cell] != part;
      const double grey = other ? 0 : std::clamp(0.5 - field.distance[cell] / (4 * field.cell), 0.0, 1.0);
      mask.samples[indexOf(x, y, mask.width)] = static_cast<std::uint16_t>(std::lround(65535 * grey));
    }
  }
  corner = field.corner + Vec2{left * field.cell, below * field.cell};
  Result<Shape> shape = shapeFromMask(mask, mask.width * field.cell);
  if (!shape) return shape;
  for (FilledPath& path : shape.value().paths) {
    std::vector<Ring>& rings = path.rings;
    const auto tiny = [&](const Ring& ring) { return std::abs(areaOf(ring)) < hole; };
    rings.erase(std::remove_if(rings.begin(), rings.end(), tiny), rings.end());
  }
  return shape;
}

std::vector<float> depths(const RegionField& field) {
  std::vector<char> outside(field.part.size());
  for (std::size_t k = 0; k < outside.size(); ++k) outside[k] = field.part[k] < 0 ? 1 : 0;
  return chamferDistance(outside, field.columns, field.rows);
}

std::vector<double> breadths(const RegionField& field, const std::vector<float>& depth) {
  std::vector<double> widest(field.parts, 0);
  for (std::size_t k = 0; k < depth.size(); ++k) {
    if (field.part[k] < 0) continue;
    double& most = widest[field.part[k]];
    most = std::max(most, (2 * static_cast<double>(depth[k]) - 1) * field.cell);
  }
  return widest;
}

}  // namespace sillon
