#include "toolpath/path.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/parallel_for.hpp"
#include "base/sort_key.hpp"
#include "geometry/closed_curves.hpp"
#include "geometry/point_grid.hpp"
#include "toolpath/even_order.hpp"
#include "toolpath/joining.hpp"

namespace sillon {
namespace {

constexpr int kFirstStride = 4;  ///< points between two that seek partners in the first round: most curves need no more
constexpr float kFarthestOutside = 8;  ///< most of an edge between facing points that may lie outside [spacings]
constexpr float kOutsideCost = 4;      ///< cost of a mm outside the shape, against 0.65 of a mm of added length
constexpr int kMaxRounds = 60;         ///< most rounds of one go; far more than any plate needs
constexpr int kMaxGoes = 8;            ///< most goes in which the paths so far are curves again

/// Places in which partners are looked for. Each search begins only when the one before leads to no more joints.
enum class SearchKind {
  Nearest,         ///< the nearest point on either side
  Near,            ///< all near points, and shorter pieces
  AcrossGaps,      ///< the same, and joints may leave the shape by the width of a bridged gap
  AcrossWideGaps,  ///< the same with twice the reach: beads in two facing tips lie further apart than the tips
  Facing,          ///< points that face each other, however far; joints may leave the shape for some spacings
  AroundFacing,    ///< the same, and points near to these: a tip may be too sharp, or another strand the outer one
};

SearchKind wider(SearchKind search) { return static_cast<SearchKind>(static_cast<int>(search) + 1); }

/// Limits of one search. Searches from Facing on have no limit of distance.
struct SearchLimits {
  float reach;           ///< greatest distance of joined pieces [mm]
  std::size_t partners;  ///< most partners tried per point
  int leastSpan;         ///< segments in the shortest piece
  float gap;             ///< length of each new edge that may lie outside the shape [mm]
  bool nearestOnly = false;
  int stride = 1;  ///< points along a curve from one that looks for partners to the next
};

SearchLimits limitsOf(SearchKind search, const ToolpathParams& params) {
  const float spacing = static_cast<float>(params.spacing);
  const float reach = 1.8f * spacing;
  // Room for joints that cross a gap at a slant (1.2), and for the error of samples.
  const float gap = 1.2f * static_cast<float>(params.bridge.value_or(params.spacing)) + 0.125f * spacing;
  switch (search) {
    case SearchKind::Nearest:
      return {reach, 2, kSpan, 0, true};
    case SearchKind::Near:
      return {reach, 6, 1, 0};
    case SearchKind::AcrossGaps:
      return {reach, 6, 1, gap};
    case SearchKind::AcrossWideGaps:
      return {2 * reach, 24, 1, 2 * gap};
    case SearchKind::Facing:
    case SearchKind::AroundFacing:
      break;
  }
  return {std::numeric_limits<float>::max(), 1, 1, std::max(2 * gap, kFarthestOutside * spacing)};
}

// The sets that a round is to join.
struct SetsToJoin {
  std::vector<int> ofCurve;   ///< set of each curve
  std::vector<char> open;     ///< curves of parts that are not one set yet
  std::vector<char> seeking;  ///< curves of these outside their part's largest set: they look for partners
  bool any = false;
};

// Finds the parts with more than one set. The largest set of each, by points, waits for the others: one side is enough
// to find a joint, and it has most of the points.
SetsToJoin setsToJoin(const ClosedCurves& curves, const std::vector<int>& partOfCurve, int parts, Joining& joining) {
  const std::size_t count = partOfCurve.size();
  SetsToJoin sets{std::vector<int>(count), std::vector<char>(count, 0), std::vector<char>(count, 0)};
  std::vector<int> points(count, 0);
  std::vector<int> setsOfPart(parts, 0);
  for (std::size_t c = 0; c < count; ++c) {
    sets.ofCurve[c] = joining.setOf(static_cast<int>(c));
    points[sets.ofCurve[c]] += curves.size(static_cast<int>(c));
    if (sets.ofCurve[c] == static_cast<int>(c) && partOfCurve[c] >= 0) ++setsOfPart[partOfCurve[c]];
  }
  // The largest set of each part; the lower one of two as large.
  std::vector<int> largest(setsOfPart.size(), -1);
  for (std::size_t c = 0; c < count; ++c) {
    if (partOfCurve[c] < 0 || sets.ofCurve[c] != static_cast<int>(c)) continue;
    int& top = largest[partOfCurve[c]];
    if (top < 0 || points[c] > points[top]) top = static_cast<int>(c);
  }
  for (std::size_t c = 0; c < count; ++c) {
    if (partOfCurve[c] < 0 || setsOfPart[partOfCurve[c]] < 2) continue;
    sets.open[c] = 1;
    sets.seeking[c] = sets.ofCurve[c] != largest[partOfCurve[c]] ? 1 : 0;
    sets.any = true;
  }
  return sets;
}

// The curves and what belongs to each of their points: all that a round looks at.
struct Strands {
  const ClosedCurves& curves;
  const PointGrid& grid;
  const std::vector<int>& curveAt;  ///< curve of each point of the grid
  const std::vector<int>& partAt;  ///< part of each point of the grid, and four more, as vector loads read past the end
  const Parts& parts;
  const std::vector<int>& partOfCurve;
};

struct Partner {
  float distance2;
  int point;
};

void sortNearestFirst(std::vector<Partner>& partners) {
  std::sort(partners.begin(), partners.end(), [](const Partner& a, const Partner& b) {
    return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.point < b.point;
  });
}

// Set of each point of the grid, -1 where a joint has used it; and four more, as vector loads read past the end.
std::vector<std::int32_t> freeSets(const Strands& strands, const Joining& joining, const SetsToJoin& sets,
                                   const RunContext& run) {
  std::vector<std::int32_t> free(strands.grid.id.size(), -1);
  parallelForEach(run, strands.grid.count(), 8192, [&](std::size_t s) {
    if (!joining.used(strands.grid.id[s])) free[s] = sets.ofCurve[strands.curveAt[s]];
  });
  return free;
}

// The nearest point on one side, by SIMD lane; of two as near, the one of lower index.
struct NearestLanes {
  F4 distance2;
  I4 point = splatInt(INT32_MAX);

