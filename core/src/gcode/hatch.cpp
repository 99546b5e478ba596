#include "gcode/hatch.hpp"

#include <algorithm>
#include <cmath>

#include "sillon/geometry/outline.hpp"

namespace sillon {
namespace {

// A joint along the border longer than this many line widths (border flatter than 15 degrees to the lines) could leave
// the shape between two rows.
constexpr double kLongestJoint = 4;

using Row = std::vector<Interval>;

// A frame whose u axis runs along the lines.
struct Frame {
  double cosine;
  double sine;
  [[nodiscard]] Vec2 to(Vec2 p) const { return {cosine * p.x + sine * p.y, cosine * p.y - sine * p.x}; }
  [[nodiscard]] Vec2 from(Vec2 p) const { return {cosine * p.x - sine * p.y, sine * p.x + cosine * p.y}; }
};

Shape turned(const Shape& shape, const Frame& frame) {
  Shape result = shape;
  for (FilledPath& path : result.paths) {
    for (Ring& ring : path.rings) {
      for (Vec2& p : ring) p = frame.to(p);
    }
  }
  return result;
}

// Intersection of a with b shrunk by `inset` at both ends; all lists ascend.
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

// Where a line's middle may run: the shape eroded by a regular octagon around the bead, tested at the octagon's
// corners. Exact for borders along, across and at 45 degrees to the lines, at most 8 % too deep between.
std::vector<Row> erodedRows(const Shape& shape, double firstY, double step, int rows, double lineWidth, double inset) {
  const double radius =
      inset + 0.49 * lineWidth;  // a hair less than half, so that a line along the border does not graze it
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

// A zigzag under construction: its last line and the end it stopped at.
struct Run {
  std::size_t polyline;
  Interval line;
  bool atEnd;
};

// Boustrophedon: each line continues the zigzag that stopped next to it in the row before, or starts a new one.
std::vector<Polyline> zigzags(const std::vector<Row>& rows, double firstY, double step, double lineWidth) {
  std::vector<Polyline> result;
  std::vector<Run> previous;
  std::vector<Run> current;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const double y = firstY + static_cast<double>(r) * step;
    current.clear();
    std::size_t candidate = 0;
    for (const Interval& line : rows[r]) {
      if (line.end - line.begin < lineWidth) continue;
      while (candidate < previous.size() && previous[candidate].line.end <= line.begin) ++candidate;
      Run run{result.size(), line, true};
      if (candidate < previous.size() && previous[candidate].line.begin < line.end) {
        const Run& before = previous[candidate];
        const double joint = before.atEnd ? line.end - before.line.end : line.begin - before.line.begin;
        if (std::abs(joint) <= kLongestJoint * lineWidth) {
          run.polyline = before.polyline;
          run.atEnd = !before.atEnd;
          ++candidate;
        }
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
  const std::vector<Row> inside = erodedRows(level, firstY, lineWidth, rows, lineWidth, inset);
  std::vector<Polyline> lines = zigzags(inside, firstY, lineWidth, lineWidth);
  for (Polyline& line : lines) {
    for (Vec2& p : line) p = frame.from(p);
  }
  return lines;
}

}  // namespace sillon
