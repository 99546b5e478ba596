#include "sillon/stitch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <unordered_map>

#include "curves.hpp"
#include "parallel_for.hpp"
#include "point_grid.hpp"

namespace sillon {
namespace {

constexpr int kSpan = 4;              ///< segments taken out of each curve: one spacing, so two beads fit side by side
constexpr float kFirstReach = 1.8f;   ///< how far apart joined pieces may lie at first [tau]
constexpr float kLengthCost = 0.65f;  ///< cost of a mm of added length
constexpr int kMaxRounds = 60;
constexpr std::size_t kAlternatives =
    6;  ///< partners tried per point where the nearest ones cannot be joined, at first

struct Candidate {
  float cost;
  int i;     ///< middle of the piece of one curve
  int j;     ///< of the other
  int span;  ///< segments taken out of each
  int curveI;
  int curveJ;
};

// The state of the curves while they are being joined.
class Joining {
 public:
  Joining(const ClosedCurves& curves, const LineField& lines, const BorderIndex& border, const ToolpathParams& params)
      : curves_(curves),
        lines_(lines),
        border_(border),
        spacing_(static_cast<float>(params.spacing)),
        alignmentCost_(static_cast<float>(params.stitchAlignment)),
        curveOf_(curveOfPoints(curves)),
        next_(curves.points.size()),
        used_(curves.points.size(), 0),
        root_(static_cast<std::size_t>(curves.count())) {
    for (int c = 0; c < curves.count(); ++c) {
      for (int k = 0; k < curves.size(c); ++k) {
        const int point = curves.begin[static_cast<std::size_t>(c)] + k;
        next_[static_cast<std::size_t>(point)] = nextOf(curves, c, point);
      }
    }
    std::iota(root_.begin(), root_.end(), 0);
  }

  [[nodiscard]] int curveOf(int point) const { return curveOf_[static_cast<std::size_t>(point)]; }
  [[nodiscard]] int setOf(int curve) {
    while (root_[static_cast<std::size_t>(curve)] != curve) {
      int& up = root_[static_cast<std::size_t>(curve)];
      up = root_[static_cast<std::size_t>(up)];
      curve = up;
    }
    return curve;
  }
  [[nodiscard]] bool used(int point) const { return used_[static_cast<std::size_t>(point)] != 0; }

  // What joining the pieces around i and j costs; curves run in opposite senses, so the edges cross over.
  [[nodiscard]] float cost(int i, int j, int span) const {
    const Piece a = pieceAround(i, span);
    const Piece b = pieceAround(j, span);
    const float gap = length(at(a.begin) - at(b.end)) + length(at(b.begin) - at(a.end));
    const float added = gap - a.length - b.length;
    const float misaligned =
        misalignment(at(a.begin), at(b.end)) + misalignment(at(b.begin), at(a.end)) - misalignment(a) - misalignment(b);
    return kLengthCost * added + alignmentCost_ * misaligned;
  }

  // Joins if nothing stands against it. \param gap  what the new edges may lie outside the shape [mm].
  bool join(const Candidate& candidate, const PointGrid& grid, float gap) {
    const int si = setOf(candidate.curveI);
    const int sj = setOf(candidate.curveJ);
    if (si == sj) return false;
    const Piece a = pieceAround(candidate.i, candidate.span);
    const Piece b = pieceAround(candidate.j, candidate.span);
    if (touchesUsed(a) || touchesUsed(b)) return false;
    const Edge e{a.begin, b.end};
    const Edge f{b.begin, a.end};
    if (outsideLength(e) > gap || outsideLength(f) > gap) return false;
    if (segmentsMeet(at(e.from), at(e.to), at(f.from), at(f.to))) return false;
    markUsed(a);
    markUsed(b);  // taken out, so that the new edges may pass over them
    // The middle too: where nearly all of a tiny cycle is taken out, the edges may pass round what is left of it, which
    // turns the cycle inside out, and then no joint fits it any more.
    const Edge middle{candidate.i, candidate.j};
    if (meetsLiveEdge(e, f, grid) || meetsLiveEdge(f, e, grid) || meetsLiveEdge(middle, middle, grid)) {
      unmark(a);
      unmark(b);
      return false;
    }
    next_[static_cast<std::size_t>(e.from)] = e.to;
    next_[static_cast<std::size_t>(f.from)] = f.to;
    gapJoints_ += outsideLength(e) + outsideLength(f) > 0 ? 1 : 0;
    for (const Edge& edge : {e, f}) {
      addJoint(edge);
      longest_ = std::max(longest_, length(at(edge.from) - at(edge.to)));
    }
    root_[static_cast<std::size_t>(std::max(si, sj))] = std::min(si, sj);
    return true;
  }

