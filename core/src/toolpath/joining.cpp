#include "toolpath/joining.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "geometry/closed_curves.hpp"

namespace sillon {
namespace {

constexpr float kLengthCost = 0.65f;  ///< cost of a mm of added length

// Packs the two indices of a cell into one key for the hash map.
std::uint64_t packed(int x, int y) {
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(y)) << 32) | static_cast<std::uint32_t>(x);
}

}  // namespace

Joining::Joining(const ClosedCurves& curves, const PointGrid& grid, const LineField& lines, const BorderIndex& border,
                 const ToolpathParams& params)
    : curves_(curves),
      grid_(grid),
      lines_(lines),
      border_(border),
      spacing_(static_cast<float>(params.spacing)),
      alignmentCost_(static_cast<float>(params.stitchAlignment)),
      farthest_(static_cast<float>(0.5 * (params.bridge.value_or(params.spacing) + params.spacing))),
      curveOf_(curveOfPoints(curves)),
      next_(curves.points.size()),
      previous_(curves.points.size()),
      used_(curves.points.size(), kFree),
      root_(curves.count()) {
  // At first every curve is a set of its own, and each point leads to the next along its curve.
  for (int c = 0; c < curves.count(); ++c) {
    for (int k = 0; k < curves.size(c); ++k) {
      const int point = curves.begin[c] + k;
      link(point, nextOf(curves, c, point));
    }
  }
  std::iota(root_.begin(), root_.end(), 0);
}

// Union-find with path halving: each look-up shortens the way to the root.
int Joining::setOf(int curve) {
  while (root_[curve] != curve) {
    int& up = root_[curve];
    up = root_[up];
    curve = up;
  }
  return curve;
}

// The patching energy (Eq. 14) with one more term: misaligned length counts, which raises alignment by 0.002 to 0.004.
float Joining::cost(int i, int j, int span) const {
  const TakenPiece a = pieceAround(i, span);
  const TakenPiece b = pieceAround(j, span);
  // The sum of the two new edges less the two pieces. Curves run in opposite senses, so the edges that cross over are
  // the shorter ones.
  const float added = length(at(a.begin) - at(b.end)) + length(at(b.begin) - at(a.end)) - a.length - b.length;
  const float misaligned =
      misalignment(at(a.begin), at(b.end)) + misalignment(at(b.begin), at(a.end)) - misalignment(a) - misalignment(b);
  return kLengthCost * added + alignmentCost_ * misaligned;
}

// Both new edges together, to the end: candidates are compared by it.
float Joining::outsideLength(int i, int j, int span) const {
  const TakenPiece a = pieceAround(i, span);
  const TakenPiece b = pieceAround(j, span);
  constexpr float kAll = std::numeric_limits<float>::infinity();
  return outsideLength(JointEdge{a.begin, b.end}, kAll) + outsideLength(JointEdge{b.begin, a.end}, kAll);
}

// Joins two sets as in Kruskal's algorithm: refuses a joint within one set, and merges two sets under the lower curve.
bool Joining::join(const Candidate& candidate, float gap) {
  const int si = setOf(curveOf(candidate.i));
  const int sj = setOf(curveOf(candidate.j));
  if (si == sj) return false;
  Joint joint{candidate.i, candidate.j, candidate.span, gap};
  if (!toggle(joint)) return false;
  made_.push_back(joint);
  root_[std::max(si, sj)] = std::min(si, sj);
  return true;
}

bool Joining::toggle(Joint& joint) {
  if (!(joint.on ? undo(joint) : make(joint))) return false;
  joint.on = !joint.on;
  return true;
}

