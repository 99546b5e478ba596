#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "base/refused.hpp"
#include "geometry/outline.hpp"
#include "geometry/shape_points.hpp"

namespace sillon {
namespace {

/// Tells whether a hole removes anything from the inside of an outline.
bool meets(const RoundHole& hole, const Outline& outline) {
  const Vec2 c = hole.centre;
  int winding = 0;
  for (const BorderSegment& s : outline.segments) {
    const Vec2 along = s.b - s.a;
    const double share = std::clamp(dot(c - s.a, along) / dot(along, along), 0.0, 1.0);
    if (length(s.a + share * along - c) < hole.diameter / 2) return true;
    if ((s.a.y <= c.y) == (s.b.y <= c.y)) continue;
    const double side = cross(along, c - s.a);
    if (s.a.y <= c.y ? side > 0 : side < 0) winding += s.a.y <= c.y ? 1 : -1;
  }
  return winding != 0;
}

}  // namespace

Result<Shape> withHoles(Shape shape, const std::vector<RoundHole>& holes) {
  if (holes.empty()) return shape;
  const Result<Outline> outline = resolveOutline(shape);
  if (!outline) return outline.error();
  std::vector<FilledPath> paths = shape.paths;
  FilledPath cut;
  for (std::size_t k = 0; k < holes.size(); ++k) {
    const RoundHole& hole = holes[k];
    if (!validSize(hole.diameter)) {
      return sizeError("shape.holes[" + std::to_string(k) + "].diameter", hole.diameter);
    }
    if (!meets(hole, outline.value())) {
      const Bounds box = outline.value().bounds;
      return refused(ErrorCode::InvalidArgument, "HoleOutside",
                     {{"n", k + 1},
                      {"x", hole.centre.x},
                      {"y", hole.centre.y},
                      {"diameter", hole.diameter},
                      {"left", box.min.x},
                      {"bottom", box.min.y},
                      {"right", box.max.x},
                      {"top", box.max.y}});
    }
    cut.rings.push_back(circleRing(hole.centre, hole.diameter));
  }
  paths.push_back(std::move(cut));
  const InsideRule rule = [](const std::vector<char>& filled) {
    if (filled.back() != 0) return false;
    return std::any_of(filled.begin(), filled.end() - 1, [](char one) { return one != 0; });
  };
  Result<FilledPath> left = combined(paths, rule);
  if (!left) return left.error();
  if (left.value().rings.empty()) {
    return refused(ErrorCode::EmptyShape, "HolesLeaveNothing");
  }
  shape.paths = {std::move(left).value()};
  return shape;
}

}  // namespace sillon