  void finish(Stitched& out) {
    std::vector<char> done(static_cast<std::size_t>(curves_.count()), 0);
    for (int c = 0; c < curves_.count(); ++c) {
      const int set = setOf(c);
      if (done[static_cast<std::size_t>(set)]) continue;
      done[static_cast<std::size_t>(set)] = 1;
      // Begin at a point that is still part of the path.
      int start = curves_.begin[static_cast<std::size_t>(c)];
      while (start < curves_.begin[static_cast<std::size_t>(c) + 1] && inner(start)) ++start;
      out.curves.begin.push_back(static_cast<int>(out.curves.points.size()));
      int k = start;
      do {
        out.curves.points.push_back(at(k));
        k = next_[static_cast<std::size_t>(k)];
      } while (k != start);
    }
    out.curves.begin.push_back(static_cast<int>(out.curves.points.size()));
    out.longestJoint = static_cast<double>(longest_);
    out.gapJoints = gapJoints_;
  }

  [[nodiscard]] Vec2f at(int point) const { return curves_.points[static_cast<std::size_t>(point)]; }

 private:
  struct Piece {
    int begin;
    int end;
    int segments;
    float length;
  };
  struct Edge {
    int from;
    int to;
  };
  enum : char { kFree = 0, kEnd = 1, kInner = 2 };

  [[nodiscard]] bool inner(int point) const { return used_[static_cast<std::size_t>(point)] == kInner; }

  [[nodiscard]] Piece pieceAround(int point, int wanted) const {
    const int curve = curveOf(point);
    const int first = curves_.begin[static_cast<std::size_t>(curve)];
    const int n = curves_.size(curve);
    const int span = std::min(wanted, n / 2);
    const int begin = first + (point - first - span / 2 + n) % n;
    const int end = first + (begin - first + span) % n;
    Piece piece{begin, end, span, 0};
    forSegments(piece, [&](int a, int b) { piece.length += length(at(a) - at(b)); });
    return piece;
  }

  template <class Visit>
  void forSegments(const Piece& piece, const Visit& visit) const {
    const int curve = curveOf(piece.begin);
    int a = piece.begin;
    for (int k = 0; k < piece.segments; ++k) {
      const int b = nextOf(curves_, curve, a);
      visit(a, b);
      a = b;
    }
  }

  // Length times sin² of the angle to the wanted bead: the part of it along d.
  [[nodiscard]] float misalignment(Vec2f a, Vec2f b) const {
    const Vec2f e = b - a;
    const float size = length(e);
    if (size <= 0) return 0;
    const Grid& grid = lines_.grid;
    const double x = (0.5 * static_cast<double>(a.x + b.x) - grid.origin.x) / grid.cell;
    const double y = (0.5 * static_cast<double>(a.y + b.y) - grid.origin.y) / grid.cell;
    const int cx = std::clamp(static_cast<int>(x), 0, grid.nx - 1);
    const int cy = std::clamp(static_cast<int>(y), 0, grid.ny - 1);
    const float across = dot(e, lines_.direction[grid.index(cx, cy)]);
    return across * across / size;
  }
  [[nodiscard]] float misalignment(const Piece& piece) const {
    float sum = 0;
    forSegments(piece, [&](int a, int b) { sum += misalignment(at(a), at(b)); });
    return sum;
  }

