#include "gcode/base_layers.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/outline.hpp"
#include "geometry/shape_points.hpp"

namespace sillon {
namespace {

// Longest joint along the border, in line widths. A longer one (border flatter than 15 degrees to the lines) could
// leave the shape between two rows.
constexpr double kLongestJoint = 4;

using Row = std::vector<Interval>;

// A rotated frame whose u axis runs along the lines.
struct Frame {
  double cosine;
  double sine;
  [[nodiscard]] Vec2 to(Vec2 p) const { return {cosine * p.x + sine * p.y, cosine * p.y - sine * p.x}; }
  [[nodiscard]] Vec2 from(Vec2 p) const { return {cosine * p.x - sine * p.y, sine * p.x + cosine * p.y}; }
};

// Turns a shape into a frame.
Shape turned(const Shape& shape, const Frame& frame) {
  Shape result = shape;
  movePoints(result, [&](Vec2 p) { return frame.to(p); });
  return result;
}

// Intersects a with the intervals of b, shrunk by `inset` at both ends; all lists ascend.
Row intersection(const Row& a, const Row& b, double inset) {
  Row result;
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    const double begin = std::max(a[i].begin, b[j].begin + inset);
    const double end = std::min(a[i].end, b[j].end - inset);
    if (begin < end) result.push_back({begin, end});
    if (a[i].end < b[j].end - inset) {
      ++i;
    } else {
      ++j;
    }
  }
  return result;
}

// Intervals in which a line's centre may run: the shape eroded by a regular octagon around the bead, tested at the
// octagon's corners. The erosion is exact for borders along, across and at 45 degrees to the lines, and at most 8 % too
// deep between.
std::vector<Row> erodedRows(const Shape& shape, double firstY, double step, int rows, double radius) {
  const double corner = (std::sqrt(2.0) - 1) * radius;
  std::vector<Row> result = insideIntervals(shape, firstY, step, rows);
  const auto erode = [&](double shift, double inset) {
    const std::vector<Row> shifted = insideIntervals(shape, firstY + shift, step, rows);
    for (std::size_t r = 0; r < result.size(); ++r) result[r] = intersection(result[r], shifted[r], inset);
  };
  erode(corner, radius);
  erode(-corner, radius);
  erode(radius, corner);
  erode(-radius, corner);
  return result;
}

// Tells whether a row holds x, up to `slack` outside its intervals.
bool holds(const Row& row, double x, double slack) {
  return std::any_of(row.begin(), row.end(),
                     [&](const Interval& piece) { return piece.begin - slack <= x && x <= piece.end + slack; });
}

double lengthOf(const Polyline& line) {
  double sum = 0;
  for (std::size_t k = 0; k + 1 < line.size(); ++k) sum += length(line[k + 1] - line[k]);
  return sum;
}

// A zigzag under construction: its last line and the end it stopped at.
struct Zigzag {
  std::size_t polyline;
  Interval line;
  bool atEnd;
};

// Boustrophedon path: each line continues a zigzag that stopped next to it in the row before, or starts a new one.
// \param halfRows  rows in which a line's centre may run, half a step apart; every other row gets lines.
// \param radius    radius of the disc around every such centre that lies within the shape [mm].
std::vector<Polyline> zigzags(const std::vector<Row>& halfRows, double firstY, double lineWidth, double radius) {
  std::vector<Polyline> result;
  std::vector<Zigzag> previous;
  std::vector<Zigzag> current;
  const double longest = kLongestJoint * lineWidth;
  for (std::size_t r = 0; r < halfRows.size(); r += 2) {
    const double y = firstY + static_cast<double>(r / 2) * lineWidth;
    current.clear();
    std::size_t candidate = 0;
    const auto joins = [&](const Zigzag& before, const Interval& line) {
      const double from = before.atEnd ? before.line.end : before.line.begin;
      const double to = before.atEnd ? line.end : line.begin;
      if (std::abs(to - from) > longest) return false;
      if (before.line.begin < line.end && line.begin < before.line.end) return true;
      // In narrow places neighbouring lines do not overlap; the joint stays inside if the discs at both ends and in its
      // middle lie within the shape. Along a straight border the middle lies on the edge of its row, along a concave
      // one a little beyond, hence the slack.
      const double slack = 0.1 * radius;
      return length(Vec2{to - from, lineWidth}) <= 4 * radius - 2 * slack &&
             holds(halfRows[r - 1], (from + to) / 2, slack);
    };
    for (const Interval& line : halfRows[r]) {
      while (candidate < previous.size() && previous[candidate].line.end + longest < line.begin) ++candidate;
      Zigzag run{result.size(), line, true};
      for (std::size_t k = candidate; k < previous.size() && previous[k].line.begin <= line.end + longest; ++k) {
        if (!joins(previous[k], line)) continue;
        run.polyline = previous[k].polyline;
        run.atEnd = !previous[k].atEnd;
        candidate = k + 1;
        break;
      }
      if (run.polyline == result.size()) result.emplace_back();
      const Vec2 begin{line.begin, y};
      const Vec2 end{line.end, y};
      result[run.polyline].push_back(run.atEnd ? begin : end);
      result[run.polyline].push_back(run.atEnd ? end : begin);
      current.push_back(run);
    }
    previous.swap(current);
  }
  std::erase_if(result, [&](const Polyline& line) { return lengthOf(line) < lineWidth; });
  return result;
}

}  // namespace

std::vector<Polyline> hatchLines(const Shape& shape, double lineWidth, bool falling, double inset) {
  const double diagonal = std::sqrt(0.5);
  const Frame frame{falling ? -diagonal : diagonal, diagonal};
  const Shape level = turned(shape, frame);
  Bounds box;
  for (const FilledPath& path : level.paths) {
    for (const Ring& ring : path.rings) {
      for (const Vec2 p : ring) box.add(p);
    }
  }
  if (box.empty()) return {};

  const int rows = std::max(1, static_cast<int>(box.size().y / lineWidth));
  const double firstY = box.min.y + (box.size().y - (rows - 1) * lineWidth) / 2;
  const double radius = inset + 0.49 * lineWidth;  // not quite half, so that a line along the border does not touch it
  const std::vector<Row> inside = erodedRows(level, firstY, lineWidth / 2, 2 * rows - 1, radius);
  std::vector<Polyline> lines = zigzags(inside, firstY, lineWidth, radius);
  for (Polyline& line : lines) {
    for (Vec2& p : line) p = frame.from(p);
  }
  return lines;
}

}  // namespace sillon
