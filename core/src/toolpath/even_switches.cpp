#include <algorithm>
#include <cmath>
#include <tuple>

#include "toolpath/even_order.hpp"

namespace sillon {
namespace {

constexpr int kStride = 2;         ///< points from one that looks for a joint to the next
constexpr int kApart = 40;         ///< least distance of two joints between the same two strands [points]
constexpr int kLeastLoop = 40;     ///< shortest loop that a joint within a curve may split off [points]
constexpr float kStraight = 0.7f;  ///< cosine over four spacings; above it, a joint makes two U-turns
constexpr float kTurnCost = 0.3f;  ///< price of an added U-turn, to choose between neighbours [mm]
constexpr float kDearest = 1.5f;   ///< highest cost of a joint at the usual price of misalignment [mm]
constexpr int kTurnsOfJoint = 1;   ///< most U-turns that a joint may add
constexpr int kTurnsOfRings = 2;   ///< most of them between rings and between windings
constexpr int kFar = 1200;         ///< least distance along a curve of two of its windings [points]
constexpr int kFarStride = 40;     ///< points from one that looks for a joint between windings to the next
constexpr int kWinding = -2;       ///< Switch::ring of a joint between two windings of one curve

// The point that lies `steps` points after another on the same curve; before it where negative.
int stepped(const Beads& beads, const Joining& joining, int point, int steps) {
  const int curve = joining.curveOf(point);
  const int first = beads.curves.begin[curve];
  const int size = beads.curves.size(curve);
  return first + ((point - first + steps) % size + size) % size;
}

Vec2f tangentOf(const Beads& beads, const Joining& joining, int point) {
  return tangentAt(beads.curves, joining.curveOf(point), point);
}

// Compares the tangents eight points before and after, which are four spacings apart.
bool straightAround(const Beads& beads, const Joining& joining, int point) {
  return dot(tangentOf(beads, joining, stepped(beads, joining, point, -8)),
             tangentOf(beads, joining, stepped(beads, joining, point, 8))) > kStraight;
}

// The nearest points within reach on the left and right across the bead; -1 where there is none.
struct Neighbours {
  int left = -1;
  int right = -1;
};

template <class Wanted>
// Finds the nearest wanted point on either side. Points less than 0.4 spacings across or more than 0.7 along are no
// neighbours: they lie on the same strand, or ahead.
Neighbours besides(const Beads& beads, const Joining& joining, int point, float reach, const Wanted& wanted) {
  const Vec2f p = joining.at(point);
  const Vec2f t = tangentOf(beads, joining, point);
  Neighbours sides;
  float left = reach;
  float right = reach;
  beads.grid.around(p, reach, [&](int first, int last) {
    for (int k = first; k < last; ++k) {
      const Vec2f v{beads.grid.x[k] - p.x, beads.grid.y[k] - p.y};
      const float across = t.x * v.y - t.y * v.x;
      if (std::abs(across) < 0.4f * beads.spacing || std::abs(dot(t, v)) > 0.7f * beads.spacing) continue;
      const float away = length(v);
      if (away >= (across > 0 ? left : right) || !wanted(beads.grid.id[k], t)) continue;
      (across > 0 ? left : right) = away;
      (across > 0 ? sides.left : sides.right) = beads.grid.id[k];
    }
  });
  return sides;
}

// Collects what find(k, out) adds for each k, on the run's threads. Chunks of fixed size keep the order of the points,
// whatever the threads.
template <class Item, class Find>
std::vector<Item> found(int count, const RunContext& run, const Find& find) {
  constexpr int kGrain = 1024;
  std::vector<std::vector<Item>> some((count + kGrain - 1) / kGrain);
  parallelFor(run, count, kGrain, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) find(k, some[begin / kGrain]);
  });
  std::vector<Item> all;
  for (const std::vector<Item>& part : some) all.insert(all.end(), part.begin(), part.end());
  return all;
}