  [[nodiscard]] bool touchesUsed(const Piece& piece) const {
    bool touches = used(piece.begin);
    forSegments(piece, [&](int, int b) { touches = touches || used(b); });
    return touches;
  }
  void markUsed(const Piece& piece) {
    forSegments(piece, [&](int, int b) { used_[static_cast<std::size_t>(b)] = kInner; });
    used_[static_cast<std::size_t>(piece.begin)] = kEnd;
    used_[static_cast<std::size_t>(piece.end)] = kEnd;
  }
  void unmark(const Piece& piece) {
    used_[static_cast<std::size_t>(piece.begin)] = kFree;
    forSegments(piece, [&](int, int b) { used_[static_cast<std::size_t>(b)] = kFree; });
  }

  // An edge of a curve is live unless it was taken out with a piece.
  [[nodiscard]] bool live(int point) const {
    const int next = nextOf(curves_, curveOf(point), point);
    return next_[static_cast<std::size_t>(point)] == next && !inner(point) && !inner(next);
  }

  [[nodiscard]] bool meetsLiveEdge(const Edge& edge, const Edge& sibling, const PointGrid& grid) const {
    const Vec2f a = at(edge.from);
    const Vec2f b = at(edge.to);
    const Vec2f middle = (a + b) * 0.5f;
    // Points sit tau/4 apart, so an edge that meets ours begins within this reach.
    const float reach = 0.5f * length(b - a) + 0.5f * spacing_;
    bool meets = false;
    grid.around(middle, reach, [&](int begin, int end) {
      for (int k = begin; k < end && !meets; ++k) {
        const int p = grid.id[static_cast<std::size_t>(k)];
        const int q = nextOf(curves_, curveOf(p), p);
        if (p == edge.from || p == edge.to || q == edge.from || q == edge.to || !live(p)) continue;
        meets = segmentsMeet(a, b, at(p), at(q));
      }
    });
    if (meets) return true;
    const auto key = jointCell(middle);
    const int cells = static_cast<int>(length(b - a) / jointCellSize()) + 1;
    for (int dy = -cells; dy <= cells; ++dy) {
      for (int dx = -cells; dx <= cells; ++dx) {
        const auto found = joints_.find(packed(key.first + dx, key.second + dy));
        if (found == joints_.end()) continue;
        for (const Edge& other : found->second) {
          if (other.from == sibling.from && other.to == sibling.to) continue;
          if (segmentsMeet(a, b, at(other.from), at(other.to))) return true;
        }
      }
    }
    return false;
  }

  // How much of the edge lies outside the shape, by samples tau/16 apart [mm].
  [[nodiscard]] float outsideLength(const Edge& edge) const {
    const Vec2 a{static_cast<double>(at(edge.from).x), static_cast<double>(at(edge.from).y)};
    const Vec2 b{static_cast<double>(at(edge.to).x), static_cast<double>(at(edge.to).y)};
    const double size = length(b - a);
    const int samples = static_cast<int>(size / (static_cast<double>(spacing_) / 16)) + 1;
    int outside = 0;
    for (int k = 1; k < samples; ++k) {
      const Vec2 p = a + (b - a) * (static_cast<double>(k) / samples);
      outside += border_.outside(p) ? 1 : 0;
    }
    return static_cast<float>(outside * size / samples);
  }

  [[nodiscard]] float jointCellSize() const { return 2 * spacing_; }
  [[nodiscard]] std::pair<int, int> jointCell(Vec2f p) const {
    return {static_cast<int>(std::floor(p.x / jointCellSize())), static_cast<int>(std::floor(p.y / jointCellSize()))};
  }
  static std::uint64_t packed(int x, int y) {
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(y)) << 32) | static_cast<std::uint32_t>(x);
  }
  // Registered in every cell it may pass, so that a search around any edge finds it.
  void addJoint(const Edge& edge) {
    const Vec2f a = at(edge.from);
    const Vec2f b = at(edge.to);
    const int steps = static_cast<int>(length(b - a) / (0.5f * jointCellSize())) + 1;
    std::pair<int, int> last{INT32_MIN, INT32_MIN};
    for (int k = 0; k <= steps; ++k) {
      const auto key = jointCell(a + (b - a) * (static_cast<float>(k) / static_cast<float>(steps)));
      if (key != last) joints_[packed(key.first, key.second)].push_back(edge);
      last = key;
    }
  }

