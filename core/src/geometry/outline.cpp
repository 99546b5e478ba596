#include "geometry/outline.hpp"

#include <cmath>
#include <cstddef>
#include <optional>

#include "base/refused.hpp"
#include "geometry/outline_steps.hpp"

namespace sillon {
namespace {

constexpr double kPerGrid = 1000;  ///< points of the grid of coordinates in files [1/mm]

// Converts edges to steps of the grid, whose sums and products are exact.
std::vector<PathEdge> gridEdges(const std::vector<PathEdge>& edges) {
  std::vector<PathEdge> out;
  for (const PathEdge& edge : edges) {
    const PathEdge to{onGrid(edge.a * kPerGrid), onGrid(edge.b * kPerGrid), edge.path};
    if (!(to.a == to.b)) out.push_back(to);
  }
  return out;
}

/// Returns a point beyond kMaxCoordinate, or one that is no number; null if there is none.
const Vec2* farPoint(const Shape& shape) {
  for (const FilledPath& path : shape.paths) {
    for (const Ring& ring : path.rings) {
      for (const Vec2& p : ring) {
        if (!(std::abs(p.x) <= kMaxCoordinate && std::abs(p.y) <= kMaxCoordinate)) return &p;
      }
    }
  }
  return nullptr;
}

/// Checks a shape's points and resolves its outline.
Result<Outline> outlineOf(const Shape& shape, Points points) {
  if (const Vec2* far = farPoint(shape)) {
    return refusedArgument("ShapePointTooFar", {{"x", far->x}, {"y", far->y}, {"most", kMaxCoordinate}});
  }
  Result<Outline> outline = borderOf(shape.paths, nullptr, points);
  if (!outline) return outline;
  if (outline.value().bounds.empty()) return refused(ErrorCode::EmptyShape, "NoOutline");
  if (!(outline.value().area > 0)) return refused(ErrorCode::EmptyShape, "NoInside");
  return outline;
}

}  // namespace

Result<Outline> borderOf(const std::vector<FilledPath>& paths, const InsideRule* rule, Points points) {
  const bool grid = points == Points::OnGrid;
  std::vector<PathEdge> edges = edgesOf(paths, rule ? std::vector<char>{} : coveredPaths(paths));
  if (grid) edges = gridEdges(edges);
  Outline outline;
  for (const PathEdge& edge : edges) outline.bounds.add(edge.a);
  if (edges.empty()) return outline;

  const std::optional<std::vector<PathEdge>> pieces = splitEdges(edges, outline.bounds, points);
  const auto sides = pieces ? sidesOf(*pieces, outline.bounds, paths, rule) : std::nullopt;
  if (!sides) {
    return refused(ErrorCode::TooLarge, "OutlineTooManyPieces");
  }
  for (std::size_t k = 0; k < pieces->size(); ++k) {
    const auto [left, right] = (*sides)[k];
    const PathEdge& piece = (*pieces)[k];
    if (left == right || length(piece.b - piece.a) <= kTouch) continue;
    outline.segments.push_back(left ? BorderSegment{piece.a, piece.b} : BorderSegment{piece.b, piece.a});
  }
  if (grid) {
    for (BorderSegment& s : outline.segments)
      s = {{s.a.x / kPerGrid, s.a.y / kPerGrid}, {s.b.x / kPerGrid, s.b.y / kPerGrid}};
    Bounds box;
    box.add({outline.bounds.min.x / kPerGrid, outline.bounds.min.y / kPerGrid});
    box.add({outline.bounds.max.x / kPerGrid, outline.bounds.max.y / kPerGrid});
    outline.bounds = box;
  }
  for (const BorderSegment& s : outline.segments) {
    outline.area += 0.5 * cross(s.a - outline.bounds.min, s.b - outline.bounds.min);
  }
  return outline;
}

Result<Outline> resolveOutline(const Shape& shape) { return outlineOf(shape, Points::AsGiven); }

Result<Outline> outlineOnGrid(const Shape& shape) { return outlineOf(shape, Points::OnGrid); }

}  // namespace sillon
