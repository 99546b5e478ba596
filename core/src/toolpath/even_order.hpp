// The order in which the beads of a joined path are laid: neighbours soon after one another.
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

/// Curves and their points, on which the order is searched.
struct Beads {
  const ClosedCurves& curves;
  const PointGrid& grid;
  const BorderIndex& border;
  float spacing;  ///< tau [mm]
};

/// Exchanges joints until neighbouring beads are laid soon after one another, and makes each path begin at the end of
/// its sweep. Every set is one curve before and after, and no point moves. U-turns and misaligned length may grow by
/// the limits in even_search.cpp. The work grows with the points. \return false where the run was cancelled.
bool evenOrder(const Beads& beads, const ToolpathParams& params, Joining& joining, const RunContext& run);

// Parts of it.

/// Two points side by side, whose beads touch.
struct Link {
  int a;
  int b;
};

/// Finds the nearest point on either side of every twelfth one. In order of the first point.
std::vector<Link> linksBeside(const Beads& beads, const Joining& joining, const RunContext& run);
/// Price of misalignment that the costs below were chosen for.
inline constexpr double kUsualPrice = ToolpathParams{}.stitchAlignment;

inline constexpr int kPointsPerLink = 12;

/// A joint, made or possible.
struct Switch {
  Joint joint;
  float miss;  ///< cost of the joint as Joining says [mm]
  int turns;   ///< U-turns that it adds, roughly
  /// Number of the two curves that it joins amid straight strands, as rings are joined: it makes two U-turns wherever
  /// between the two it is. -1: it joins others; below: two windings of one curve, likewise amid straight strands.
  int ring = -1;
};

/// The joints made, and all others that would cost little, the cheapest of each stretch of two strands: amid straight
/// ones, where a joint makes two U-turns, only between curves that have such a joint, and between windings of one.
std::vector<Switch> findSwitches(const Beads& beads, double stitchAlignment, const Joining& joining,
                                 const RunContext& run);

/// U-turns of a polyline as they will be once it is relaxed, counted as the report does.
/// \param places  gets where they are.
int uTurnsOf(std::vector<Vec2f>& line, float spacing, std::vector<Vec2f>* places = nullptr);

/// U-turns of the path near the ends of two joints, as they are now. Calls before and after a toggle of both compare.
int uTurnsNear(const Beads& beads, const Joining& joining, const Joint& a, const Joint& b);

/// Four cuts of a closed path, ascending: it goes W X Y Z, and with the blocks exchanged W Z Y X.
using Cuts = std::array<int, 4>;

/// A closed path cut into elements, whose order changes, and how late neighbours are laid in it.
class Tour {
 public:
  /// \param size  of the path [points]. \param cuts  where elements begin, ascending, the first at 0.
  /// \param links  by places on the path. \param pointSeconds  from a point to the next.
  Tour(int size, std::vector<int> cuts, const std::vector<Link>& links, double pointSeconds);

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] int elementAt(int place) const;  ///< the element that holds a place of the first order
  [[nodiscard]] int beginOf(int element) const { return begin_[element]; }  ///< its place now
  [[nodiscard]] int endOf(int element) const { return begin_[element] + length_[element]; }
  [[nodiscard]] int placeNow(int place) const;  ///< where the point is now that was at a place at first

  /// Work of a Split: elements, and pairs of them side by side.
  [[nodiscard]] std::int64_t work() const { return static_cast<std::int64_t>(bonds_.size() + order_.size()); }
  /// Lateness of all neighbours, in links: one half each for 30 s and for 120 s, and a tenth for 1000 s.
  [[nodiscard]] double lateness() const;
  /// Tells how much an exchange lessens the lateness.
  [[nodiscard]] double gain(const Cuts& cuts) const;
  void exchange(const Cuts& cuts);
  /// Changes of the lateness where the path begins at each place instead of being seen as a ring; below 0 where it
  /// falls.
  [[nodiscard]] std::vector<double> latenessOfBegins(const std::vector<Link>& links) const;

  /// Gains of all exchanges with one pair of cuts, after some work that is done once for the pair.
  class Split {
   public:
    /// Memory that one split leaves to the next, so that none is allocated.
    class Room;
    Split(const Tour& tour, int low, int high, Room& room);
    /// Bounds gain() from above, without its work. \param a,b  as there.
    [[nodiscard]] double atMost(int a, int b) const;
    /// Tells what the exchange gains. \param a,b  the other two cuts, one strictly between the pair and one outside,
    /// each as the end of an element. \param least  gains below this need not be exact. \param work  grows by the links
    /// that were looked at.
    [[nodiscard]] double gain(int a, int b, double least, std::int64_t& work) const;

   private:
    struct Cut {
      int in, out;        ///< places of the other two cuts
      std::int64_t late;  ///< lateness of the links that the first pair does not separate
    };
    struct Across {
      int in, out;  ///< begins of the elements, within the pair of cuts and from the second one on
      int offset;
      int weight;
    };
    [[nodiscard]] Cut cutAt(int a, int b) const;

    const Tour& tour_;
    int low_, high_;
    std::int64_t kept_ = 0;             ///< lateness of links that no cut separates
    std::vector<std::int64_t>& added_;  ///< by rank of the element at which a cut is made
    std::vector<Across>& across_;
  };

 private:
  struct Bond {  ///< all links between two elements
    int a, b;
    int offset;  ///< mean difference of the places in them
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
  std::vector<int> begin_, length_;  ///< of each element
  std::vector<int> order_, rank_;
  std::vector<int> orderedBegin_;
  std::vector<Bond> bonds_;
  std::vector<int> firstBeside_;
  std::vector<Beside> beside_;
  std::vector<int> late_;  ///< lateness of a link, by its delay
  std::int64_t now_ = 0;
};

class Tour::Split::Room {
  friend class Split;
  struct Place {
    int begin, rank;
  };
  std::vector<Place> places_;  ///< of each element, from the first cut on
  std::vector<std::int64_t> added_;
  std::vector<Across> across_;
};

/// A path whose order is searched: its points in the order that it has at first, and what lies at places on it.
struct PathOrder {
  std::vector<int> points;
  std::vector<Link> links;
  std::vector<Switch> switches;
  std::vector<Link> cuts;  ///< of each switch, the places after which it cuts
  double begin = 0;        ///< share of the stage at which its search begins, for the progress
  double end = 1;          ///< share at which it ends
};

/// Toggles switches of a path two by two, so that it stays one, until its order is even. \return the order then.
Tour searchOrder(const Beads& beads, const ToolpathParams& params, PathOrder& path, Joining& joining,
                 const RunContext& run);

}  // namespace sillon