  const ClosedCurves& curves_;
  const LineField& lines_;
  const BorderIndex& border_;
  float spacing_;
  float alignmentCost_;
  std::vector<std::int32_t> curveOf_;
  std::vector<int> next_;
  std::vector<char> used_;
  std::vector<int> root_;
  std::unordered_map<std::uint64_t, std::vector<Edge>> joints_;
  float longest_ = 0;
  int gapJoints_ = 0;
};

// Part of the cell that holds p, or of one beside it where that cell's centre lies outside.
int partOf(const Parts& parts, Vec2f p) {
  const Grid& grid = parts.grid;
  const int x = std::clamp(static_cast<int>((static_cast<double>(p.x) - grid.origin.x) / grid.cell), 1, grid.nx - 2);
  const int y = std::clamp(static_cast<int>((static_cast<double>(p.y) - grid.origin.y) / grid.cell), 1, grid.ny - 2);
  int part = parts.label[grid.index(x, y)];
  for (int k = 0; k < 9 && part < 0; ++k) part = parts.label[grid.index(x + k % 3 - 1, y + k / 3 - 1)];
  return part;
}

// Around the points of a set.
struct Box {
  Vec2f min{1e30f, 1e30f};
  Vec2f max{-1e30f, -1e30f};

  [[nodiscard]] bool isWithin(float reach, Vec2f p) const {
    return p.x > min.x - reach && p.x < max.x + reach && p.y > min.y - reach && p.y < max.y + reach;
  }
};

struct Search {
  const std::vector<int>& setOfCurve;
  const std::vector<int>& partOfCurve;
  const std::vector<int>& curveAt;  ///< curve of each sorted point
  const std::vector<char>& wanted;  ///< curves whose points look for partners
  int stride;                       ///< every how many points
  float reach;
  std::size_t alternatives;          ///< most partners per point
  bool thorough;                     ///< not only the nearest partner on either side, and shorter pieces too
  const std::vector<Box>& boxOfSet;  ///< where the search is thorough
};

// A wide search costs all points within reach, most of them of the own set: only what may lie near another looks round.
bool mayHavePartners(const Joining& state, const Search& search, int i) {
  if (!search.thorough) return true;
  const std::size_t c = static_cast<std::size_t>(state.curveOf(i));
  for (std::size_t set = 0; set < search.boxOfSet.size(); ++set) {
    if (static_cast<int>(set) != search.setOfCurve[c] && search.partOfCurve[set] == search.partOfCurve[c] &&
        search.boxOfSet[set].isWithin(search.reach, state.at(i))) {
      return true;
    }
  }
  return false;
}

struct Partner {
  float distance2;
  int point;
};

// Free points of other sets of the same part within reach, nearest first; in the quick search one on either side.
void findPartners(const Joining& state, const PointGrid& grid, const ClosedCurves& curves, const Search& search, int i,
                  std::vector<Partner>& partners) {
  partners.clear();
  const int curve = state.curveOf(i);
  const std::size_t c = static_cast<std::size_t>(curve);
  const int own = search.setOfCurve[c];
  const int part = search.partOfCurve[c];
  const Vec2f p = state.at(i);
  const Vec2f along = state.at(nextOf(curves, curve, i)) - p;
  Partner nearest[2] = {{search.reach * search.reach, -1}, {search.reach * search.reach, -1}};
  grid.around(p, search.reach, [&](int first, int last) {
    for (int k = first; k < last; ++k) {
      const std::size_t s = static_cast<std::size_t>(k);
      const Vec2f to{grid.x[s] - p.x, grid.y[s] - p.y};
      const float distance2 = dot(to, to);
      Partner& best = nearest[cross(along, to) > 0 ? 1 : 0];
      if (distance2 > (search.thorough ? search.reach * search.reach : best.distance2)) continue;
      const std::size_t other = static_cast<std::size_t>(search.curveAt[s]);
      const int j = grid.id[s];
      if (search.setOfCurve[other] == own || search.partOfCurve[other] != part || state.used(j)) continue;
      if (search.thorough) {
        partners.push_back({distance2, j});
      } else if (distance2 < best.distance2 || best.point < 0 || j < best.point) {
        best = {distance2, j};
      }
    }
  });
  for (const Partner& partner : nearest) {
    if (partner.point >= 0) partners.push_back(partner);
  }
  std::sort(partners.begin(), partners.end(), [](const Partner& a, const Partner& b) {
    return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.point < b.point;
  });
  if (partners.size() > search.alternatives) partners.resize(search.alternatives);
}

