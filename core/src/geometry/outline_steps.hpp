// The steps of resolveOutline: from paths in any order to edges with the inside on their left.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "sillon/geometry/outline.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

// The inside along a line: edges of paths that cross it, and their winding numbers.

/// One side of a ring.
struct PathEdge {
  Vec2 a;
  Vec2 b;
  int path;
};

/// Collects the edges of all rings, without those of no length. \param without  where not empty, 1 for paths that are
/// left out.
std::vector<PathEdge> edgesOf(const std::vector<FilledPath>& paths, const std::vector<char>& without = {});

/// Half-open in y, so that a vertex on the line counts once. +1 upwards, -1 downwards, 0 none.
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

/// Winding numbers of all paths along one line, and how many paths are filled there.
class WindingState {
 public:
  /// \param rule  null: inside is where any path is filled.
  explicit WindingState(const std::vector<FilledPath>& paths, const InsideRule* rule = nullptr)
      : paths_(paths), rule_(rule), winding_(paths.size(), 0), filled_(rule ? paths.size() : 0, 0) {}

  void cross(int path, int direction) {
    const auto k = static_cast<std::size_t>(path);
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

enum class Points { AsGiven, OnGrid };  ///< mm as they are, or whole steps of the grid

/// The pieces with inside on exactly one side, on their left. No pieces if nothing is inside.
/// \param rule  null: inside is where any path is filled. \return TooLarge as resolveOutline.
Result<Outline> borderOf(const std::vector<FilledPath>& paths, const InsideRule* rule, Points points);

/// For each path 1 if it lies within one of the largest convex paths, so that all of them together are the same without
/// it; of equal paths one stays. \return as many as there are paths.
std::vector<char> coveredPaths(const std::vector<FilledPath>& paths);

inline constexpr double kTouch = 1e-7;  ///< points nearer than this coincide [mm]

/// The nearest point of the grid, of a point in its steps.
inline Vec2 onGrid(Vec2 p) { return {std::round(p.x) + 0.0, std::round(p.y) + 0.0}; }

/// The edges in pieces that meet at their ends only. Every ring stays closed.
/// \param box     that holds them
/// \param points  on the grid, edges and pieces are in whole steps of it
/// \return none if there are more than 4 million pieces, or that would take too long.
std::optional<std::vector<PathEdge>> splitEdges(const std::vector<PathEdge>& edges, const Bounds& box, Points points);

/// Tells for both sides of a piece, seen from a to b, whether the inside lies there.
struct Sides {
  bool left = false;
  bool right = false;
};

/// \param pieces  of the edges of paths, meeting at their ends only; box holds them
/// \param rule    null: inside is where any path is filled
/// \return of each piece; of those with the same ends, the first one's are told and the others have no inside on
///         either. None if that would take too long.
std::optional<std::vector<Sides>> sidesOf(const std::vector<PathEdge>& pieces, const Bounds& box,
                                          const std::vector<FilledPath>& paths, const InsideRule* rule);

}  // namespace sillon
