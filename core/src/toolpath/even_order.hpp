// Even order: exchanges joints of a path so that neighbouring beads are laid soon after one another.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/parallel_for.hpp"
#include "geometry/closed_curves.hpp"
#include "geometry/point_grid.hpp"
#include "geometry/signed_distance.hpp"
#include "sillon/settings/project.hpp"
#include "toolpath/joining.hpp"

namespace sillon {

/// The curves and their points, on which the order is searched.
struct Beads {
  const ClosedCurves& curves;
  const PointGrid& grid;
  const BorderIndex& border;
  float spacing;  ///< tau [mm]
};

/// Exchanges joints until neighbouring beads are laid soon after one another, and makes each path begin at the end of
/// its sweep. Every set of joined curves is one curve before and after, and no point moves. U-turns and misaligned
/// length may grow by the limits in even_search.cpp. The work grows in proportion to the points. \return false if the
/// run was cancelled.
bool evenOrder(const Beads& beads, const ToolpathParams& params, Joining& joining, const RunContext& run);

// The steps of evenOrder().

/// Two points side by side, whose beads touch.
struct Link {
  int a;
  int b;
};

/// Finds the nearest point on either side of every kPointsPerLink-th point. The links are in order of their first
/// point.
std::vector<Link> linksBeside(const Beads& beads, const Joining& joining, const RunContext& run);
/// Price of misalignment for which the other costs of the search were chosen.
inline constexpr double kUsualPrice = ToolpathParams{}.stitchAlignment;

/// Points from one link to the next: a link stands for three spacings of bead, as points are tau/4 apart.
inline constexpr int kPointsPerLink = 12;

/// A joint that is made (on) or could be made (off).
struct Switch {
  Joint joint;
  float miss;  ///< cost of the joint by Joining::cost [mm]
  int turns;   ///< U-turns that the joint adds, roughly
  /// Number of the pair of curves that the switch joins amid straight strands, as rings are joined: the joint makes two
  /// U-turns wherever between the two it is. -1 for all other switches; kWinding (-2) for two windings of one curve,
  /// likewise amid straight strands.
  int ring = -1;
};

/// Finds the joints that are made and, for each stretch of two strands, the cheapest one that could be made. Amid
/// straight strands, where a joint makes two U-turns, it offers joints only between curves that already have such a
/// joint, and between windings of one curve.
std::vector<Switch> findSwitches(const Beads& beads, double stitchAlignment, const Joining& joining,
                                 const RunContext& run);

/// Counts the U-turns that a polyline will have once it is relaxed, as the report does. The line is smoothed in place.
/// \param places  receives their places, unless null.
int uTurnsOf(std::vector<Vec2f>& line, float spacing, std::vector<Vec2f>* places = nullptr);

/// Counts the U-turns of the path near the ends of two joints, as they are now. Two calls, before and after both joints
/// are toggled, tell what the toggle adds.
int uTurnsNear(const Beads& beads, const Joining& joining, const Joint& a, const Joint& b);

/// Four cuts of a closed path, ascending. They bound the blocks W X Y Z; exchanging X and Z gives W Z Y X, a double
/// bridge move.
using Cuts = std::array<int, 4>;

/// A closed path cut into elements whose order may change. It keeps account of how late neighbours are laid.
class Tour {
 public:
  /// \param size  points of the path. \param cuts  places where elements begin, ascending, the first at 0.
  /// \param links  pairs of places on the path. \param pointSeconds  time from one point to the next [s].
  Tour(int size, std::vector<int> cuts, const std::vector<Link>& links, double pointSeconds);

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] int elementAt(int place) const;  ///< element that holds a place of the initial order
  [[nodiscard]] int beginOf(int element) const { return begin_[element]; }  ///< place at which the element begins now
  [[nodiscard]] int endOf(int element) const { return begin_[element] + length_[element]; }
  [[nodiscard]] int placeNow(int place) const;  ///< place now of the point that was at `place` in the initial order