  // Takes a point in each lane where it is wanted and nearer, without branches.
  void look(I4 wanted, F4 to2, I4 id) {
    const I4 asNear = (to2 > distance2) == splatInt(0);
    const I4 take = wanted & ((to2 < distance2) | (asNear & (id < point)));
    distance2 = select4(take, to2, distance2);
    point = point + (take & (id - point));
  }

  // Reduces the four lanes to one point, and adds it if there is any.
  void append(std::vector<Partner>& partners) const {
    Partner best{distance2[0], point[0]};
    for (int k = 1; k < 4; ++k) {
      const bool nearer = distance2[k] < best.distance2 || (distance2[k] == best.distance2 && point[k] < best.point);
      if (nearer) best = {distance2[k], point[k]};
    }
    if (best.point != INT32_MAX) partners.push_back(best);
  }
};

// A point that looks for partners.
struct Seeker {
  int point;
  int set;
  float reach;  ///< [mm]
};

// Finds the nearest free point of another set of the same part on either side, the nearer one first. Which points these
// are cannot be predicted, so that branches would cost more than the arithmetic: four points are looked at at once.
void findNearest(const Strands& strands, const Joining& joining, const std::vector<std::int32_t>& free,
                 const Seeker& seeker, std::vector<Partner>& partners) {
  partners.clear();
  const int curve = joining.curveOf(seeker.point);
  const I4 part = splatInt(strands.partOfCurve[curve]);
  const Vec2f p = joining.at(seeker.point);
  const Vec2f along = joining.at(nextOf(strands.curves, curve, seeker.point)) - p;
  const float reach2 = seeker.reach * seeker.reach;
  NearestLanes left{splat(reach2)};
  NearestLanes right{splat(reach2)};
  strands.grid.around(p, seeker.reach, [&](int first, int last) {
    for (int k = first; k < last; k += 4) {
      const std::size_t s = k;
      const F4 dx = load4(&strands.grid.x[s]) - splat(p.x);
      const F4 dy = load4(&strands.grid.y[s]) - splat(p.y);
      const F4 distance2 = dx * dx + dy * dy;
      const I4 other = load4(&free[s]);
      const I4 wanted = (other != splatInt(seeker.set)) & (other > splatInt(-1)) & (load4(&strands.partAt[s]) == part);
      const I4 onLeft = splat(along.x) * dy - splat(along.y) * dx > splat(0);
      const I4 id = load4(&strands.grid.id[s]);
      left.look(wanted & onLeft, distance2, id);
      right.look(wanted & (onLeft == splatInt(0)), distance2, id);
    }
  });
  left.append(partners);
  right.append(partners);
  sortNearestFirst(partners);
}

// Finds all free points of other sets of the same part within reach, nearest first, as many as may be tried.
void findPartners(const Strands& strands, const Joining& joining, const SetsToJoin& sets, const SearchLimits& limits,
                  int i, std::vector<Partner>& partners) {
  partners.clear();
  const std::size_t c = joining.curveOf(i);
  const int own = sets.ofCurve[c];
  const int part = strands.partOfCurve[c];
  const Vec2f p = joining.at(i);
  const float reach2 = limits.reach * limits.reach;
  strands.grid.around(p, limits.reach, [&](int first, int last) {
    for (int k = first; k < last; ++k) {
      const std::size_t s = k;
      const Vec2f to{strands.grid.x[s] - p.x, strands.grid.y[s] - p.y};
      const float distance2 = dot(to, to);
      if (distance2 > reach2) continue;
      const std::size_t other = strands.curveAt[s];
      const int j = strands.grid.id[s];
      if (sets.ofCurve[other] == own || strands.partOfCurve[other] != part || joining.used(j)) continue;
      partners.push_back({distance2, j});
    }
  });
  sortNearestFirst(partners);
  if (partners.size() > limits.partners) partners.resize(limits.partners);
}

// Calls find(begin, end, candidates) for ranges of [0, count) on the run's threads. \return the candidates, cheapest
// first; ties are broken by index, so that threads do not matter.
template <class Find>
std::vector<Candidate> cheapestFirst(int count, const RunContext& run, const Find& find) {
  constexpr int kGrain = 4096;
  std::vector<std::vector<Candidate>> found((count + kGrain - 1) / kGrain);
  parallelFor(run, count, kGrain, [&](int begin, int end) { find(begin, end, found[begin / kGrain]); });
  std::vector<Candidate> candidates;
  for (const std::vector<Candidate>& some : found) candidates.insert(candidates.end(), some.begin(), some.end());
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.cost != b.cost ? a.cost < b.cost : (a.i != b.i ? a.i < b.i : (a.j != b.j ? a.j < b.j : a.span > b.span));
  });
  return candidates;
}

