#include "geometry/outline.hpp"

#include <cmath>
#include <cstddef>
#include <optional>

#include "base/numbers.hpp"
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
    return Error{ErrorCode::InvalidArgument, "the shape has a point at " + shownNumber(far->x) + ", " +
                                                 shownNumber(far->y) +
                                                 " mm; both coordinates must be -1000000 to 1000000 mm"};
  }
  Result<Outline> outline = borderOf(shape.paths, nullptr, points);
  if (!outline) return outline;
  if (outline.value().bounds.empty()) {
    return Error{ErrorCode::EmptyShape, "the shape has no outline; it needs at least one closed path"};
  }
  if (!(outline.value().area > 0)) {
    return Error{ErrorCode::EmptyShape, "the shape encloses no area; it needs at least one closed path with an inside"};
  }
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
    return Error{ErrorCode::TooLarge,
                 "the outline has too many edges or meets itself too often; at most 4 million pieces can be read; "
                 "merge its paths in a drawing program, or draw it as a PNG"};
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
