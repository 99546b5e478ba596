// Closed curves while they are being joined (Sec. 5.5): which of them are one already, whether a joint is possible, and
// which points face each other across room without curves, however far.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "field/fields.hpp"
#include "geometry/parts.hpp"
#include "geometry/point_grid.hpp"
#include "geometry/signed_distance.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// A joint that may be made: a piece of each of two curves is taken out, and two new edges close the gap crosswise.
struct Candidate {
  float cost;
  int i;     ///< middle of the piece of one curve
  int j;     ///< middle of the piece of the other curve
  int span;  ///< segments taken out of each curve
};

/// Segments taken out of each curve: four of tau/4 are one spacing, so that the two new U-turns fit side by side.
inline constexpr int kSpan = 4;

/// A joint that can be made and undone: between two curves, which it joins, or within one, which it splits.
struct Joint {
  int i;          ///< middle of one piece
  int j;          ///< middle of the other piece
  int span;       ///< segments taken out of each
  float gap = 0;  ///< length of a new edge that may lie outside the shape [mm]
  bool on = false;
};

/// Joins closed curves: takes a piece out of each of two and closes the ends crosswise, joint by joint. The points
/// never move. A set is a group of curves that joints have made one; it is named by its lowest curve.
class Joining {
 public:
  /// All arguments must outlive the object. \param grid  the points of `curves`.
  Joining(const ClosedCurves& curves, const PointGrid& grid, const LineField& lines, const BorderIndex& border,
          const ToolpathParams& params);

  [[nodiscard]] int curveOf(int point) const { return curveOf_[point]; }
  [[nodiscard]] int setOf(int curve);
  /// Tells whether a joint has used the point, as an end or by taking it out: no other may.
  [[nodiscard]] bool used(int point) const { return used_[point] != kFree; }
  [[nodiscard]] Vec2f at(int point) const { return curves_.points[point]; }

  /// Cost of joining the pieces of `span` segments around i and j [mm]: 0.65 of the length it adds (Eq. 14), plus
  /// `stitchAlignment` times the misaligned length it adds.
  [[nodiscard]] float cost(int i, int j, int span) const;
  /// Length of the two new edges that lies outside the shape [mm], by samples tau/16 apart; infinite if an edge gets
  /// farther from the shape than half a bridge and half a bead.
  [[nodiscard]] float outsideLength(int i, int j, int span) const;

  /// Joins if nothing stands against it: the curves are of two sets, no piece touches a used one, and neither the new
  /// edges nor the line between the pieces' middles meet another edge. The work grows with the edges' length.
  /// \param gap  length of each new edge that may lie outside the shape [mm].
  bool join(const Candidate& candidate, float gap);
  /// The joints that join() made, in their order.
  [[nodiscard]] const std::vector<Joint>& made() const { return made_; }

  /// Undoes a joint that is on and makes one that is off, whatever the sets are. Sets are not updated: the caller must
  /// see to it that each is one curve again in the end.
  /// \return false if something stands against it: when a joint is made, by the rules of join(); when it is undone,
  /// another joint across the segments that would come back.
  bool toggle(Joint& joint);
  /// Tells whether a joint that is off would touch a used point.
  [[nodiscard]] bool blocked(const Joint& joint) const;
  /// First points of the two pieces of a joint. Both stay on the path when it is made or undone.
  [[nodiscard]] std::pair<int, int> beginsOf(const Joint& joint) const;
  /// Part of a segment's length that runs across the wanted lines: its length times sin² of the angle [mm].
  [[nodiscard]] float misalignment(Vec2f a, Vec2f b) const;
  [[nodiscard]] bool onPath(int point) const {
    return !inner(point);
  }                                                                  ///< tells whether no joint has taken the point out
  [[nodiscard]] int after(int point) const { return next_[point]; }  ///< the point after one that is on the path
  [[nodiscard]] int before(int point) const { return previous_[point]; }
  /// Makes the path of the point's set begin at it.
  void beginAt(int point) { begins_.push_back(point); }