std::vector<Candidate> findCandidates(const Joining& state, const PointGrid& grid, const ClosedCurves& curves,
                                      const Search& search, const RunContext& run) {
  const int count = static_cast<int>(curves.points.size());
  constexpr int kGrain = 4096;
  std::vector<std::vector<Candidate>> found(static_cast<std::size_t>((count + kGrain - 1) / kGrain));
  parallelFor(run, count, kGrain, [&](int begin, int end) {
    std::vector<Candidate>& out = found[static_cast<std::size_t>(begin / kGrain)];
    std::vector<Partner> partners;
    for (int i = begin; i < end; ++i) {
      const std::size_t c = static_cast<std::size_t>(state.curveOf(i));
      if (!search.wanted[c] || (i - curves.begin[c]) % search.stride != 0 || state.used(i)) continue;
      if (!mayHavePartners(state, search, i)) continue;
      findPartners(state, grid, curves, search, i, partners);
      for (const Partner& partner : partners) {
        for (int span = kSpan; span >= (search.thorough ? 1 : kSpan); span /= 2) {
          out.push_back({state.cost(i, partner.point, span), i, partner.point, span, static_cast<int>(c),
                         state.curveOf(partner.point)});
        }
      }
    }
  });
  std::vector<Candidate> candidates;
  for (const std::vector<Candidate>& part : found) candidates.insert(candidates.end(), part.begin(), part.end());
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.cost != b.cost ? a.cost < b.cost : (a.i != b.i ? a.i < b.i : (a.j != b.j ? a.j < b.j : a.span > b.span));
  });
  return candidates;
}