// Proposes joints of each seeking point with its neighbours, by pieces of four segments or, where allowed, of two and
// one.
std::vector<Candidate> nearCandidates(const Strands& strands, const Joining& joining, const SetsToJoin& sets,
                                      const SearchLimits& limits, const RunContext& run) {
  const int count = static_cast<int>(strands.curves.points.size());
  const std::vector<std::int32_t> free =
      limits.nearestOnly ? freeSets(strands, joining, sets, run) : std::vector<std::int32_t>();
  return cheapestFirst(count, run, [&](int begin, int end, std::vector<Candidate>& out) {
    std::vector<Partner> partners;
    for (int i = begin; i < end; ++i) {
      const std::size_t c = joining.curveOf(i);
      if (!sets.seeking[c] || (i - strands.curves.begin[c]) % limits.stride != 0 || joining.used(i)) continue;
      if (limits.nearestOnly) {
        findNearest(strands, joining, free, {i, sets.ofCurve[c], limits.reach}, partners);
      } else {
        findPartners(strands, joining, sets, limits, i, partners);
      }
      for (const Partner& partner : partners) {
        // Shorter pieces fit where a whole spacing is not free, at the cost of tighter turns.
        for (int span = kSpan; span >= limits.leastSpan; span /= 2)
          out.push_back({joining.cost(i, partner.point, span), i, partner.point, span});
      }
    }
  });
}

using Pairs = std::vector<std::pair<int, int>>;

// Replaces the nearest pairs by all pairs of their neighbours: points along the curve, and points on strands of the
// same set beside it, of which only one faces the other set.
Pairs neighboursOf(Pairs pairs, const Strands& strands, const Joining& joining, const SetsToJoin& sets, float spacing) {
  constexpr std::size_t kNearest = 16;  ///< pairs that are kept, which bounds the work
  constexpr int kPointsBeside = 4;      ///< points on either side along the curve: one spacing
  sortBy(pairs, [&](const auto& pair) { return length(joining.at(pair.first) - joining.at(pair.second)); });
  pairs.resize(std::min(pairs.size(), kNearest));
  const auto neighbours = [&](int point) {
    const int curve = joining.curveOf(point);
    const std::size_t c = curve;
    const int begin = strands.curves.begin[c];
    const int size = strands.curves.size(curve);
    std::vector<int> found;
    for (int k = -kPointsBeside; k <= kPointsBeside; ++k)
      found.push_back(begin + ((point - begin + k) % size + size) % size);
    const float reach = 0.5f * spacing;
    strands.grid.around(joining.at(point), reach, [&](int first, int last) {
      for (int k = first; k < last; ++k) {
        const std::size_t s = k;
        const int id = strands.grid.id[s];
        const bool sameSet = sets.ofCurve[strands.curveAt[s]] == sets.ofCurve[c];
        if (sameSet && length(joining.at(id) - joining.at(point)) <= reach) found.push_back(id);
      }
    });
    return found;
  };
  Pairs around;
  for (const auto& [i, j] : pairs) {
    const std::vector<int> besideJ = neighbours(j);
    for (const int a : neighbours(i)) {
      for (const int b : besideJ) around.emplace_back(a, b);
    }
  }
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  return around;
}