// Counts the U-turns that a joint adds to the four strands at its ends: those of the two joined lines, less those of
// the two lines as they are.
int turnsAdded(const Beads& beads, const Joining& joining, const Joint& joint) {
  constexpr int kStretchedBy = 10;
  const int begin = -(joint.span / 2);
  const int end = begin + joint.span;
  const auto append = [&](std::vector<Vec2f>& line, int point, int from, int to) {
    for (int k = from; k <= to; ++k) line.push_back(joining.at(stepped(beads, joining, point, k)));
  };
  std::vector<Vec2f> line;
  int turns = 0;
  // Each of the two strands as it is, then the line that the joint makes of one strand's begin and the other's end.
  for (const auto& [from, to] : {std::pair{joint.i, joint.j}, std::pair{joint.j, joint.i}}) {
    line.clear();
    append(line, from, begin - kStretchedBy, end + kStretchedBy);
    turns -= uTurnsOf(line, beads.spacing);
    line.clear();
    append(line, from, begin - kStretchedBy, begin);
    append(line, to, end, end + kStretchedBy);
    turns += uTurnsOf(line, beads.spacing);
  }
  return turns;
}

// A joint that could be made, ordered by cost. Its two ends may both have found it, as joints of different kinds; ties
// are broken by all of its figures, so that threads do not matter.
struct Possible {
  float cost;
  Switch made;

  bool operator<(const Possible& other) const {
    return std::tie(cost, made.joint.i, made.joint.j, made.ring) <
           std::tie(other.cost, other.made.joint.i, other.made.joint.j, other.made.ring);
  }
};

// Index of the stretches of two strands that have a joint, by blocks of `apart` points of the lower end.
class Taken {
 public:
  /// \param apart  points from one joint to the next
  Taken(int points, int apart) : apart_(apart), at_(points / apart + 2) {}

  void take(const Joint& joint) { at_[joint.i / apart_].push_back({joint.i, joint.j}); }

  // Tells whether a joint lies less than `apart` points away on both strands.
  [[nodiscard]] bool near(const Joint& joint) const {
    const int own = joint.i / apart_;
    for (int k = std::max(0, own - 1); k <= own + 1; ++k) {
      for (const Link& other : at_[k]) {
        if (std::abs(other.a - joint.i) < apart_ && std::abs(other.b - joint.j) < apart_) return true;
      }
    }
    return false;
  }

 private:
  int apart_;
  std::vector<std::vector<Link>> at_;
};

// Numbers the pairs of curves that are joined amid straight strands.
class Rings {
 public:
  explicit Rings(std::size_t curves) : others_(curves) {}

  int add(int a, int b) {
    if (const int known = numberOf(a, b); known >= 0) return known;
    others_[a].push_back({b, count_});
    others_[b].push_back({a, count_});
    return count_++;
  }
  [[nodiscard]] bool any(int curve) const { return !others_[curve].empty(); }
  [[nodiscard]] int numberOf(int a, int b) const {
    for (const auto& [other, number] : others_[a]) {
      if (other == b) return number;
    }
    return -1;
  }

 private:
  std::vector<std::vector<std::pair<int, int>>> others_;
  int count_ = 0;
};

// Keeps the cheapest joint of each stretch that is not taken, as greedy suppression does.
void thinOut(std::vector<Possible>& possible, Taken taken) {
  std::sort(possible.begin(), possible.end());
  std::erase_if(possible, [&](const Possible& one) {
    if (taken.near(one.made.joint)) return true;
    taken.take(one.made.joint);
    return false;
  });
}

}  // namespace

std::vector<Link> linksBeside(const Beads& beads, const Joining& joining, const RunContext& run) {
  const int count = static_cast<int>(beads.curves.points.size());
  return found<Link>((count + kPointsPerLink - 1) / kPointsPerLink, run, [&](int k, std::vector<Link>& out) {
    const int point = k * kPointsPerLink;
    const Neighbours sides = besides(beads, joining, point, 1.45f * beads.spacing, [](int, Vec2f) { return true; });
    if (sides.left >= 0) out.push_back({point, sides.left});
    if (sides.right >= 0) out.push_back({point, sides.right});
  });
}

