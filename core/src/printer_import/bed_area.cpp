#include "printer_import/slicer_files.hpp"

#include <algorithm>
#include <cmath>

namespace sillon {
namespace {

constexpr double kFarthest = 5000;  // [mm], greatest coordinate of a corner

// Corners of all boxes of a text, in which '#' may separate the boxes.
std::vector<Vec2> cornersOf(std::string_view text) {
  std::string list(text);
  std::replace(list.begin(), list.end(), '#', ',');
  return readCorners(list);
}

// Boxes of four corners each; for any other count, the box around all corners. Qidi draws several boxes with one line,
// which begins with the same place twice and returns to it between two boxes. Empty: too few corners, or one too far
// off.
std::vector<Bounds> boxesOf(const std::vector<Vec2>& corners) {
  if (corners.size() < 3) return {};
  const bool returns = corners[0] == corners[1];
  const std::size_t each = corners.size() % 4 == 0 ? 4 : corners.size();
  std::vector<Bounds> boxes;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    if (std::max(std::abs(corners[k].x), std::abs(corners[k].y)) > kFarthest) return {};
    if (returns ? corners[k] == corners[0] : k % each == 0) boxes.emplace_back();
    if (!returns || !(corners[k] == corners[0])) boxes.back().add(corners[k]);
  }
  boxes.erase(std::remove_if(boxes.begin(), boxes.end(), [](const Bounds& box) { return box.empty(); }), boxes.end());
  return boxes;
}

double areaOf(const Bounds& box) { return box.size().x * box.size().y; }

// Tells whether a point lies inside an outline, by the even-odd rule.
bool holds(const std::vector<Vec2>& outline, Vec2 p) {
  bool inside = false;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vec2 a = outline[k], b = outline[(k + 1) % outline.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

// Box that an outline along the edges of the bed leaves free in the middle; empty: the outline does not run like that.
Bounds insideOf(const std::vector<Vec2>& outline, const Bounds& bed) {
  Bounds left = bed;
  for (const Vec2 corner : outline) {  // each corner belongs to the nearest edge
    const double toLeft = corner.x - bed.min.x, toRight = bed.max.x - corner.x;
    const double toFront = corner.y - bed.min.y, toBack = bed.max.y - corner.y;
    const double least = std::min({toLeft, toRight, toFront, toBack});
    if (least == toLeft) {
      left.min.x = std::max(left.min.x, corner.x);
    } else if (least == toRight) {
      left.max.x = std::min(left.max.x, corner.x);
    } else if (least == toFront) {
      left.min.y = std::max(left.min.y, corner.y);
    } else {
      left.max.y = std::min(left.max.y, corner.y);
    }
  }
  constexpr int kPieces = 64;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vec2 from = outline[k], to = outline[(k + 1) % outline.size()];
    for (int piece = 0; piece <= kPieces; ++piece) {
      const Vec2 at = from + (static_cast<double>(piece) / kPieces) * (to - from);
      if (at.x > left.min.x && at.x < left.max.x && at.y > left.min.y && at.y < left.max.y) return {};
    }
  }
  const bool most = areaOf(left) > 0.5 * areaOf(bed);
  return most && !holds(outline, 0.5 * (left.min + left.max)) ? left : Bounds{};
}

// Takes a strip along a whole edge off the bed. \return false: the box is no such strip.
bool takeStrip(const Bounds& box, Bounds& bed) {
  const bool wide = box.min.x <= bed.min.x && box.max.x >= bed.max.x;
  const bool tall = box.min.y <= bed.min.y && box.max.y >= bed.max.y;
  if (tall == wide) return false;
  if (tall && box.min.x <= bed.min.x) {
    bed.min.x = std::max(bed.min.x, box.max.x);
  } else if (tall && box.max.x >= bed.max.x) {
    bed.max.x = std::min(bed.max.x, box.min.x);
  } else if (wide && box.min.y <= bed.min.y) {
    bed.min.y = std::max(bed.min.y, box.max.y);
  } else if (wide && box.max.y >= bed.max.y) {
    bed.max.y = std::min(bed.max.y, box.min.y);
  } else {
    return false;
  }
  return true;
}

// Takes one of several boxes off the bed, on the side where the bed loses least. \return false: it lies at no edge.
bool cutOff(const Bounds& box, Bounds& bed) {
  const double losses[] = {box.max.x - bed.min.x, bed.max.x - box.min.x, box.max.y - bed.min.y, bed.max.y - box.min.y};
  const double* const least = std::min_element(std::begin(losses), std::end(losses));
  const bool atEdge =
      box.min.x <= bed.min.x || box.max.x >= bed.max.x || box.min.y <= bed.min.y || box.max.y >= bed.max.y;
  if (!atEdge) return false;
  const double loss = std::max(*least, 0.0);
  switch (least - losses) {
    case 0:
      bed.min.x += loss;
      break;
    case 1:
      bed.max.x -= loss;
      break;
    case 2:
      bed.min.y += loss;
      break;
    default:
      bed.max.y -= loss;
  }
  return true;
}

}  // namespace

bool reachByAll(std::string_view text, BedArea& area) {
  constexpr double kLeast = 10;  // [mm], shortest side that the bed may keep
  Bounds bed = area.bed;
  const std::vector<Bounds> boxes = boxesOf(cornersOf(text));
  for (const Bounds& box : boxes) {
    bed = {{std::max(box.min.x, bed.min.x), std::max(box.min.y, bed.min.y)},
           {std::min(box.max.x, bed.max.x), std::min(box.max.y, bed.max.y)}};
  }
  if (boxes.empty() || bed.size().x < kLeast || bed.size().y < kLeast) return false;
  area.bed = bed;
  return true;
}

bool exclude(std::string_view text, BedArea& area) {
  const std::vector<Vec2> corners = cornersOf(text);
  const std::vector<Bounds> boxes = boxesOf(corners);
  if (boxes.size() == 1 && areaOf(boxes[0]) > 0.5 * areaOf(area.bed)) {
    if (const Bounds left = insideOf(corners, area.bed); !left.empty()) {
      area.bed = left;
      return true;
    }
  }
  for (const Bounds& box : boxes) {
    if (takeStrip(box, area.bed) || (boxes.size() > 1 && cutOff(box, area.bed))) continue;
    area.excluded.add(box.min);
    area.excluded.add(box.max);
  }
  return !boxes.empty();
}

}  // namespace sillon