  /// Work of building a Split: elements plus bonds between them.
  [[nodiscard]] std::int64_t work() const { return static_cast<std::int64_t>(bonds_.size() + order_.size()); }
  /// Lateness of all neighbours, in links: each counts up to a half for 30 s, a half for 120 s and a tenth for 1000 s.
  [[nodiscard]] double lateness() const;
  /// Tells by how much an exchange of X and Z lowers the lateness.
  [[nodiscard]] double gain(const Cuts& cuts) const;
  /// Exchanges the blocks X and Z.
  void exchange(const Cuts& cuts);
  /// Change of the lateness for each place at which the path could begin, relative to the path as a ring; negative
  /// where it falls.
  [[nodiscard]] std::vector<double> latenessOfBegins(const std::vector<Link>& links) const;

  /// Gains of all exchanges that share one pair of cuts, after some work that is done once for the pair.
  class Split {
   public:
    /// Memory that one split leaves to the next, so that splits allocate nothing.
    class Room;
    Split(const Tour& tour, int low, int high, Room& room);
    /// Bounds gain() from above at a fraction of its cost. \param a,b  as in gain().
    [[nodiscard]] double atMost(int a, int b) const;
    /// Computes what the exchange gains. \param a,b  elements at whose ends the other two cuts are, one strictly
    /// between the pair and one outside. \param least  gains below this need not be exact. \param work  grows by the
    /// links that were looked at.
    [[nodiscard]] double gain(int a, int b, double least, std::int64_t& work) const;

   private:
    struct Cut {
      int in, out;        ///< places of the other two cuts, between the pair and outside
      std::int64_t late;  ///< lateness of the links whose two ends lie on the same side of the pair
    };
    struct Across {
      int in, out;  ///< begins of the elements, between the pair of cuts and from the second one on
      int offset;
      int weight;
    };
    [[nodiscard]] Cut cutAt(int a, int b) const;

    const Tour& tour_;
    int low_, high_;
    std::int64_t kept_ = 0;             ///< lateness of the links that no cut separates
    std::vector<std::int64_t>& added_;  ///< lateness that a cut adds, by the rank of the element after which it is made
    std::vector<Across>& across_;
  };

 private:
  struct Bond {  ///< all links between two elements
    int a, b;
    int offset;  ///< mean difference of the links' places within their elements
    int weight;
  };
  struct Beside {
    int other;
    int offset;
    int weight;
  };
  [[nodiscard]] int late(int apart) const { return late_[static_cast<unsigned>(apart) / kLateStep]; }
  [[nodiscard]] int lateRound(int apart) const { return late(apart < size_ - apart ? apart : size_ - apart); }
  [[nodiscard]] int rankAt(int place) const;

  static constexpr int kLateStep = 16;
  int size_;
  std::vector<int> cuts_;
  std::vector<int> begin_, length_;  ///< by element: place now, and points
  std::vector<int> order_, rank_;
  std::vector<int> orderedBegin_;
  std::vector<Bond> bonds_;
  std::vector<int> firstBeside_;
  std::vector<Beside> beside_;
  std::vector<int> late_;  ///< lateness of a link, by its delay in steps of kLateStep points
  std::int64_t now_ = 0;
};

class Tour::Split::Room {
  friend class Split;
  struct Place {
    int begin, rank;
  };
  std::vector<Place> places_;  ///< by element, as seen from the first cut
  std::vector<std::int64_t> added_;
  std::vector<Across> across_;
};

/// A path whose order is searched: its points in the initial order, and what lies at places on it.
struct PathOrder {
  std::vector<int> points;
  std::vector<Link> links;
  std::vector<Switch> switches;
  std::vector<Link> cuts;  ///< by switch: the two places after which it cuts
  double begin = 0;        ///< share of the stage at which the search of this path begins, for the progress
  double end = 1;          ///< share at which it ends
};

/// Toggles switches of a path in pairs, so that the path stays one curve, until its order is even. \return the order at
/// the end.
Tour searchOrder(const Beads& beads, const ToolpathParams& params, PathOrder& path, Joining& joining,
                 const RunContext& run);

}  // namespace sillon