// Proposes joints between points that face each other. Length outside the shape is dear, so that joints lie inside if
// they can.
std::vector<Candidate> facingCandidates(const Strands& strands, const Joining& joining, const SetsToJoin& sets,
                                        bool andNeighbours, float spacing, const RunContext& run) {
  std::vector<int> setOfPoint(strands.curves.points.size(), -1);
  for (std::size_t i = 0; i < setOfPoint.size(); ++i) {
    const std::size_t c = joining.curveOf(static_cast<int>(i));
    if (sets.open[c] && !joining.used(static_cast<int>(i))) setOfPoint[i] = sets.ofCurve[c];
  }
  // All free points of open sets spread; used ones cannot serve a joint.
  Pairs pairs = facingPoints(strands.parts, strands.curves.points, setOfPoint);
  if (andNeighbours) pairs = neighboursOf(std::move(pairs), strands, joining, sets, spacing);
  const int count = static_cast<int>(pairs.size());
  return cheapestFirst(count, run, [&](int begin, int end, std::vector<Candidate>& out) {
    for (int k = begin; k < end; ++k) {
      const auto& [i, j] = pairs[k];
      for (int span = kSpan; span >= 1; span /= 2)
        out.push_back({joining.cost(i, j, span) + kOutsideCost * joining.outsideLength(i, j, span), i, j, span});
    }
  });
}

// Work of a list of candidates, in the unit of Stitched::work.
std::int64_t workOf(const std::vector<Candidate>& candidates, const Joining& joining, double spacing) {
  std::int64_t work = 0;
  for (const Candidate& c : candidates)
    work += 1 + static_cast<std::int64_t>(static_cast<double>(length(joining.at(c.i) - joining.at(c.j))) / spacing);
  return work;
}

// Makes all joints that are possible, cheapest first: Kruskal's algorithm. \return the number of joints made.
int joinInOrder(const std::vector<Candidate>& candidates, float gap, Joining& joining, const RunContext& run) {
  int joined = 0;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (k % 1024 == 0 && run.cancelled()) break;
    joined += joining.join(candidates[k], gap) ? 1 : 0;
  }
  return joined;
}

