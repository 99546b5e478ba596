#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/refused.hpp"
#include "gcode/base_layers.hpp"
#include "gcode/layout.hpp"

namespace sillon {
namespace {

constexpr double kInset = 0.02;  // [mm] beyond half a line; more than the error of offsetLoops: no bead may stick out
constexpr int kMaxLoops = 1000;
constexpr double kStraight = 5;      // [mm]; shorter travels go straight, such as those from one loop to its neighbour
constexpr std::size_t kSought = 16;  // places around a loop where a search for its closest point to another starts
constexpr std::size_t kSeams = 21;   // places around a border at which its layers begin, in turns

// Index of the point of a path that is nearest to p.
std::size_t nearestPoint(const BeadPath& path, PointUm p) {
  const auto distance = [p](PointUm a) { return dot(wide(a - p), wide(a - p)); };
  const auto nearest = std::min_element(path.points.begin(), path.points.end(),
                                        [&](PointUm a, PointUm b) { return distance(a) < distance(b); });
  return nearest - path.points.begin();
}

// Distance from a point to a closed line [mm].
double distanceTo(const BeadPath& loop, PointUm point) {
  const Vec2 p = mm(point);
  double least = std::numeric_limits<double>::infinity();
  Vec2 a = mm(loop.points.back());
  for (const PointUm next : loop.points) {
    const Vec2 b = mm(next);
    const Vec2 d = b - a;
    const double share = dot(d, d) > 0 ? std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0) : 0;
    least = std::min(least, length(p - a - share * d));
    a = b;
  }
  return least;
}

// Appends the shorter way around a loop from one of its points to another, both included.
void addAlong(const BeadPath& loop, std::size_t from, std::size_t to, std::vector<PointUm>& way) {
  const std::size_t count = loop.points.size();
  double forward = 0;
  double all = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double piece = lengthMm(loop.points[(k + 1) % count] - loop.points[k]);
    all += piece;
    if ((k + count - from) % count < (to + count - from) % count) forward += piece;
  }
  const std::size_t step = 2 * forward <= all ? 1 : count - 1;
  for (std::size_t k = from; k != to; k = (k + step) % count) way.push_back(loop.points[k]);
  way.push_back(loop.points[to]);
}

// The points at which two loops are closest, as indices, and their distance.
struct LoopCrossing {
  std::size_t leave = 0;
  std::size_t enter = 0;
  double length = std::numeric_limits<double>::infinity();  // distance [mm]
};

// Finds where two loops are closest, by alternating nearest points from several places; the result may be a local
// minimum.
LoopCrossing crossing(const BeadPath& from, const BeadPath& to) {
  LoopCrossing best;
  for (std::size_t k = 0; k < kSought; ++k) {
    LoopCrossing one;
    one.leave = nearestPoint(from, to.points[k * to.points.size() / kSought]);
    one.enter = nearestPoint(to, from.points[one.leave]);
    one.leave = nearestPoint(from, to.points[one.enter]);
    one.length = lengthMm(to.points[one.enter] - from.points[one.leave]);
    if (one.length < best.length) best = one;
  }
  return best;
}

// Groups the loops by border. Within a group each loop follows one beside it and begins beside its start, so that no
// travel between them crosses the face. The widest border comes first, the others by their distance from the one
// before.
std::vector<std::vector<BeadPath>> byBorder(std::vector<BeadPath> loops, double step) {
  constexpr double kBeside = 1.1;  // [step], largest distance of a loop from the one beside it
  const std::size_t count = loops.size();
  std::vector<std::vector<std::size_t>> inner(count);
  std::vector<std::size_t> borders;
  for (std::size_t k = 0; k < count; ++k) {
    std::size_t outer = k;  // loops nearer to the border come first, so the search runs backwards from the nearest one
    while (outer-- > 0 && distanceTo(loops[outer], loops[k].points.front()) > kBeside * step) continue;
    std::vector<std::uint32_t>& seams = loops[k].seams;
    if (outer >= count) {
      borders.push_back(k);
      for (std::size_t i = 0; i < kSeams; ++i) {
        seams.push_back(static_cast<std::uint32_t>(i * loops[k].points.size() / kSeams));
      }
      continue;
    }
    inner[outer].push_back(k);
    for (const std::uint32_t seam : loops[outer].seams) {
      seams.push_back(static_cast<std::uint32_t>(nearestPoint(loops[k], loops[outer].points[seam])));
    }
  }
  std::vector<Bounds> boxes(count);
  for (const std::size_t border : borders) {
    for (const PointUm p : loops[border].points) boxes[border].add(mm(p));
  }
  const auto wide = [&](std::size_t a, std::size_t b) { return length(boxes[a].size()) < length(boxes[b].size()); };
  auto next = std::max_element(borders.begin(), borders.end(), wide);
  std::vector<std::vector<BeadPath>> out;
  while (!borders.empty()) {
    const Vec2 at = 0.5 * (boxes[*next].min + boxes[*next].max);
    std::vector<std::size_t> open{*next};
    borders.erase(next);
    std::vector<BeadPath>& border = out.emplace_back();
    while (!open.empty()) {
      const std::size_t loop = open.back();
      open.pop_back();
      open.insert(open.end(), inner[loop].rbegin(), inner[loop].rend());
      border.push_back(std::move(loops[loop]));
    }
    const auto away = [&](std::size_t k) { return length(0.5 * (boxes[k].min + boxes[k].max) - at); };
    next = std::min_element(borders.begin(), borders.end(),
                            [&](std::size_t a, std::size_t b) { return away(a) < away(b); });
  }
  return out;
}

}  // namespace

const BeadPath* loopNearest(const std::vector<std::vector<BeadPath>>& rim, PointUm at) {
  const BeadPath* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const std::vector<BeadPath>& border : rim) {
    const double away = distanceTo(border.front(), at);
    if (away >= least) continue;
    least = away;
    nearest = &border.front();
  }
  return nearest;
}

std::vector<PointUm> wayAlong(const BeadPath& from, PointUm at, const BeadPath& via, const BeadPath& to,
                              std::size_t start) {
  std::vector<PointUm> way;
  if (lengthMm(to.points[start] - at) <= kStraight) return way;
  LoopCrossing last = crossing(from, to);
  std::size_t begin = nearestPoint(from, at);
  const BeadPath* leaves = &from;
  const LoopCrossing there = crossing(from, via);
  const LoopCrossing back = crossing(via, to);
  if (there.length + back.length < last.length) {
    addAlong(from, begin, there.leave, way);
    begin = there.enter;
    leaves = &via;
    last = back;
  }
  addAlong(*leaves, begin, last.leave, way);
  addAlong(to, last.enter, start, way);
  way.pop_back();
  return way;
}

std::optional<Error> addRim(GcodeJob& job, const Shape& body, PointUm offset, const Printer& printer,
                            const PrintParams& params) {
  if (params.rim == 0) return std::nullopt;
  const double line = printer.nozzle;
  const int count = std::min(rimLoops(params, line), kMaxLoops);
  const Result<std::vector<Polyline>> loops = offsetLoops(body, -line / 2 - kInset, -line, count);
  if (!loops) return loops.error();
  std::vector<BeadPath> paths;
  for (const Polyline& loop : loops.value()) {
    BeadPath path = placed(loop, offset, line, true);
    if (path.points.size() >= 3) paths.push_back(std::move(path));
  }
  job.rim = byBorder(std::move(paths), line);
  if (!job.rim.empty()) return std::nullopt;
  return refusedArgument("TooThinFor", {{"setting", "print.rim"}, {"value", params.rim}, {"width", line}});
}

}  // namespace sillon
