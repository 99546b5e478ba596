#include "gcode/layout.hpp"

#include <algorithm>

namespace sillon {
namespace {

// Finds the concave corners of the shape, where a seam hides best: the point between the two sides, a little way off,
// lies outside. Returns none if there are very many, because no seam shows among them.
std::vector<Vec2> concaveCorners(const Shape& shape, const ShapeScan& scan) {
  constexpr double kAway = 0.5;  // [mm] from the corner to the point that is tested
  constexpr std::size_t kMost = 100;
  constexpr double kStraight = -0.94;  // cosine between the sides; blunter corners hide no seam
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

}  // namespace

void markSeams(std::vector<BeadPath>& cycles, PointUm offset, const Shape& shape, const ShapeScan& scan,
               double spacing) {
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
      path.beginsUnseen = path.beginsUnseen || i == 0;
      const auto near = [&](Vec2 corner) { return length(corner - p) <= 2 * reach; };
      if (std::any_of(corners.begin(), corners.end(), near)) hidden.push_back(static_cast<std::uint32_t>(i));
    }
    if (!hidden.empty()) path.seams = std::move(hidden);
  }
}

}  // namespace sillon