Result<Stitched> stitchOnce(const ClosedCurves& curves, const LineField& lines, const BorderIndex& border,
                            const Parts& parts, const ToolpathParams& params, bool anyGap, const RunContext& run) {
  const float spacing = static_cast<float>(params.spacing);
  Joining joining(curves, lines, border, params);
  const std::size_t count = static_cast<std::size_t>(curves.count());
  std::vector<int> partOfCurve(count);
  for (std::size_t c = 0; c < count; ++c) {
    partOfCurve[c] = partOf(parts, curves.points[static_cast<std::size_t>(curves.begin[c])]);
  }

  Stitched stitched;
  {
    std::vector<int> labels = partOfCurve;
    std::sort(labels.begin(), labels.end());
    stitched.parts = static_cast<int>(std::unique(labels.begin(), labels.end()) - labels.begin());
  }
  const PointGrid grid(curves.points, spacing, run);
  if (run.cancelled()) return Error{ErrorCode::Cancelled, "the run was cancelled"};  // the grid may be half made
  float reach = kFirstReach * spacing;
  std::size_t alternatives = kAlternatives;
  bool thorough = false;
  bool outside = false;
  // Gaps are crossed at a slant now and then, and sampled.
  float gap = 1.2f * static_cast<float>(params.bridge.value_or(params.spacing)) + 0.125f * spacing;
  const float diagonal =
      static_cast<float>(length(Vec2{parts.grid.nx * parts.grid.cell, parts.grid.ny * parts.grid.cell}));
  std::vector<int> setOfCurve(count);
  std::vector<int> curveAt(static_cast<std::size_t>(grid.count()));
  for (std::size_t k = 0; k < curveAt.size(); ++k) curveAt[k] = joining.curveOf(grid.id[k]);
  for (int round = 0; round < kMaxRounds && !run.cancelled(); ++round) {
    // All sets of a part but its largest look for others; the first time all points do, with a coarser step.
    std::vector<int> pointsOfSet(count, 0);
    std::vector<int> setsOfPart(static_cast<std::size_t>(*std::max_element(parts.label.begin(), parts.label.end())) + 1,
                                0);
    for (std::size_t c = 0; c < count; ++c) {
      setOfCurve[c] = joining.setOf(static_cast<int>(c));
      pointsOfSet[static_cast<std::size_t>(setOfCurve[c])] += curves.size(static_cast<int>(c));
      if (setOfCurve[c] == static_cast<int>(c) && partOfCurve[c] >= 0)
        ++setsOfPart[static_cast<std::size_t>(partOfCurve[c])];
    }
    std::vector<int> largest(setsOfPart.size(), -1);
    for (std::size_t c = 0; c < count; ++c) {
      if (partOfCurve[c] < 0 || setOfCurve[c] != static_cast<int>(c)) continue;
      int& top = largest[static_cast<std::size_t>(partOfCurve[c])];
      if (top < 0 || pointsOfSet[c] > pointsOfSet[static_cast<std::size_t>(top)]) top = static_cast<int>(c);
    }
    std::vector<char> wanted(count, 0);
    bool any = false;
    for (std::size_t c = 0; c < count; ++c) {
      if (partOfCurve[c] < 0 || setsOfPart[static_cast<std::size_t>(partOfCurve[c])] < 2) continue;
      wanted[c] = setOfCurve[c] != largest[static_cast<std::size_t>(partOfCurve[c])] ? 1 : 0;
      any = any || wanted[c];
    }
    if (!any) break;
    std::vector<Box> boxOfSet(thorough ? count : 0);
    for (std::size_t c = 0; c < boxOfSet.size(); ++c) {
      Box& box = boxOfSet[static_cast<std::size_t>(setOfCurve[c])];
      for (int k = curves.begin[c]; k < curves.begin[c + 1]; ++k) {
        const Vec2f p = curves.points[static_cast<std::size_t>(k)];
        box.min = {std::min(box.min.x, p.x), std::min(box.min.y, p.y)};
        box.max = {std::max(box.max.x, p.x), std::max(box.max.y, p.y)};
      }
    }
    const Search search{setOfCurve, partOfCurve,  curveAt,  wanted,  round == 0 ? 4 : 1,
                        reach,      alternatives, thorough, boxOfSet};
    int joined = 0;
    const std::vector<Candidate> candidates = findCandidates(joining, grid, curves, search, run);
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      if (k % 1024 == 0 && run.cancelled()) break;
      joined += joining.join(candidates[k], grid, outside ? gap : 0) ? 1 : 0;
    }
    if (joined > 0) continue;
    // First the nearest partners, then all of them, then across gaps, then from further away and across wider gaps.
    if (thorough && outside) {
      if (reach > diagonal && (!anyGap || gap > diagonal)) break;
      reach *= 2;
      alternatives = std::min(4 * alternatives, curves.points.size());
      gap *= 2;  // facing tips are nearer to each other than the beads in them; the part is one all the same
    }
    outside = thorough;
    thorough = true;
  }
  if (run.cancelled()) return Error{ErrorCode::Cancelled, "the run was cancelled"};
  joining.finish(stitched);
  return stitched;
}

}  // namespace

Result<Stitched> stitchCycles(const ClosedCurves& curves, const LineField& lines, const BorderIndex& border,
                              const Parts& parts, const ToolpathParams& params, const RunContext& run) {
  bool anyGap = false;
  Result<Stitched> stitched = stitchOnce(curves, lines, border, parts, params, anyGap, run);
  // Tiny cycles may use up their points, and joints may stand between others: paths as they are now are curves again.
  // Where that does not help the neck between two solids is long, and threads go along it as they can.
  while (stitched && stitched.value().curves.count() > stitched.value().parts) {
    const Stitched& last = stitched.value();
    const ClosedCurves paths = resampledSimply(last.curves, static_cast<float>(0.25 * params.spacing), run);
    Result<Stitched> more = stitchOnce(paths, lines, border, parts, params, anyGap, run);
    if (!more) return more;
    if (more.value().curves.count() == paths.count()) {
      if (anyGap) break;
      anyGap = true;
      continue;
    }
    more.value().longestJoint = std::max(more.value().longestJoint, last.longestJoint);
    more.value().gapJoints += last.gapJoints;
    stitched = std::move(more);
  }
  return stitched;
}

}  // namespace sillon
