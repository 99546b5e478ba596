// What lies inside along a line: edges of paths that cross it, and their winding numbers.
#pragma once

#include <cstddef>
#include <vector>

#include "sillon/geometry/outline.hpp"

namespace sillon {

/// One side of a ring.
struct PathEdge {
  Vec2 a;
  Vec2 b;
  int path;
};

/// Of all rings, without those of no length. \param without  where not empty, 1 for paths that are left out.
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

}  // namespace sillon