// Checks a joint, cheap tests first, and makes it.
bool Joining::make(const Joint& joint) {
  const TakenPiece a = pieceAround(joint.i, joint.span);
  const TakenPiece b = pieceAround(joint.j, joint.span);
  // A point can serve one joint only.
  if (touchesUsed(a) || touchesUsed(b) || overlap(a, b)) return false;
  const JointEdge e{a.begin, b.end};
  const JointEdge f{b.begin, a.end};
  // Each new edge may leave the shape by the joint's gap at most.
  const float outsideE = outsideLength(e, joint.gap);
  if (outsideE > joint.gap) return false;
  const float outsideF = outsideLength(f, joint.gap);
  if (outsideF > joint.gap) return false;
  // The two new edges must not cross each other, nor, with the pieces taken out, any other edge.
  if (segmentsMeet(at(e.from), at(e.to), at(f.from), at(f.to))) return false;
  markUsed(a);
  markUsed(b);  // both pieces are taken out, so that the new edges may pass over them
  // The line between the middles must be free, too: where nearly all of a tiny cycle is taken out, the edges may pass
  // round what is left of it, which turns the cycle inside out, and then no joint fits it any more.
  const JointEdge middle{joint.i, joint.j};
  if (meetsLiveEdge(e) || meetsLiveEdge(f) || meetsLiveEdge(middle)) {
    unmark(a);
    unmark(b);
    return false;
  }
  // Link the ends crosswise, and register the edges, so that later joints keep off them.
  gapJoints_ += outsideE + outsideF > 0 ? 1 : 0;
  for (const JointEdge& edge : {e, f}) {
    link(edge.from, edge.to);
    addJoint(edge);
  }
  return true;
}

// Puts the two pieces back, unless another joint stands in their way.
bool Joining::undo(const Joint& joint) {
  const TakenPiece a = pieceAround(joint.i, joint.span);
  const TakenPiece b = pieceAround(joint.j, joint.span);
  const JointEdge e{a.begin, b.end};
  const JointEdge f{b.begin, a.end};
  removeJoint(e);
  removeJoint(f);
  // Curves do not meet, but a later joint may pass over the segments that come back.
  bool meets = false;
  const auto look = [&](int p, int q) { meets = meets || meetsJoint({p, q}, (at(p) + at(q)) * 0.5f, 1); };
  forSegments(a, look);
  forSegments(b, look);
  if (meets) {
    addJoint(e);
    addJoint(f);
    return false;
  }
  if (joint.gap > 0 && leavesShape(e, f)) --gapJoints_;
  unmark(a);
  unmark(b);
  const auto back = [&](int p, int q) { link(p, q); };
  forSegments(a, back);
  forSegments(b, back);
  return true;
}

void Joining::link(int from, int to) {
  next_[from] = to;
  previous_[to] = from;
}

bool Joining::leavesShape(const JointEdge& e, const JointEdge& f) const {
  return outsideLength(e, 0) + outsideLength(f, 0) > 0;
}

// Reads marks only: much cheaper than trying the joint.
bool Joining::blocked(const Joint& joint) const {
  return !joint.on && (touchesUsed(pieceAround(joint.i, joint.span)) || touchesUsed(pieceAround(joint.j, joint.span)));
}

std::pair<int, int> Joining::beginsOf(const Joint& joint) const {
  return {pieceAround(joint.i, joint.span).begin, pieceAround(joint.j, joint.span).begin};
}

// Looks at the edges that belong to no curve: each leads from an end of one piece to an end of another.
float Joining::longestJoint() const {
  float longest = 0;
  for (std::size_t p = 0; p < next_.size(); ++p) {
    if (used_[p] != kEnd) continue;
    const int from = static_cast<int>(p);
    const int to = next_[p];
    if (to != nextOf(curves_, curveOf(from), from)) longest = std::max(longest, length(at(from) - at(to)));
  }
  return longest;
}

// Walks round each set once and writes its points.
ClosedCurves Joining::joined() const {
  ClosedCurves out;
  // Requested begins, by set; a later one replaces an earlier one.
  std::vector<int> beginOf(root_.size(), -1);
  for (const int point : begins_) {
    int set = curveOf(point);
    while (root_[set] != set) set = root_[set];
    beginOf[set] = point;
  }
  for (int c = 0; c < curves_.count(); ++c) {
    if (root_[c] != c) continue;
    // Begin at a point that is still part of the path.
    int start = curves_.begin[c];
    while (start < curves_.begin[c + 1] && inner(start)) ++start;
    if (beginOf[c] >= 0 && !inner(beginOf[c])) start = beginOf[c];
    out.begin.push_back(static_cast<int>(out.points.size()));
    int k = start;
    do {
      out.points.push_back(at(k));
      k = next_[k];
    } while (k != start);
  }
  out.begin.push_back(static_cast<int>(out.points.size()));
  return out;
}