  /// The curves as they are now, one for each set, in order of their lowest curves.
  [[nodiscard]] ClosedCurves joined() const;
  [[nodiscard]] float longestJoint() const;                   ///< [mm]
  [[nodiscard]] int gapJoints() const { return gapJoints_; }  ///< joints that lie outside the shape in part

 private:
  // A piece of a curve that a joint takes out, from its first point to its last.
  struct TakenPiece {
    int begin;
    int end;
    int segments;
    float length;  ///< [mm]
  };
  // A new edge between the ends of two pieces.
  struct JointEdge {
    int from;
    int to;
  };
  // State of a point: on no piece, at the end of one, or taken out.
  enum Use : char { kFree, kEnd, kInner };

  [[nodiscard]] bool inner(int point) const { return used_[point] == kInner; }
  [[nodiscard]] TakenPiece pieceAround(int point, int wanted) const;
  template <class Visit>
  void forSegments(const TakenPiece& piece, const Visit& visit) const;
  [[nodiscard]] float misalignment(const TakenPiece& piece) const;
  [[nodiscard]] bool touchesUsed(const TakenPiece& piece) const;
  [[nodiscard]] bool overlap(const TakenPiece& a, const TakenPiece& b) const;
  void markUsed(const TakenPiece& piece);
  void unmark(const TakenPiece& piece);
  [[nodiscard]] bool live(int point) const;
  [[nodiscard]] bool meetsLiveEdge(const JointEdge& edge) const;
  [[nodiscard]] bool meetsCurve(const JointEdge& edge, Vec2f middle, float reach) const;
  [[nodiscard]] bool meetsJoint(const JointEdge& edge, Vec2f middle, int cells) const;
  [[nodiscard]] float outsideLength(const JointEdge& edge, float enough) const;
  [[nodiscard]] std::pair<int, int> jointCell(Vec2f p) const;
  template <class Visit>
  void forCells(const JointEdge& edge, const Visit& visit);
  void addJoint(const JointEdge& edge);
  void removeJoint(const JointEdge& edge);
  [[nodiscard]] bool leavesShape(const JointEdge& e, const JointEdge& f) const;
  bool make(const Joint& joint);
  bool undo(const Joint& joint);
  void link(int from, int to);

  const ClosedCurves& curves_;
  const PointGrid& grid_;
  const LineField& lines_;
  const BorderIndex& border_;
  float spacing_;
  float alignmentCost_;
  float farthest_;  ///< greatest distance of an edge from the shape: what is farther belongs to no part [mm]
  std::vector<std::int32_t> curveOf_;
  std::vector<int> next_;  ///< successor of each point along the curves as joined
  std::vector<int> previous_;
  std::vector<Use> used_;
  std::vector<int> root_;                                             ///< parents in the union-find forest of sets
  std::unordered_map<std::uint64_t, std::vector<JointEdge>> joints_;  ///< edges of joints, by the cells they pass
  std::vector<Joint> made_;
  std::vector<int> begins_;
  int gapJoints_ = 0;
};

/// The cell that holds p, or, if that lies outside all parts, the first of its neighbours that belongs to one.
std::size_t cellInPart(const Parts& parts, Vec2f p);

/// Finds pairs of points of different sets that face each other: every point spreads over the cells of its part until
/// it meets the region of another, and each border between two regions gives a pair (a Voronoi diagram by breadth-first
/// search). Of two sets, the points that are nearest to each other on a way within the part are among the pairs. The
/// work is linear in the cells.
/// \param setOfPoint  set of each point; -1: the point does not spread. \return each pair once, the lower index first,
/// in ascending order.
std::vector<std::pair<int, int>> facingPoints(const Parts& parts, const std::vector<Vec2f>& points,
                                              const std::vector<int>& setOfPoint);

}  // namespace sillon
