// Steps of resolveOutline(): from paths in any order to edges with the inside on their left.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "geometry/outline.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

// Inside along a line: edges of paths that cross it, and their winding numbers.

/// One side of a ring.
struct PathEdge {
  Vec2 a;
  Vec2 b;
  int path;
};

/// Collects the edges of all rings, except those of length 0.
/// \param without  if not empty, 1 for each path that is left out.
std::vector<PathEdge> edgesOf(const std::vector<FilledPath>& paths, const std::vector<char>& without = {});

/// Returns the direction in which an edge crosses a row: +1 upwards, -1 downwards, 0 not at all. Half-open in y, so
/// that a vertex on the row counts once.
inline int crossesRow(const PathEdge& edge, double y) {
  const bool below = edge.a.y <= y;
  return below == (edge.b.y <= y) ? 0 : (below ? 1 : -1);
}

inline double crossingX(const PathEdge& edge, double y) {
  return edge.a.x + (y - edge.a.y) / (edge.b.y - edge.a.y) * (edge.b.x - edge.a.x);
}

inline bool isFilled(FillRule rule, int winding) {
  return rule == FillRule::NonZero ? winding != 0 : (winding & 1) != 0;
}

/// Winding numbers of all paths along one line, and the number of paths that are filled there.
class WindingState {
 public:
  /// \param rule  null: a point is inside if any path is filled there.
  explicit WindingState(const std::vector<FilledPath>& paths, const InsideRule* rule = nullptr)
      : paths_(paths), rule_(rule), winding_(paths.size(), 0), filled_(rule ? paths.size() : 0, 0) {}

  void cross(int path, int direction) {
    const std::size_t k = path;
    int& winding = winding_[k];
    const FillRule rule = paths_[k].fillRule;
    inside_ -= isFilled(rule, winding) ? 1 : 0;
    winding += direction;
    inside_ += isFilled(rule, winding) ? 1 : 0;
    if (rule_) filled_[k] = isFilled(rule, winding) ? 1 : 0;
    touched_.push_back(path);
  }
  [[nodiscard]] bool inside() const { return rule_ ? (*rule_)(filled_) : inside_ > 0; }
  void reset() {
    for (const int path : touched_) {
      winding_[path] = 0;
      if (rule_) filled_[path] = 0;
    }
    touched_.clear();
    inside_ = 0;
  }

 private:
  const std::vector<FilledPath>& paths_;
  const InsideRule* rule_;
  std::vector<int> winding_;
  std::vector<char> filled_;
  std::vector<int> touched_;
  int inside_ = 0;
};

enum class Points { AsGiven, OnGrid };  ///< AsGiven keeps mm as they are; OnGrid takes whole steps of the grid

/// Returns the pieces with the inside on exactly one side, turned so that it is on their left; none if nothing is
/// inside.
/// \param rule  null: a point is inside if any path is filled there.
/// \return TooLarge under the conditions of resolveOutline().
Result<Outline> borderOf(const std::vector<FilledPath>& paths, const InsideRule* rule, Points points);

/// Marks paths that lie within one of the largest convex paths, so that the union is the same without them; of equal
/// paths one stays unmarked.
/// \return 1 or 0 for each path.
std::vector<char> coveredPaths(const std::vector<FilledPath>& paths);

inline constexpr double kTouch = 1e-7;  ///< points nearer to each other than this coincide [mm]

/// Rounds a point, given in steps of the grid, to the grid.
inline Vec2 onGrid(Vec2 p) { return {std::round(p.x) + 0.0, std::round(p.y) + 0.0}; }

/// Splits edges into pieces that meet at their ends only. Every ring stays closed.
/// \param box     box that holds the edges
/// \param points  OnGrid: edges and pieces are in whole steps of the grid
/// \return nothing if there are more than 4 million pieces, or if it would take too long.
std::optional<std::vector<PathEdge>> splitEdges(const std::vector<PathEdge>& edges, const Bounds& box, Points points);

/// Tells for both sides of a piece, seen from a to b, whether they are inside.
struct Sides {
  bool left = false;
  bool right = false;
};

/// Computes the sides of all pieces.
/// \param pieces  pieces of the paths' edges, which meet at their ends only
/// \param box     box that holds the pieces
/// \param rule    null: a point is inside if any path is filled there
/// \return one entry per piece; of pieces with the same ends, the first carries the result and the others have no
/// inside on either side. Nothing if it would take too long.
std::optional<std::vector<Sides>> sidesOf(const std::vector<PathEdge>& pieces, const Bounds& box,
                                          const std::vector<FilledPath>& paths, const InsideRule* rule);

}  // namespace sillon