// Piece of `wanted` segments around a point, at most half of its curve, which may be tiny.
Joining::TakenPiece Joining::pieceAround(int point, int wanted) const {
  const int curve = curveOf(point);
  const int first = curves_.begin[curve];
  const int n = curves_.size(curve);
  const int span = std::min(wanted, n / 2);
  const int begin = first + (point - first - span / 2 + n) % n;
  const int end = first + (begin - first + span) % n;
  TakenPiece piece{begin, end, span, 0};
  forSegments(piece, [&](int a, int b) { piece.length += length(at(a) - at(b)); });
  return piece;
}

template <class Visit>
void Joining::forSegments(const TakenPiece& piece, const Visit& visit) const {
  const int curve = curveOf(piece.begin);
  int a = piece.begin;
  for (int k = 0; k < piece.segments; ++k) {
    const int b = nextOf(curves_, curve, a);
    visit(a, b);
    a = b;
  }
}

// Part of a segment that runs across the line there. Directions of a LineField lie across the beads, so that their dot
// product with the segment is its misaligned part.
float Joining::misalignment(Vec2f a, Vec2f b) const {
  const Vec2f e = b - a;
  const float size = length(e);
  if (size <= 0) return 0;
  const Vec2 middle{0.5 * static_cast<double>(a.x + b.x), 0.5 * static_cast<double>(a.y + b.y)};
  const float across = dot(e, lines_.direction[lines_.grid.cellAt(middle)]);
  return across * across / size;
}

float Joining::misalignment(const TakenPiece& piece) const {
  float sum = 0;
  forSegments(piece, [&](int a, int b) { sum += misalignment(at(a), at(b)); });
  return sum;
}

bool Joining::touchesUsed(const TakenPiece& piece) const {
  bool touches = used(piece.begin);
  forSegments(piece, [&](int, int b) { touches = touches || used(b); });
  return touches;
}

// Compares all points of both pieces: there are five of each at most.
bool Joining::overlap(const TakenPiece& a, const TakenPiece& b) const {
  bool meet = a.begin == b.begin;
  forSegments(a, [&](int, int p) {
    meet = meet || p == b.begin;
    forSegments(b, [&](int, int q) { meet = meet || q == p || q == a.begin; });
  });
  return meet;
}

// Inner points leave the path; the two ends stay on it, but serve no other joint.
void Joining::markUsed(const TakenPiece& piece) {
  forSegments(piece, [&](int, int b) { used_[b] = kInner; });
  used_[piece.begin] = kEnd;
  used_[piece.end] = kEnd;
}

void Joining::unmark(const TakenPiece& piece) {
  used_[piece.begin] = kFree;
  forSegments(piece, [&](int, int b) { used_[b] = kFree; });
}

// Tells whether the edge after a point is part of the path: an edge of a curve is, unless it was taken out with a
// piece.
bool Joining::live(int point) const {
  const int next = nextOf(curves_, curveOf(point), point);
  return next_[point] == next && !inner(point) && !inner(next);
}

// Tells whether an edge meets any edge of the path. Looks at it in stretches, so that a long edge costs its length and
// not the square of it.
bool Joining::meetsLiveEdge(const JointEdge& edge) const {
  const Vec2f a = at(edge.from);
  const Vec2f b = at(edge.to);
  const float size = length(b - a);
  const int stretches = static_cast<int>(size / (4 * spacing_)) + 1;
  const float half = 0.5f * size / static_cast<float>(stretches);
  // Points lie tau/4 apart, so that an edge that meets a stretch begins within this reach of its middle.
  const float reach = half + 0.5f * spacing_;
  // A joint is registered within tau/2 of every place on it, a quarter of a cell.
  const int cells = half > spacing_ ? 2 : 1;
  for (int k = 0; k < stretches; ++k) {
    const Vec2f middle = a + (b - a) * ((static_cast<float>(k) + 0.5f) / static_cast<float>(stretches));
    if (meetsCurve(edge, middle, reach) || meetsJoint(edge, middle, cells)) return true;
  }
  return false;
}