// Stitches once, for all parts and all cycles of a round together. Alg. 2 takes the cheapest joint that leaves the
// smallest cycle; that joint belongs to the cheapest spanning tree, so that the tree is the same.
Result<Stitched> stitchOnce(const ClosedCurves& curves, const LineField& lines, const BorderIndex& border,
                            const Parts& parts, const ToolpathParams& params, const RunContext& run) {
  const PointGrid grid(curves.points, static_cast<float>(params.spacing), run);
  if (run.cancelled()) return cancelledRun();  // the grid may be half made
  // 1. Part of each curve, by the cell of its first point, and of each point of the grid.
  Joining joining(curves, grid, lines, border, params);
  std::vector<int> partOfCurve;
  for (int c = 0; c < curves.count(); ++c) {
    const Vec2f first = curves.points[curves.begin[c]];
    partOfCurve.push_back(parts.label[cellInPart(parts, first)]);
  }
  std::vector<int> labels = partOfCurve;
  std::sort(labels.begin(), labels.end());
  // Number of parts that hold a curve: so many curves should be left.
  const int held = static_cast<int>(std::unique(labels.begin(), labels.end()) - labels.begin());
  const int most = labels.empty() ? 0 : *std::max_element(partOfCurve.begin(), partOfCurve.end()) + 1;
  std::vector<int> curveAt(grid.count());
  std::vector<int> partAt(grid.id.size(), -1);
  parallelForEach(run, grid.count(), 8192, [&](std::size_t k) {
    curveAt[k] = joining.curveOf(grid.id[k]);
    partAt[k] = partOfCurve[curveAt[k]];
  });
  // 2. Rounds: find candidates between open sets, join the cheapest first, and widen the search when nothing is joined
  // any more.
  const Strands strands{curves, grid, curveAt, partAt, parts, partOfCurve};

  Stitched stitched;
  SearchKind search = SearchKind::Nearest;
  for (int round = 0; round < kMaxRounds && !run.cancelled(); ++round) {
    const SetsToJoin sets = setsToJoin(curves, partOfCurve, most, joining);
    // All parts are one set each: done.
    if (!sets.any) break;
    SearchLimits limits = limitsOf(search, params);
    if (round == 0) limits.stride = kFirstStride;
    const std::vector<Candidate> candidates =
        search >= SearchKind::Facing ? facingCandidates(strands, joining, sets, search == SearchKind::AroundFacing,
                                                        static_cast<float>(params.spacing), run)
                                     : nearCandidates(strands, joining, sets, limits, run);
    stitched.work += workOf(candidates, joining, params.spacing);
    if (joinInOrder(candidates, limits.gap, joining, run) > 0) continue;
    if (search == SearchKind::AroundFacing) break;
    search = wider(search);
  }
  if (run.cancelled()) return cancelledRun();
  // 3. Exchange joints until neighbouring beads are laid soon after one another.
  const Beads beads{curves, grid, border, static_cast<float>(params.spacing)};
  if (params.order == BeadOrder::Even && !evenOrder(beads, params, joining, run)) return cancelledRun();
  stitched.curves = joining.joined();
  stitched.parts = held;
  stitched.longestJoint = static_cast<double>(joining.longestJoint());
  stitched.gapJoints = joining.gapJoints();
  return stitched;
}

// Middles of the boxes of the curves that Stitched::apart lists: all but the longest of each part.
std::vector<Vec2> middlesOfApart(const ClosedCurves& curves, const Parts& parts) {
  std::vector<int> longest(parts.count, -1);  // longest curve, by part
  std::vector<int> part;
  for (int c = 0; c < curves.count(); ++c) {
    const Vec2f first = curves.points[curves.begin[c]];
    part.push_back(parts.label[cellInPart(parts, first)]);
    if (part.back() < 0) continue;
    const std::size_t label = part.back();
    if (label >= longest.size()) longest.resize(label + 1, -1);
    if (longest[label] < 0 || curves.size(c) > curves.size(longest[label])) longest[label] = c;
  }
  std::vector<Vec2> apart;
  for (int c = 0; c < curves.count(); ++c) {
    const int label = part[c];
    if (label >= 0 && longest[label] == c) continue;
    const auto begin = curves.points.begin() + curves.begin[c];
    const auto end = begin + curves.size(c);
    const auto [left, right] = std::minmax_element(begin, end, [](Vec2f a, Vec2f b) { return a.x < b.x; });
    const auto [low, high] = std::minmax_element(begin, end, [](Vec2f a, Vec2f b) { return a.y < b.y; });
    apart.push_back({0.5 * static_cast<double>(left->x + right->x), 0.5 * static_cast<double>(low->y + high->y)});
  }
  return apart;
}

}  // namespace

Result<Stitched> stitchCycles(const ClosedCurves& curves, const LineField& lines, const BorderIndex& border,
                              const Parts& parts, const ToolpathParams& params, const RunContext& run) {
  Result<Stitched> stitched = stitchOnce(curves, lines, border, parts, params, run);
  // Tiny cycles may use up their points, and joints may stand between others. The paths made so far are therefore
  // curves again, with fresh points, and are stitched once more.
  for (int go = 1; go < kMaxGoes && stitched && stitched.value().unjoined() > 0; ++go) {
    const Stitched& last = stitched.value();
    const ClosedCurves paths = resampledSimply(last.curves, static_cast<float>(0.25 * params.spacing), run);
    Result<Stitched> more = stitchOnce(paths, lines, border, parts, params, run);
    if (!more) return more;
    more.value().work += last.work;
    // Nothing was joined: another go would not help.
    if (more.value().curves.count() == paths.count()) {
      stitched.value().work = more.value().work;
      break;
    }
    // The result counts the joints of all goes.
    more.value().longestJoint = std::max(more.value().longestJoint, last.longestJoint);
    more.value().gapJoints += last.gapJoints;
    stitched = std::move(more);
  }
  if (stitched && stitched.value().unjoined() > 0) {
    stitched.value().apart = middlesOfApart(stitched.value().curves, parts);
  }
  return stitched;
}

}  // namespace sillon