std::vector<Switch> findSwitches(const Beads& beads, double stitchAlignment, const Joining& joining,
                                 const RunContext& run) {
  // Plates with pictures weigh misalignment more than usual: scale the limit up and the cost down to compare alike.
  const float dearest = kDearest * static_cast<float>(std::max(1.0, stitchAlignment / kUsualPrice));
  const float price = static_cast<float>(kUsualPrice / std::max(kUsualPrice, stitchAlignment));
  const int count = static_cast<int>(beads.curves.points.size());
  // 1. Joints that are made become switches that are on, and take their stretch.
  std::vector<Switch> switches;
  Taken taken(count, kApart);
  for (const Joint& joint : joining.made()) {
    taken.take({std::min(joint.i, joint.j), std::max(joint.i, joint.j), joint.span});
    switches.push_back({joint, joining.cost(joint.i, joint.j, joint.span), turnsAdded(beads, joining, joint)});
  }
  // 2. Joints with two U-turns tell which pairs of curves are rings; the pair is numbered.
  Rings rings(beads.curves.begin.size() - 1);
  for (Switch& one : switches) {
    if (one.turns > kTurnsOfJoint) one.ring = rings.add(joining.curveOf(one.joint.i), joining.curveOf(one.joint.j));
  }

  // 3. Each second point looks for possible joints with its neighbours in the opposite sense. Within one curve a joint
  // must split off a real loop; amid straight strands only rings and windings count.
  const auto look = [&](int i, int j, bool straight, std::vector<Possible>& out) {
    if (j < 0) return;
    int ring = straight ? rings.numberOf(joining.curveOf(i), joining.curveOf(j)) : -1;
    if (joining.curveOf(i) == joining.curveOf(j)) {
      const int apart = std::abs(i - j);
      const int along = std::min(apart, beads.curves.size(joining.curveOf(i)) - apart);
      if (along < kLeastLoop) return;
      if (ring < 0 && straight && along > kFar && i % kFarStride == 0) ring = kWinding;
    }
    if (straight && ring == -1) return;
    const Joint joint{std::min(i, j), std::max(i, j), kSpan};
    const float miss = joining.cost(joint.i, joint.j, kSpan);
    if (miss < dearest) out.push_back({miss, {joint, miss, 0, ring}});
  };
  std::vector<Possible> possible = found<Possible>((count + kStride - 1) / kStride, run, [&](int k, auto& out) {
    const int i = k * kStride;
    // Amid straight strands most points are skipped, as only rings and windings could use them.
    const bool straight = straightAround(beads, joining, i);
    if (straight && i % kFarStride != 0 && !rings.any(joining.curveOf(i))) return;
    const Neighbours sides = besides(beads, joining, i, 1.8f * beads.spacing,
                                     [&](int j, Vec2f t) { return dot(t, tangentOf(beads, joining, j)) <= -0.7f; });
    look(i, sides.left, straight, out);
    look(i, sides.right, straight, out);
  });
  // 4. Thin out, count turns, and thin out again by the cost with turns. Turns are counted for few joints, as that
  // takes longer than all the rest.
  thinOut(possible, Taken(count, kApart / 8));
  parallelForEach(run, static_cast<int>(possible.size()), 64, [&](int k) {
    Switch& made = possible[k].made;
    made.turns = turnsAdded(beads, joining, made.joint);
    possible[k].cost = price * made.miss + kTurnCost * static_cast<float>(made.turns);
  });
  std::erase_if(possible, [](const Possible& one) {
    return one.made.turns > (one.made.ring == -1 ? kTurnsOfJoint : kTurnsOfRings);
  });
  thinOut(possible, taken);
  for (const Possible& one : possible) switches.push_back(one.made);
  return switches;
}

}  // namespace sillon