// Looks for live edges of curves near to `middle` that meet the edge; those that share an end with it do not count.
bool Joining::meetsCurve(const JointEdge& edge, Vec2f middle, float reach) const {
  bool meets = false;
  grid_.around(middle, reach, [&](int begin, int end) {
    for (int k = begin; k < end && !meets; ++k) {
      const int p = grid_.id[k];
      const int q = nextOf(curves_, curveOf(p), p);
      if (p == edge.from || p == edge.to || q == edge.from || q == edge.to || !live(p)) continue;
      meets = segmentsMeet(at(edge.from), at(edge.to), at(p), at(q));
    }
  });
  return meets;
}

// Looks for edges of other joints in the cells around `middle` that meet the edge.
bool Joining::meetsJoint(const JointEdge& edge, Vec2f middle, int cells) const {
  const auto key = jointCell(middle);
  for (int dy = -cells; dy <= cells; ++dy) {
    for (int dx = -cells; dx <= cells; ++dx) {
      const auto found = joints_.find(packed(key.first + dx, key.second + dy));
      if (found == joints_.end()) continue;
      for (const JointEdge& other : found->second) {
        if (segmentsMeet(at(edge.from), at(edge.to), at(other.from), at(other.to))) return true;
      }
    }
  }
  return false;
}

// Length of an edge outside the shape, by samples. They go from the middle outwards, where a gap lies, and stop once
// more than `enough` is outside.
float Joining::outsideLength(const JointEdge& edge, float enough) const {
  const Vec2 a{static_cast<double>(at(edge.from).x), static_cast<double>(at(edge.from).y)};
  const Vec2 b{static_cast<double>(at(edge.to).x), static_cast<double>(at(edge.to).y)};
  const double size = length(b - a);
  const int samples = static_cast<int>(size / (static_cast<double>(spacing_) / 16)) + 1;
  float outside = 0;
  int count = 0;
  for (int n = 1; n < samples && outside <= enough; ++n) {
    const int k = samples / 2 + (n % 2 == 0 ? n / 2 : -(n / 2));
    const Vec2 p = a + (b - a) * (static_cast<double>(k) / samples);
    if (!border_.outside(p)) continue;
    if (std::abs(border_.nearest(p).distance) > farthest_) return std::numeric_limits<float>::infinity();
    outside = static_cast<float>(++count * size / samples);
  }
  return outside;
}

// Cell, two spacings wide, in which a place of a joint is registered.
std::pair<int, int> Joining::jointCell(Vec2f p) const {
  const float size = 2 * spacing_;
  return {static_cast<int>(std::floor(p.x / size)), static_cast<int>(std::floor(p.y / size))};
}

// Calls visit with the joints registered in each cell that an edge passes, by samples half a cell apart.
template <class Visit>
void Joining::forCells(const JointEdge& edge, const Visit& visit) {
  const Vec2f a = at(edge.from);
  const Vec2f b = at(edge.to);
  const int steps = static_cast<int>(length(b - a) / spacing_) + 1;
  std::pair<int, int> last{INT32_MIN, INT32_MIN};
  for (int k = 0; k <= steps; ++k) {
    const auto key = jointCell(a + (b - a) * (static_cast<float>(k) / static_cast<float>(steps)));
    if (key != last) visit(joints_[packed(key.first, key.second)]);
    last = key;
  }
}

void Joining::addJoint(const JointEdge& edge) {
  forCells(edge, [&](std::vector<JointEdge>& in) { in.push_back(edge); });
}

void Joining::removeJoint(const JointEdge& edge) {
  forCells(edge, [&](std::vector<JointEdge>& in) {
    std::erase_if(in, [&](const JointEdge& other) { return other.from == edge.from && other.to == edge.to; });
  });
}

}  // namespace sillon
